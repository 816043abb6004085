// The command `relief check` as a user meets it: pictures of other programs, folders, lists, and bad input.
#include <filesystem>
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "live_command.h"
#include "png16.h"
#include "relief/check/record.h"
#include "relief/texture/image.h"

namespace {

namespace fs = std::filesystem;
using namespace relief;

Outcome check(const TemporaryFolder& folder, const std::string& arguments)
{
    unsetenv("CI");
    return runCommand(folder, "check " + arguments, "relief_goldens");
}

// A small PNG of one colour.
void writeGrey(const fs::path& path, std::uint8_t value, int width = 6, int height = 4)
{
    fs::create_directories(path.parent_path());
    REQUIRE(
        writePng(path, width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(width * height) * 4, value)));
}

void checkRefused(const TemporaryFolder& folder, const std::string& arguments, const std::string& words)
{
    const Outcome outcome = check(folder, arguments);
    CAPTURE(arguments);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 2);
    CHECK(outcome.err.find(words) != std::string::npos);
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
}

bool says(const Outcome& outcome, const std::string& words)
{
    CAPTURE(words);
    CAPTURE(outcome.out);
    const bool found = outcome.out.find(words) != std::string::npos;
    CHECK(found);
    return found;
}

// A PNG as other programs write it: a palette of two colours and four bits a pixel, in a stored zlib stream.
std::string palettePng()
{
    const std::string rows = std::string("\0\x01\x01", 3) + std::string("\0\x10\x10", 3);
    std::uint32_t a = 1, b = 0;
    for (const char byte : rows) {
        a = (a + static_cast<std::uint8_t>(byte)) % 65521;
        b = (b + a) % 65521;
    }
    const std::string zlib = std::string("\x78\x01\x01\x06\x00\xf9\xff", 7) + rows + bigEndian(b << 16 | a);
    return "\x89PNG\r\n\x1a\n" + chunk("IHDR", bigEndian(4) + bigEndian(2) + std::string("\x04\x03\0\0\0", 5)) +
           chunk("PLTE", std::string("\xff\0\0\0\0\xff", 6)) + chunk("IDAT", zlib) + chunk("IEND", "");
}

}  // namespace

TEST_CASE("check compare: 0 the same, 1 different, 2 no picture")
{
    const TemporaryFolder folder;
    writeGrey(folder / "a.png", 10);
    writeGrey(folder / "b.png", 12);
    writeGrey(folder / "large.png", 10, 7, 4);
    CHECK(check(folder, "compare a.png a.png").code == 0);
    const Outcome different = check(folder, "compare a.png b.png -o difference.png");
    CHECK(different.code == 1);
    says(different, "24 pixels differ, the largest difference is 2, 24 lie in one square of 8x8\n  (0, 0)  is  10");
    CHECK(readImage(folder / "difference.png"));
    CHECK(check(folder, "compare a.png b.png --range pixels=20-24,largest=2").code == 0);
    const Outcome better = check(folder, "compare a.png b.png --range pixels=25-30,largest=2");
    CHECK(better.code == 1);
    says(better, "the picture is better than that");
    CHECK(check(folder, "compare a.png a.png --range pixels=1-9,largest=2").code == 1);
    const Outcome size = check(folder, "compare a.png large.png");
    CHECK(size.code == 1);
    says(size, "a.png: is 6x4 and should be 7x4");
    checkRefused(folder, "compare a.png nothing.png", "nothing.png");
    folder.write("text.png", "no picture");
    checkRefused(folder, "compare text.png a.png", "text.png");
    checkRefused(folder, "compare a.png b.png --range pixels=3", "give both");
    checkRefused(folder, "compare a.png", "golden");
    checkRefused(folder, "compare a.png b.png -o none/d.png", "none");
    checkRefused(folder, "", "subcommand");
}

