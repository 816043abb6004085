// Clipping: cuts lie where they belong, neighbours cut alike, nothing is lost or doubled, and clipping itself does not
// show. References are in double (see HomogeneousTriangle in pipeline_fixture.h).
#include "relief/pipeline/clip.h"

#include "numbers.h"
#include "pipeline_fixture.h"
#include "relief/pipeline/viewport_transform.h"

using namespace fixture;

namespace {

// Positions are moved by at most a rounding to 1/256 px and, where the guard band cuts, 2^-23 of it, four times.
constexpr double kEdgeTolerance = 1.0 / 32.0;

Mesh meshOf(const glm::vec4& a, const glm::vec4& b, const glm::vec4& c)
{
    Mesh mesh;
    addTriangle(mesh, {a}, {b}, {c});
    return mesh;
}

// The pixels that are clearly inside of the reference but not drawn, and clearly outside but drawn, and drawn twice.
int wrongPixels(const Framebuffer& target, const HomogeneousTriangle& reference, bool depthClip = true)
{
    int wrong = 0;
    for (int y = 0; y < target.height(); ++y) {
        for (int x = 0; x < target.width(); ++x) {
            const double margin = reference.margin(x + 0.5, y + 0.5, depthClip);
            const float drawn = pixel(target, x, y).x;
            wrong += drawn != 0.0f && drawn != 1.0f;
            wrong += margin > kEdgeTolerance && drawn == 0.0f;
            wrong += margin < -kEdgeTolerance && drawn != 0.0f;
        }
    }
    return wrong;
}

int drawnPixels(const Framebuffer& target)
{
    int drawn = 0;
    for (const glm::vec4& c : target.color32f()) drawn += c != glm::vec4(0.0f);
    return drawn;
}

glm::vec4 randomClipPosition(Random& random, float reach)
{
    const float w = random.real(-1.0f, 2.0f);
    return {random.real(-reach, reach), random.real(-reach, reach), random.real(-0.5f, 1.5f) * std::fabs(w), w};
}

}  // namespace

TEST_CASE("clip: the polygon is planar to the triangle, inside all planes, and keeps the triangle's corners' bits")
{
    Random random(40);
    int wrong = 0, clipped = 0;
    for (int trial = 0; trial < trials(50000); ++trial) {
        glm::vec4 corners[3];
        for (glm::vec4& c : corners) c = randomClipPosition(random, random.chance(3) ? 100.0f : 3.0f);
        const ClipLimits limits = {random.chance(2) ? 1.0f : 0.001f, random.chance(2) ? 1.0f : 0.001f,
                                   random.chance(2)};
        ClipVertex polygon[kMaxClippedVertices];
        const int count = clipTriangle(corners, limits, polygon);
        wrong += count != 0 && count < 3;
        wrong += count > kMaxClippedVertices;
        clipped += count > 0;
        for (int i = 0; i < count; ++i) {
            const ClipVertex& v = polygon[i];
            const float slack = 1e-5f * (std::fabs(v.position.x) + std::fabs(v.position.y) + std::fabs(v.position.w));
            wrong += !(v.position.w >= kSmallestW);
            wrong += std::fabs(v.position.x) * limits.inverseGuardX > v.position.w + slack;
            wrong += std::fabs(v.position.y) * limits.inverseGuardY > v.position.w + slack;
            if (limits.depthClip) wrong += v.position.z < -slack || v.position.z > v.position.w + slack;
            float sum = 0.0f;
            glm::vec4 position(0.0f);
            for (int k = 0; k < 3; ++k) {
                wrong += !(v.weight[k] >= 0.0f && v.weight[k] <= 1.0f);
                sum += v.weight[k];
                position += v.weight[k] * corners[k];
                if (v.weight[k] == 1.0f && v.weight[(k + 1) % 3] == 0.0f && v.weight[(k + 2) % 3] == 0.0f) {
                    for (int c = 0; c < 4; ++c) wrong += std::fabs(v.position[c] - corners[k][c]) > slack;
                }
            }
            wrong += std::fabs(sum - 1.0f) > 1e-6f;
            for (int c = 0; c < 4; ++c) wrong += std::fabs(position[c] - v.position[c]) > 3e-4f;
        }
    }
    CHECK(wrong == 0);
    CHECK(clipped > trials(50000) / 10);
}

TEST_CASE("clip: what is inside keeps its vertices, planes included (S-204, S-208)")
{
    const glm::vec4 cases[][3] = {
        {{-1, -1, 0, 1}, {1, -1, 0, 1}, {0, 1, 0, 1}},     // all on near
        {{-1, -1, 1, 1}, {1, -1, 1, 1}, {0, 1, 1, 1}},     // all on far
        {{-1, -1, 0, 1}, {1, -1, 1, 1}, {0, 1, 0.5f, 1}},  // one on each
        {{-4, 0, 0, 4}, {4, 4, 0, 4}, {4, -4, 4, 4}},      // w = 4, on the sides
        {{-1, -1, 0, 1}, {-1, 1, 0, 1}, {-1, 1, 1, 1}},    // all on the left plane
    };
    for (const auto& corners : cases) {
        ClipVertex polygon[kMaxClippedVertices];
        REQUIRE(clipTriangle(corners, {1.0f, 1.0f, true}, polygon) == 3);
        for (int k = 0; k < 3; ++k) {
            CHECK(polygon[k].position == corners[k]);
            CHECK(polygon[k].weight[k] == 1.0f);
        }
    }
}

