// The output merger: depth tests and their coarse bounds, conversion to 8 bits and sRGB, blending, and what never gets
// into a target.
#include "relief/pipeline/output_merger.h"

#include <algorithm>
#include <limits>

#include "numbers.h"
#include "pipeline_fixture.h"

using namespace fixture;

namespace {

constexpr float kLargest = std::numeric_limits<float>::max();

bool passes(Compare compare, float z, float stored)
{
    switch (compare) {
        case Compare::never:
            return false;
        case Compare::less:
            return z < stored;
        case Compare::equal:
            return z == stored;
        case Compare::lessEqual:
            return z <= stored;
        case Compare::greater:
            return z > stored;
        case Compare::notEqual:
            return z != stored;
        case Compare::greaterEqual:
            return z >= stored;
        case Compare::always:
            return true;
    }
    return false;
}

// Calls test.template operator()<compare>() for all of them.
template <class Test>
void forEachCompare(const Test& test)
{
    test.template operator()<Compare::never>();
    test.template operator()<Compare::less>();
    test.template operator()<Compare::equal>();
    test.template operator()<Compare::lessEqual>();
    test.template operator()<Compare::greater>();
    test.template operator()<Compare::notEqual>();
    test.template operator()<Compare::greaterEqual>();
    test.template operator()<Compare::always>();
}

int code(float c)
{
    return codeOf(saturate(Float(c)))[0];
}

// The curve of IEC 61966-2-1, in double.
double encodeExactly(double c)
{
    return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
}

std::uint32_t rgba(std::uint32_t r, std::uint32_t g, std::uint32_t b, std::uint32_t a)
{
    return r | g << 8 | b << 16 | a << 24;
}

struct Uniform
{
    float4 color;
    float4 operator()(const Interpolated&) const { return color; }
};

// Every second pixel, in a pattern that breaks quads.
struct DiscardPattern
{
    float4 operator()(const Interpolated& i, Discard& discard) const
    {
        const Float phase = frac((i.position.x + i.position.y * 3.0f) * 0.25f + i.value.w * 0.25f);
        discard(phase < 0.4f);
        return i.value;
    }
};
bool isDiscarded(int x, int y, float w)
{
    const float phase = ((static_cast<float>(x) + 0.5f) + (static_cast<float>(y) + 0.5f) * 3.0f) * 0.25f + w * 0.25f;
    return phase - std::floor(phase) < 0.4f;
}

// A scene of random triangles at random depths, slanted; values tell them apart.
struct SceneTriangle
{
    Corners corners;
    float z[3];
    glm::vec4 value;
};
std::vector<SceneTriangle> randomScene(Random& random, int count, int width, int height)
{
    std::vector<SceneTriangle> scene;
    for (int i = 0; i < count; ++i) {
        SceneTriangle t{randomTriangle(random, width, height, 2000), {}, glm::vec4(static_cast<float>(i + 1))};
        // Some flat ones at few depths, so that equal depths happen.
        const float flat = static_cast<float>(random.between(0, 8)) / 8;
        for (float& z : t.z) z = random.chance(3) ? random.real(0, 1) : flat;
        t.value.w = static_cast<float>(i % 4);
        scene.push_back(t);
    }
    return scene;
}
void addTriangle(Mesh& mesh, const SceneTriangle& t)
{
    fixture::addTriangle(mesh, {pixelPosition(t.corners[0], t.z[0]), t.value},
                         {pixelPosition(t.corners[1], t.z[1]), t.value},
                         {pixelPosition(t.corners[2], t.z[2]), t.value});
}

// Draws the scene pixel by pixel without any shortcut: each triangle's own depth comes from a frame that has nothing
// else in it, and the comparisons are made here.
template <class Discarded>
void drawByHand(const std::vector<SceneTriangle>& scene, Compare compare, bool write, float clearDepth,
                const Discarded& discarded, Framebuffer& result)
{
    std::fill(result.color32f().begin(), result.color32f().end(), glm::vec4(0.0f));
    std::fill(result.depth().begin(), result.depth().end(), clearDepth);
    Framebuffer alone = makeTarget(result.width(), result.height(), Format::rgba32f, Store::keep);
    constexpr RenderState kAlone = {Compare::always, true, true, Cull::none, Blend::off};
    for (const SceneTriangle& t : scene) {
        Mesh mesh;
        addTriangle(mesh, t);
        drawPixels<kAlone>(alone, mesh, One{});
        for (std::size_t i = 0; i < alone.color32f().size(); ++i) {
            if (alone.color32f()[i].x == 0.0f) continue;
            const int x = static_cast<int>(i) % result.width(), y = static_cast<int>(i) / result.width();
            if (discarded(x, y, t.value.w) || !passes(compare, alone.depth()[i], result.depth()[i])) continue;
            result.color32f()[i] = t.value;
            if (write) result.depth()[i] = alone.depth()[i];
        }
    }
}

template <RenderState state, class FragmentProgram>
Statistics drawScene(const std::vector<SceneTriangle>& scene, float clearDepth, const FragmentProgram& fragment,
                     const FrameOptions& options, Framebuffer& target)
{
    Mesh mesh;
    for (const SceneTriangle& t : scene) addTriangle(mesh, t);
    const Viewport viewport = exactViewport(target.width(), target.height());
    Frame frame(target, options);
    frame.clear(glm::vec4(0.0f), clearDepth);
    frame.setViewport(viewport);
    frame.draw(mesh, FromPixels(viewport), fragment, state);
    return frame.run();
}

}  // namespace

