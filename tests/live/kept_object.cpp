// Objects that stay: given again for the same text, and for nothing else.
#include <filesystem>
#include <fstream>

#include <doctest/doctest.h>

#include "live/compile.h"
#include "live/kept_object.h"
#include "live/new_stage.h"
#include "relief/file.h"
#include "temporary_folder.h"

namespace {

using namespace relief;
using namespace relief::samples::live;
namespace fs = std::filesystem;
using Words = std::vector<std::string>;

void write(const fs::path& path, const std::string& text)
{
    std::ofstream(path, std::ios::binary) << text;
    fs::last_write_time(path, fs::file_time_type::clock::now() - std::chrono::minutes(1));
}

// A compiler, headers, and what a compile leaves behind in a folder of its own; the folder's name is in every text, so
// that nothing was kept of it before.
struct Compiling
{
    TemporaryFolder folder;
    std::string compiler = (folder / "compiler").string(), precompiled = (folder / "all headers.pch").string(),
                header = (folder / "my header.h").string(), text = "// " + folder.path.string() + "\nthe text";
    Words words = {"-O1", "-include-pch", precompiled};

    Compiling()
    {
        write(compiler, "compiler");
        write(precompiled, "precompiled");
        write(header, "header");
        fs::create_directory(folder / "private");
        write(folder / "private" / "1.so", "object");
        write(folder / "private" / "1.cpp", "what the compiler got");
        write(folder / "private" / "1.d", "1.o: " + (folder / "private" / "1.cpp").string() + " \\\n  " +
                                              folder.path.string() + "/my\\ header.h\n");
    }
    KeptObject kept() const { return {compiler, words, {"stage.cpp", text}}; }
    void keep() const { keepSince(fs::file_time_type::clock::now()); }
    void keepSince(fs::file_time_type begin) const
    {
        kept().keep((folder / "private" / "1.so").string(), {(folder / "private" / "1.d").string()}, begin);
    }
    bool isKept() const
    {
        const std::string copy = (folder / "copy.so").string();
        fs::remove(copy);
        const bool is = kept().copyTo(copy);
        CHECK(fs::exists(copy) == is);
        if (is) CHECK(*readText(copy) == "object");
        return is;
    }
};

}  // namespace

TEST_CASE("live: an object is kept for its text, compiler and headers, and for no others")
{
    Compiling compiling;
    CHECK_FALSE(compiling.isKept());
    compiling.keep();
    CHECK(compiling.isKept());

    const auto changed = [&](std::string& what, const std::string& now) {
        const std::string before = std::exchange(what, now);
        CHECK_FALSE(compiling.isKept());
        what = before;
        CHECK(compiling.isKept());
    };
    changed(compiling.text, compiling.text + " ");
    changed(compiling.words[0], "-O2");
    changed(compiling.compiler, (compiling.folder / "other").string());

    // What is in a header counts, and not when it was written.
    write(compiling.header, "Header");
    CHECK_FALSE(compiling.isKept());
    write(compiling.header, "header");
    CHECK(compiling.isKept());
    fs::remove(compiling.header);
    CHECK_FALSE(compiling.isKept());
    write(compiling.header, "header");

    // Large files count by size and time.
    for (const std::string& file : {compiling.compiler, compiling.precompiled}) {
        CAPTURE(file);
        write(file, "a new version");
        CHECK_FALSE(compiling.isKept());
        compiling.keep();
        CHECK(compiling.isKept());
    }
}

TEST_CASE("live: an object is not kept if a header was saved while it was compiled")
{
    const Compiling compiling;
    compiling.keepSince(fs::file_time_type::clock::now() - std::chrono::minutes(2));
    CHECK_FALSE(compiling.isKept());
    compiling.keep();
    CHECK(compiling.isKept());
}

TEST_CASE("live: a stage that was compiled before is not compiled again, until a file that it includes is another one")
{
    const TemporaryFolder folder;
    const std::string path = (folder / "my_shader.cpp").string(), header = (folder / "mine.h").string();
    REQUIRE(writeNewStage(path, ""));
    const std::string text = "#include \"mine.h\"\n" + *readText(path);
    const Toolchain& toolchain = **findToolchain();
    int version = 0;
    const auto isCompiled = [&] {
        Compile compile(toolchain.path, toolchain.words, {path, text}, {.parts = 1, .owners = {}}, folder.path.string(),
                        ++version);
        const Compiled compiled = compile.wait();
        REQUIRE(compiled.object == (folder / (std::to_string(version) + ".so")).string());
        CHECK(fs::file_size(compiled.object) > 10000);
        return compiled.compileMilliseconds > 0.0;
    };
    write(header, "// one\n");
    CHECK(isCompiled());
    CHECK_FALSE(isCompiled());
    write(header, "// two\n");
    CHECK(isCompiled());
    write(header, "// one\n");
    CHECK_FALSE(isCompiled());
}