TEST_CASE("clip: a corner or an edge on a plane makes no repeated vertices (S-204)")
{
    struct Case
    {
        glm::vec4 corners[3];
        int vertices;
    };
    const Case cases[] = {
        {{{0, 0, 0, 1}, {0.5f, 0, -0.5f, 1}, {0, 0.5f, -0.5f, 1}}, 0},     // touches near with a corner, outside
        {{{0, 0, 0, 1}, {0.5f, 0, 0, 1}, {0, 0.5f, -0.5f, 1}}, 0},         // with an edge, outside
        {{{0, 0, 0, 1}, {0.5f, 0, 0.5f, 1}, {0, 0.5f, -0.5f, 1}}, 3},      // through a corner
        {{{0, 0, 0, 1}, {0.5f, 0, 0, 1}, {0, 0.5f, 0.5f, 1}}, 3},          // with an edge, inside
        {{{0, 0, 0.5f, 1}, {0.5f, 0, 0.5f, 1}, {0, 0.5f, -0.5f, 1}}, 4},   // one corner cut off
        {{{0, 0, -0.5f, 1}, {0.5f, 0, -0.5f, 1}, {0, 0.5f, 0.5f, 1}}, 3},  // two corners cut off
    };
    for (const Case& c : cases) {
        ClipVertex polygon[kMaxClippedVertices];
        const int count = clipTriangle(c.corners, {1.0f, 1.0f, true}, polygon);
        CHECK(count == c.vertices);
        for (int i = 0; i < count; ++i) {
            for (int j = 0; j < i; ++j) CHECK(polygon[i].position != polygon[j].position);
        }
    }
}

TEST_CASE("clip: cutting next to a corner stays within the edge (S-201)")
{
    Random random(41);
    int wrong = 0;
    for (int trial = 0; trial < trials(20000); ++trial) {
        // One corner a hair inside of the near plane, from the smallest subnormal up.
        const int exponent = random.between(-149, -1);
        const float hair = std::ldexp(1.0f, exponent);
        const glm::vec4 corners[3] = {
            {random.real(-1, 1), random.real(-1, 1), hair, random.real(0.5f, 2)},
            {random.real(-1, 1), random.real(-1, 1), -random.real(0.1f, 2), random.real(0.5f, 2)},
            {random.real(-1, 1), random.real(-1, 1), -random.real(0.1f, 2), random.real(0.5f, 2)}};
        ClipVertex polygon[kMaxClippedVertices];
        const int count = clipTriangle(corners, {0.001f, 0.001f, true}, polygon);
        wrong += count != 3;
        for (int i = 1; i < count; ++i) {
            const glm::vec4& end = corners[polygon[i].weight[1] > 0.0f ? 1 : 2];
            const bool isCorner = polygon[i].position == corners[0];
            for (int c = 0; c < 4 && !isCorner; ++c) {
                wrong += polygon[i].position[c] < std::fmin(corners[0][c], std::fmin(corners[1][c], corners[2][c]));
                wrong += polygon[i].position[c] > std::fmax(corners[0][c], std::fmax(corners[1][c], corners[2][c]));
            }
            wrong += !std::isfinite(end.x);
        }
    }
    measured("coordinates outside of their edge's box", wrong, 0);
}

TEST_CASE("clip: two triangles cut their shared edge at the same bits (S-202)")
{
    Random random(42);
    int wrong = 0, cuts = 0;
    for (int trial = 0; trial < trials(100000); ++trial) {
        // a and b are shared, in opposite directions; c and d are not, and lie inside.
        glm::vec4 a, b;
        do {
            a = randomClipPosition(random, 2.0f);
            b = randomClipPosition(random, 2.0f);
        } while ((a.z < 0.0f) == (b.z < 0.0f));
        const glm::vec4 c = {random.real(-1, 1), random.real(-1, 1), 0.5f, 1}, d = {random.real(-1, 1), 1, 0.25f, 1};
        const ClipLimits limits = {0.01f, 0.01f, true};
        ClipVertex one[kMaxClippedVertices], other[kMaxClippedVertices];
        const glm::vec4 first[3] = {a, b, c}, second[3] = {b, a, d};
        const int countOne = clipTriangle(first, limits, one), countOther = clipTriangle(second, limits, other);
        // The cuts through a-b have no share of the third corner.
        const auto onEdge = [](const ClipVertex* polygon, int count, int third) {
            std::vector<glm::vec4> points;
            for (int i = 0; i < count; ++i) {
                if (polygon[i].weight[third] == 0.0f) points.push_back(polygon[i].position);
            }
            return points;
        };
        const std::vector<glm::vec4> mine = onEdge(one, countOne, 2), theirs = onEdge(other, countOther, 2);
        cuts += !mine.empty();
        wrong += mine.size() != theirs.size();
        for (const glm::vec4& p : mine) wrong += std::find(theirs.begin(), theirs.end(), p) == theirs.end();
    }
    measured("cuts of a shared edge that differ", wrong, 0);
    CHECK(cuts > trials(100000) / 2);
}

