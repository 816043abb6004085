// E-17: perspective-correct coordinates at every pixel, or at every few with straight lines between.
#include <array>

#include "experiments.h"
#include "lane_kernel.h"
#include "relief/pipeline/interpolate.h"

namespace relief::experiments {

namespace {

constexpr int kPixels = 640;
constexpr double kTexels = 256.0;

// A row of pixels across a surface whose w grows from 1 to `ratio`: u, v over w and 1/w, linear on screen. u and v run
// from 0 to 256 texels.
struct Span
{
    int pixels;
    float u, toU, v, toV, q, toQ;  // at pixel 0, and what is added per pixel
};

Span spanOf(double ratio, int pixels)
{
    const auto step = static_cast<float>(kTexels / ratio / pixels);
    return {pixels, 0.0f, step, 0.0f, step, 1.0f, static_cast<float>((1.0 / ratio - 1.0) / pixels)};
}

double exact(double ratio, int pixels, double x)
{
    const double s = x / pixels;
    return kTexels * s / ratio / (1.0 - s + s / ratio);
}

// 0, 1, 2 ... in a row, unlike the lanes of a block.
Float ascending()
{
    alignas(64) float numbers[kLanes];
    for (int i = 0; i < kLanes; ++i) numbers[i] = static_cast<float>(i);
    return Float::load(numbers);
}

struct Pair
{
    Float u, v;
};
Pair divided(const Span& s, Float x)
{
    const Float w = 1.0f / (Float(s.q) + Float(s.toQ) * x);
    return {(Float(s.u) + Float(s.toU) * x) * w, (Float(s.v) + Float(s.toV) * x) * w};
}

[[gnu::noinline]] void everyPixel(const Span& s, float* u, float* v)
{
    for (int x = 0; x < s.pixels; x += kLanes) {
        const Pair p = divided(s, ascending() + static_cast<float>(x));
        p.u.store(u + x);
        p.v.store(v + x);
    }
}

// Divides at every k-th pixel, k a power of two from 4 or the whole span. The ends come first, kLanes of them at a
// time.
[[gnu::noinline]] void everyFew(const Span& s, int k, float* u, float* v, std::vector<float>& endU,
                                std::vector<float>& endV)
{
    const Float lane = ascending();
    const auto step = static_cast<float>(k);
    for (int i = 0; i <= s.pixels / k; i += kLanes) {
        const Pair p = divided(s, (lane + static_cast<float>(i)) * step);
        p.u.store(&endU[static_cast<std::size_t>(i)]);
        p.v.store(&endV[static_cast<std::size_t>(i)]);
    }
    const float share = 1.0f / step;
    const auto line = [share](const std::vector<float>& ends, std::size_t i) {
        return std::pair{ends[i], (ends[i + 1] - ends[i]) * share};
    };
    if (k >= kLanes) {
        for (int x = 0; x < s.pixels; x += k) {
            const auto lineU = line(endU, static_cast<std::size_t>(x / k)),
                       lineV = line(endV, static_cast<std::size_t>(x / k));
            for (int i = 0; i < k; i += kLanes) {
                const Float along = lane + static_cast<float>(i);
                (Float(lineU.first) + along * lineU.second).store(u + x + i);
                (Float(lineV.first) + along * lineV.second).store(v + x + i);
            }
        }
        return;
    }
    for (int x = 0; x < s.pixels; x += kLanes) {  // several lines in one vector
        Float fromU, fromV, byU, byV, along = lane;
        for (int i = 0; i < kLanes; i += k) {
            const Mask here = lane >= static_cast<float>(i);
            const auto lineU = line(endU, static_cast<std::size_t>((x + i) / k)),
                       lineV = line(endV, static_cast<std::size_t>((x + i) / k));
            fromU = i == 0 ? Float(lineU.first) : select(here, Float(lineU.first), fromU);
            fromV = i == 0 ? Float(lineV.first) : select(here, Float(lineV.first), fromV);
            byU = i == 0 ? Float(lineU.second) : select(here, Float(lineU.second), byU);
            byV = i == 0 ? Float(lineV.second) : select(here, Float(lineV.second), byV);
            along = select(here, lane - static_cast<float>(i), along);
        }
        (fromU + along * byU).store(u + x);
        (fromV + along * byV).store(v + x);
    }
}

// One row of pixels; k 1 divides at each.
struct Row640
{
    std::vector<float> u, v, endU, endV;
    explicit Row640(int pixels) : u(static_cast<std::size_t>(pixels)), v(u), endU(u.size() / 4 + 32), endV(endU) {}
    void fill(const Span& s, int k)
    {
        if (k == 1)
            everyPixel(s, u.data(), v.data());
        else
            everyFew(s, k, u.data(), v.data(), endU, endV);
        asm volatile("" : : : "memory");
    }
};

// `finer` takes more samples of the same lines.
Error errorOf(double ratio, int k, int finer = 1)
{
    const int pixels = kPixels * finer;
    Row640 row(pixels);
    row.fill(spanOf(ratio, pixels), k == 1 ? 1 : k * finer);
    ErrorSum sum;
    for (int x = 0; x < pixels; ++x)
        sum.add(static_cast<double>(row.u[static_cast<std::size_t>(x)]) - exact(ratio, pixels, x));
    return sum.result();
}

// The engine: a triangle of 640x640 pixels, of which one row of blocks is interpolated.
struct EngineRow
{
    Triangle triangle = {};
    TriangleBatch batch;
    CornerComponents<2> corners;
    std::vector<float> u, v;