TEST_CASE("check compare: pictures of other programs, 16 bits, and floats")
{
    const TemporaryFolder folder;
    folder.write("palette.png", palettePng());
    std::vector<std::uint8_t> rgba;
    for (const int color : {0, 1, 0, 1, 1, 0, 1, 0}) {
        for (const int channel : {color == 0 ? 255 : 0, 0, color == 1 ? 255 : 0, 255})
            rgba.push_back(static_cast<std::uint8_t>(channel));
    }
    REQUIRE(writePng(folder / "plain.png", 4, 2, rgba));
    const Outcome same = check(folder, "compare palette.png plain.png");
    CHECK(same.code == 0);
    says(same, "the same: 4x2, 8-bit");

    folder.write("a16.png", png16(3, 1, {1, 500, 65535}));
    folder.write("b16.png", png16(3, 1, {1, 503, 65535}));
    CHECK(check(folder, "compare a16.png a16.png").code == 0);
    says(check(folder, "compare a16.png b16.png"), "1 pixel differs, the largest difference is 3");
    says(check(folder, "compare a16.png plain.png"), "is 3x1 and should be 4x2");

    REQUIRE(writePfm(folder / "a.pfm", 1, 1, std::vector<float>{0.5f, 1.0f, 2.0f}));
    REQUIRE(writePfm(folder / "b.pfm", 1, 1, std::vector<float>{0.50000006f, 1.0f, 2.0f}));
    says(check(folder, "compare b.pfm a.pfm"), "the largest difference is 1");
    CHECK(check(folder, "compare b.pfm a.pfm --range pixels=1,largest=1").code == 0);
}

TEST_CASE("check folder: what is the same, different, missing, unreadable, of another size, and unused")
{
    const TemporaryFolder folder;
    for (const char* name :
         {"same.png", "deep/different.png", "size.png", "unreadable.png", "ranged.png", "new & <odd>.png"})
        writeGrey(folder / "actual" / name, 10);
    writeGrey(folder / "golden/same.png", 10);
    writeGrey(folder / "golden/deep/different.png", 13);
    writeGrey(folder / "golden/ranged.png", 11);
    writeGrey(folder / "golden/size.png", 10, 5, 5);
    writeGrey(folder / "golden/unused.png", 10);
    folder.write("golden/unreadable.png", "no picture");
    folder.write("ranges.txt", "# measured\nranged.png pixels=20-24 largest=1-2\n");
    const std::string both = "folder actual golden --ranges ranges.txt --failures failures";
    const Outcome outcome = check(folder, both + " --junit junit.xml");
    CHECK(outcome.code == 1);
    says(outcome, "2 of 7 pictures are as they should be");
    says(outcome, "deep/different.png: 24 pixels differ\n  golden      ");
    says(outcome, "new & <odd>.png: there is no golden, so this picture is a candidate");
    says(outcome, "size.png: is 6x4 and should be 5x5");
    says(outcome, "unreadable.png: the golden cannot be read: ");
    says(outcome, "unused.png: there is no picture of this golden");
    CHECK(readImage(folder / "failures/deep/different.png.difference.png"));
    const std::string xml = contents(folder / "junit.xml");
    CHECK(xml.find("tests=\"7\" failures=\"5\"") != std::string::npos);
    CHECK(xml.find("name=\"new &amp; &lt;odd&gt;.png\"") != std::string::npos);
    CHECK(xml.find("classname=\"deep\" name=\"different.png\"") != std::string::npos);

    // Two threads or one, the same; a run removes what the one before has left.
    CHECK(check(folder, both + " --threads 1").out == outcome.out);
    fs::remove(folder / "golden/unused.png");
    CHECK(check(folder, both).code == 1);
    CHECK_FALSE(fs::exists(folder / "failures/unused.png.json"));

    const std::string before = contents(folder / "golden/same.png");
    const fs::file_time_type longAgo = fs::file_time_type::clock::now() - std::chrono::hours(100);
    fs::last_write_time(folder / "golden/same.png", longAgo);
    setenv("CI", "false", 1);
    CHECK(runCommand(folder, "check " + both + " --update", "relief_goldens").code == 2);
    CHECK(contents(folder / "err.txt").find("the environment has CI set") != std::string::npos);
    CHECK(contents(folder / "golden/unreadable.png") == "no picture");
    const Outcome update = check(folder, both + " --update");
    CHECK(update.code == 1);
    for (const char* name : {"deep/different.png", "size.png", "unreadable.png", "new & <odd>.png"}) {
        says(update, "updated: " + (folder / "golden").string() + "/" + name);
        CHECK(contents(folder / "golden" / name) == contents(folder / "actual" / name));
    }
    CHECK(fs::last_write_time(folder / "golden/same.png") == longAgo);
    CHECK(check(folder, both).code == 0);
}