TEST_CASE("clip: a triangle through all six planes with the frustum inside covers everything (S-203, S-206)")
{
    // x, y and depth all leave the view volume between the corners; at the screen depth is within 0..1 everywhere.
    const glm::vec4 a = {-3e5f, -2.9e5f, -5.5f, 1}, b = {3.1e5f, -3e5f, 6.5f, 1}, c = {1e4f, 4e5f, 0.4f, 1};
    for (const int size : {16, 64, 100}) {
        Framebuffer target = makeTarget(size, size);
        const Statistics statistics = drawClip(target, meshOf(a, b, c));
        measured("pixels not covered once", pixelsNotEqualTo(target, 1.0f),
                 0);  // the fan's inner edges are no holes and hit nothing twice
        CHECK(statistics.trianglesClipped == 1);
        checkInvariants(target, statistics);
    }

    // The clipper alone, at the view volume's own planes: all six cut, and nine vertices are room enough.
    Random random(43);
    int most = 0;
    for (int trial = 0; trial < trials(200000); ++trial) {
        glm::vec4 corners[3];
        for (glm::vec4& p : corners)
            p = {random.real(-4, 4), random.real(-4, 4), random.real(-4, 4), random.real(-1, 3)};
        ClipVertex polygon[kMaxClippedVertices];
        most = std::max(most, clipTriangle(corners, {1.0f, 1.0f, true}, polygon));
    }
    CHECK(most >= 7);
    measured("corners of a clipped polygon", most, 9);
    CHECK(9 <= kMaxClippedVertices);
}

TEST_CASE("clip: random triangles through the near plane, the eye plane and the guard band lie where they should")
{
    Random random(44);
    Framebuffer target = makeTarget(40, 30);
    int wrong = 0, clipped = 0, finite = 0;
    bool sums = true;
    const int count = trials(3000);
    for (int trial = 0; trial < count; ++trial) {
        const float reach = random.chance(3) ? 1e6f : random.chance(2) ? 300.0f : 3.0f;
        const glm::vec4 a = randomClipPosition(random, random.chance(2) ? 1.0f : reach);
        const glm::vec4 b = randomClipPosition(random, reach), c = randomClipPosition(random, reach);
        const Statistics statistics = drawClip(target, meshOf(a, b, c));
        wrong += wrongPixels(target, HomogeneousTriangle(a, b, c, {0, 0, 40, 30}));
        clipped += statistics.trianglesClipped != 0 && drawnPixels(target) != 0;
        finite += allFinite(target);
        sums = sums && addsUp(statistics);
    }
    CHECK(wrong == 0);
    CHECK(clipped > count / 20);
    CHECK(finite == count);
    CHECK(sums);
}

TEST_CASE("clip: a NaN in a corner drops the triangle, and the others stay as they are (S-101)")
{
    Framebuffer with = makeTarget(40, 40), without = makeTarget(40, 40);
    const TestVertex a = {{-0.9f, -0.9f, 0.5f, 1}}, b = {{0.1f, 0.9f, 0.5f, 1}}, c = {{0.9f, -0.8f, 0.5f, 1}};
    for (int corner = 0; corner < 3; ++corner) {
        for (int component = 0; component < 4; ++component) {
            for (const float bad : {kNan, -kNan, kInfinity, -kInfinity}) {
                TestVertex bent[3] = {a, b, c};
                bent[corner].position[component] = bad;
                Mesh mesh;
                addTriangle(mesh, a, b, c);
                addTriangle(mesh, bent[0], bent[1], bent[2]);
                addTriangle(mesh, a, c, b);
                const Statistics statistics = drawClip(with, mesh);
                Mesh clean;
                addTriangle(clean, a, b, c);
                addTriangle(clean, a, c, b);
                drawClip(without, clean);
                CHECK(sameBits(with, without));
                CHECK(statistics.droppedNan == (std::isnan(bad) ? 1 : 0));
                CHECK(statistics.droppedInfinite == (std::isnan(bad) ? 0 : 1));
                checkInvariants(with, statistics);
            }
        }
    }
}