TEST_CASE("output merger: depth comparisons")
{
    const float values[] = {0.0f, -0.0f, 0.5f, std::nextafter(0.5f, 1.0f), 1.0f};
    int wrong = 0;
    forEachCompare([&]<Compare compare>() {
        for (const float z : values) {
            for (const float stored : values) wrong += compareBy(compare, z, stored)[0] != passes(compare, z, stored);
        }
    });
    CHECK(wrong == 0);
}

TEST_CASE("output merger: coarse depth bounds never hide a pixel that would pass, nor let one through (S-905)")
{
    Random random(70);
    int wrong = 0, hidden = 0, inFront = 0;
    forEachCompare([&]<Compare compare>() {
        for (int block = 0; block < trials(2000); ++block) {
            const float cleared = static_cast<float>(random.between(0, 2)) / 2;
            float depth[kLanes];
            std::fill_n(depth, kLanes, cleared);
            DepthBounds bounds = {cleared, cleared};
            for (int step = 0; step < 20; ++step) {
                const float a = static_cast<float>(random.between(0, 16)) / 16,
                            b = static_cast<float>(random.between(0, 16)) / 16;
                const float nearest = std::min(a, b), farthest = std::max(a, b);
                const bool hide = isHidden(compare, nearest, farthest, bounds);
                const bool pass = isInFront(compare, nearest, farthest, bounds);
                hidden += hide;
                inFront += pass;
                const bool whole = random.chance(2);
                for (float& stored : depth) {
                    if (!whole && random.chance(2)) continue;
                    const float z = random.chance(3)   ? nearest
                                    : random.chance(2) ? farthest
                                                       : random.real(nearest, farthest);
                    wrong += pass && !passes(compare, z, stored);
                    if (!passes(compare, z, stored)) continue;
                    wrong += hide;
                    if (!hide) stored = z;
                }
                if (pass && whole)
                    bounds = {nearest, farthest};
                else if (!hide)
                    updateBounds(compare, nearest, farthest, whole, bounds);
                for (const float stored : depth) wrong += stored < bounds.nearest || stored > bounds.farthest;
            }
        }
    });
    measured("pixels hidden that would pass, or drawn that would not", wrong, 0);
    CHECK(hidden > trials(2000));  // it does hide
    CHECK(inFront > trials(2000));
}

TEST_CASE("output merger: to 8 bits, nearest, ties up (S-952)")
{
    std::vector<bool> reached(256);
    for (int k = 0; k < 256; ++k) {
        CHECK(code(static_cast<float>(k) / 255.0f) == k);
        reached[static_cast<std::size_t>(code(static_cast<float>(k) / 255.0f))] = true;
    }
    CHECK(std::count(reached.begin(), reached.end(), true) == 256);

    // Around every border between two codes, a few floats to each side.
    int wrong = 0, descending = 0;
    for (int k = 0; k < 255; ++k) {
        float c = static_cast<float>((k + 0.5) / 255.0);
        for (int i = 0; i < 4; ++i) c = std::nextafter(c, 0.0f);
        int last = 0;
        for (int i = 0; i < 9; ++i, c = std::nextafter(c, 1.0f)) {
            const int n = code(c);
            wrong += std::fabs(static_cast<double>(c) * 255.0 - n) > 0.6;
            descending += n < last;
            last = n;
        }
        wrong += last != k + 1;
    }
    measured("codes off by more than 0.6", wrong, 0);
    measured("codes that fell", descending, 0);
    // Halves go up where a float is exactly half: 127.5 / 255.
    CHECK(code(0.5f) == 128);
}

