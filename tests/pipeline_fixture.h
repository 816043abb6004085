// What the tests of the pipeline share: random numbers that are the same everywhere, meshes given in exact pixels or in
// clip space, the smallest programs, exact coverage to compare with, and the checks that hold after every frame.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "relief/check/hash.h"
#include "relief/hlsl/derivatives.h"
#include "relief/pipeline/frame.h"
#include "relief/pipeline/vertex.h"
#include "stability.h"

namespace fixture {

using namespace relief;

using stability::measured;
using stability::trials;

// --- random numbers: SplitMix64 ---

// Where one expression draws several numbers it does so within braces: compilers evaluate arguments in any order.

class Random
{
public:
    explicit Random(std::uint64_t seed) : state(seed) {}

    std::uint64_t next()
    {
        state += 0x9e3779b97f4a7c15u;
        std::uint64_t z = state;
        z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
        z = (z ^ z >> 27) * 0x94d049bb133111ebu;
        return z ^ z >> 31;
    }

    // low, low + 1, ..., high
    int between(int low, int high)
    {
        const auto span = static_cast<std::uint64_t>(static_cast<std::int64_t>(high) - low + 1);
        return static_cast<int>(low + static_cast<std::int64_t>(next() % span));
    }
    bool chance(int of) { return between(1, of) == 1; }

    float real(float low, float high)  // a multiple of 2^-24 of the way
    {
        return low + static_cast<float>(next() >> 40) * 0x1p-24f * (high - low);
    }

private:
    std::uint64_t state;
};

// --- exact coverage ---

// A point in 24.8 fixed point.
struct Point
{
    std::int32_t x, y;
    friend bool operator==(const Point&, const Point&) = default;
};
using Corners = std::array<Point, 3>;

// The fill rule as Direct3D words it (11.3, 3.4.2.1), written without looking at the winding: an edge divides the
// plane, the third corner tells which side is inside, and a centre on the edge counts if the edge is a left one (the
// inside is to its right) or a top one (horizontal, the inside below). Differences stay below 2^24, so 64 bits hold
// everything.
struct ExactEdge
{
    std::int64_t stepX = 0, stepY = 0, constant = 0;  // > 0 right of the edge, or below it if it is horizontal
    bool insideIsPositive = false, empty = false;

    ExactEdge(Point a, Point b, Point inside)
    {
        if (b.y < a.y) std::swap(a, b);
        if (a.y == b.y) {
            stepY = 1;
            constant = -a.y;
        } else {
            stepX = std::int64_t{b.y} - a.y;
            stepY = -(std::int64_t{b.x} - a.x);
            constant = -(stepX * a.x + stepY * a.y);
        }
        insideIsPositive = at(inside) > 0;
        empty = at(inside) == 0 || a == b;
    }
    std::int64_t at(Point p) const { return stepX * p.x + stepY * p.y + constant; }
    bool covers(std::int64_t value) const { return insideIsPositive ? value >= 0 : value < 0; }
};

struct ExactTriangle
{
    ExactEdge edges[3];

    explicit ExactTriangle(const Corners& c) : edges{{c[0], c[1], c[2]}, {c[1], c[2], c[0]}, {c[2], c[0], c[1]}} {}

    bool isEmpty() const { return edges[0].empty || edges[1].empty || edges[2].empty; }

    bool covers(int x, int y) const  // the centre of pixel (x, y)
    {
        const Point p = {x * 256 + 128, y * 256 + 128};
        bool inside = !isEmpty();
        for (const ExactEdge& e : edges) inside = inside && e.covers(e.at(p));
        return inside;
    }