TEST_CASE("clip: corners at 1e30 and 3.4e34 leave the visible edges in place (S-102, S-103)")
{
    Random random(45);
    Framebuffer target = makeTarget(48, 48);
    int wrong = 0, drawn = 0;
    bool finite = true, sums = true;
    for (int trial = 0; trial < trials(3000); ++trial) {
        const float large = random.chance(2) ? 1e30f : 3.4e34f;
        const auto corner = [&](bool far) {
            const float w = random.chance(2) ? 1.0f : random.real(0.01f, 10.0f);
            if (!far) return glm::vec4{random.real(-1, 1) * w, random.real(-1, 1) * w, 0.5f * w, w};
            // Some coordinates large, in any combination; depth stays inside so that the whole triangle counts.
            glm::vec4 p = {random.real(-1, 1), random.real(-1, 1), 0.5f * w, w};
            const int which = random.between(1, 3);
            if ((which & 1) != 0) p.x *= large;
            if ((which & 2) != 0) p.y *= large;
            return p;
        };
        const glm::vec4 a = corner(random.chance(3)), b = corner(true), c = corner(random.chance(2));
        const Statistics statistics = drawClip(target, meshOf(a, b, c));
        wrong += wrongPixels(target, HomogeneousTriangle(a, b, c, {0, 0, 48, 48}));
        drawn += drawnPixels(target) != 0;
        finite = finite && allFinite(target);
        sums = sums && addsUp(statistics);
    }
    measured("pixels wrong by more than 1/32 px", wrong, 0);
    CHECK(drawn > trials(3000) / 10);
    CHECK(finite);
    CHECK(sums);

    // A large w with it: an ordinary triangle in disguise.
    for (const float scale : {1e30f, 3.4e34f, 1e38f}) {
        Framebuffer plain = makeTarget(48, 48);
        const glm::vec4 a = {-0.5f, -0.75f, 0.5f, 1}, b = {0, 0.75f, 0.5f, 1}, c = {0.5f, -0.25f, 0.5f, 1};
        drawClip(plain, meshOf(a, b, c));
        drawClip(target, meshOf(a * scale, b * scale, c * scale));
        CHECK(wrongPixels(target, HomogeneousTriangle(a, b, c, {0, 0, 48, 48})) == 0);
        CHECK(drawnPixels(plain) > 0);
    }
}

TEST_CASE("clip: w = 0 in one, two and three corners (S-104)")
{
    Random random(46);
    Framebuffer zero = makeTarget(48, 48), small = makeTarget(48, 48);
    int wrong = 0, drawn = 0;
    for (int trial = 0; trial < trials(2000); ++trial) {
        const int zeros = random.between(1, 3);
        glm::vec4 p[3], q[3];
        for (int k = 0; k < 3; ++k) {
            p[k] = {random.real(-1, 1), random.real(-1, 1), 0.0f, random.real(0.1f, 1)};
            if (k < zeros) p[k].w = 0.0f;
            q[k] = p[k];
            if (k < zeros) q[k].w = 1e-6f;
        }
        const Statistics statistics = drawClip(zero, meshOf(p[0], p[1], p[2]));
        wrong += wrongPixels(zero, HomogeneousTriangle(p[0], p[1], p[2], {0, 0, 48, 48}));
        wrong += !addsUp(statistics) || !allFinite(zero);
        if (zeros == 3) {
            wrong += drawnPixels(zero);
            continue;
        }
        drawn += drawnPixels(zero) != 0;
        // The same as with a tiny w, but for pixels near an edge.
        drawClip(small, meshOf(q[0], q[1], q[2]));
        const HomogeneousTriangle reference(q[0], q[1], q[2], {0, 0, 48, 48});
        for (int y = 0; y < 48; ++y) {
            for (int x = 0; x < 48; ++x) {
                wrong += pixel(zero, x, y) != pixel(small, x, y) && std::fabs(reference.margin(x + 0.5, y + 0.5)) > 1.0;
            }
        }
    }
    measured("pixels wrong", wrong, 0);
    CHECK(drawn > trials(2000) / 4);
}

TEST_CASE("clip: no mirrored ghost from behind the eye, nothing from a subnormal w (S-105, S-106)")
{
    Framebuffer target = makeTarget(32, 32);
    for (const float w : {-1.0f, -0.001f, -1e-40f, 1e-40f, 1.17549435e-38f, 0.0f}) {
        for (const bool depthClip : {true, false}) {
            CAPTURE(w);
            const float x = std::fabs(w) > 0 ? std::fabs(w) * 0.5f : 0.5f;
            const Mesh mesh = meshOf({-x, -x, 0, w}, {0, x, 0, w}, {x, -x, 0, w});
            const Statistics statistics =
                depthClip
                    ? drawClip(target, mesh)
                    : drawClip<RenderState{Compare::always, false, false, Cull::none, Blend::additive}>(target, mesh);
            measured("pixels drawn", drawnPixels(target), 0);
            CHECK(statistics.outside == 1);
            checkInvariants(target, statistics);
        }
    }
    // One subnormal corner among ordinary ones.
    const glm::vec4 a = {-0.5f, -0.5f, 0, 1}, b = {0.1f, 0.5f, 0, 1e-40f}, c = {0.5f, -0.5f, 0, 1};
    const Statistics statistics = drawClip(target, meshOf(a, b, c));
    measured("pixels wrong by more than 1/32 px", wrongPixels(target, HomogeneousTriangle(a, b, c, {0, 0, 32, 32})), 0);
    CHECK(drawnPixels(target) > 0);
    checkInvariants(target, statistics);
}

