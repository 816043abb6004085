// Golden pictures: the same picture passes; a missing, unreadable, differently sized or different one fails and says
// so.
#include "relief/check/golden.h"

#include <filesystem>
#include <string>

#include <doctest/doctest.h>

#include "relief/texture/image.h"
#include "temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using namespace relief;

// A small picture in which every pixel is another colour.
Framebuffer picture(int width, int height)
{
    Framebuffer target = *Framebuffer::create(width, height);
    std::uint32_t color = 0xff000000u;
    for (std::uint32_t& pixel : target.color8()) pixel = color += 0x010203u;
    return target;
}

// The message of a check that must fail, with the words it must have.
void checkFails(const Framebuffer& target, const fs::path& golden, const fs::path& failures, const char* word)
{
    const Expected<void> result = checkGolden(target, golden, failures);
    REQUIRE_FALSE(result);
    CAPTURE(result.error().message);
    CHECK(result.error().message.find(word) != std::string::npos);
    CHECK(result.error().message.find("make it the golden") != std::string::npos);
}

}  // namespace

TEST_CASE("golden: what updateGolden wrote, checkGolden accepts, and leaves nothing behind")
{
    const TemporaryFolder folder;
    const Framebuffer target = picture(13, 7);
    REQUIRE(updateGolden(target, folder / "some/where.png"));
    CHECK(checkGolden(target, folder / "some/where.png", folder / "failures"));
    CHECK_FALSE(fs::exists(folder / "failures"));
}

TEST_CASE("golden: a missing golden fails, and the picture is kept to be looked at")
{
    const TemporaryFolder folder;
    checkFails(picture(13, 7), folder / "missing.png", folder / "failures", "missing.png");
    checkFails(picture(13, 7), folder / "missing.png", folder / "failures", "failures/missing.actual.png");
    CHECK(readImage(folder / "failures/missing.actual.png"));
}

TEST_CASE("golden: an unreadable golden fails")
{
    const TemporaryFolder folder;
    checkFails(picture(13, 7), folder.write("text.png", "no picture"), folder / "failures", "text.png");
    checkFails(picture(13, 7), folder.write("empty.png", ""), folder / "failures", "empty.png");
}

TEST_CASE("golden: a golden of another size fails")
{
    const TemporaryFolder folder;
    REQUIRE(updateGolden(picture(13, 8), folder / "tall.png"));
    checkFails(picture(13, 7), folder / "tall.png", folder / "failures", "is 13x7 and should be 13x8");
    CHECK(readImage(folder / "failures/tall.actual.png"));
}

TEST_CASE("golden: one bit in one pixel fails, is named, and is shown eight times as large")
{
    const TemporaryFolder folder;
    const Framebuffer target = picture(13, 7);
    Framebuffer other = target;
    other.color8()[13 * 2 + 5] ^= 0x000100u;  // green of (5, 2)
    REQUIRE(updateGolden(other, folder / "bit.png"));
    checkFails(target, folder / "bit.png", folder / "failures",
               "1 pixel differs, the largest difference is 1, 1 lie in one square of 8x8\n  (5, 2)");
    const Expected<ImageFile> difference = readImage(folder / "failures/bit.difference.png");
    REQUIRE(difference);
    const Image8& shown = std::get<Image8>(*difference);
    for (std::size_t i = 0; i < shown.pixels.size(); ++i) {
        const int expected = i % 4 == 3 ? 255 : i == (13 * 2 + 5) * 4 + 1 ? 8 : 0;
        CHECK(shown.pixels[i] == expected);
    }
}

TEST_CASE("golden: in the folder where the program runs, no folder has to be made")
{
    const TemporaryFolder folder;
    const fs::path before = fs::current_path();
    fs::current_path(folder.path);
    const Framebuffer target = picture(5, 3);
    const Expected<void> updated = updateGolden(target, "plain.png");
    CHECK_MESSAGE(updated, (updated ? "" : updated.error().message));
    CHECK(checkGolden(target, "plain.png", "failures"));
    CHECK_FALSE(checkGolden(target, "missing.png", ""));
    CHECK(fs::exists("missing.actual.png"));
    fs::current_path(before);
}

TEST_CASE("golden: a picture that cannot be kept is said to be so")
{
    const TemporaryFolder folder;
    checkFails(picture(5, 3), folder / "missing.png", folder.write("file", "x"), "not written: ");
}

TEST_CASE("golden: a float target is refused, not compared")
{
    const TemporaryFolder folder;
    const Framebuffer target = *Framebuffer::create(4, 4, Format::rgba32f);
    CHECK_FALSE(checkGolden(target, folder / "float.png", folder / "failures"));
    CHECK_FALSE(updateGolden(target, folder / "float.png"));
    // The first colour counts, whatever the others are.
    const Framebuffer both = *Framebuffer::create(4, 4, {{Format::rgba32f}, {Format::rgba8}});
    CHECK_FALSE(checkGolden(both, folder / "float.png", folder / "failures"));
    CHECK_FALSE(updateGolden(both, folder / "float.png"));
    CHECK_FALSE(fs::exists(folder / "float.png"));
}
