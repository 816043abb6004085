// Objects of stages stay below the build's folder, the newest of them: a stage that is opened again, or of which one
// pixel is traced after the other, is compiled once. Where they cannot be read or written, all is compiled every time.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace relief::samples::live {

struct SourceText;

class KeptObject
{
public:
    // What this compiler makes of this text with these words.
    KeptObject(const std::string& compiler, const std::vector<std::string>& words, const SourceText& source);

    // Copies it to this path. False if there is none, or the compiler, the precompiled headers or a file that the text
    // includes are others now.
    bool copyTo(const std::string& object) const;

    // Keeps this object, of a compile that began then. Each of `lists` is what a compiler says that it read (-MMD -MF),
    // beside the .cpp file that it compiled.
    void keep(const std::string& object, const std::vector<std::string>& lists,
              std::filesystem::file_time_type begin) const;

private:
    std::filesystem::path included() const;  // the list of files that the text includes
    std::filesystem::path object(const std::string& names) const;

    std::filesystem::path folder;
    std::string name;
};

}  // namespace relief::samples::live
