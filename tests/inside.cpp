// Views as pictures: the scale's colours, the small print, and every view of every stage.
#include "common/inside.h"

#include <cmath>

#include "common/overlay.h"
#include "common/render.h"
#include "pipeline_fixture.h"
#include "relief/check/hash.h"

using namespace fixture;
using namespace relief::samples;

namespace {

std::uint32_t pixelOf(const Framebuffer& target, int x, int y)
{
    return target.color8()[static_cast<std::size_t>(y * target.width() + x)];
}

// 0xbbggrr
int wrongPixels(const Framebuffer& target, const Rectangle& r, std::uint32_t color)
{
    int wrong = 0;
    for (int y = r.y0; y < r.y1; ++y) {
        for (int x = r.x0; x < r.x1; ++x) wrong += (pixelOf(target, x, y) & 0xffffffu) != color;
    }
    return wrong;
}

}  // namespace

TEST_CASE("inside: the ramp begins dark, ends yellow, and is brighter at every step")
{
    CHECK(ramp(0.0f) == SrgbCode{0x44, 0x01, 0x54});
    CHECK(ramp(0.5f) == SrgbCode{0x21, 0x91, 0x8c});
    CHECK(ramp(1.0f) == SrgbCode{0xfd, 0xe7, 0x25});
    CHECK(ramp(-3.0f) == ramp(0.0f));
    CHECK(ramp(7.0f) == ramp(1.0f));
    CHECK(ramp(std::nanf("")) == ramp(0.0f));
    const auto luminance = [](const SrgbCode& c) {
        return 0.2126f * srgbToLinear(c[0]) + 0.7152f * srgbToLinear(c[1]) + 0.0722f * srgbToLinear(c[2]);
    };
    for (int i = 1; i <= 64; ++i)
        CHECK(luminance(ramp(static_cast<float>(i) / 64.0f)) > luminance(ramp(static_cast<float>(i - 1) / 64.0f)));
}

TEST_CASE("inside: numbers are short")
{
    CHECK(shortNumber(0.0f) == "0");
    CHECK(shortNumber(-1.0f) == "-1");
    CHECK(shortNumber(0.98765432f) == "0.9877");
    CHECK(shortNumber(12345.0f) == "1.234e+04");
}

TEST_CASE("inside: an overlay's rectangles and letters are whole pixels, at any size and on any format")
{
    for (const auto& [width, height] : {std::pair{256, 256}, {961, 37}, {7, 3000}}) {
        Framebuffer target = *Framebuffer::create(width, height);
        for (std::uint32_t& pixel : target.color8()) pixel = 0xff0000ffu;
        Overlay overlay;
        overlay.rectangle({1, 2, 6, 12}, {10, 20, 30});
        overlay.text(2, 3, 1, "I", {200, 100, 50});  // a bar of 7 pixels between two of 3
        overlay.rectangle({width - 1, height - 1, width, height}, {1, 2, 3});
        overlay.draw(target);
        CHECK(pixelOf(target, 1, 2) == 0xff1e140au);
        CHECK(pixelOf(target, 5, 11) == 0xff1e140au);
        CHECK(pixelOf(target, 6, 11) == 0xff0000ffu);
        CHECK(pixelOf(target, 0, 2) == 0xff0000ffu);
        CHECK(pixelOf(target, width - 1, height - 1) == 0xff030201u);
        CHECK(pixelOf(target, width - 2, height - 1) == 0xff0000ffu);
        int letter = 0;
        for (const LetterPart& p : letterParts("I"))
            letter += wrongPixels(target, {2 + p.x0, 3 + p.y0, 2 + p.x1, 3 + p.y1}, 0x3264c8u);
        CHECK(letter == 0);
    }
    CHECK(textScale(256, 256) == 1);
    CHECK(textScale(960, 540) == 2);
    CHECK(textScale(1920, 1080) == 4);
}

TEST_CASE("inside: a triangle of a known depth has the legend's lowest colour, and the background none")
{
    Mesh mesh;
    addTriangle(mesh, {{-1, -1, 0.25f, 1}, {}}, {{-1, 3, 0.25f, 1}, {}}, {{0, 1, 0.25f, 1}, {}});
    addTriangle(mesh, {{0.5f, 1, 0.5f, 1}, {}}, {{1, 1, 0.5f, 1}, {}}, {{1, 0.5f, 0.5f, 1}, {}});
    Framebuffer target = *Framebuffer::create(256, 256);
    Frame frame(target, {.threads = 1});
    frame.clear({0, 1, 0, 1});
    REQUIRE(frame.draw(mesh, FromClip{}, Value{}, kDepthTested).has_value());
    CHECK(runInside(frame, target, "depth")->pixelsShaded > 100);
    CHECK(pixelOf(target, 2, 100) == 0xff540144u);
    CHECK(pixelOf(target, 250, 4) == 0xff25e7fdu);
    CHECK(pixelOf(target, 250, 200) == 0xff181414u);

    // The legend is the same as if it were drawn alone, from the lower left corner up.
    CHECK(pixelOf(target, 0, 255) == 0xff000000u);
    CHECK(runInside(frame, target, "color").has_value());
    CHECK(pixelOf(target, 250, 200) == 0xff00ff00u);
    CHECK_FALSE(runInside(frame, target, "color ").has_value());
}