TEST_CASE("output merger: what a program may return and what is stored (S-951)")
{
    CHECK(code(kNan) == 0);
    CHECK(code(-kNan) == 0);
    CHECK(code(kInfinity) == 255);
    CHECK(code(-kInfinity) == 0);
    CHECK(code(-0.0f) == 0);
    CHECK(code(1e30f) == 255);
    CHECK(code(-1e30f) == 0);
    CHECK(code(1e-45f) == 0);
    CHECK(code(std::nextafter(1.0f, 2.0f)) == 255);

    const Mesh mesh = meshOf({{{{0, 0}, {8 * 256, 0}, {0, 8 * 256}}}});
    struct Case
    {
        float value, stored32;
        std::uint32_t stored8;
        bool invalid;
    };
    const Case cases[] = {
        {kNan, 0.0f, 0, true},      {kInfinity, kLargest, 255, true}, {-kInfinity, -kLargest, 0, true},
        {-0.0f, -0.0f, 0, false},   {1e30f, 1e30f, 255, false},       {-2.0f, -2.0f, 0, false},
        {1e-40f, 1e-40f, 0, false}, {kLargest, kLargest, 255, false}, {0.25f, 0.25f, 64, false}};
    for (const Case& c : cases) {
        CAPTURE(c.value);
        for (int channel = 0; channel < 4; ++channel) {
            float4 color(Float(0.5f));
            color[channel] = c.value;
            Framebuffer wide = makeTarget(16, 16), narrow = makeTarget(16, 16, Format::rgba8);
            const Statistics s32 = drawPixels<kPaint>(wide, mesh, Uniform{color});
            const Statistics s8 = drawPixels<kPaint>(narrow, mesh, Uniform{color});
            CHECK(std::bit_cast<std::uint32_t>(pixel(wide, 1, 1)[channel]) == std::bit_cast<std::uint32_t>(c.stored32));
            CHECK((narrow.color8()[17] >> (8 * channel) & 255) == c.stored8);
            CHECK(pixel(wide, 1, 1)[(channel + 1) % 4] == 0.5f);
            CHECK(s32.invalidColors == (c.invalid ? s32.pixelsShaded : 0));
            CHECK(s8.invalidColors == s32.invalidColors);
            checkInvariants(wide, s32);
            checkInvariants(narrow, s8);
        }
    }
}

TEST_CASE("output merger: sRGB encoding against the curve (S-953)")
{
    // All 256 codes come back; ends exact.
    int wrong = 0;
    for (int k = 0; k < 256; ++k) {
        const float c = srgbToLinear(static_cast<std::uint8_t>(k));
        wrong += (packRgba8(encodeSrgb(float4(Float(c))))[0] & 255) != k;
    }
    measured("codes that do not come back", wrong, 0);

    // Ascending through [0, 1], every 255th float or so: within 0.6 of a code and never a step back.
    int last = 0, descending = 0;
    double worst = 0.0;
    const std::uint32_t one = std::bit_cast<std::uint32_t>(1.0f);
    const std::uint32_t stride = one / static_cast<std::uint32_t>(trials(400000));
    for (std::uint32_t bits = 0; bits <= one; bits += stride) {
        const float c = std::bit_cast<float>(bits);
        const int n = packRgba8(encodeSrgb(float4(Float(c))))[0] & 255;
        worst = std::fmax(worst, std::fabs(255.0 * encodeExactly(c) - n));
        descending += n < last;
        last = n;
    }
    measured("error in codes", worst, 0.6);
    measured("codes that fell", descending, 0);
}