TEST_CASE("check folder: bad input")
{
    const TemporaryFolder folder;
    fs::create_directories(folder / "empty");
    writeGrey(folder / "golden/a.png", 10);
    checkRefused(folder, "folder nothing golden", "nothing");
    checkRefused(folder, "folder golden nothing", "nothing");
    checkRefused(folder, "folder empty empty", "has no pictures");
    folder.write("ranges.txt", "a.png\n");
    checkRefused(folder, "folder golden golden --ranges ranges.txt", "line 1: has no range");
    folder.write("ranges.txt", "a.png pixels=1 largest=x\n");
    checkRefused(folder, "folder golden golden --ranges ranges.txt", "line 1");
    folder.write("ranges.txt", "b.png pixels=1 largest=1\n");
    checkRefused(folder, "folder golden golden --ranges ranges.txt", "b.png");
    folder.write("file", "");
    checkRefused(folder, "folder golden golden --failures file/x", "file/x");
    checkRefused(folder, "folder golden golden --failures f --junit none/x.xml", "none");
}

TEST_CASE("check accept: what the list says and nothing else, all or nothing")
{
    const TemporaryFolder folder;
    for (const char* name : {"a.png", "b.png", "c.png"}) {
        writeGrey(folder / "actual" / name, 10);
        writeGrey(folder / "golden" / name, 20);
    }
    writeGrey(folder / "golden/unused.png", 10);
    CHECK(check(folder, "folder actual golden --failures failures").code == 1);
    const Expected<std::vector<GoldenRecord>> records = readRecords(folder / "failures");
    REQUIRE(records);
    const auto entry = [&](std::size_t i, const std::string& hash = "") {
        return nlohmann::json{{"name", (*records)[i].name}, {"hash", hash.empty() ? (*records)[i].actualHash : hash}};
    };
    const auto writeList = [&](const nlohmann::json& accepted) {
        folder.write("accept.json",
                     nlohmann::json{{"failures", (folder / "failures").string()}, {"accept", accepted}}.dump());
    };
    const std::string golden = contents(folder / "golden/a.png");

    writeList({entry(0), entry(1, "0123456789abcdef")});
    checkRefused(folder, "accept accept.json", "another picture by now");
    writeList({entry(0), {{"name", "z.png"}}});
    checkRefused(folder, "accept accept.json", "z.png");
    folder.write("accept.json", "{\"accept\":3}");
    checkRefused(folder, "accept accept.json", "no list of the review page");
    folder.write("accept.json", "{");
    checkRefused(folder, "accept accept.json", "no list of the review page");
    checkRefused(folder, "accept nothing.json", "nothing.json");
    writeList({entry(0), entry(1)});
    const std::string picture = contents(folder / "actual/b.png");
    writeGrey(folder / "actual/b.png", 11);
    checkRefused(folder, "accept accept.json", "no longer the picture");
    CHECK(contents(folder / "golden/a.png") == golden);  // nothing, since not all
    folder.write("actual/b.png", picture);

    writeList({entry(0), entry(3)});
    const Outcome outcome = check(folder, "accept accept.json");
    CHECK(outcome.code == 0);
    CHECK(outcome.out == "accepted: " + (folder / "golden/a.png").string() +
                             "\nremoved: " + (folder / "golden/unused.png").string() + "\n");
    CHECK(contents(folder / "golden/a.png") == contents(folder / "actual/a.png"));
    CHECK(contents(folder / "golden/b.png") == golden);
    CHECK_FALSE(fs::exists(folder / "golden/unused.png"));
    std::size_t files = 0;
    for ([[maybe_unused]] const auto& file : fs::directory_iterator(folder / "golden")) ++files;
    CHECK(files == 3);  // no temporary file

    // What ran elsewhere: the folder is here under another name, and so are the goldens.
    fs::rename(folder / "golden", folder / "mine");
    fs::rename(folder / "failures", folder / "downloaded");
    writeList(nlohmann::json::array({entry(1)}));
    const Outcome elsewhere = check(folder, "accept accept.json --failures downloaded --goldens mine");
    CAPTURE(elsewhere.err);
    CHECK(elsewhere.code == 0);
    CHECK(contents(folder / "mine/b.png") == contents(folder / "actual/b.png"));
}

TEST_CASE("check review: a folder without records is refused, and nothing is written")
{
    const TemporaryFolder folder;
    fs::create_directories(folder / "empty");
    checkRefused(folder, "review empty", "has no records");
    checkRefused(folder, "review nowhere", "nowhere");
    CHECK_FALSE(fs::exists(folder / "review.html"));
}