TEST_CASE("inside: a label stands in its cell, in lines that fit, and is the picture's alone")
{
    Stage stage;
    stage.draw = [](const Scene& s) {
        s.cutCell(1, 2);
        s.label("right");
        s.labelColumns({"", "", "", "the last column"});
        s.cutStrip(0.0f, 1.0f);
        s.labelScale("0 to 10 degrees");
    };
    const Expected<PreparedStage> prepared = PreparedStage::prepare(stage);
    REQUIRE(prepared.has_value());
    Framebuffer target = *Framebuffer::create(200, 100);
    Frame frame(target, {.threads = 1});
    prepared->record(frame, 200, 100);
    const std::vector<Label>& labels = prepared->log->labels;
    REQUIRE(labels.size() == 6);
    frame.run();
    const std::uint32_t background = pixelOf(target, 0, 0);
    REQUIRE(runInside(frame, target, "", labels).has_value());
    CHECK(pixelOf(target, 99, 0) == background);
    CHECK(pixelOf(target, 100, 0) != background);
    CHECK(pixelOf(target, 150, 0) != background);
    CHECK(pixelOf(target, 100, kLetterHeight + 2 * Overlay::kPadding) == background);
    // Two lines, as one is wider than 50 pixels.
    CHECK(textWidth("the last column") > 44);
    CHECK(pixelOf(target, 150, kLineHeight + kLetterHeight + 2 * Overlay::kPadding - 1) != background);
    CHECK(pixelOf(target, 150, kLineHeight + kLetterHeight + 2 * Overlay::kPadding) == background);
    CHECK(pixelOf(target, 100, 91) != background);
    CHECK(pixelOf(target, 100, 92) == background);
    CHECK(frame.drawCount() == 0);
}

TEST_CASE("inside: every view of every stage has numbers, and none that is not finite")
{
    int views = 0;
    for (const Stage& stage : allStages()) {
        CAPTURE(stage.stem);
#if defined(RELIEF_SHORT_TESTS)
        if (stage.stem.find("1") == std::string::npos) continue;
#endif
        Expected<PreparedStage> prepared = PreparedStage::prepare(stage);
        REQUIRE(prepared.has_value());
        Framebuffer target = *Framebuffer::create(64, 36);
        Frame frame(target, {.threads = 1});
        prepared->record(frame, 64, 36);
        for (const View& view : viewsOf(frame)) {
            CAPTURE(view.name);
            const Expected<Inspection> seen = inspect(frame, view.name);
            REQUIRE(seen.has_value());
            CHECK(seen->lowest <= seen->highest);
            int drawn = 0, invalid = 0;
            for (std::size_t i = 0; i < seen->values.size(); ++i) {
                drawn += seen->drawn[i];
                for (int c = 0; c < seen->components; ++c) invalid += !std::isfinite(seen->values[i][c]);
            }
            CHECK(invalid == 0);
            if (view.sight != Sight::color && view.sight != Sight::mipLevel) CHECK(drawn > 100);
            CHECK(runInside(frame, target, view.name).has_value());
            ++views;
        }
    }
    CHECK(views > 200);
}

TEST_CASE("inside: the pictures of the views have the same bits everywhere")
{
    // Recorded. Lanes and blocks are of this build, and time is of the moment.
    const std::pair<const char*, std::uint64_t> expected[] = {
        {"depth", 0x602d460dd7b97009},     {"normal", 0xd752e4469371709d},  {"uv", 0x821c68611f829c11},
        {"TEXCOORD4", 0x983b4c4e427bdfdc}, {"mip", 0xe12e4fe6ce04dd07},     {"triangles", 0x4b5d43cb0511fce8},
        {"overdraw", 0xad68f4260f193c25},  {"samples", 0x83fa615aef4447aa},
    };
    const Expected<PreparedStage> prepared = PreparedStage::prepare(**findStage("1.25"));
    REQUIRE(prepared.has_value());
    for (const auto& [name, hash] : expected) {
        const std::string view = name;
        CAPTURE(view);
        for (const FrameOptions& options : {FrameOptions{.threads = 1}, {.threads = 3, .tileSize = 32}}) {
            Framebuffer target = *Framebuffer::create(320, 180);
            Frame frame(target, options);
            prepared->record(frame, 320, 180);
            REQUIRE(runInside(frame, target, view).has_value());
            CHECK(hexadecimal(hashOf(target)) == hexadecimal(hash));
        }
    }
}