TEST_CASE("output merger: the three formats store one picture each in its own way")
{
    Mesh mesh;
    const float4 color(Float(0.2f), Float(0.5f), Float(0.001f), Float(0.5f));
    const Corners c = {{{0, 0}, {40 * 256, 0}, {0, 40 * 256}}};
    fixture::addTriangle(mesh, c);
    Framebuffer wide = makeTarget(8, 8), unorm = makeTarget(8, 8, Format::rgba8),
                srgb = makeTarget(8, 8, Format::rgba8Srgb);
    drawPixels<kPaint>(wide, mesh, Uniform{color});
    drawPixels<kPaint>(unorm, mesh, Uniform{color});
    drawPixels<kPaint>(srgb, mesh, Uniform{color});
    CHECK(pixel(wide, 5, 5) == glm::vec4(0.2f, 0.5f, 0.001f, 0.5f));
    CHECK(unorm.color8()[45] == rgba(51, 128, 0, 128));
    const auto encoded = [](double v) { return static_cast<std::uint32_t>(255 * encodeExactly(v) + 0.5); };
    CHECK(srgb.color8()[45] == rgba(encoded(0.2f), encoded(0.5f), encoded(0.001f), 128));
}

TEST_CASE("output merger: blending in each format (S-954)")
{
    const Mesh mesh = meshOf({{{{0, 0}, {40 * 256, 0}, {0, 40 * 256}}}});
    const glm::vec4 below = {0.25f, 0.5f, 0.75f, 0.5f}, above = {0.5f, 0.75f, 1.0f, 0.25f};
    const auto draw = [&]<Blend blend>(Format format) {
        constexpr RenderState kState = {Compare::always, false, true, Cull::none, blend};
        Framebuffer target = makeTarget(8, 8, format);
        Frame frame(target, {1, 16});
        frame.clear(below);
        frame.setViewport({0, 0, 8, 8});
        frame.draw(mesh, FromPixels({0, 0, 8, 8}), Uniform{broadcast(above)}, kState);
        checkInvariants(target, frame.run());
        return target;
    };
    const auto near = [](const glm::vec4& a, const glm::vec4& b, float tolerance) {
        for (int i = 0; i < 4; ++i) {
            if (std::fabs(a[i] - b[i]) > tolerance) return false;
        }
        return true;
    };
    const auto unpack = [](std::uint32_t c) {
        return glm::vec4(static_cast<float>(c & 255), static_cast<float>(c >> 8 & 255),
                         static_cast<float>(c >> 16 & 255), static_cast<float>(c >> 24)) /
               255.0f;
    };
    const auto decoded = [&](std::uint32_t c) {
        glm::vec4 v = unpack(c);
        for (int i = 0; i < 3; ++i) v[i] = static_cast<float>(decodeSrgb(v[i]));
        return v;
    };
    const glm::vec4 sum = below + above, mixed = above * above.w + below * (1.0f - above.w);
    const glm::vec4 saturatedSum = {0.75f, 1.0f, 1.0f, 0.75f};

    CHECK(pixel(draw.operator()<Blend::off>(Format::rgba32f), 3, 3) == above);
    CHECK(pixel(draw.operator()<Blend::additive>(Format::rgba32f), 3, 3) == sum);
    CHECK(near(pixel(draw.operator()<Blend::alpha>(Format::rgba32f), 3, 3), mixed, 2e-7f));
    CHECK(near(unpack(draw.operator()<Blend::additive>(Format::rgba8).color8()[27]), saturatedSum, 1.1f / 255));
    CHECK(near(unpack(draw.operator()<Blend::alpha>(Format::rgba8).color8()[27]), mixed, 1.1f / 255));
    // In linear light: an error of one code is at most 1 % of it there.
    CHECK(near(decoded(draw.operator()<Blend::additive>(Format::rgba8Srgb).color8()[27]), saturatedSum, 0.01f));
    CHECK(near(decoded(draw.operator()<Blend::alpha>(Format::rgba8Srgb).color8()[27]), mixed, 0.01f));
}

