// E-18: what a triangle's setup must know to interpolate in floats.
#include <algorithm>
#include <cstdio>

#include "experiments.h"
#include "lane_kernel.h"
#include "relief/pipeline/interpolate.h"

namespace relief::experiments {

namespace {

// Corners' u and v, each 0 ... 1.
struct Corners
{
    float uv[3][2];
};

struct Triangles
{
    std::vector<Triangle> all;
    std::vector<Corners> corners;
};

// Near pixel (3800, 2100), corners within a square of `size` pixels. Their w are anywhere in 1 ... ratio, evenly by
// logarithm; with `both` the first corner has w 1 and the second `ratio`.
Triangles trianglesOf(int size, double ratio, int count, bool both = false)
{
    Triangles t;
    std::mt19937 random(17);
    while (static_cast<int>(t.all.size()) < count) {
        Triangle triangle = {};
        for (int k = 0; k < 3; ++k) {
            triangle.x[k] = 3800 * kSubpixels + static_cast<int>(uniform(random) * size * kSubpixels);
            triangle.y[k] = 2100 * kSubpixels + static_cast<int>(uniform(random) * size * kSubpixels);
            const double w = both && k < 2 ? (k == 0 ? 1.0 : ratio) : std::pow(ratio, uniform(random));
            triangle.invW[k] = static_cast<float>(1.0 / w);
        }
        const std::int64_t area =
            static_cast<std::int64_t>(triangle.x[1] - triangle.x[0]) * (triangle.y[2] - triangle.y[0]) -
            static_cast<std::int64_t>(triangle.x[2] - triangle.x[0]) * (triangle.y[1] - triangle.y[0]);
        if (area < 0) std::swap(triangle.x[1], triangle.x[2]), std::swap(triangle.y[1], triangle.y[2]);
        Corners c;
        for (auto& uv : c.uv) uv[0] = static_cast<float>(uniform(random)), uv[1] = static_cast<float>(uniform(random));
        if (area != 0) t.all.push_back(triangle), t.corners.push_back(c);
    }
    return t;
}

// --- the methods: set() for kLanes triangles at once, begin() for one of them, at() for a block of its pixels ---

struct Uv
{
    Float u, v;
};

// The engine's: weights from edge functions in exact integers.
struct FromEdges
{
    TriangleBatch batch;
    TriangleEdges edges;
    TriangleWeights weights;
    CornerComponents<2> components;

    void set(const Triangle* const* triangles, const Corners*)
    {
        batch.set({triangles, static_cast<std::size_t>(kLanes)}, {0, 0, 8192, 8192});
    }
    void begin(int lane, const Corners& c)
    {
        edges.set(batch, lane);
        weights.set(batch, lane);
        components.set(c.uv[0], c.uv[1], c.uv[2]);
    }
    Uv at(int x, int y) const
    {
        Float edge[3];
        edges.at(x, y, edge);
        const BlockWeights w = weights.of(edge, kAllLanes);
        return {components.perspective(0, w), components.perspective(1, w)};
    }
};

// u/w, v/w and 1/w as planes over the screen, a x + b y + c: with c at the screen's corner, or at the triangle's first.
template <bool aboutCorner>
struct FromPlanes
{
    float a[3][kLanes], b[3][kLanes], c[3][kLanes], x0[kLanes], y0[kLanes];
    float plane[3][3], fromX, fromY;  // of the triangle that has begun

