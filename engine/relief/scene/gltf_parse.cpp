#include "relief/scene/gltf_parse.h"

#include <cstdint>
#include <exception>
#include <utility>
#include <vector>

#include "relief/file.h"
#include "relief/path.h"
#include "relief/scene/gltf_text.h"
#include "relief/scene/tinygltf.h"

namespace relief {
namespace {

std::string folderOf(const std::string& path)
{
    return utf8Of(pathOf(path).parent_path());
}

// tinygltf asks whether a file exists to look for it in the current folder, too: there is only the one beside it.
bool exists(const std::string&, void*)
{
    return true;
}

std::string samePath(const std::string& path, void*)
{
    return path;
}

// What tinygltf is reading.
struct Reading
{
    const std::string& path;  // the .gltf file's
    std::vector<GltfBuffer> buffers;
    std::string problem;
};

// Leaves what went wrong with the Reading that `user` is.
bool readWhole(std::vector<unsigned char>* bytes, std::string*, const std::string& path, void* user)
{
    auto& [gltfPath, buffers, problem] = *static_cast<Reading*>(user);
    if (path.find("data:") != std::string::npos) {
        problem = "a data URI of a buffer is not application/octet-stream in base64; export the file again";
        return false;
    }
    Expected<std::vector<std::uint8_t>> file = readFile(path);
    if (!file) {
        problem = file.error().message;
        return false;
    }
    *bytes = std::move(*file);
    // A buffer's file may be longer than the buffer, which tinygltf takes for an error.
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        if (buffers[i].uri.empty() || pathBeside(gltfPath, buffers[i].uri) != path) continue;
        if (bytes->size() < buffers[i].byteLength) {
            problem = path + ": has " + std::to_string(bytes->size()) + " bytes, and buffers[" + std::to_string(i) +
                      "].byteLength is " + std::to_string(buffers[i].byteLength) + "; copy or export it again";
            return false;
        }
        bytes->resize(static_cast<std::size_t>(std::exchange(buffers[i], {}).byteLength));  // each is read once
        break;
    }
    return true;
}

// Of a picture in a data URI. Those in buffer views are not looked at: their view is not checked yet.
bool keepBytes(tinygltf::Image* image, const int, std::string*, std::string*, int, int, const unsigned char* bytes,
               int size, void*)
{
    if (image->bufferView < 0) image->image.assign(bytes, bytes + size);
    return true;
}

}  // namespace

std::string pathBeside(const std::string& gltfPath, const std::string& uri)
{
    const auto digit = [](char c) {
        return c >= '0' && c <= '9'   ? c - '0'
               : c >= 'a' && c <= 'f' ? c - 'a' + 10
               : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                      : -1;
    };
    std::string name;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const bool isCode = uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0;
        name += isCode ? static_cast<char>(digit(uri[i + 1]) * 16 + digit(uri[i + 2])) : uri[i];
        if (isCode) i += 2;
    }
    const std::string folder = folderOf(gltfPath);
    return folder.empty() ? name : folder + "/" + name;
}

Expected<void> parseGltf(const std::string& path, tinygltf::Model& model)
{
    Expected<std::vector<std::uint8_t>> bytes = readFile(path);
    if (!bytes) return tl::unexpected(bytes.error());
    const auto failHere = [&path](const std::string& what) { return fail(path + ": " + what); };
    const Expected<GltfText> text = gltfText(*bytes);
    if (!text) return failHere(text.error().message);
    Expected<std::vector<GltfBuffer>> buffers = checkGltfText(text->json);
    if (!buffers) return failHere(buffers.error().message);

    tinygltf::TinyGLTF reader;
    std::string problem, warning;
    Reading reading = {path, std::move(*buffers), ""};
    reader.SetFsCallbacks({exists, samePath, readWhole, nullptr, &reading});
    reader.SetImageLoader(keepBytes, nullptr);
    const auto load = [&] {
        const auto length = static_cast<unsigned>(text->json.size());
        const std::string folder = folderOf(path);
        return text->isBinary
                   ? reader.LoadBinaryFromMemory(&model, &problem, &warning, bytes->data(),
                                                 static_cast<unsigned>(bytes->size()), folder)
                   : reader.LoadASCIIFromString(&model, &problem, &warning, text->json.data(), length, folder);
    };
    bool done = false;
#if defined(__cpp_exceptions)
    try {
        done = load();
    } catch (const std::exception& exception) {
        problem = exception.what();
    }
#else
    done = load();  // what checkGltfText did not refuse and the library throws for ends the program
#endif
    while (problem.ends_with('\n') || problem.ends_with('.')) problem.pop_back();  // tinygltf's own words
    if (!reading.problem.empty()) return failHere(reading.problem);
    if (!done) return failHere((problem.empty() ? "is damaged" : problem) + "; export it again");
    if (!model.asset.version.starts_with("2.")) {
        return failHere("asset.version: is '" + model.asset.version + "'; convert it to glTF 2.0");
    }
    return {};
}

}  // namespace relief