TEST_CASE("output merger: an opaque source hides what is below, a transparent one leaves it as it is")
{
    Random random(71);
    int wrong = 0;
    for (int i = 0; i < trials(20000); ++i) {
        float4 source, destination;
        for (int c = 0; c < 4; ++c) {
            const float s = random.real(-1, 1), d = random.real(-1, 1);
            source[c] = std::ldexp(s, random.between(-20, 20));
            destination[c] = std::ldexp(d, random.between(-20, 20));
        }
        source.w = 1.0f;
        const float4 opaque = blendColors(Blend::alpha, source, destination);
        for (int c = 0; c < 4; ++c) wrong += any(opaque[c] != source[c]);
        source.w = 0.0f;
        const float4 clear = blendColors(Blend::alpha, source, destination);
        for (int c = 0; c < 4; ++c) wrong += any(clear[c] != destination[c]);
        // By the formula s.a s + (1 - s.a) d, to the precision of the larger of the two.
        const float alpha = random.real(0, 1);
        source.w = alpha;
        const float4 mixed = blendColors(Blend::alpha, source, destination);
        for (int c = 0; c < 4; ++c) {
            const double s = source[c][0], d = destination[c][0],
                         exact = alpha * s + (1 - static_cast<double>(alpha)) * d;
            wrong += std::fabs(mixed[c][0] - exact) > 2 * 0x1p-24 * (std::fabs(s) + std::fabs(d));
        }
    }
    CHECK(wrong == 0);
}

TEST_CASE("output merger: sums saturate instead of wrapping, or overflowing (S-954)")
{
    std::vector<Corners> twenty(20, Corners{{{0, 0}, {40 * 256, 0}, {0, 40 * 256}}});
    const Mesh mesh = meshOf(twenty);
    for (const Format format : {Format::rgba8, Format::rgba8Srgb}) {
        Framebuffer target = makeTarget(8, 8, format);
        drawPixels<kCount>(target, mesh, One{});
        for (const std::uint32_t c : target.color8()) CHECK(c == 0xffffffffu);
    }
    Framebuffer wide = makeTarget(8, 8);
    for (const float value : {kLargest, -kLargest}) {
        checkInvariants(wide, drawPixels<kCount>(wide, mesh, Uniform{float4(Float(value))}));
        CHECK(pixel(wide, 4, 4) == glm::vec4(value));
    }
    constexpr RenderState kAlpha = {Compare::always, false, true, Cull::none, Blend::alpha};
    for (const float alpha : {0.5f, 1.0f, 1e30f, -1e30f}) {
        for (const float value : {kLargest, -kLargest}) {
            Frame frame(wide, {1, 16});
            frame.clear(glm::vec4(-value));
            frame.setViewport({0, 0, 8, 8});
            frame.draw(mesh, FromPixels({0, 0, 8, 8}),
                       Uniform{float4(Float(value), Float(value), Float(value), Float(alpha))}, kAlpha);
            checkInvariants(wide, frame.run());
        }
    }
}

TEST_CASE("output merger: additive steps of 1/255 count up without an error")
{
    std::vector<Corners> many(200, Corners{{{0, 0}, {40 * 256, 0}, {0, 40 * 256}}});
    Framebuffer target = makeTarget(8, 8, Format::rgba8);
    drawPixels<kCount>(target, meshOf(many), Uniform{float4(Float(1.0f / 255.0f))});
    for (const std::uint32_t c : target.color8()) CHECK(c == rgba(200, 200, 200, 200));
}

