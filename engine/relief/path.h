// Paths of files are text in UTF-8 everywhere in the engine; this is where they become what the system wants. Included
// by sources only: <filesystem> takes long to compile.
#pragma once

#include <filesystem>
#include <string>

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

}  // namespace relief