TEST_CASE("clip: clipping at the viewport instead of at the guard band hardly shows (S-205)")
{
    Random random(47);
    const Viewport viewport = {0, 0, 48, 48};
    const ViewportTransform transform(viewport);
    const auto cover = [&](const glm::vec4* polygon, int count, std::vector<int>& counts) {
        for (int i = 0; i + 2 < count; ++i) {
            Corners c;
            for (int k = 0; k < 3; ++k) {
                const ScreenLanes s = transform.project(broadcast(polygon[k == 0 ? 0 : i + k]));
                c[static_cast<std::size_t>(k)] = {s.x[0], s.y[0]};
            }
            addExactCoverage(c, 48, 48, counts);
        }
    };
    int wrong = 0, compared = 0;
    for (int trial = 0; trial < trials(3000); ++trial) {
        glm::vec4 corners[3];
        for (glm::vec4& p : corners) {
            const float w = random.real(0.25f, 2.0f), reach = random.chance(2) ? 0.9f : 30.0f;
            p = {random.real(-reach, reach) * w, random.real(-reach, reach) * w, 0.5f * w, w};
        }
        ClipVertex polygon[kMaxClippedVertices];
        const int count = clipTriangle(corners, {1.0f, 1.0f, true}, polygon);
        glm::vec4 positions[kMaxClippedVertices];
        for (int i = 0; i < count; ++i) positions[i] = polygon[i].position;
        std::vector<int> clipped(48 * 48), whole(48 * 48);
        cover(positions, count, clipped);
        cover(corners, 3, whole);
        compared += count > 3;
        const HomogeneousTriangle reference(corners[0], corners[1], corners[2], viewport);
        for (int i = 0; i < 48 * 48; ++i) {
            const auto at = static_cast<std::size_t>(i);
            if (clipped[at] == whole[at]) continue;
            // New corners lie on the border of the view and are rounded to 1/256 px like all others.
            wrong += std::fabs(reference.margin(i % 48 + 0.5, i / 48 + 0.5)) > kEdgeTolerance;
        }
    }
    measured("pixels that differ farther than 1/32 px from an edge", wrong, 0);
    CHECK(compared > trials(3000) / 10);
}

TEST_CASE("clip: inside of the guard band nothing is clipped, beyond it something is (S-205)")
{
    Framebuffer target = makeTarget(64, 64);
    const auto clippedAt = [&](float pixels) {
        return drawPixels(
                   target,
                   [&] {
                       Mesh mesh;
                       addTriangle(mesh, {{-pixels, 10, 0.5f, 1}}, {{pixels, 0, 0.5f, 1}}, {{30, pixels, 0.5f, 1}});
                       return mesh;
                   }())
            .trianglesClipped;
    };
    CHECK(clippedAt(100.0f) == 0);
    CHECK(clippedAt(32000.0f) == 0);
    CHECK(clippedAt(40000.0f) == 1);
    CHECK(clippedAt(1e9f) == 1);
}

TEST_CASE("clip: a mesh around the eye covers every pixel once (S-202, S-206, S-301)")
{
    // A cube seen from inside, its sides cut into a jittered grid of random triangles. Many lie behind the eye, cross
    // the eye plane or leave the guard band.
    Random random(48);
    int wrong = 0;
    std::uint64_t clipped = 0;
    bool sums = true;
    const int count = trials(1500);
    for (int trial = 0; trial < count; ++trial) {
        const int width = random.between(17, 90), height = random.between(17, 90);
        Framebuffer target = makeTarget(width, height);
        // A random rotation from a quaternion, and an eye well inside, sometimes very near to a side.
        float q[4], length = 0.0f;
        for (float& component : q) {
            component = random.real(-1, 1);
            length += component * component;
        }
        for (float& component : q) component /= std::sqrt(length);
        const auto rotate = [&](const glm::vec3& v) {
            const glm::vec3 u(q[0], q[1], q[2]);
            const auto cross3 = [](const glm::vec3& a, const glm::vec3& b) {
                return glm::vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
            };
            return v + 2.0f * cross3(u, cross3(u, v) + q[3] * v);
        };
        const float edge = random.chance(3) ? 0.9999f : 0.8f;
        const glm::vec3 eye = {random.real(-edge, edge), random.real(-edge, edge), random.real(-edge, edge)};
        const float near = 1e-6f, far = 10.0f;
        const auto toClip = [&](const glm::vec3& p) {
            const glm::vec3 v = rotate(p - eye);
            return glm::vec4(v.x * 1.5f, v.y * 1.5f, (v.z - near) * far / (far - near), v.z);
        };

        const int n = random.between(1, 5);
        Mesh mesh;
        for (int side = 0; side < 6; ++side) {
            std::vector<glm::vec4> points;
            for (int j = 0; j <= n; ++j) {
                for (int i = 0; i <= n; ++i) {
                    float s = static_cast<float>(i) * 2 / static_cast<float>(n) - 1;
                    float t = static_cast<float>(j) * 2 / static_cast<float>(n) - 1;
                    if (i > 0 && i < n && j > 0 && j < n) {
                        s += random.real(-0.4f, 0.4f) / static_cast<float>(n);
                        t += random.real(-0.4f, 0.4f) / static_cast<float>(n);
                    }
                    const float r = (side & 1) != 0 ? 1.0f : -1.0f;
                    const glm::vec3 p = side < 2   ? glm::vec3(r, s, t)
                                        : side < 4 ? glm::vec3(s, r, t)
                                                   : glm::vec3(s, t, r);
                    points.push_back(toClip(p));
                }
            }
            for (int j = 0; j < n; ++j) {
                for (int i = 0; i < n; ++i) {
                    const auto at = [&](int x, int y) -> TestVertex {
                        return {points[static_cast<std::size_t>((j + y) * (n + 1) + i + x)]};
                    };
                    const int turn = random.chance(2) ? 1 : 0;
                    if (turn == 1) {
                        addTriangle(mesh, at(0, 0), at(1, 0), at(1, 1));
                        addTriangle(mesh, at(0, 1), at(0, 0), at(1, 1));
                    } else {
                        addTriangle(mesh, at(1, 0), at(0, 1), at(0, 0));
                        addTriangle(mesh, at(1, 1), at(0, 1), at(1, 0));
                    }
                }
            }
        }
        const int tileSizes[] = {16, 32, 64, 128};
        const Statistics statistics = drawClip(target, mesh, One{}, {1, tileSizes[random.between(0, 3)]});
        wrong += pixelsNotEqualTo(target, 1.0f) != 0;
        clipped += statistics.trianglesClipped;
        sums = sums && addsUp(statistics);
    }
    measured("pixels not covered once", wrong, 0);
    CHECK(sums);
    CHECK(clipped > static_cast<std::uint64_t>(count));
}