TEST_CASE("output merger: only live lanes are written (S-960)")
{
    Random random(72);
    for (const Format format : {Format::rgba8, Format::rgba8Srgb, Format::rgba32f}) {
        Framebuffer target = makeTarget(16, 16, format);
        const TargetMemory memory(target);
        Tile tile(16, TargetMemory(target));
        int wrong = 0;
        for (int i = 0; i < trials(500); ++i) {
            tile.begin(0, 0, memory, {{glm::vec4(0.25f)}, 1.0f, {}});
            const unsigned live = static_cast<unsigned>(random.next()) & kAllLanes;
            alignas(Float) Channels color;
            for (float(&channel)[kLanes] : color) Float(0.75f).store(channel);
            withFormat(format, [&]<Format f>() { ColorWriter<f>(true).write(tile.color<f>(0, 0), color, live); });
            tile.store(memory);
            Framebuffer cleared = makeTarget(16, 16, format);
            Tile clean(16, TargetMemory(cleared));
            clean.begin(0, 0, TargetMemory(cleared), {{glm::vec4(0.25f)}, 1.0f, {}});
            clean.store(TargetMemory(cleared));
            for (int y = 0; y < 16; ++y) {
                for (int x = 0; x < 16; ++x) {
                    int lane = -1;
                    for (int l = 0; l < kLanes; ++l) lane = laneX(l) == x && laneY(l) == y ? l : lane;
                    const bool written = lane >= 0 && (live >> lane & 1u) != 0;
                    const auto at = static_cast<std::size_t>(y * 16 + x);
                    const bool same = format == Format::rgba32f ? target.color32f()[at] == cleared.color32f()[at]
                                                                : target.color8()[at] == cleared.color8()[at];
                    wrong += same == written;
                }
            }
        }
        measured("lanes wrong", wrong, 0);
    }

    // In a frame: pixels beside the triangle, and discarded ones, keep their bits.
    Framebuffer target = makeTarget(32, 32, Format::rgba32f, Store::keep);
    for (std::size_t i = 0; i < target.color32f().size(); ++i) {
        target.color32f()[i] = glm::vec4(static_cast<float>(i));
        target.depth()[i] = 0.9f + static_cast<float>(i) * 1e-6f;
    }
    const Framebuffer before = target;
    const Corners c = {{{1000, 300}, {7000, 2500}, {2200, 8000}}};
    Mesh mesh;
    fixture::addTriangle(mesh, c, glm::vec4(-1, -1, -1, 2));
    Frame frame(target, {1, 16});
    frame.setViewport({0, 0, 32, 32});
    frame.draw(mesh, FromPixels({0, 0, 32, 32}), DiscardPattern{}, kDepthTested);
    const Statistics statistics = frame.run();
    const ExactTriangle exact(c);
    int wrong = 0;
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 32; ++x) {
            const auto i = static_cast<std::size_t>(y * 32 + x);
            const bool written = exact.covers(x, y) && !isDiscarded(x, y, 2);
            wrong += target.color32f()[i] != (written ? glm::vec4(-1, -1, -1, 2) : before.color32f()[i]);
            wrong += target.depth()[i] != (written ? 0.5f : before.depth()[i]);
        }
    }
    measured("pixels wrong", wrong, 0);
    checkInvariants(target, statistics);
}

TEST_CASE("output merger: a colour that comes again is cleaned where other pixels are live (S-951)")
{
    for (const bool areOfLarge : {false, true}) {
        // A NaN in lane 0 does not count while lane 0 is not live, and does when it is.
        alignas(Float) Channels color;
        for (float(&channel)[kLanes] : color) Float(0.5f).store(channel);
        color[0][0] = std::numeric_limits<float>::quiet_NaN();
        std::int32_t stored[4 * kLanes] = {};
        ColorWriter<Format::rgba32f> writer(areOfLarge);
        CHECK(writer.write(stored, color, kAllLanes & ~1u) == 0);
        CHECK(stored[0] == 0);
        CHECK(writer.write(stored, color, 1u) == 1);
        CHECK(stored[0] == 0);  // NaN becomes 0
        CHECK(stored[1] == std::bit_cast<std::int32_t>(0.5f));

        // And the same colour twice is stored twice, wherever it lies.
        alignas(Float) Channels plain, again;
        for (float(&channel)[kLanes] : plain) Float(0.25f).store(channel);
        for (float(&channel)[kLanes] : again) Float(0.25f).store(channel);
        std::int32_t other[4 * kLanes] = {};
        CHECK(writer.write(stored, plain, kAllLanes) == 0);
        CHECK(writer.write(other, again, kAllLanes) == 0);
        CHECK(std::equal(stored, stored + 4 * kLanes, other));
    }
}

TEST_CASE("output merger: depth-tested scenes equal pixel-by-pixel comparison (S-905)")
{
    Random random(73);
    const auto keep = [](int, int, float) { return false; };
    Framebuffer expected = makeTarget(70, 40, Format::rgba32f, Store::keep);
    Framebuffer target = makeTarget(70, 40, Format::rgba32f, Store::keep);
    forEachCompare([&]<Compare compare>() {
        CAPTURE(static_cast<int>(compare));
        for (const float clearDepth : {0.0f, 0.5f, 1.0f}) {
            const std::vector<SceneTriangle> scene = randomScene(random, trials(120), 70, 40);
            for (const int tileSize : {16, 64}) {
                constexpr RenderState kWrite = {compare, true, true, Cull::none, Blend::off};
                drawByHand(scene, compare, true, clearDepth, keep, expected);
                const Statistics statistics = drawScene<kWrite>(scene, clearDepth, Value{}, {1, tileSize}, target);
                CHECK(sameBits(target, expected));
                checkInvariants(target, statistics);
            }
            constexpr RenderState kTestOnly = {compare, false, true, Cull::none, Blend::off};
            drawByHand(scene, compare, false, clearDepth, keep, expected);
            drawScene<kTestOnly>(scene, clearDepth, Value{}, {1, 32}, target);
            CHECK(sameBits(target, expected));
        }
    });
}

