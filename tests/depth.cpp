// Depth at its limits, and what never reaches a target: planes one behind the other, depths that are no numbers, and
// rectangles with nothing changed around them (stability cases S-902 to S-909, S-956, S-959).
#include <algorithm>
#include <limits>

#include "numbers.h"
#include "pipeline_fixture.h"

using namespace fixture;

namespace {

constexpr RenderState kReversed = {Compare::greater, true, true, Cull::none, Blend::off};

// Depth of a view distance: d = a + b / z.
struct Projection
{
    float a, b;
    double depth(double z) const { return static_cast<double>(a) + static_cast<double>(b) / z; }
    glm::vec4 clip(float x, float y, float z) const { return {x * z, y * z, a * z + b, z}; }

    // How far a plane has to be behind another at z for its depth to differ by one float.
    double step(double z) const
    {
        const auto d = static_cast<float>(depth(z));
        const double ulp = static_cast<double>(std::nextafter(d, 2.0f)) - static_cast<double>(d);
        return ulp / (std::fabs(static_cast<double>(b)) / (z * z));
    }
};

Projection standard(float near, float far)
{
    return {far / (far - near), -far * near / (far - near)};
}

void addPlane(Mesh& mesh, const Projection& projection, double z, double gap, const glm::vec4& value)
{
    // Slanted: from 0.8 z on the left to 1.2 z on the right, and across.
    const float slant[4] = {0.8f, 1.2f, 0.9f, 1.1f}, xs[4] = {-1.3f, 1.3f, -1.3f, 1.3f},
                ys[4] = {-1.3f, -1.3f, 1.3f, 1.3f};
    TestVertex v[4];
    for (int k = 0; k < 4; ++k) {
        const double at = z * static_cast<double>(slant[k]);
        v[k] = {projection.clip(xs[k], ys[k], static_cast<float>(at + gap)), value};
    }
    addTriangle(mesh, v[0], v[1], v[2]);
    addTriangle(mesh, v[2], v[1], v[3]);
}

// Pixels of two planes, `steps` floats of depth apart, that show the one behind, in either order of drawing.
template <RenderState state>
int wrongPixels(const Projection& projection, double z, double steps)
{
    const double gap = steps * std::fmax(projection.step(0.8 * z), projection.step(1.2 * z)) * 1.01;
    int wrong = 0;
    for (const bool nearFirst : {false, true}) {
        Mesh mesh;
        addPlane(mesh, projection, z, nearFirst ? 0.0 : gap, glm::vec4(nearFirst ? 1.0f : 2.0f));
        addPlane(mesh, projection, z, nearFirst ? gap : 0.0, glm::vec4(nearFirst ? 2.0f : 1.0f));
        Framebuffer target = makeTarget(64, 48, Format::rgba32f, Store::keep);
        Frame frame(target, {1, kDefaultTileSize});
        frame.clear(glm::vec4(0.0f), state.depthTest == Compare::greater ? 0.0f : 1.0f);
        frame.draw(mesh, FromClip{}, Value{}, state);
        checkInvariants(target, frame.run());
        wrong += pixelsNotEqualTo(target, 1.0f);
    }
    return wrong;
}

// From how many steps on no pixel is wrong any more, of `most`.
template <RenderState state>
int stepsNeeded(const Projection& projection, const std::vector<double>& distances, int most)
{
    int needed = 0;
    for (const double z : distances) {
        for (int steps = most; steps > needed; --steps) {
            if (wrongPixels<state>(projection, z, steps) > 0) {
                needed = steps + 1;
                break;
            }
        }
    }
    return needed;
}

constexpr int kSteps = 4;  // two for storage, and two for rounding in z / w and interpolation

std::uint64_t bitsOf(const Framebuffer& target, int x, int y)
{
    const std::size_t i =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(target.width()) + static_cast<std::size_t>(x);
    std::uint64_t hash = !target.color32f().empty() ? hashBytes(&target.color32f()[i], sizeof(glm::vec4))
                                                    : hashBytes(&target.color8()[i], 4);
    return hashBytes(&target.depth()[i], 4, hash);
}

}  // namespace

TEST_CASE("depth: S-902 of two planes the nearer one is seen, from a few steps of depth on")
{
    const int needed = stepsNeeded<kDepthTested>(standard(0.1f, 1000.0f), {0.2, 1.0, 10.0, 100.0, 500.0}, 12);
    measured("steps of depth between planes that are told apart", needed, kSteps);
}

TEST_CASE("depth: S-903 reversed, with the far plane at infinity, planes are told apart 1e6 units away")
{
    const Projection reversed = {0.0f, 0.1f};
    const int needed = stepsNeeded<kReversed>(reversed, {0.2, 1.0, 10.0, 1e3, 1e6}, 12);
    measured("steps of depth between planes that are told apart", needed, kSteps);
    stability::noted("units between them 1000 units away", needed * reversed.step(1000.0));
}

