#include "live/kept_object.h"

#include <algorithm>
#include <chrono>
#include <set>
#include <sstream>
#include <utility>

#include "live/compile.h"
#include "relief/check/hash.h"
#include "relief/file.h"

namespace relief::samples::live {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMost = 200;  // objects; about 100 KB each

std::span<const std::uint8_t> bytesOf(const std::string& text)
{
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

// What changes when a large file does.
std::string stampOf(const fs::path& file)
{
    std::error_code error;
    const auto time = fs::last_write_time(file, error);
    if (error) return "";
    return std::to_string(fs::file_size(file, error)) + " " + std::to_string(time.time_since_epoch().count());
}

// "object: file \ file ...", as make reads it; spaces in names have a backslash before them.
std::vector<std::string> filesOfList(const std::string& list)
{
    std::vector<std::string> files(1);
    for (std::size_t i = list.find(": ") + 2; i < list.size(); ++i) {
        if (list[i] == '\\' && i + 1 < list.size() && list[i + 1] == ' ') {
            files.back() += list[++i];
        } else if (list[i] == ' ' || list[i] == '\n' || list[i] == '\\') {
            if (!files.back().empty()) files.emplace_back();
        } else {
            files.back() += list[i];
        }
    }
    files.pop_back();
    return files;
}

// The oldest go, and with each the list of its text: what else was made of the same text is compiled again.
void makeRoom(const fs::path& folder)
{
    std::vector<std::pair<fs::file_time_type, fs::path>> objects;
    std::error_code error;
    for (const auto& file : fs::directory_iterator(folder, error)) {
        if (file.path().extension() == ".so") objects.emplace_back(file.last_write_time(error), file.path());
    }
    if (objects.size() <= kMost) return;
    std::sort(objects.begin(), objects.end());
    for (std::size_t i = 0; i < objects.size() - kMost; ++i) {
        fs::remove(objects[i].second, error);
        const std::string stem = objects[i].second.stem().string();
        fs::remove(folder / (stem.substr(0, stem.find('-')) + ".txt"), error);
    }
}

}  // namespace

KeptObject::KeptObject(const std::string& compiler, const std::vector<std::string>& words, const SourceText& source)
    : folder(fs::path(liveFolder()) / "kept")
{
    std::string all = compiler + '\0' + stampOf(compiler) + '\0';
    for (const std::string& word : words) {
        all += word + '\0';
        if (!word.starts_with("-")) all += stampOf(word) + '\0' + stampOf(word + ".gch") + '\0';  // precompiled
    }
    name = hexadecimal(hashOf(bytesOf(all + source.path + '\0' + source.text)));
}

fs::path KeptObject::included() const
{
    return folder / (name + ".txt");
}

// It is named after what is in the files that the text includes; empty if one of them cannot be read.
fs::path KeptObject::object(const std::string& names) const
{
    std::string all;
    std::istringstream list(names);
    for (std::string file; std::getline(list, file);) {
        const Expected<std::string> text = readText(file);
        if (!text) return {};
        all += hexadecimal(hashOf(bytesOf(*text)));
    }
    return folder / (name + "-" + hexadecimal(hashOf(bytesOf(all))) + ".so");
}

bool KeptObject::copyTo(const std::string& path) const
{
    const Expected<std::string> names = readText(included().string());
    const fs::path kept = names ? object(*names) : fs::path();
    std::error_code error;
    if (kept.empty() || !fs::copy_file(kept, path, error)) return false;
    fs::last_write_time(kept, fs::file_time_type::clock::now(), error);
    return true;
}

void KeptObject::keep(const std::string& path, const std::vector<std::string>& lists, fs::file_time_type begin) const
{
    const fs::file_time_type latest = begin - std::chrono::milliseconds(20);  // what files' times may lag behind
    std::set<std::string> names;
    for (const std::string& list : lists) {
        const Expected<std::string> text = readText(list);
        if (!text) return;
        for (const std::string& file : filesOfList(*text)) {
            if (fs::path(file) == fs::path(list).replace_extension(".cpp")) continue;  // the text, which the name has
            std::error_code error;
            if (fs::last_write_time(file, error) >= latest || error) return;  // perhaps after the compiler read it
            names.insert(file);
        }
    }
    std::string all;
    for (const std::string& file : names) all += file + '\n';
    const fs::path kept = object(all);
    std::error_code error;
    fs::create_directories(folder, error);
    const fs::path beside = kept.string() + "." + fs::path(path).parent_path().filename().string();
    if (kept.empty() || !fs::copy_file(path, beside, error)) {
        fs::remove(beside, error);
        return;
    }
    fs::rename(beside, kept, error);
    (void)writeFileAtomically(included().string(), bytesOf(all));
    makeRoom(folder);
}

}  // namespace relief::samples::live