TEST_CASE("output merger: a discarded fragment neither shows nor hides (S-910)")
{
    Random random(74);
    Framebuffer expected = makeTarget(70, 40, Format::rgba32f, Store::keep);
    Framebuffer target = makeTarget(70, 40, Format::rgba32f, Store::keep);
    const auto compareAll = [&]<Compare compare>(float clearDepth) {
        constexpr RenderState kState = {compare, true, true, Cull::none, Blend::off};
        for (int i = 0; i < 4; ++i) {
            const std::vector<SceneTriangle> scene = randomScene(random, trials(120), 70, 40);
            drawByHand(scene, compare, true, clearDepth, isDiscarded, expected);
            const Statistics statistics = drawScene<kState>(scene, clearDepth, DiscardPattern{}, {1, 32}, target);
            CHECK(sameBits(target, expected));
            checkInvariants(target, statistics);
        }
    };
    compareAll.operator()<Compare::less>(1.0f);
    compareAll.operator()<Compare::lessEqual>(1.0f);
    compareAll.operator()<Compare::greater>(0.0f);
    compareAll.operator()<Compare::always>(1.0f);
}

TEST_CASE("output merger: a second pass at the same depths (S-901)")
{
    Random random(75);
    for (const Store storage : {Store::discard, Store::keep}) {
        Framebuffer target = makeTarget(70, 40, Format::rgba32f, storage);
        const std::vector<SceneTriangle> scene = randomScene(random, trials(100), 70, 40);
        Mesh mesh;
        for (const SceneTriangle& t : scene) addTriangle(mesh, t);
        const Viewport viewport = exactViewport(70, 40);
        constexpr RenderState kLess = {Compare::less, true, true, Cull::none, Blend::off};
        constexpr RenderState kLessAgain = {Compare::less, true, true, Cull::none, Blend::additive};
        constexpr RenderState kEqual = {Compare::equal, false, true, Cull::none, Blend::additive};
        constexpr RenderState kLessEqual = {Compare::lessEqual, false, true, Cull::none, Blend::additive};
        const auto twice = [&]<RenderState second>() {
            Frame frame(target, {1, 32});
            frame.clear(glm::vec4(0.0f));
            frame.setViewport(viewport);
            frame.draw(mesh, FromPixels(viewport), Uniform{float4(Float(1.0f))}, kLess);
            // Another program and more interpolators: the same depths all the same.
            frame.draw(mesh, FromPixels(viewport), Uniform{float4(Float(16.0f))}, second);
            checkInvariants(target, frame.run());
            int first = 0, second_ = 0;
            for (const glm::vec4& c : target.color32f()) {
                first += c.x != 0.0f;
                second_ += c.x > 1.0f;
            }
            CHECK(first > 1000);
            return std::pair(first, second_);
        };
        const auto [a, none] = twice.operator()<kLessAgain>();
        measured("pixels drawn again by `less`", none, 0);
        const auto [b, all] = twice.operator()<kEqual>();
        CHECK(all == b);
        const auto [c, allToo] = twice.operator()<kLessEqual>();
        CHECK(allToo == c);
        CHECK(a == b);
        CHECK(b == c);
    }
}

TEST_CASE("output merger: depth is linear on screen and within the corners' range")
{
    Framebuffer target = makeTarget(64, 64, Format::rgba32f, Store::keep);
    Mesh mesh;
    fixture::addTriangle(mesh, {{0, 0, 0.1f, 1}}, {{128, 0, 0.9f, 16}}, {{0, 128, 0.4f, 0.25f}});
    checkInvariants(target, drawPixels<kDepthTested>(target, mesh, One{}));
    double worst = 0.0;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            const double exact = static_cast<double>(0.1f) +
                                 (x + 0.5) / 128 * (static_cast<double>(0.9f) - static_cast<double>(0.1f)) +
                                 (y + 0.5) / 128 * (static_cast<double>(0.4f) - static_cast<double>(0.1f));
            worst = std::fmax(worst, std::fabs(target.depth()[static_cast<std::size_t>(y * 64 + x)] - exact));
        }
    }
    CHECK(worst <= 4 * 0x1p-24);
}