    // Calls hit(x, y) for every covered pixel of a rectangle.
    template <class Hit>
    void forEachPixel(const Rectangle& r, const Hit& hit) const
    {
        if (isEmpty()) return;
        for (int y = r.y0; y < r.y1; ++y) {
            std::int64_t value[3];
            for (int k = 0; k < 3; ++k) value[k] = edges[k].at({r.x0 * 256 + 128, y * 256 + 128});
            for (int x = r.x0; x < r.x1; ++x) {
                if (edges[0].covers(value[0]) && edges[1].covers(value[1]) && edges[2].covers(value[2])) hit(x, y);
                for (int k = 0; k < 3; ++k) value[k] += edges[k].stepX * 256;
            }
        }
    }
};

inline int exactCount(const Corners& corners, const Rectangle& pixels)
{
    int count = 0;
    ExactTriangle(corners).forEachPixel(pixels, [&](int, int) { ++count; });
    return count;
}

// Adds 1 to every pixel of a width x height image that the triangle covers.
inline void addExactCoverage(const Corners& corners, int width, int height, std::vector<int>& counts)
{
    ExactTriangle(corners).forEachPixel({0, 0, width, height}, [&](int x, int y) {
        ++counts[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    });
}

// The corners as a sample in that place sees them.
inline Corners moved(const Corners& c, SamplePattern::Position by)
{
    Corners result = c;
    for (Point& p : result) p = {p.x - by.x, p.y - by.y};
    return result;
}

// A square from (0, 0) to (side, side) pixels as n x n cells, whose inner corners `place` may move.
struct Grid
{
    int n;
    std::vector<Point> points;

    template <class Place>
    Grid(int cells, int side, const Place& place) : n(cells)
    {
        for (int j = 0; j <= n; ++j) {
            for (int i = 0; i <= n; ++i) {
                const int cell = side * 256 / n;
                const Point p = {i == n ? side * 256 : i * cell, j == n ? side * 256 : j * cell};
                const Point inner = place(p, cell);
                points.push_back({i > 0 && i < n ? inner.x : p.x, j > 0 && j < n ? inner.y : p.y});
            }
        }
    }
    // Corner (x, y) of cell (i, j).
    Point at(int i, int j, int x, int y) const { return points[static_cast<std::size_t>((j + y) * (n + 1) + i + x)]; }

    // Calls add(corners) for both triangles of each cell, which is cut from the upper left where `falls()` says so.
    template <class Falls, class Add>
    void triangulate(const Falls& falls, const Add& add) const
    {
        for (int j = 0; j < n; ++j) {
            for (int i = 0; i < n; ++i) {
                const Point a = at(i, j, 0, 0), b = at(i, j, 1, 0), c = at(i, j, 1, 1), d = at(i, j, 0, 1);
                if (falls()) {
                    add(Corners{a, b, c});
                    add(Corners{a, c, d});
                } else {
                    add(Corners{a, b, d});
                    add(Corners{b, c, d});
                }
            }
        }
    }
};

// Moves a grid's corner by less than half a cell: no triangle flips over by more than a sliver, none leaves the square.
inline Point jitter(Random& random, Point p, int cell)
{
    return {p.x + random.between(-cell / 5, cell / 5), p.y + random.between(-cell / 5, cell / 5)};
}

// Any kind of triangle on or around a target; no coordinate beyond +-limit pixels.
inline Corners randomTriangle(Random& random, int width, int height, int limit = 32000)
{
    const int w = width * 256, h = height * 256;
    const auto anywhere = [&] { return Point{random.between(0, w), random.between(0, h)}; };
    const auto near = [&](Point p, int reach) {
        return Point{p.x + random.between(-reach, reach), p.y + random.between(-reach, reach)};
    };
    const auto far = [&] {
        return Point{random.between(-limit * 256, limit * 256), random.between(-limit * 256, limit * 256)};
    };
    const auto snapTo = [](Point p, int grid, int offset) {
        return Point{(p.x & -grid) + offset, (p.y & -grid) + offset};
    };
    const Point p = anywhere();
    switch (random.between(0, 11)) {
        case 0:
            return {p, near(p, 2), near(p, 2)};  // next to nothing
        case 1:
            return {p, near(p, 300), near(p, 300)};  // about a pixel
        case 2:
            return {p, near(p, 3000), near(p, 3000)};  // some pixels
        case 3:
            return {p, anywhere(), anywhere()};  // medium
        case 4:
            return {far(), far(), far()};  // huge
        case 5:
            return {p, far(), far()};
        case 6: {  // slivers
            const Point q = random.chance(2) ? anywhere() : far();
            return {p, q, near(random.chance(2) ? p : q, 2)};
        }
        case 7:
            return {snapTo(p, 256, 128), snapTo(anywhere(), 256, 128), snapTo(anywhere(), 256, 128)};  // on centres
        case 8:
            return {snapTo(p, 256, 0), snapTo(anywhere(), 256, 0), snapTo(anywhere(), 256, 0)};  // between
        case 9: {  // edges through centres, right angles
            const Point a = snapTo(p, 256, 128), b = snapTo(anywhere(), 256, 128);
            return random.chance(2) ? Corners{a, {b.x, a.y}, {a.x, b.y}} : Corners{a, {a.x, b.y}, b};
        }
        case 10: {  // collinear or nearly so
            const int dx = random.between(-500, 500), dy = random.between(-500, 500);
            const int m = random.between(-20, 20), off = random.between(-1, 1);
            return {p, {p.x + dx, p.y + dy}, {p.x + m * dx + off, p.y + m * dy}};
        }
        default:
            return {near(p, 2 * w), near(p, 2 * w), near(p, 2 * w)};  // partly outside
    }
}

// --- meshes and programs ---

// What a test vertex holds, in the streams that a mesh has: x, y and depth in the position, w in the normal, and four
// numbers to interpolate in the tangent.
struct TestVertex
{
    glm::vec4 position;  // FromPixels: x and y in pixels, depth, clip-space w. FromClip: clip space.
    glm::vec4 value = glm::vec4(0.0f);
};

inline void addTriangle(Mesh& mesh, const TestVertex& a, const TestVertex& b, const TestVertex& c)
{
    for (const TestVertex& v : {a, b, c}) {
        mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
        mesh.positions.emplace_back(v.position);
        mesh.normals.emplace_back(v.position.w, 0.0f, 0.0f);
        mesh.tangents.push_back(v.value);
    }
}

inline void addTriangle(Mesh& mesh, const std::array<TestVertex, 3>& v)
{
    addTriangle(mesh, v[0], v[1], v[2]);
}

inline glm::vec4 pixelPosition(Point p, float depth = 0.5f, float w = 1.0f)
{
    return {static_cast<float>(p.x) / 256.0f, static_cast<float>(p.y) / 256.0f, depth, w};
}

inline void addTriangle(Mesh& mesh, const Corners& c, const glm::vec4& value = glm::vec4(1.0f), float depth = 0.5f)
{
    addTriangle(mesh, {pixelPosition(c[0], depth), value}, {pixelPosition(c[1], depth), value},
                {pixelPosition(c[2], depth), value});
}

inline Mesh meshOf(const std::vector<Corners>& triangles)
{
    Mesh mesh;
    for (const Corners& c : triangles) addTriangle(mesh, c);
    return mesh;
}

struct TestVertexData
{
    POSITION position;
    NORMAL w;
    TANGENT value;
};

struct Interpolated
{
    SV_POSITION position;
    TEXCOORD<0, float4> value;
};

// A viewport whose sides are powers of two, not smaller than the target: with it, FromPixels gives every point of the
// 1/256 pixel grid without any rounding (w = 1, or another power of two).
inline Viewport exactViewport(int width, int height)
{
    return {0, 0, static_cast<int>(std::bit_ceil(static_cast<unsigned>(width))),
            static_cast<int>(std::bit_ceil(static_cast<unsigned>(height)))};
}

struct FromPixels
{
    Float halfWidth, halfHeight, originX, originY;

    explicit FromPixels(const Viewport& v)
        : halfWidth(static_cast<float>(v.width) * 0.5f),
          halfHeight(static_cast<float>(v.height) * 0.5f),
          originX(static_cast<float>(v.x)),
          originY(static_cast<float>(v.y))
    {
    }
    Interpolated operator()(const TestVertexData& v) const
    {
        const Float x = (v.position.x - originX) / halfWidth - 1.0f;
        const Float y = 1.0f - (v.position.y - originY) / halfHeight;
        const Float w = v.w.x;
        return {float4(x * w, y * w, v.position.z * w, w), v.value};
    }
};

struct FromClip
{
    Interpolated operator()(const TestVertexData& v) const
    {
        return {float4(v.position.x, v.position.y, v.position.z, v.w.x), v.value};
    }
};

struct One
{
    float4 operator()(const Interpolated&) const { return float4(Float(1.0f)); }
};

struct Value
{
    float4 operator()(const Interpolated& i) const { return i.value; }
};

struct Position
{
    float4 operator()(const Interpolated& i) const { return i.position; }
};

// Adds 1 to every pixel that is covered: no depth, no culling.
inline constexpr RenderState kCount = {Compare::always, false, true, Cull::none, Blend::additive};
// Writes what the program gives, no depth, no culling.
inline constexpr RenderState kPaint = {Compare::always, false, true, Cull::none, Blend::off};
// The usual state, but for culling.
inline constexpr RenderState kDepthTested = {Compare::less, true, true, Cull::none, Blend::off};

inline Framebuffer makeTarget(int width, int height, Format format = Format::rgba32f, Store depth = Store::discard)
{
    Expected<Framebuffer> target = Framebuffer::create(width, height, format, depth);
    REQUIRE(target.has_value());
    return std::move(*target);
}

// One draw of a mesh in pixels onto a cleared target.
template <RenderState state = kCount, class FragmentProgram = One>
Statistics drawPixels(Framebuffer& target, const Mesh& mesh, const FragmentProgram& fragment = {},
                      const FrameOptions& options = {1, kDefaultTileSize})
{
    const Viewport viewport = exactViewport(target.width(), target.height());
    Frame frame(target, options);
    frame.clear(glm::vec4(0.0f));
    frame.setViewport(viewport);
    frame.draw(mesh, FromPixels(viewport), fragment, state);
    return frame.run();
}

// One draw of a mesh in clip space onto a cleared target; the viewport is the whole target.
template <RenderState state = kCount, class FragmentProgram = One>
Statistics drawClip(Framebuffer& target, const Mesh& mesh, const FragmentProgram& fragment = {},
                    const FrameOptions& options = {1, kDefaultTileSize})
{
    Frame frame(target, options);
    frame.clear(glm::vec4(0.0f));
    frame.draw(mesh, FromClip{}, fragment, state);
    return frame.run();
}

// One draw's front end without a frame: clip-space positions in, codes and screen positions out, ready for setup.
struct FrontEnd
{
    FrontEnd(std::vector<glm::vec4> positions, std::vector<std::uint32_t> corners, const Viewport& viewport)
        : clip(std::move(positions)), indices(std::move(corners)), screen(clip.size()), codes(clip.size())
    {
        draw.indices = indices.data();
        draw.primitiveCount = static_cast<std::uint32_t>(indices.size() / 3);
        draw.vertexCount = draw.verticesPerInstance = static_cast<std::uint32_t>(clip.size());
        draw.primitivesPerInstance = draw.primitiveCount;
        draw.clip = clip.data();
        draw.screen = screen.data();
        draw.codes = codes.data();
        draw.viewport = viewport;
        draw.bounds = {viewport.x, viewport.y, viewport.x + viewport.width, viewport.y + viewport.height};
        draw.cull = Cull::none;
    }

    void project()
    {
        const std::vector<glm::vec4> in = clip;
        for (std::size_t first = 0; first < in.size(); first += kLanes) {
            const std::size_t count = std::min<std::size_t>(kLanes, in.size() - first);
            float4 lanes(Float(0.0f));
            for (std::size_t i = 0; i < count; ++i) {
                for (int c = 0; c < 4; ++c) lanes[c].set(static_cast<int>(i), in[first + i][c]);
            }
            projectVertices(draw, ViewportTransform(draw.viewport), static_cast<std::uint32_t>(first),
                            static_cast<std::uint32_t>(count), lanes);
        }
    }

    std::vector<glm::vec4> clip;
    std::vector<std::uint32_t> indices;
    std::vector<ScreenVertex> screen;
    std::vector<std::uint16_t> codes;
    DrawGeometry draw;
};

// A point in pixels as a clip-space position, exact in an exactViewport() at the origin.
inline glm::vec4 clipPosition(Point p, const Viewport& v, float z = 0.5f)
{
    return {static_cast<float>(p.x) / 128.0f / static_cast<float>(v.width) - 1.0f,
            1.0f - static_cast<float>(p.y) / 128.0f / static_cast<float>(v.height), z, 1.0f};
}

// --- looking at results ---

inline const glm::vec4& pixel(const Framebuffer& target, int x, int y)
{
    return target.color32f()[static_cast<std::size_t>(y) * static_cast<std::size_t>(target.width()) +
                             static_cast<std::size_t>(x)];
}

// The pixels of a counting frame whose count is not the expected one.
inline int wrongCounts(const Framebuffer& target, const std::vector<int>& expected)
{
    int wrong = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        wrong += target.color32f()[i] != glm::vec4(static_cast<float>(expected[i]));
    }
    return wrong;
}
inline int pixelsNotEqualTo(const Framebuffer& target, float value)
{
    int wrong = 0;
    for (const glm::vec4& c : target.color32f()) wrong += c != glm::vec4(value);
    return wrong;
}

inline std::uint64_t hashBytes(const void* data, std::size_t size, std::uint64_t hash = 14695981039346656037u)
{
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) hash = (hash ^ bytes[i]) * 1099511628211u;
    return hash;
}