    void set(const Triangle* const* triangles, const Corners* corners)
    {
        float x[3][kLanes], y[3][kLanes], value[3][3][kLanes];
        for (int lane = 0; lane < kLanes; ++lane) {
            const Triangle& t = *triangles[lane];
            for (int k = 0; k < 3; ++k) {
                x[k][lane] = static_cast<float>(t.x[k]) / kSubpixels;
                y[k][lane] = static_cast<float>(t.y[k]) / kSubpixels;
                value[0][k][lane] = corners[lane].uv[k][0] * t.invW[k];
                value[1][k][lane] = corners[lane].uv[k][1] * t.invW[k];
                value[2][k][lane] = t.invW[k];
            }
        }
        const Float firstX = Float::load(x[0]), firstY = Float::load(y[0]);
        const Float x1 = Float::load(x[1]) - firstX, y1 = Float::load(y[1]) - firstY;
        const Float x2 = Float::load(x[2]) - firstX, y2 = Float::load(y[2]) - firstY;
        const Float inverse = 1.0f / (x1 * y2 - x2 * y1);
        for (int p = 0; p < 3; ++p) {
            const Float at0 = Float::load(value[p][0]);
            const Float d1 = Float::load(value[p][1]) - at0, d2 = Float::load(value[p][2]) - at0;
            const Float perX = (d1 * y2 - d2 * y1) * inverse, perY = (d2 * x1 - d1 * x2) * inverse;
            perX.store(a[p]);
            perY.store(b[p]);
            (aboutCorner ? at0 : at0 - perX * firstX - perY * firstY).store(c[p]);
        }
        firstX.store(x0);
        firstY.store(y0);
    }
    void begin(int lane, const Corners&)
    {
        for (int p = 0; p < 3; ++p) plane[p][0] = a[p][lane], plane[p][1] = b[p][lane], plane[p][2] = c[p][lane];
        fromX = aboutCorner ? x0[lane] : 0.0f;
        fromY = aboutCorner ? y0[lane] : 0.0f;
    }
    Uv at(int x, int y) const
    {
        const Float px = Float(laneXs() + x) + (0.5f - fromX), py = Float(laneYs() + y) + (0.5f - fromY);
        const auto value = [&](int p) { return Float(plane[p][0]) * px + Float(plane[p][1]) * py + plane[p][2]; };
        const Float w = 1.0f / value(2);
        return {value(0) * w, value(1) * w};
    }
};

// --- every triangle's blocks, or those in every `stride`-th square of 4x4 pixels each way ---

template <class Method, class Take>
void interpolateAll(const Triangles& t, int stride, Take take)
{
    Method method;
    const int count = static_cast<int>(t.all.size());
    for (int first = 0; first < count; first += kLanes) {
        const Triangle* group[kLanes];
        for (int i = 0; i < kLanes; ++i) group[i] = &t.all[static_cast<std::size_t>(first + i)];
        method.set(group, &t.corners[static_cast<std::size_t>(first)]);
        for (int i = 0; i < kLanes; ++i) {
            const auto at = static_cast<std::size_t>(first + i);
            method.begin(i, t.corners[at]);
            const Rectangle r = sampleBounds(t.all[at], {0, 0, 8192, 8192});
            for (int y = r.y0 & -kBlockHeight; y < r.y1; y += kBlockHeight) {
                if (stride > 1 && y / 4 % stride != 0) continue;
                for (int x = r.x0 & -kBlockWidth; x < r.x1; x += kBlockWidth) {
                    if (stride == 1 || x / 4 % stride == 0) take(at, x, y, method.at(x, y));
                }
            }
        }
    }
}

// Whether the pixel is inside, and its u, from the integers in double.
bool exactU(const Triangle& t, const Corners& c, int x, int y, double& u)
{
    double sum = 0.0, weighted = 0.0;
    for (int k = 0; k < 3; ++k) {
        const EdgeFunction e = edgeOf(t, k);
        if (e.coverage(x, y) < 0) return false;
        const double edge = static_cast<double>(
            e.origin + (static_cast<std::int64_t>(e.stepX) * x + static_cast<std::int64_t>(e.stepY) * y) * kSubpixels);
        const double weight = edge * static_cast<double>(t.invW[k]);
        sum += weight;
        weighted += weight * static_cast<double>(c.uv[k][0]);
    }
    u = weighted / sum;
    return true;
}

// Errors beyond the whole texture, infinities and NaN among them, count as 1: so they do where a plane of 1/w reaches
// 0.
template <class Method>
Error errorOf(int size, double ratio, int count, bool both = false)
{
    const Triangles t = trianglesOf(size, ratio, count, both);
    ErrorSum sum;
    interpolateAll<Method>(t, std::max(1, size / 64), [&](std::size_t triangle, int x, int y, const Uv& uv) {
        for (int lane = 0; lane < kLanes; ++lane) {
            double u = 0.0;
            if (exactU(t.all[triangle], t.corners[triangle], x + laneX(lane), y + laneY(lane), u))
                sum.add(std::fmin(std::abs(static_cast<double>(uv.u[lane]) - u), 1.0));
        }
    });
    return sum.result();
}

int coveredPixels(const Triangles& t)
{
    int covered = 0;
    for (const Triangle& triangle : t.all) {
        const Rectangle r = sampleBounds(triangle, {0, 0, 8192, 8192});
        const EdgeFunction edges[] = {edgeOf(triangle, 0), edgeOf(triangle, 1), edgeOf(triangle, 2)};
        for (int y = r.y0; y < r.y1; ++y) {
            for (int x = r.x0; x < r.x1; ++x)
                covered += edges[0].coverage(x, y) >= 0 && edges[1].coverage(x, y) >= 0 && edges[2].coverage(x, y) >= 0;
        }
    }
    return covered;
}

template <class Method>
Work workOf(int size)
{
    const auto t = std::make_shared<const Triangles>(trianglesOf(size, 1e4, size <= 2 ? 1024 : size <= 16 ? 128 : 16));
    return {[t] {
                Float sum = 0.0f;
                interpolateAll<Method>(
                    *t, 1, [&sum](std::size_t, int, int, const Uv& uv) { sum = max(sum, max(uv.u, uv.v)); });
                asm volatile("" : : "r"(&sum) : "memory");
            },
            static_cast<double>(coveredPixels(*t))};
}

}  // namespace

Experiment attributeSetup(Effort effort)
{
    Experiment e;
    e.id = "E-18";
    e.title = "Interpolating in floats, far from the origin";
    e.question =
        "u/w, v/w and 1/w are planes over the screen, and many renderers store each as three floats. For a triangle "
        "near pixel (3800, 2100) such a plane, taken from the screen's corner, is the small difference of large "
        "numbers; taken from a corner of the triangle it is not. The engine weights the corners by exact integer edge "
        "values instead. How far is u, in widths of the texture, off where w changes by 10000 within a triangle of 2, "
        "16 and 512 pixels, and what does a pixel cost, with two components and the setup? Only rows of one size "
        "compare.";
    e.item = "covered pixel";
    e.unit = "texture widths";
    const int count = effort.samples(4000, 320) / kLanes * kLanes;
    const auto add = [&]<class Method>(const std::string& name, Method*) {
        for (const int size : {2, 16, 512}) {
            const auto few = size == 512 ? count / 10 / kLanes * kLanes : count;
            e.variants.push_back(
                {name, std::to_string(size) + " px",
                 [=] {
                     const Error mild = errorOf<Method>(size, 10.0, few), hard = errorOf<Method>(size, 1e4, few, true);
                     return Outcome(errorOf<Method>(size, 1e4, few),
                                    {{"RMS, w to 10", mild.rms}, {"worst, from w 1 to 10000", hard.max}});
                 },
                 workOf<Method>(size)});
        }
    };
    add("edges, engine", static_cast<FromEdges*>(nullptr));
    add("plane at corner", static_cast<FromPlanes<true>*>(nullptr));
    add("plane at origin", static_cast<FromPlanes<false>*>(nullptr));

    // Random triangles: the planes' errors hang on a few slivers, so only their order of magnitude can be compared: the
    // decimal logarithm. The engine's are bounded: 8 units of a float's last place.
    struct Reference
    {
        int size;
        double ratio, origin, corner, edges;  // RMS
    };
    constexpr Reference kReferences[] = {{2, 10, 6.9e-4, 8.9e-8, 3.6e-8},
                                         {2, 1e4, 9.8e-3, 1.2e-6, 3.7e-8},
                                         {16, 1e4, 6.4e-4, 4.1e-7, 3.8e-8},
                                         {512, 1e4, 1.9e-5, 4.9e-7, 3.8e-8}};
    for (const Reference& r : kReferences) {
        const std::string of = ", " + std::to_string(r.size) + " px, w ratio " + number(r.ratio, 0);
        const int some = r.size == 512 ? count / 10 / kLanes * kLanes : count;
        e.checks.push_back({"plane at origin, log10 of RMS" + of, std::log10(r.origin),
                            [=] { return std::log10(errorOf<FromPlanes<false>>(r.size, r.ratio, some).rms); },
                            effort.full ? 0.7 : 1.0});
        e.checks.push_back({"plane at corner, log10 of RMS" + of, std::log10(r.corner),
                            [=] { return std::log10(errorOf<FromPlanes<true>>(r.size, r.ratio, some).rms); },
                            effort.full ? 0.7 : 1.0});
        e.checks.push_back({"edges, log10 of RMS" + of, std::log10(r.edges),
                            [=] { return std::log10(errorOf<FromEdges>(r.size, r.ratio, some).rms); }, 0.5});
        e.checks.push_back({"edges, worst" + of, 8 * 0x1p-24,
                            [=] { return errorOf<FromEdges>(r.size, r.ratio, some).max; }, 0.0, true});
    }
    e.finding = [](const Rows& rows) {
        const Row &edges = rows("edges, engine", "2 px"), &corner = rows("plane at corner", "2 px"),
                  &origin = rows("plane at origin", "2 px");
        const Row &large = rows("edges, engine", "512 px"), &largePlane = rows("plane at corner", "512 px");
        const auto tiny = [](double value) {
            char text[32];
            std::snprintf(text, sizeof text, "%.2g", value);
            return std::string(text);
        };
        return "In triangles of 2 pixels a plane taken from the screen's corner is up to " +
               tiny(origin.outcome.error.max) + " of the whole texture off, with an RMS of " +
               tiny(origin.outcome.error.rms) + "; from the triangle's corner " + tiny(corner.outcome.error.max) +
               " (RMS " + tiny(corner.outcome.error.rms) + "), from exact edges " + tiny(edges.outcome.error.max) +
               " (RMS " + tiny(edges.outcome.error.rms) +
               "), for every size. Setup included, a covered pixel of such a triangle takes " +
               number(origin.fastest, 1) + ", " + number(corner.fastest, 1) + " and " + number(edges.fastest, 1) +
               " ns, one of 512 pixels " + number(rows("plane at origin", "512 px").fastest, 2) + ", " +
               number(largePlane.fastest, 2) + " and " + number(large.fastest, 2) +
               ". Moving the plane to a corner of the triangle costs two subtractions. It is the least that a renderer "
               "should do, but no cure: where that corner is 10000 times nearer than another, it is up to " +
               tiny(largePlane.fact("worst, from w 1 to 10000")) + " off in triangles of 512 pixels, the engine " +
               tiny(large.fact("worst, from w 1 to 10000")) + ".";
    };
    return e;
}

}  // namespace relief::experiments
