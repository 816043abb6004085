// relief_instrument FROM... TO: copies the headers of folders, in which shaders' functions are instrumented, for the
// precompiled headers that traced stages are compiled with.
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

bool copyHeader(const fs::path& from, const fs::path& to, const std::string& name)
{
    std::ifstream in(from, std::ios::binary);
    std::stringstream all;
    all << in.rdbuf();
    const std::string text = all.str();
    fs::create_directories(to.parent_path());
    std::ofstream out(to, std::ios::binary);
    out << "#line 1 \"" << from.string() << "\"\n"
        << (holdsShaders(from) ? relief::samples::trace::instrumented(text, name) : text);
    return in.good() && out.good();
}

}  // namespace

int main(int argc, char** argv)
{
    const fs::path to = argc > 2 ? argv[argc - 1] : "";
    for (int i = 1; i + 1 < argc; ++i) {
        const fs::path folder = argv[i];
        const std::string name = folder.filename().string();
        for (const fs::directory_entry& file : fs::recursive_directory_iterator(folder)) {
            if (file.path().extension() != ".h") continue;
            const fs::path relative = fs::relative(file.path(), folder);
            if (!copyHeader(file.path(), to / name / relative, name + "/" + relative.generic_string())) {
                std::fprintf(stderr, "relief_instrument: %s: cannot be copied\n", file.path().c_str());
                return 1;
            }
        }
    }
    return 0;
}