inline bool sameBits(const Framebuffer& a, const Framebuffer& b)
{
    return a.samePixels(b);
}

inline bool allFinite(const Framebuffer& target)
{
    for (const glm::vec4& c : target.color32f()) {
        for (int i = 0; i < 4; ++i) {
            if (!std::isfinite(c[i])) return false;
        }
    }
    for (const float z : target.depth()) {
        if (!std::isfinite(z)) return false;
    }
    return true;
}

inline bool addsUp(const Statistics& s)
{
    return s.trianglesSubmitted == s.culledFacing + s.culledNoSample + s.outside + s.droppedNan + s.droppedInfinite +
                                       s.droppedIndex + s.rasterised;
}

// What holds after every frame: nothing but finite numbers in the target, and every triangle counted once.
inline void checkInvariants(const Framebuffer& target, const Statistics& statistics)
{
    CHECK(allFinite(target));
    CHECK(addsUp(statistics));
}

// The same frame again gives the same bits.
inline void checkRunsAgain(Frame& frame, const Framebuffer& target)
{
    const std::uint64_t first = hashOf(target);
    const Statistics again = frame.run();
    CHECK(hashOf(target) == first);
    checkInvariants(target, again);
}

// --- triangles in clip space, in double: the reference where clipping rounds ---

// Which pixels a triangle with any w covers, and how clearly. With M = (x y w of the three corners as columns) and
// p = (pixel in NDC, 1), mu = M^-1 p are the corners' shares of the point that is seen at p: it is inside where all
// are >= 0, at depth z/w = sum(mu_k z_k). No division by w, so corners behind the eye are nothing special.
// (Olano and Greer, Triangle Scan Conversion using 2D Homogeneous Coordinates, 1997.)
class HomogeneousTriangle
{
public:
    HomogeneousTriangle(const glm::vec4& a, const glm::vec4& b, const glm::vec4& c, const Viewport& viewport)
    {
        const glm::dvec4 v[3] = {a, b, c};
        glm::dvec3 rows[3];
        double determinant = 0.0;
        for (int k = 0; k < 3; ++k) {
            const glm::dvec4 &p = v[(k + 1) % 3], &q = v[(k + 2) % 3];
            rows[k] = {p.y * q.w - p.w * q.y, p.w * q.x - p.x * q.w, p.x * q.y - p.y * q.x};
            determinant = v[k].x * rows[k].x + v[k].y * rows[k].y + v[k].w * rows[k].z;
        }
        isFlat = determinant == 0.0;
        if (isFlat) return;
        for (int k = 0; k < 3; ++k) planes[k] = toPixels(rows[k] / determinant, viewport);
        for (int k = 0; k < 3; ++k) depth += planes[k] * v[k].z;
    }

