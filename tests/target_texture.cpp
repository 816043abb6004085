// A target's attachments as textures.
#include "relief/pipeline/target_texture.h"

#include <cstring>
#include <utility>

#include <doctest/doctest.h>

#include "pipeline_fixture.h"
#include "relief/check/hash.h"
#include "relief/texture/sampler.h"

using namespace fixture;

TEST_CASE("target as a texture: the pixels of every format, with row 0 above")
{
    constexpr Format kAll[] = {Format::rgba8, Format::rgba8Srgb, Format::rgba16f, Format::r32f, Format::rgba32f};
    Mesh mesh;
    addTriangle(mesh, {{Point{0, 0}, Point{40 * 256, 0}, Point{0, 40 * 256}}}, {0.25f, 0.5f, 0.75f, 1.0f}, 0.125f);
    for (const Format format : kAll) {
        Framebuffer target = *Framebuffer::create(19, 33, {{format}, {Format::depth32f}});
        const Viewport viewport = exactViewport(19, 33);
        Frame frame(target, {1, 16});
        frame.setViewport(viewport);
        frame.clear(glm::vec4(0.0f));
        REQUIRE(frame.draw(mesh, FromPixels(viewport), Value{}, kDepthTested));
        frame.run();
        const Texture color = *textureOf(target, 0), depth = *textureOf(target, 1);
        CHECK(color.width() == 19);
        CHECK(color.height() == 33);
        int wrong = 0;
        for (int y = 0; y < 33; ++y) {
            for (int x = 0; x < 19; ++x) {
                const auto at = static_cast<std::size_t>(y * 19 + x);
                const bool isDrawn = target.depth()[at] != 1.0f;
                const glm::vec4 texel = color.texel(x, 32 - y);
                const auto isNear = [](float a, float b) { return std::abs(a - b) < 0.01f; };
                wrong += depth.texel(x, 32 - y) != glm::vec4(target.depth()[at], 0.0f, 0.0f, 1.0f);
                wrong += !isNear(texel.x, isDrawn ? 0.25f : 0.0f);
                if (format == Format::r32f) continue;
                wrong += !isNear(texel.y, isDrawn ? 0.5f : 0.0f) || !isNear(texel.z, isDrawn ? 0.75f : 0.0f);
            }
        }
        CHECK(wrong == 0);
        CHECK(color.levelsBuilt() == 1);
        color.level(3);
        CHECK(color.levelsBuilt() == 4);
        CHECK_FALSE(std::isnan(color.level(2).texel<std::uint8_t>(0, 0)[0]));
    }
}

namespace {

// A copy of the attachment is the same texture, texel by texel and level by level.
bool isSameTexture(const Texture& a, const Texture& b)
{
    if (a.format() != b.format() || a.width() != b.width() || a.levelCount() != b.levelCount()) return false;
    for (int k = 0; k < a.levelCount(); ++k) {
        const MipLevel &mine = a.level(k), &its = b.level(k);
        const std::size_t bytes = mine.rowBytes() * static_cast<std::size_t>(mine.height() + 2);
        if (std::memcmp(mine.texels(), its.texels(), bytes) != 0 || mine.isOpaque() != its.isOpaque()) return false;
    }
    return true;
}

// The same frame again and again, on a target that keeps its attachments and on one that stores them as textures.
struct TwoTargets
{
    Framebuffer kept, stored;
    Frame onKept, onStored;

    TwoTargets(Format color, int samples, const FrameOptions& options)
        : kept(*Framebuffer::create(67, 41, {{color}, {Format::depth32f}}, samples)),
          stored(*Framebuffer::create(67, 41, {{color, Store::texture}, {Format::depth32f, Store::texture}}, samples)),
          onKept(kept, options),
          onStored(stored, options)
    {
    }
    template <class Record>
    bool sameAfter(const Record& record)
    {
        for (Frame* frame : {&onKept, &onStored}) {
            frame->reset();
            record(*frame);
            frame->run();
        }
        return hashOf(kept) == hashOf(stored) && isSameTexture(*textureOf(kept, 0), *stored.texture(0)) &&
               isSameTexture(*textureOf(kept, 1), *stored.texture(1));
    }
};

}  // namespace