    explicit EngineRow(double ratio) : u(kPixels * kBlockHeight), v(u)
    {
        constexpr int side = kPixels * kSubpixels;
        triangle.x[1] = triangle.y[2] = side;
        triangle.invW[0] = triangle.invW[2] = 1.0f;
        triangle.invW[1] = static_cast<float>(1.0 / ratio);
        constexpr float a[2] = {0, 0}, b[2] = {static_cast<float>(kTexels), 0}, c[2] = {0, static_cast<float>(kTexels)};
        corners.set(a, b, c);
    }
    void fill()
    {
        const Triangle* const only = &triangle;
        batch.set({&only, 1}, {0, 0, kPixels, kPixels});
        TriangleEdges edges;
        TriangleWeights weights;
        edges.set(batch, 0);
        weights.set(batch, 0);
        for (int x = 0; x < kPixels; x += kBlockWidth) {
            Float edge[3];
            edges.at(x, 0, edge);
            const BlockWeights w = weights.of(edge, kAllLanes);
            corners.perspective(0, w).store(&u[static_cast<std::size_t>(x * kBlockHeight)]);
            corners.perspective(1, w).store(&v[static_cast<std::size_t>(x * kBlockHeight)]);
        }
        asm volatile("" : : : "memory");
    }
};

Error engineError(double ratio)
{
    EngineRow row(ratio);
    row.fill();
    ErrorSum sum;
    for (int x = 0; x < kPixels - 4; x += kBlockWidth) {  // the last pixels of a row are outside
        for (int lane = 0; lane < kLanes; ++lane) {
            if (laneY(lane) >= 2) continue;  // the same pixels for every number of lanes
            const double px = x + laneX(lane) + 0.5, py = laneY(lane) + 0.5, b1 = px / kPixels, b2 = py / kPixels;
            const double invW = static_cast<double>(row.triangle.invW[1]);
            const double u = kTexels * b1 * invW / (1.0 - b1 - b2 + b1 * invW + b2);
            sum.add(static_cast<double>(row.u[static_cast<std::size_t>(x * kBlockHeight + lane)]) - u);
        }
    }
    return sum.result();
}

template <class ErrorAt>
Outcome outcomeOf(double divisions, ErrorAt errorAt)
{
    return {
        errorAt(10.0),
        {{"divisions per pixel", divisions}, {"worst at w ratio 2", errorAt(2.0).max}, {"at 100", errorAt(100.0).max}}};
}

}  // namespace

Experiment spanPerspective(Effort)
{
    Experiment e;
    e.id = "E-17";
    e.title = "Perspective at every k-th pixel";
    e.question =
        "A texture coordinate is a quotient on screen, so each pixel needs a division. Games of the nineties divided "
        "at every 8th or 16th pixel of a row and drew straight lines between. How many texels is that off on a row of "
        "640 pixels and 256 texels whose far end is 10 times as far away as the near one, and is it still faster when "
        "a processor divides for a whole vector of pixels at once?";
    e.item = "pixel";
    e.unit = "texels";
    const auto timed = [](int k) -> Work {
        const auto row = std::make_shared<Row640>(kPixels);
        return {[row, k, span = spanOf(10.0, kPixels)] { row->fill(span, k); }, kPixels};
    };
    const auto engine = std::make_shared<EngineRow>(10.0);
    e.variants.push_back({"every pixel",
                          "engine",
                          [] { return outcomeOf(1.0, engineError); },
                          {[engine] { engine->fill(); }, kPixels * kBlockHeight}});
    for (const int k : {1, 4, 8, 16, 32, kPixels}) {
        const std::string name = k == 1 ? "every pixel" : k == kPixels ? "affine" : "every " + std::to_string(k);
        e.variants.push_back(
            {name, "", [k] { return outcomeOf(1.0 / k, [k](double ratio) { return errorOf(ratio, k); }); }, timed(k)});
    }

    // The worst place of a straight line lies between pixels: 16 samples per pixel come close. Floats of 256 texels end
    // at 1.5e-5.
    const auto check = [&e](const std::string& what, double expected, double ratio, int k) {
        e.checks.push_back({what + ", w ratio " + number(ratio, 1), expected, [=] { return errorOf(ratio, k, 16).max; },
                            1e-4 * expected + 1e-4});
    };
    constexpr double kAffine[][2] = {{1.1, .0238230}, {1.5, .101021}, {2, .171573},   {4, .333333},
                                     {10, .519494},   {100, .818182}, {1000, .938693}};
    for (const auto& row : kAffine) check("affine", row[1] * kTexels, row[0], kPixels);
    struct Reference
    {
        double ratio, texels[4];
    };
    constexpr Reference kReferences[] = {{2, {.00495348, .0196306, .0770882, .297373}},
                                         {10, {.207229, .766450, 2.64838, 8.17652}},
                                         {100, {11.8447, 28.4121, 55.5665, 90.0259}}};
    for (const Reference& r : kReferences) {
        for (std::size_t i = 0; i < 4; ++i) check("every " + std::to_string(4 << i), r.texels[i], r.ratio, 4 << i);
    }
    e.finding = [](const Rows& rows) {
        const Row &always = rows("every pixel"), &inEngine = rows("every pixel", "engine"), &eight = rows("every 8"),
                  &sixteen = rows("every 16"), &affine = rows("affine");
        const auto against = [&always](const Row& row) {
            return number(row.fastest, 3) + " ns, " +
                   (row.fastest < 0.97 * always.fastest ? number(always.fastest / row.fastest, 1) + " times as fast"
                                                        : "no faster");
        };
        return "At a w ratio of 10, a division at every 8th pixel is up to " + number(eight.outcome.error.max, 2) +
               " texels off, every 16th " + number(sixteen.outcome.error.max, 1) + ", none at all " +
               number(affine.outcome.error.max, 0) + "; at 100 even every 8th is " + number(eight.fact("at 100"), 0) +
               " off, and the error jumps from row to row. "
               "Dividing at every pixel takes " +
               number(always.fastest, 3) + " ns, every 8th " + against(eight) + ", every 16th " + against(sixteen) +
               ". The engine's weights, which serve all components of a triangle and not a row alone, take " +
               number(inEngine.fastest, 3) + " ns. " +
               (sixteen.fastest < 0.5 * always.fastest ? "Straight lines still pay."
                                                       : "Straight lines hardly pay any more: a whole vector is "
                                                         "divided at once, and lines cost work of their own.");
    };
    return e;
}

}  // namespace relief::experiments