TEST_CASE("depth: S-904 near 1e-3 and far 1e6: finite, and right from as many steps on")
{
    const Projection wide = standard(1e-3f, 1e6f);
    const int needed = stepsNeeded<kDepthTested>(wide, {2e-3, 0.1, 1.0, 100.0}, 12);
    measured("steps of depth between planes that are told apart", needed, kSteps);
    stability::noted("units between them 100 units away", needed * wide.step(100.0));
}

TEST_CASE("depth: S-906 a vertex whose depth is NaN drops its triangle, and the cleared depth stays")
{
    constexpr RenderState kWrite = {Compare::always, true, true, Cull::none, Blend::off};
    constexpr RenderState kWriteUnclipped = {Compare::always, true, false, Cull::none, Blend::off};
    for (int corner = 0; corner < 3; ++corner) {
        for (const float bad : {kNan, kInfinity, -kInfinity}) {
            glm::vec4 p[3] = {{-1, -1, 0.5f, 1}, {-1, 3, 0.5f, 1}, {3, -1, 0.5f, 1}};
            p[corner].z = bad;
            Mesh mesh;
            addTriangle(mesh, {p[0]}, {p[1]}, {p[2]});
            for (const bool clip : {true, false}) {
                Framebuffer target = makeTarget(16, 16, Format::rgba32f, Store::keep);
                const Statistics statistics =
                    clip ? drawClip<kWrite>(target, mesh) : drawClip<kWriteUnclipped>(target, mesh);
                checkInvariants(target, statistics);
                CHECK(statistics.droppedNan + statistics.droppedInfinite == 1);
                measured("pixels drawn", statistics.pixelsShaded, 0);
                for (const float z : target.depth()) CHECK(z == 1.0f);
            }
        }
    }
}

TEST_CASE("depth: S-909 a depth one float beyond 0 or 1, not clipped, is 0 or 1")
{
    constexpr RenderState kUnclipped = {Compare::always, true, false, Cull::none, Blend::off};
    const float above = std::nextafter(1.0f, 2.0f), below = -std::numeric_limits<float>::denorm_min();
    int wrong = 0;
    for (const auto& [z, expected] : {std::pair{above, 1.0f}, {below, 0.0f}, {-0.0f, 0.0f}, {1.0f, 1.0f}}) {
        Mesh mesh;
        addTriangle(mesh, {{-1, -1, z, 1}}, {{-1, 3, z, 1}}, {{3, -1, z, 1}});
        Framebuffer target = makeTarget(16, 16, Format::rgba32f, Store::keep);
        checkInvariants(target, drawClip<kUnclipped>(target, mesh));
        for (const float stored : target.depth()) wrong += stored != expected;
    }
    measured("depths wrong", wrong, 0);
}

TEST_CASE("depth: S-956 nothing outside of the rectangle that is drawn changes, however odd rows are")
{
    Random random(956);
    int changed = 0, same = 0;
    for (int trial = 0; trial < trials(300); ++trial) {
        const Format format = trial % 3 == 0 ? Format::rgba8 : trial % 3 == 1 ? Format::rgba8Srgb : Format::rgba32f;
        const int width = random.between(1, 70), height = random.between(1, 70);
        Framebuffer target = makeTarget(width, height, format, Store::keep);
        // Every pixel another pattern: the guard around what is drawn.
        for (std::uint32_t& c : target.color8()) c = static_cast<std::uint32_t>(random.next());
        for (glm::vec4& c : target.color32f()) c = {random.real(0, 1), random.real(0, 1), random.real(0, 1), 5.0f};
        for (float& z : target.depth()) z = random.real(0.5f, 1.0f);
        const Framebuffer before = target;
        const Rectangle r = {random.between(-3, width), random.between(-3, height), random.between(-3, width + 3),
                             random.between(-3, height + 3)};
        Mesh mesh;
        addTriangle(mesh, {{-1, -1, 0.25f, 1}, glm::vec4(0.5f)}, {{-1, 3, 0.25f, 1}, glm::vec4(0.5f)},
                    {{3, -1, 0.25f, 1}, glm::vec4(0.5f)});
        Frame frame(target, {1 + trial % 3, trial % 2 == 0 ? 16 : 64});
        if (trial % 2 == 0) {
            frame.setScissor(r);
        } else {
            frame.setViewport({r.x0, r.y0, std::max(0, r.x1 - r.x0), std::max(0, r.y1 - r.y0)});
        }
        frame.draw(mesh, FromClip{}, Value{}, kDepthTested);
        checkInvariants(target, frame.run());
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const bool inside = x >= r.x0 && x < r.x1 && y >= r.y0 && y < r.y1;
                const bool differs = bitsOf(target, x, y) != bitsOf(before, x, y);
                changed += differs && !inside;
                same += !differs && inside;
            }
        }
    }
    measured("pixels outside that changed", changed, 0);
    measured("pixels inside that did not", same, 0);
}