TEST_CASE("clip: a mesh cut by the near plane in view has no holes and no doubled pixels (S-202, S-206)")
{
    // A plane in space, a grid of random triangles, through the near and the far plane within the picture.
    Random random(49);
    int wrong = 0;
    std::uint64_t clipped = 0;
    for (int trial = 0; trial < trials(1500); ++trial) {
        Framebuffer target = makeTarget(64, 48);
        const float w = random.real(0.5f, 1.0f), slant = random.real(-0.5f, 0.5f);
        const float zx = random.real(-1, 1), zy = random.real(-1, 1), z0 = random.real(0.2f, 0.8f);
        // Clip-space positions over the plane's parameters s and t; the corners are outside of the view.
        const auto at = [&](float s, float t) {
            const float ww = w + 0.2f * slant * s + 0.1f * t;
            return glm::vec4(2.5f * s, 2.5f * t, z0 + zx * s + zy * t, ww);
        };
        const int n = random.between(2, 8);
        std::vector<glm::vec4> points;
        for (int j = 0; j <= n; ++j) {
            for (int i = 0; i <= n; ++i) {
                const bool inner = i > 0 && i < n && j > 0 && j < n;
                const float jitter = inner ? 0.4f / static_cast<float>(n) : 0.0f;
                const float u = static_cast<float>(i) * 2 / static_cast<float>(n) - 1 + random.real(-jitter, jitter);
                const float v = static_cast<float>(j) * 2 / static_cast<float>(n) - 1 + random.real(-jitter, jitter);
                points.push_back(at(u, v));
            }
        }
        Mesh mesh;
        for (int j = 0; j < n; ++j) {
            for (int i = 0; i < n; ++i) {
                const auto p = [&](int x, int y) -> TestVertex {
                    return {points[static_cast<std::size_t>((j + y) * (n + 1) + i + x)]};
                };
                if (random.chance(2)) {
                    addTriangle(mesh, p(0, 0), p(1, 0), p(1, 1));
                    addTriangle(mesh, p(0, 0), p(1, 1), p(0, 1));
                } else {
                    addTriangle(mesh, p(1, 0), p(0, 1), p(0, 0));
                    addTriangle(mesh, p(0, 1), p(1, 0), p(1, 1));
                }
            }
        }
        clipped += drawClip(target, mesh).trianglesClipped;
        // The plane is flat: its two big halves tell where it is to be seen.
        const glm::vec4 corner[4] = {at(-1, -1), at(1, -1), at(1, 1), at(-1, 1)};
        const HomogeneousTriangle one(corner[0], corner[1], corner[2], {0, 0, 64, 48});
        const HomogeneousTriangle other(corner[0], corner[2], corner[3], {0, 0, 64, 48});
        for (int y = 0; y < 48; ++y) {
            for (int x = 0; x < 64; ++x) {
                const float hits = pixel(target, x, y).x;
                wrong += hits != 0.0f && hits != 1.0f;
                // Depth tells in or out; which of the two halves it is does not matter.
                const double depth = one.depthAt(x + 0.5, y + 0.5);
                const double depthOther = other.depthAt(x + 0.5, y + 0.5);
                if (std::fabs(depth - depthOther) > 1e-5) continue;  // float corners: hardly ever quite flat
                const bool within = one.margin(x + 0.5, y + 0.5) > 0.1 || other.margin(x + 0.5, y + 0.5) > 0.1;
                const bool beyond = depth < -1e-3 || depth > 1.001;
                wrong += within && hits != 1.0f;
                wrong += beyond && hits != 0.0f;
            }
        }
    }
    measured("pixels not covered once", wrong, 0);
    CHECK(clipped > static_cast<std::uint64_t>(trials(1500)));
}

