// A tile in its own order of pixels: what is loaded is stored again, whatever the format, the size and the part of the
// tile that lies in the target, and nothing else in the target changes.
#include "relief/pipeline/tile.h"

#include <bit>
#include <cstring>
#include <limits>

#include "pipeline_fixture.h"

using namespace fixture;

namespace {

void fillWithNumbers(Framebuffer& target)
{
    std::uint32_t n = 1;
    for (std::uint32_t& c : target.color8()) c = 0x9e3779b9u * n++;
    for (auto& c : target.color16f()) {
        for (std::uint16_t& half : c) half = static_cast<std::uint16_t>(n++ * 7 & 0x7bff);
    }
    for (float& c : target.colorR32f()) c = static_cast<float>(n++);
    for (glm::vec4& c : target.color32f()) {
        for (int i = 0; i < 4; ++i) c[i] = static_cast<float>(n++);
    }
    for (float& z : target.depth()) z = 1.0f / static_cast<float>(n++);
}

const Format kFormats[] = {Format::rgba8, Format::rgba8Srgb, Format::rgba16f, Format::r32f, Format::rgba32f};
// A depth that is not kept is cleared, one that is kept is loaded.
std::optional<float> clearFor(Store depth, float value)
{
    return depth == Store::discard ? std::optional<float>(value) : std::nullopt;
}

std::uint32_t packed(const glm::vec4& color, Format format)
{
    std::int32_t words[4];
    packColor(color, format, words);
    return static_cast<std::uint32_t>(words[0]);
}

const int kTileSizes[] = {16, 32, 64, 128};

// Of a target with one colour.
Clear cleared(const std::optional<glm::vec4>& color, const std::optional<float>& depth)
{
    Clear clear;
    clear.color[0] = color;
    clear.depth = depth;
    return clear;
}

}  // namespace

TEST_CASE("tile: load and store keep every bit (S-318, S-957)")
{
    const int sizes[][2] = {{1, 1}, {1, 33}, {33, 1}, {3, 3}, {16, 16}, {17, 31}, {130, 70}};
    for (const Format format : kFormats) {
        for (const Store depth : {Store::discard, Store::keep}) {
            for (const int tileSize : kTileSizes) {
                for (const auto& size : sizes) {
                    Framebuffer source = makeTarget(size[0], size[1], format, depth);
                    fillWithNumbers(source);
                    Framebuffer copy = makeTarget(size[0], size[1], format, depth);
                    Tile tile(tileSize, TargetMemory(source));
                    const TargetMemory from(source), to(copy);
                    for (int y = 0; y < size[1]; y += tileSize) {
                        for (int x = 0; x < size[0]; x += tileSize) {
                            tile.begin(x, y, from, cleared(std::nullopt, clearFor(depth, 0.5f)));
                            tile.store(to);
                        }
                    }
                    CHECK(sameBits(source, copy));
                }
            }
        }
    }
}

TEST_CASE("tile: store and clear write their own rectangle only (S-957)")
{
    for (const Format format : kFormats) {
        Framebuffer target = makeTarget(50, 50, format, Store::keep);
        fillWithNumbers(target);
        const Framebuffer before = target;
        const glm::vec4 color = {0.25f, 0.5f, 0.75f, 1.0f};
        const auto changedOutside = [&](const Rectangle& r) {
            int changed = 0, kept = 0;
            for (int y = 0; y < 50; ++y) {
                for (int x = 0; x < 50; ++x) {
                    const auto i = static_cast<std::size_t>(y * 50 + x);
                    const std::size_t words = static_cast<std::size_t>(wordsPerPixel(format));
                    const bool same =
                        std::memcmp(&target.words(0)[i * words], &before.words(0)[i * words], 4 * words) == 0;
                    const bool inside = x >= r.x0 && x < r.x1 && y >= r.y0 && y < r.y1;
                    changed += !inside && (!same || target.depth()[i] != before.depth()[i]);
                    kept += inside && (same || target.depth()[i] == before.depth()[i]);
                }
            }
            return changed + kept;
        };
        Tile tile(16, TargetMemory(target));
        tile.begin(32, 16, TargetMemory(target), cleared(color, 2.0f));
        tile.store(TargetMemory(target));
        CHECK(changedOutside({32, 16, 48, 32}) == 0);

        target = before;
        tile.begin(48, 48, TargetMemory(target), cleared(color, 2.0f));  // two pixels of it are in the target
        tile.store(TargetMemory(target));
        CHECK(changedOutside({48, 48, 50, 50}) == 0);

        target = before;
        clearRectangle(TargetMemory(target), {45, -10, 61, 6}, cleared(color, 2.0f));
        CHECK(changedOutside({45, 0, 50, 6}) == 0);
    }
}

