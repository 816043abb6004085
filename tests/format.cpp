// The formats of targets: what each of them stores, and gives back.
#include "relief/pipeline/format.h"

#include "pipeline_fixture.h"

using namespace fixture;

namespace {

// The value of a half, by its definition.
double valueOf(int half)
{
    const int exponent = half >> 10 & 31, mantissa = half & 1023;
    const double value = exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25);
    return (half & 0x8000) != 0 ? -value : value;
}

int half(float number)
{
    return toHalf(number)[0];
}

}  // namespace

TEST_CASE("format: every finite half is read exactly and written as itself")
{
    int wrong = 0;
    for (int code = 0; code < 65536; ++code) {
        if ((code >> 10 & 31) == 31) continue;  // infinities and NaN
        const float number = fromHalf(code)[0];
        wrong += static_cast<double>(number) != valueOf(code) || std::signbit(number) != ((code & 0x8000) != 0);
        wrong += half(number) != code;
    }
    measured("halves off", wrong, 0);
}

TEST_CASE("format: floats become the nearest half, ties to even, and never an infinity (S-958)")
{
    int wrong = 0;
    for (int code = 0; code < 0x7bff; ++code) {
        const double low = valueOf(code), high = valueOf(code + 1);
        const auto middle = static_cast<float>((low + high) / 2);  // exact: halves have 13 bits less than floats
        wrong += half(std::nextafter(middle, 0.0f)) != code;
        wrong += half(std::nextafter(middle, 1e9f)) != code + 1;
        wrong += half(middle) != (code % 2 == 0 ? code : code + 1);
        wrong += half(-middle) != (0x8000 | (code % 2 == 0 ? code : code + 1));
    }
    measured("halves off", wrong, 0);
    CHECK(half(65504.0f) == 0x7bff);
    CHECK(half(65519.0f) == 0x7bff);
    CHECK(half(1e30f) == 0x7bff);
    CHECK(half(-1e30f) == 0xfbff);
    CHECK(half(std::numeric_limits<float>::infinity()) == 0x7bff);
    CHECK(half(1e-40f) == 0);
}

TEST_CASE("format: one picture in every colour format, blended too")
{
    const glm::vec4 color = {0.5f, 0.25f, 0.125f, 0.5f};
    for (const Blend blend : {Blend::off, Blend::additive, Blend::alpha}) {
        const RenderState state = {Compare::always, false, true, Cull::none, blend};
        for (const Format format : {Format::rgba8, Format::rgba16f, Format::r32f, Format::rgba32f}) {
            Framebuffer target = makeTarget(19, 9, format);
            Frame frame(target, {1, 16});
            frame.clear(glm::vec4(0.25f));
            Mesh mesh;
            addTriangle(mesh, {{-1, -1, 0.5f, 1}, color}, {{-1, 3, 0.5f, 1}, color}, {{3, -1, 0.5f, 1}, color});
            REQUIRE(frame.draw(mesh, FromClip{}, Value{}, state).has_value());
            frame.run();
            const float expected = blend == Blend::off ? 0.5f : blend == Blend::additive ? 0.75f : 0.375f;
            const float stored = !target.color32f().empty()    ? target.color32f()[100].x
                                 : !target.colorR32f().empty() ? target.colorR32f()[100]
                                 : !target.color16f().empty()  ? fromHalf(target.color16f()[100][0])[0]
                                                               : static_cast<float>(target.color8()[100] & 255) / 255;
            CHECK(std::fabs(stored - expected) < (format == Format::rgba8 ? 0.004f : 1e-6f));
        }
    }
}

TEST_CASE("format: targets of depth alone and of colour alone")
{
    Mesh mesh;
    addTriangle(mesh, {{-1, -1, 0.25f, 1}, glm::vec4(1.0f)}, {{-1, 3, 0.25f, 1}, glm::vec4(1.0f)},
                {{3, -1, 0.25f, 1}, glm::vec4(1.0f)});
    Framebuffer shadow = *Framebuffer::create(33, 17, {{Format::depth32f}});
    Frame frame(shadow, {2, 16});
    frame.clearDepth();
    REQUIRE(frame.draw(mesh, FromClip{}, Value{}, kDepthTested).has_value());
    const Statistics statistics = frame.run();
    CHECK(statistics.pixelsShaded == 33 * 17);
    for (const float z : shadow.depth()) CHECK(z == 0.25f);

    Framebuffer picture = *Framebuffer::create(33, 17, {{Format::rgba32f}});
    Frame second(picture, {2, 16});
    second.clearColor(glm::vec4(0.0f));
    REQUIRE(second.draw(mesh, FromClip{}, Value{}, kDepthTested).has_value());  // nothing to test against
    second.run();
    CHECK(pixelsNotEqualTo(picture, 1.0f) == 0);
    CHECK_FALSE(Framebuffer::create(4, 4, std::vector<Attachment>{}).has_value());
    CHECK_FALSE(Framebuffer::create(4, 4, {{Format::depth32f}, {Format::depth32f}}).has_value());
}

TEST_CASE("format: clearing depth alone keeps the colour, clearing colour alone keeps the depth")
{
    Framebuffer target = makeTarget(40, 24, Format::rgba32f, Store::keep);
    Mesh mesh;
    addTriangle(mesh, {{-1, -1, 0.25f, 1}, glm::vec4(1.0f)}, {{-1, 3, 0.25f, 1}, glm::vec4(1.0f)},
                {{3, -1, 0.25f, 1}, glm::vec4(1.0f)});
    Frame frame(target, {1, 16});
    frame.clear(glm::vec4(0.5f));
    REQUIRE(frame.draw(mesh, FromClip{}, Value{}, kDepthTested).has_value());
    frame.run();
    frame.reset();
    frame.clearDepth(0.0f);
    frame.run();
    CHECK(pixelsNotEqualTo(target, 1.0f) == 0);
    for (const float z : target.depth()) REQUIRE(z == 0.0f);
    frame.reset();
    frame.clearColor(glm::vec4(0.5f));
    frame.run();
    CHECK(pixelsNotEqualTo(target, 0.5f) == 0);
    for (const float z : target.depth()) REQUIRE(z == 0.0f);

    // Reversed depth onto kept colour.
    frame.reset();
    frame.clearDepth(0.0f);
    REQUIRE(
        frame.draw(mesh, FromClip{}, Value{}, {Compare::greater, true, true, Cull::none, Blend::additive}).has_value());
    frame.run();
    CHECK(pixelsNotEqualTo(target, 1.5f) == 0);
}