TEST_CASE("target stored as a texture: what a copy of a kept one holds, frame after frame")
{
    const Viewport viewport = exactViewport(67, 41);
    const auto draw = [&](Frame& frame, const Mesh& mesh) {
        frame.setViewport(viewport);
        REQUIRE(frame.draw(mesh, FromPixels(viewport), Value{}, kDepthTested));
    };
    Mesh large, small, many;
    addTriangle(large, {{Point{0, 0}, Point{90 * 256, 0}, Point{0, 90 * 256}}}, {0.25f, 0.5f, 0.75f, 1.0f}, 0.75f);
    addTriangle(small, {{Point{600, 700}, Point{3000, 800}, Point{900, 5000}}}, {1.0f, 0.5f, 0.0f, 0.5f}, 0.25f);
    Random random{11};
    for (int i = 0; i < 300; ++i)
        addTriangle(many, randomTriangle(random, 67, 41, 200), glm::vec4(0.01f * static_cast<float>(i)), 0.5f);
    for (const Format color : {Format::rgba8, Format::r32f, Format::rgba32f}) {
        for (const int samples : {1, 4}) {
            for (const std::uint32_t maxBinned : {kMaxBinned, 40u}) {
                CAPTURE(static_cast<int>(color));
                CAPTURE(samples);
                CAPTURE(maxBinned);
                TwoTargets both(color, samples, {2, 16, maxBinned});
                CHECK(isSameTexture(*textureOf(both.kept, 0), *both.stored.texture(0)));  // before anything is drawn
                CHECK(isSameTexture(*textureOf(both.kept, 1), *both.stored.texture(1)));
                CHECK(both.sameAfter([&](Frame& frame) {
                    frame.clear({0.1f, 0.2f, 0.3f, 1.0f});
                    draw(frame, large);
                }));
                CHECK(both.sameAfter([&](Frame& frame) { draw(frame, small); }));  // most tiles are left as they are
                CHECK(both.sameAfter([&](Frame&) {}));
                CHECK(both.sameAfter([&](Frame& frame) {
                    frame.clearDepth();
                    draw(frame, small);
                }));
                CHECK(both.sameAfter([&](Frame& frame) { frame.clearColor({0.5f, 0.25f, 0.125f, 0.0f}); }));
                CHECK(both.sameAfter([&](Frame& frame) { draw(frame, many); }));
                CHECK(both.sameAfter([&](Frame& frame) {
                    frame.clear(glm::vec4(1.0f));
                    draw(frame, many);
                }));
            }
        }
    }
}

TEST_CASE("target stored as a texture: it stays where it is, and keeps no words")
{
    Framebuffer target = *Framebuffer::create(5, 3, {{Format::rgba8, Store::texture}, {Format::depth32f}});
    const Texture* const texture = target.texture(0);
    REQUIRE(texture != nullptr);
    for (const int other : {-1, 1, 2}) CHECK(target.texture(other) == nullptr);
    CHECK(target.words(0).empty());
    CHECK(target.color8().empty());
    Frame frame(target, {1, 16});
    frame.clear({1.0f, 0.0f, 0.0f, 1.0f});
    frame.run();
    CHECK(texture->texel(4, 2) == glm::vec4(1.0f, 0.0f, 0.0f, 1.0f));

    Framebuffer copy = target;
    CHECK(copy.samePixels(target));
    CHECK(copy.texture(0) != texture);
    CHECK(isSameTexture(*copy.texture(0), *texture));
    frame.clearColor({0.0f, 1.0f, 0.0f, 1.0f});
    frame.run();
    CHECK_FALSE(copy.samePixels(target));
    CHECK(texture->texel(4, 2) == glm::vec4(0.0f, 1.0f, 0.0f, 1.0f));
    CHECK(copy.texture(0)->texel(4, 2) == glm::vec4(1.0f, 0.0f, 0.0f, 1.0f));
    const Framebuffer moved = std::move(target);
    CHECK(moved.texture(0) == texture);
    CHECK(texture->isConstant() == false);

    Framebuffer one = *Framebuffer::create(1, 1, {{Format::r32f, Store::texture}});
    Frame onOne(one, {1, 16});
    onOne.clear(glm::vec4(0.5f));
    onOne.run();
    CHECK(one.texture(0)->constant() == glm::vec4(0.5f, 0.0f, 0.0f, 1.0f));
}

