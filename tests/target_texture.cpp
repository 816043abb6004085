// A target's attachments as textures.
#include "relief/pipeline/target_texture.h"

#include <doctest/doctest.h>

#include "pipeline_fixture.h"

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