TEST_CASE(
    "depth: a NaN that the owner left in a kept depth passes no test but always and notEqual, whatever is around it")
{
    Mesh large, small;
    addTriangle(large, Corners{{{0, 0}, {400 * 256, 0}, {0, 400 * 256}}}, glm::vec4(1.0f), 0.5f);
    for (int y = 0; y < 64; y += 2) {
        for (int x = 0; x < 64; x += 2) {
            const int left = x * 256, top = y * 256, right = left + 512, bottom = top + 512;
            addTriangle(small, Corners{{{left, top}, {right, top}, {left, bottom}}}, glm::vec4(1.0f), 0.5f);
            addTriangle(small, Corners{{{right, top}, {right, bottom}, {left, bottom}}}, glm::vec4(1.0f), 0.5f);
        }
    }
    constexpr Compare kAll[] = {Compare::less,  Compare::lessEqual, Compare::greater, Compare::greaterEqual,
                                Compare::equal, Compare::notEqual,  Compare::always};
    const Viewport viewport = exactViewport(64, 64);
    int wrong = 0;
    for (const Compare first : kAll) {
        for (const Compare second : kAll) {
            for (const Mesh* mesh : {&large, &small}) {
                for (const int tileSize : {16, 64}) {
                    Framebuffer target = makeTarget(64, 64, Format::rgba32f, Store::keep);
                    std::vector<float> depths(64 * 64);
                    std::vector<int> counts(64 * 64);
                    for (std::size_t i = 0; i < depths.size(); ++i) {
                        depths[i] = i % 7 == 0 && i < 2000 ? kNan : i / 64 < 40 ? 0.75f : 0.25f;
                        target.depth()[i] = depths[i];
                        for (const Compare test : {first, second}) {
                            if (!compareBy(test, Float(0.5f), Float(depths[i]))[0]) continue;
                            depths[i] = 0.5f;
                            ++counts[i];
                        }
                    }
                    Frame frame(target, {1, tileSize});
                    frame.clearColor(glm::vec4(0.0f));
                    frame.setViewport(viewport);
                    for (const Compare test : {first, second}) {
                        const RenderState state = {test, true, true, Cull::none, Blend::additive};
                        REQUIRE(frame.draw(*mesh, FromPixels(viewport), Value{}, state));
                    }
                    frame.run();
                    wrong += wrongCounts(target, counts);
                    wrong += std::memcmp(target.depth().data(), depths.data(), depths.size() * 4) != 0;
                }
            }
        }
    }
    measured("pixels wrong", wrong, 0);
}

TEST_CASE("depth: S-959 NaN that the owner left in a target is gone wherever something is blended, and stays elsewhere")
{
    constexpr RenderState kOver = {Compare::always, false, true, Cull::none, Blend::alpha};
    int notFinite = 0, changed = 0;
    const auto check = [&]<RenderState state>() {
        for (const float bad : {kNan, kInfinity, -kInfinity}) {
            Framebuffer target = makeTarget(40, 24);
            for (glm::vec4& c : target.color32f()) c = glm::vec4(bad);
            const Framebuffer before = target;
            Mesh mesh;
            addTriangle(mesh, Corners{{{0, 0}, {40 * 256, 0}, {0, 24 * 256}}}, glm::vec4(0.5f));
            const Viewport viewport = exactViewport(40, 24);
            Frame frame(target, {1, kDefaultTileSize});
            frame.setViewport(viewport);
            frame.draw(mesh, FromPixels(viewport), Value{}, state);
            CHECK(addsUp(frame.run()));
            const ExactTriangle exact(Corners{{{0, 0}, {40 * 256, 0}, {0, 24 * 256}}});
            for (int y = 0; y < 24; ++y) {
                for (int x = 0; x < 40; ++x) {
                    const glm::vec4 c = pixel(target, x, y);
                    if (exact.covers(x, y)) {
                        for (int i = 0; i < 4; ++i) notFinite += !std::isfinite(c[i]);
                    } else {
                        changed += std::memcmp(&c, &pixel(before, x, y), sizeof c) != 0;
                    }
                }
            }
        }
    };
    check.template operator()<kCount>();
    check.template operator()<kOver>();
    check.template operator()<kPaint>();
    measured("numbers NaN or infinite where something was drawn", notFinite, 0);
    measured("other pixels that changed", changed, 0);
}