TEST_CASE("tile: a cleared tile and a cleared rectangle are the same, also for colours that no format holds (S-951)")
{
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    for (const Format format : kFormats) {
        for (const glm::vec4& color : {glm::vec4(0.1f, 0.5f, 0.9f, 0.3f), glm::vec4(-1.0f, 2.0f, 1e30f, -0.0f),
                                       glm::vec4(nan, infinity, -infinity, nan)}) {
            Framebuffer a = makeTarget(20, 20, format), b = makeTarget(20, 20, format), c = makeTarget(20, 20, format);
            Tile tile(32, TargetMemory(a));
            tile.begin(0, 0, TargetMemory(a), cleared(color, 1.0f));
            tile.store(TargetMemory(a));
            clearRectangle(TargetMemory(b), {0, 0, 32, 32}, cleared(color, 1.0f));
            CHECK(sameBits(a, b));
            Frame frame(c, {1, 16});
            frame.clear(color);
            frame.run();
            CHECK(allFinite(c));
            const bool finite = std::isfinite(color.x);
            if (finite) CHECK(sameBits(a, c));
        }
    }
    CHECK(packed({0, 0, 0, 1}, Format::rgba8) == 0xff000000u);
    CHECK(packed({1, 0, 0, 0}, Format::rgba8) == 0x000000ffu);
    CHECK(packed({nan, infinity, -infinity, 2}, Format::rgba8) == 0xff00ff00u);
    CHECK(packed({0.5f, 0.5f, 0.5f, 0.5f}, Format::rgba8) == 0x80808080u);
    CHECK(packed({0.5f, 0.5f, 0.5f, 0.5f}, Format::rgba8Srgb) == 0x80bcbcbcu);  // alpha is linear
}

TEST_CASE("tile: blocks hold the pixels that their lanes name")
{
    Framebuffer target = makeTarget(64, 64, Format::rgba32f, Store::keep);
    fillWithNumbers(target);
    Tile tile(32, TargetMemory(target));
    tile.begin(32, 0, TargetMemory(target), {});
    int wrong = 0;
    for (int y = 0; y < 32; y += kBlockHeight) {
        for (int x = 32; x < 64; x += kBlockWidth) {
            const int block = tile.blockAt(x, y);
            float nearest = 2.0f, farthest = -1.0f;
            for (int lane = 0; lane < kLanes; ++lane) {
                const auto i = static_cast<std::size_t>((y + laneY(lane)) * 64 + x + laneX(lane));
                for (int c = 0; c < 4; ++c)
                    wrong += std::bit_cast<float>(tile.color<Format::rgba32f>(0, block)[c * kLanes + lane]) !=
                             target.color32f()[i][c];
                wrong += tile.depth(block)[lane] != target.depth()[i];
                nearest = std::fmin(nearest, target.depth()[i]);
                farthest = std::fmax(farthest, target.depth()[i]);
            }
            wrong += tile.bounds(block).nearest > nearest || tile.bounds(block).farthest < farthest;
        }
    }
    CHECK(wrong == 0);
}

TEST_CASE("tile: nothing of the tile before remains after clear and load")
{
    Framebuffer target = makeTarget(40, 40, Format::rgba8, Store::discard);
    Tile tile(32, TargetMemory(target));
    tile.begin(0, 0, TargetMemory(target), cleared(glm::vec4(1.0f), 0.25f));
    tile.begin(32, 32, TargetMemory(target), cleared(std::nullopt, 0.75f));
    for (int block = 0; block < 32 * 32 / kLanes; ++block) {
        for (int lane = 0; lane < kLanes; ++lane) {
            REQUIRE(tile.color<Format::rgba8>(0, block)[lane] == 0);
            REQUIRE(tile.depth(block)[lane] == 0.75f);
        }
        REQUIRE(tile.bounds(block).nearest == 0.75f);
        REQUIRE(tile.bounds(block).farthest == 0.75f);
    }
}

TEST_CASE("tile: nor where a pixel has several samples, and what was stored last was a colour")
{
    // The word of white is a NaN where it is taken for a depth. Of the tile 20 x 20 pixels lie in the target.
    Framebuffer target =
        *Framebuffer::create(20, 20, {{Format::depth32f, Store::keep}, {Format::rgba8, Store::keep}}, 4);
    const TargetMemory memory(target);
    Tile tile(32, memory);
    tile.begin(0, 0, memory, cleared(glm::vec4(1.0f), 0.25f));
    tile.store(memory);
    tile.begin(0, 0, memory, {});
    for (int block = 0; block < 32 * 32 / kLanes; ++block) {
        for (int lane = 0; lane < 4 * kLanes; ++lane) {
            const float depth = tile.depth(tile.sampleOf(block, 0))[lane];
            REQUIRE((depth == 0.0f || depth == 0.25f));
        }
    }
    CHECK(tile.wholeBounds().nearest == 0.0f);
    CHECK(tile.wholeBounds().farthest == 0.25f);
}
