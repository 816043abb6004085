#include "relief/scene/gltf_text.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "relief/file.h"

namespace relief {
namespace {

// A little-endian word of 32 bits.
std::uint64_t wordAt(std::span<const std::uint8_t> file, std::size_t at)
{
    std::uint64_t word = 0;
    for (std::size_t i = 0; i < 4; ++i) word |= std::uint64_t{file[at + i]} << (8 * i);
    return word;
}

// What has to be an integer, 0 or more, wherever it is no object and no array.
constexpr std::array<std::string_view, 20> kIntegers = {
    "buffer",        "bufferView", "byteLength", "byteOffset", "byteStride", "camera",  "children",
    "componentType", "count",      "index",      "indices",    "material",   "mesh",    "mode",
    "nodes",         "sampler",    "scene",      "skin",       "source",     "texCoord"};

constexpr std::array<std::string_view, 5> kUnderstood = {"KHR_texture_transform", "KHR_materials_unlit",
                                                         "KHR_materials_emissive_strength", "KHR_mesh_quantization",
                                                         "KHR_lights_punctual"};

// What is a list in glTF 2.0 and an object in 1.0.
constexpr std::array<std::string_view, 4> kLists = {"accessors", "buffers", "meshes", "nodes"};

bool isAmong(std::string_view name, std::span<const std::string_view> names)
{
    return std::find(names.begin(), names.end(), name) != names.end();
}

// Walks through the JSON (nlohmann's SAX interface) and stops at the first problem.
struct Checker
{
    struct Level
    {
        bool isArray;
        std::size_t index = 0;  // of an array's element
        std::string key;        // of an object's
        bool isFree = false;    // within extras or extensions
    };
    std::vector<Level> levels;
    std::uint64_t bufferBytes = 0;
    std::string problem;

    // "accessors[3].bufferView"
    std::string path() const
    {
        std::string text;
        for (const Level& level : levels) {
            if (level.isArray)
                text += "[" + std::to_string(level.index) + "]";
            else
                text += (text.empty() ? "" : ".") + level.key;
        }
        return text.empty() ? "the file" : text;
    }

    bool stop(const std::string& what)
    {
        if (problem.empty()) problem = path() + " " + what;
        return false;
    }

    // The key that the value at hand belongs to: an element of an array belongs to the array's.
    std::string_view key() const
    {
        const auto object = std::find_if(levels.rbegin(), levels.rend(), [](const Level& l) { return !l.isArray; });
        return object != levels.rend() ? std::string_view(object->key) : std::string_view();
    }
    bool isFree() const { return !levels.empty() && levels.back().isFree; }
    bool hasToBeInteger() const { return !isFree() && isAmong(key(), kIntegers); }

    bool next()
    {
        if (!levels.empty() && levels.back().isArray) ++levels.back().index;
        return true;
    }
    bool scalar() { return hasToBeInteger() ? stop("is not an integer; export the file again") : next(); }

    bool null() { return scalar(); }
    bool boolean(bool) { return scalar(); }
    bool number_float(double, const std::string&) { return scalar(); }
    bool string(std::string& text)
    {
        if (levels.size() == 2 && levels[0].key == "extensionsRequired" && !isUnderstood(text)) {
            return stop("requires " + text + ", which is not supported; export the file without it");
        }
        return scalar();
    }
    bool binary(std::vector<std::uint8_t>&) { return scalar(); }
    bool number_integer(std::int64_t value)
    {
        return hasToBeInteger() && value < 0 ? stop("is negative; export the file again") : next();
    }
    bool number_unsigned(std::uint64_t value)
    {
        if (hasToBeInteger() && value > 0x7fffffffu) return stop("is larger than 2147483647; export the file again");
        if (levels.size() == 3 && levels[0].key == "buffers" && key() == "byteLength") bufferBytes += value;
        if (bufferBytes > kMaxFileBytes) return stop("makes the buffers larger than 1 GiB; split the file");
        return next();
    }

    bool start(bool isArray)
    {
        if (levels.size() >= static_cast<std::size_t>(kMaxJsonDepth)) {
            problem = "the JSON is nested more than " + std::to_string(kMaxJsonDepth) + " deep; export the file again";
            return false;
        }
        levels.push_back({.isArray = isArray, .index = 0, .key = "", .isFree = isFree()});
        return true;
    }
    bool end()
    {
        levels.pop_back();
        return next();
    }
    bool start_object(std::size_t)
    {
        if (levels.size() == 1 && isAmong(key(), kLists)) return stop("is no list, as in glTF 1.0; convert it to 2.0");
        return start(false);
    }
    bool start_array(std::size_t) { return start(true); }
    bool end_object() { return end(); }
    bool end_array() { return end(); }
    bool key(std::string& name)
    {
        levels.back().key = name;
        levels.back().isFree =
            name == "extras" || name == "extensions" || (levels.size() > 1 && levels[levels.size() - 2].isFree);
        return true;
    }

    template <class Exception>
    bool parse_error(std::size_t position, const std::string&, const Exception&)
    {
        problem = "is no JSON from byte " + std::to_string(position) + " on; copy or export it again";
        return false;
    }
};

}  // namespace

bool isUnderstood(std::string_view extension)
{
    return isAmong(extension, kUnderstood);
}

Expected<GltfText> gltfText(std::span<const std::uint8_t> file)
{
    const std::string_view whole(reinterpret_cast<const char*>(file.data()), file.size());
    if (!whole.starts_with("glTF")) return GltfText{whole, false};
    const auto truncated = [&](std::uint64_t expected) {
        return fail("is truncated (" + std::to_string(file.size()) + " of " + std::to_string(expected) +
                    " bytes); copy or export it again");
    };
    if (file.size() < 20) return truncated(20);
    if (const std::uint64_t version = wordAt(file, 4); version != 2) {
        return fail("is a .glb of version " + std::to_string(version) + "; convert it to version 2");
    }
    const std::uint64_t length = wordAt(file, 8), jsonLength = wordAt(file, 12);
    if (length > file.size()) return truncated(length);
    const bool isJson = wordAt(file, 16) == 0x4e4f534a;
    if (!isJson || jsonLength == 0 || 20 + jsonLength > length) {
        return fail("is damaged (its first chunk is not JSON within the file); copy or export it again");
    }
    if (20 + jsonLength + 8 <= length) {
        const std::uint64_t binary = wordAt(file, static_cast<std::size_t>(20 + jsonLength));
        if (28 + jsonLength + binary > length) {
            return fail("is damaged (its second chunk does not fit into the file); copy or export it again");
        }
    }
    return GltfText{whole.substr(20, static_cast<std::size_t>(jsonLength)), true};
}

Expected<void> checkGltfText(std::string_view json)
{
    Checker checker;
    if (nlohmann::json::sax_parse(json, &checker)) return {};
    return fail(checker.problem);
}

}  // namespace relief
