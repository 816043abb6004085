// relief_instrument FROM... TO: copies in which shaders' functions are instrumented: of a folder's headers, for what
// traced stages are compiled with, and of a stage FOLDER/STEM.cpp, to TO/FOLDER/STEM.cpp.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "trace/instrument.h"

namespace {

namespace fs = std::filesystem;

// What a fragment program can call and a reader wants to look into.
bool holdsShaders(const fs::path& header)
{
    const std::string name = header.filename().string(), folder = header.parent_path().filename().string();
    if (folder == "shading") return name != "camera.h" && name != "environment.h" && name != "loop.h";
    return folder == "common" && (name == "triplanar_methods.h" || name == "false_color.h" || name == "screen_quad.h");
}

// `name`: what the copy calls the file.
bool copy(const fs::path& from, const fs::path& to, const std::string& name, bool instrument)
{
    std::ifstream in(from, std::ios::binary);
    std::stringstream all;
    all << in.rdbuf();
    const std::string text = all.str();
    fs::create_directories(to.parent_path());
    std::ofstream out(to, std::ios::binary);
    out << "#line 1 \"" << from.string() << "\"\n"
        << (instrument ? relief::samples::trace::instrumented(text, name) : text);
    return in.good() && out.good();
}

}  // namespace

int main(int argc, char** argv)
{
    const fs::path to = argc > 2 ? argv[argc - 1] : "";
    for (int i = 1; i + 1 < argc; ++i) {
        const fs::path from = argv[i];
        const std::string name = from.filename().string();
        const auto copied = [](const fs::path& file, const fs::path& there, const std::string& itsName,
                               bool instrument) {
            const bool done = copy(file, there, itsName, instrument);
            if (!done) std::fprintf(stderr, "relief_instrument: %s: cannot be copied\n", file.c_str());
            return done;
        };
        if (from.extension() == ".cpp") {
            if (!copied(from, to / from.parent_path().filename() / name, name, true)) return 1;
            continue;
        }
        for (const fs::directory_entry& file : fs::recursive_directory_iterator(from)) {
            if (file.path().extension() != ".h") continue;
            const fs::path relative = fs::relative(file.path(), from);
            const std::string itsName = name + "/" + relative.generic_string();
            if (!copied(file.path(), to / name / relative, itsName, holdsShaders(file.path()))) return 1;
        }
    }
    return 0;
}