TEST_CASE("clip: triangles cut by the near plane, at every one of several samples (S-211)")
{
    Random random(60);
    int wrong = 0, wrongDepths = 0, twice = 0;
    std::uint64_t clipped = 0;
    for (int trial = 0; trial < trials(600); ++trial) {
        const SamplePattern& pattern = kSamplePatterns[1 + trial % 3];
        const int count = pattern.count;
        const std::vector<Attachment> attachments = {{Format::rgba32f}, {Format::depth32f}};
        Framebuffer target = *Framebuffer::create(40, 30, attachments, count);
        // At least one corner in front of the near plane, at least one behind it: w >= 0.1 keeps the eye out of it.
        const auto corner = [&](bool isVisible) {
            const float w = random.real(0.1f, 2.0f), z = random.real(0.0f, 0.9f) * w;
            return glm::vec4(random.real(-1.5f, 1.5f) * w, random.real(-1.5f, 1.5f) * w, isVisible ? z : -z, w);
        };
        const glm::vec4 a = corner(true), b = corner(false), c = corner(random.chance(2)), d = corner(random.chance(2));
        Mesh mesh;
        addTriangle(mesh, {a}, {b}, {c});
        clipped += drawClip(target, mesh).trianglesClipped;
        const Viewport viewport = {0, 0, 40, 30};
        const HomogeneousTriangle exact(a, b, c, viewport);
        const auto samplesInside = [&](int x, int y, double margin) {
            int inside = 0;
            for (int k = 0; k < count; ++k) {
                const auto [sx, sy] = pattern.position[static_cast<std::size_t>(k)];
                inside += exact.margin(x + 0.5 + sx / 256.0, y + 0.5 + sy / 256.0) > margin;
            }
            return inside;
        };
        const auto hitsOf = [&](const Framebuffer& drawn, int x, int y) {
            return static_cast<double>(pixel(drawn, x, y).x) * count;
        };
        for (int y = 0; y < 30; ++y) {
            for (int x = 0; x < 40; ++x) {
                const double hits = hitsOf(target, x, y);
                wrong += hits < samplesInside(x, y, kEdgeTolerance) || hits > samplesInside(x, y, -kEdgeTolerance) ||
                         hits != std::floor(hits);
                const float depth = target.depth()[static_cast<std::size_t>(y * 40 + x)];
                wrongDepths += !(depth >= 0.0f && depth <= 1.0f);
            }
        }
        // Both sides of the edge from b to c, unless they fold over each other: each sample once.
        const double side =
            (c.x / c.w - b.x / b.w) * (a.y / a.w - b.y / b.w) - (c.y / c.w - b.y / b.w) * (a.x / a.w - b.x / b.w);
        const double other =
            (c.x / c.w - b.x / b.w) * (d.y / d.w - b.y / b.w) - (c.y / c.w - b.y / b.w) * (d.x / d.w - b.x / b.w);
        if (side * other >= 0.0) continue;
        addTriangle(mesh, {c}, {b}, {d});
        drawClip(target, mesh);
        for (int y = 0; y < 30; ++y) {
            for (int x = 0; x < 40; ++x) twice += hitsOf(target, x, y) > count;
        }
    }
    measured("pixels whose number of samples no exact cut gives", wrong, 0);
    measured("depths out of 0 to 1", wrongDepths, 0);
    measured("pixels with a sample hit twice along a shared edge", twice, 0);
    CHECK(clipped > static_cast<std::uint64_t>(trials(600)) / 2);
}

TEST_CASE("clip: z at the limits is kept, depth clipping off clamps depth per pixel (S-207, S-208)")
{
    Framebuffer target = makeTarget(32, 32, Format::rgba32f, Store::keep);
    const auto draw = [&]<RenderState state>(float z0, float z1, float z2) {
        Mesh mesh;
        addTriangle(mesh, {{-16, -16, z0, 1}}, {{80, -16, z1, 1}}, {{-16, 80, z2, 1}});
        return drawPixels<state>(target, mesh);
    };
    constexpr RenderState kClip = {Compare::always, true, true, Cull::none, Blend::off};
    constexpr RenderState kClamp = {Compare::always, true, false, Cull::none, Blend::off};
    for (const float z : {0.0f, 0.5f, 1.0f}) {
        const Statistics statistics = draw.template operator()<kClip>(z, z, z);
        measured("pixels not drawn", pixelsNotEqualTo(target, 1.0f), 0);
        CHECK(statistics.trianglesClipped == 0);
        for (const float stored : target.depth()) REQUIRE(stored == z);
    }
    for (const float z : {-1e-6f, -3.0f, 1.0001f, 100.0f}) {
        draw.template operator()<kClip>(z, z, z);
        CHECK(drawnPixels(target) == 0);
    }
    for (const float z : {-1e30f, -3.0f, -1e-6f, 0.0f, 0.25f, 1.0f, 1.0001f, 100.0f, 1e30f}) {
        const Statistics statistics = draw.template operator()<kClamp>(z, z, z);
        measured("pixels not drawn", pixelsNotEqualTo(target, 1.0f), 0);
        CHECK(statistics.trianglesClipped == 0);
        for (const float stored : target.depth()) REQUIRE(stored == std::fmin(std::fmax(z, 0.0f), 1.0f));
        checkInvariants(target, statistics);
    }
    // Depth that leaves the range within the triangle: linear where it is inside, the limits beyond.
    const auto checkRamp = [&](float z0, float z1, float z2) {
        draw.template operator()<kClamp>(z0, z1, z2);
        int wrong = 0;
        for (int y = 0; y < 32; ++y) {
            for (int x = 0; x < 32; ++x) {
                const double b1 = (x + 16.5) / 96, b2 = (y + 16.5) / 96;
                const double z = z0 + b1 * (double{z1} - z0) + b2 * (double{z2} - z0);
                const double scale = std::fmax(1.0, std::fmax(std::fabs(z0), std::fmax(std::fabs(z1), std::fabs(z2))));
                const double stored = target.depth()[static_cast<std::size_t>(y * 32 + x)];
                wrong += std::fabs(stored - std::fmin(std::fmax(z, 0.0), 1.0)) > 8 * 0x1p-24 * scale;
            }
        }
        measured("depths off by more than 8 * 2^-24", wrong, 0);
    };
    checkRamp(0.0f, 1.0f, 0.5f);
    checkRamp(-1.0f, 2.0f, 0.5f);
    checkRamp(2.0f, -1.0f, -1.0f);
    checkRamp(-0.1f, 0.7f, 30.0f);
}

