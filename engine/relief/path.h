// Paths of files are text in UTF-8 everywhere in the engine; this is where they become what the system wants. Included
// by sources only: <filesystem> takes long to compile.
#pragma once

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>

namespace relief {

// Windows would take a std::string for text in the user's code page.
inline std::filesystem::path pathOf(const std::string& utf8)
{
    return std::filesystem::path(std::u8string(utf8.begin(), utf8.end()));
}

inline std::string utf8Of(const std::filesystem::path& path)
{
    const std::u8string text = path.u8string();
    return {text.begin(), text.end()};
}

// Whether the name ends with one of these, which are in small letters; the name's letters may be of either case.
inline bool hasEnding(const std::string& name, std::initializer_list<std::string_view> endings)
{
    const auto same = [](char letter, char small) {
        return letter == small || (letter >= 'A' && letter <= 'Z' && letter - 'A' + 'a' == small);
    };
    return std::any_of(endings.begin(), endings.end(), [&](std::string_view ending) {
        return name.size() >= ending.size() && std::equal(ending.rbegin(), ending.rend(), name.rbegin(),
                                                          [&](char small, char letter) { return same(letter, small); });
    });
}

}  // namespace relief