    // The smallest distance in pixels to an edge, or to the line where the triangle meets the near or the far plane:
    // positive inside. A sum of very different magnitudes is good to 2^-50 of the largest.
    double margin(double x, double y, bool depthClip = true) const
    {
        if (isFlat) return -1e30;
        double least = 1e30;
        for (const glm::dvec3& plane : planes) least = std::fmin(least, distance(plane, x, y));
        if (depthClip) {
            least = std::fmin(least, distance(depth, x, y));
            least = std::fmin(least, distance(glm::dvec3(0, 0, 1) - depth, x, y));
        }
        return least;
    }
    double depthAt(double x, double y) const { return depth.x * x + depth.y * y + depth.z; }
    double weight(int k, double x, double y) const  // the share of corner k in space, sum 1
    {
        double sum = 0.0, mine = 0.0;
        for (int i = 0; i < 3; ++i) {
            const double mu = planes[i].x * x + planes[i].y * y + planes[i].z;
            sum += mu;
            if (i == k) mine = mu;
        }
        return mine / sum;
    }

private:
    // From a function of NDC to one of pixels.
    static glm::dvec3 toPixels(const glm::dvec3& f, const Viewport& v)
    {
        const double perX = 2.0 / v.width, perY = -2.0 / v.height;
        return {f.x * perX, f.y * perY, f.x * (-1.0 - v.x * perX) + f.y * (1.0 - v.y * perY) + f.z};
    }
    static double distance(const glm::dvec3& plane, double x, double y)
    {
        const double value = plane.x * x + plane.y * y + plane.z;
        const double slope = std::sqrt(plane.x * plane.x + plane.y * plane.y);
        return slope > 0.0 ? value / slope : (value >= 0.0 ? 1e30 : -1e30);
    }

    glm::dvec3 planes[3] = {};
    glm::dvec3 depth = glm::dvec3(0.0);
    bool isFlat = false;
};

}  // namespace fixture