TEST_CASE("clip: depth clipping off still clips behind the eye (S-207)")
{
    constexpr RenderState kClamp = {Compare::always, false, false, Cull::none, Blend::additive};
    Random random(50);
    Framebuffer target = makeTarget(40, 30);
    int wrong = 0;
    bool fine = true;
    for (int trial = 0; trial < trials(1500); ++trial) {
        const glm::vec4 a = randomClipPosition(random, 3), b = randomClipPosition(random, 3),
                        c = randomClipPosition(random, 30);
        const Statistics statistics = drawClip<kClamp>(target, meshOf(a, b, c));
        wrong += wrongPixels(target, HomogeneousTriangle(a, b, c, {0, 0, 40, 30}), false);
        fine = fine && addsUp(statistics) && allFinite(target);
    }
    measured("pixels wrong by more than 1/32 px", wrong, 0);
    CHECK(fine);
}

TEST_CASE("clip: attributes stay linear over many cuts (S-210)")
{
    // A strip is cut and cut again: 1000 times its one end moves to the middle of what is left of the edge, the way
    // repeated clipping moves it. The weights must still describe the position.
    ClipVertex polygon[kMaxClippedVertices];
    glm::vec4 corners[3] = {{-1, 0, 0.5f, 1}, {1, 0.5f, 0.5f, 1}, {1, -0.5f, 0.5f, 1}};
    double u[3] = {0, 1, 1};  // u = (x + 1) / 2 at the corners
    double worst = 0.0;
    Random random(51);
    for (int cutNumber = 0; cutNumber < 1000; ++cutNumber) {
        // Shift the near plane through the triangle: z = x - where, and clip.
        const float low = corners[0].x, high = corners[1].x;
        const float where = low + (high - low) * random.real(0.001f, 0.01f);
        for (glm::vec4& c : corners) c.z = c.x - where;
        const int count = clipTriangle(corners, {0.001f, 0.001f, true}, polygon);
        REQUIRE(count >= 3);
        // The new leftmost corner becomes the tip again.
        int tip = 0;
        for (int i = 1; i < count; ++i) tip = polygon[i].position.x < polygon[tip].position.x ? i : tip;
        double value = 0.0;
        for (int k = 0; k < 3; ++k) value += static_cast<double>(polygon[tip].weight[k]) * u[k];
        worst = std::fmax(worst, std::fabs(value - (static_cast<double>(polygon[tip].position.x) + 1) / 2));
        corners[0] = polygon[tip].position;
        u[0] = (static_cast<double>(corners[0].x) + 1) / 2;
        if (corners[1].x - corners[0].x < 0.1f) {
            corners[0] = {-1, 0, 0.5f, 1};
            u[0] = 0;
        }
    }
    measured("error of u after 1000 cuts", worst, 16 * 0x1p-24);

    // All planes in sequence, interpolated through the pipeline: u is linear on screen where w is equal.
    struct Case
    {
        glm::vec4 a, b, c;
    };
    const Case cases[] = {{{-50, -40, -3, 1}, {60, -30, 5, 1}, {0, 70, 0.5f, 1}},
                          {{-9000, -4000, 0.5f, 1}, {8000, -7000, 0.5f, 1}, {100, 9000, 0.5f, 1}}};
    for (const Case& c : cases) {
        Mesh mesh;
        addTriangle(mesh, {c.a, glm::vec4(0, 0, 0, 1)}, {c.b, glm::vec4(1, 0, 0, 1)}, {c.c, glm::vec4(0, 1, 0, 1)});
        Framebuffer target = makeTarget(32, 32);
        const Statistics statistics = drawClip<kPaint>(target, mesh, Value{});
        checkInvariants(target, statistics);
        CHECK(statistics.trianglesClipped == 1);
        const HomogeneousTriangle reference(c.a, c.b, c.c, {0, 0, 32, 32});
        double error = 0.0;
        int drawn = 0;
        for (int y = 0; y < 32; ++y) {
            for (int x = 0; x < 32; ++x) {
                const glm::vec4 v = pixel(target, x, y);
                if (v.w == 0.0f) continue;
                ++drawn;
                error = std::fmax(error, std::fabs(v.x - reference.weight(1, x + 0.5, y + 0.5)));
                error = std::fmax(error, std::fabs(v.y - reference.weight(2, x + 0.5, y + 0.5)));
            }
        }
        CHECK(drawn > 100);
        // Corners on the pixel grid move u by its slope times 1/512 px, which is tiny here.
        measured("error of u on screen", error, 1e-4);
    }
}