TEST_CASE("target stored as a texture: tiles that are only copied are not counted as touched")
{
    Framebuffer target = *Framebuffer::create(64, 64, {{Format::rgba8, Store::texture}});
    Frame frame(target, {1, 16});
    const Mesh mesh = meshOf({{Point{2048, 2048}, Point{6144, 2560}, Point{2560, 6144}}});
    const Viewport viewport = exactViewport(64, 64);
    frame.setViewport(viewport);
    REQUIRE(frame.draw(mesh, FromPixels(viewport), One{}, kPaint));
    const Statistics statistics = frame.run();
    CHECK(statistics.tiles == 16);
    CHECK(statistics.tilesTouched == 4);
}

TEST_CASE("target as a texture: read while it is drawn into, it is what the last frame left")
{
    struct ReadsTarget
    {
        sampler2D last;
        float4 operator()(const Interpolated& i) const
        {
            const float2 uv = float2(i.position.x, 16.0f - i.position.y) / 16.0f;
            return tex2D(last, uv) * 2.0f + 1.0f;
        }
    };
    Framebuffer target = makeTarget(16, 16);
    Framebuffer stored = *Framebuffer::create(16, 16, {{Format::rgba32f, Store::texture}});
    const Mesh mesh = meshOf({{Point{0, 0}, Point{9000, 0}, Point{0, 9000}}});
    float expected = 0.0f;
    for (int pass = 0; pass < 4; ++pass) {
        const Texture last = *textureOf(target, 0);
        ReadsTarget program;
        program.last.texture = &last;
        program.last.filter = Filter::nearest;
        program.last.mipmaps = false;
        Frame frame(target, {2, 16});
        const Viewport viewport = exactViewport(16, 16);
        frame.setViewport(viewport);
        REQUIRE(frame.draw(mesh, FromPixels(viewport), program, kPaint));
        frame.run();
        expected = expected * 2.0f + 1.0f;
        CHECK(pixelsNotEqualTo(target, expected) == 0);

        program.last.texture = stored.texture(0);
        Frame onStored(stored, {2, 16});
        onStored.setViewport(viewport);
        REQUIRE(onStored.draw(mesh, FromPixels(viewport), program, kPaint));
        onStored.run();
        CHECK(isSameTexture(*stored.texture(0), *textureOf(target, 0)));
    }
}

TEST_CASE("target as a texture: what cannot be one is an error of one line")
{
    const Framebuffer target =
        *Framebuffer::create(8, 8, {{Format::rgba8}, {Format::depth32f, Store::discard}, {Format::stencil8}});
    const auto message = [&](int attachment) {
        const Expected<Texture> texture = textureOf(target, attachment);
        REQUIRE_FALSE(texture.has_value());
        CHECK(texture.error().message.find('\n') == std::string::npos);
        return texture.error().message;
    };
    CHECK(textureOf(target, 0).has_value());
    CHECK(message(1).find("Store::keep") != std::string::npos);
    CHECK(message(2).find("stencil") != std::string::npos);
    CHECK(message(3).find("has 3") != std::string::npos);
    CHECK(message(-1).find("counted from 0") != std::string::npos);
}

TEST_CASE("target stored as a texture: what cannot be one is an error of one line")
{
    for (const Format format : {Format::rgba8Srgb, Format::rgba16f, Format::stencil8}) {
        const Expected<Framebuffer> made =
            Framebuffer::create(4, 4, {{Format::rgba32f, Store::texture}, {format, Store::texture}});
        REQUIRE_FALSE(made.has_value());
        CHECK(made.error().message.find("attachment 1 cannot be stored as a texture") == 0);
        CHECK(made.error().message.find("textureOf()") != std::string::npos);
        CHECK(made.error().message.find('\n') == std::string::npos);
    }
    const Framebuffer target = *Framebuffer::create(4, 4, {{Format::rgba8, Store::texture}});
    CHECK(textureOf(target, 0).error().message.find("texture()") != std::string::npos);
}
