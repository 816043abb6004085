// E-32: corners snapped to 1/16, 1/256 or 1/4096 of a pixel.
#include <algorithm>

#include "experiments.h"
#include "lane_kernel.h"
#include "relief/hlsl/intrinsics.h"
#include "relief/pipeline/viewport_transform.h"

namespace relief::experiments {

namespace {

// A corner in fixed point with so many fraction bits, back in pixels. 8 bits are the engine's own.
template <int bits>
Float snapped(Float pixels)
{
    constexpr float steps = 1 << bits;
    if constexpr (bits == kSubpixelBits) return Float(ViewportTransform::snap(pixels)) * (1.0f / steps);
    const float limit = kGuardBand;
    return Float(roundToInt(clamp(pixels, -limit, limit) * steps)) * (1.0f / steps);
}

constexpr auto unsnapped = [](Float x, Float y) { return float2(x, y); };
template <int bits>
constexpr auto corner = [](Float x, Float y) { return float2(snapped<bits>(x), snapped<bits>(y)); };

struct Point
{
    double x, y;
};

template <class Snap>
std::vector<Point> placed(Snap snap, const std::vector<Point>& points)
{
    Columns in(2);
    for (const Point& p : points) in[0].push_back(static_cast<float>(p.x)), in[1].push_back(static_cast<float>(p.y));
    for (std::vector<float>& column : in) column.resize((points.size() + 15) / 16 * 16);
    const Columns out = evaluate<2>(in, snap);
    std::vector<Point> result;
    for (std::size_t i = 0; i < points.size(); ++i) result.push_back({out[0][i], out[1][i]});
    return result;
}

std::vector<Point> randomPoints(int count, double size, unsigned seed)
{
    std::mt19937 random(seed);
    const auto coordinate = [&] { return size * uniform(random); };
    std::vector<Point> points;
    for (int i = 0; i < count; ++i)
        points.push_back({0.0, 0.0}), points.back().x = coordinate(), points.back().y = coordinate();
    return points;
}

double distance(const Point& a, const Point& b)
{
    return std::hypot(a.x - b.x, a.y - b.y);
}

// How far corners move, in pixels, on a target of this size.
template <class Snap>
Error moved(Snap snap, int count, double size)
{
    const std::vector<Point> points = randomPoints(count, size, 32), after = placed(snap, points);
    ErrorSum sum;
    for (std::size_t i = 0; i < points.size(); ++i) sum.add(distance(points[i], after[i]));
    return sum.result();
}

// Of triangles in boxes of 10 pixels: by how many per cent of the average area theirs changes, RMS.
template <class Snap>
double areaError(Snap snap, int count)
{
    const std::vector<Point> points = randomPoints(3 * count, 10.0, 33), after = placed(snap, points);
    const auto area = [](const std::vector<Point>& p, std::size_t i) {
        return 0.5 *
               std::abs((p[i + 1].x - p[i].x) * (p[i + 2].y - p[i].y) - (p[i + 1].y - p[i].y) * (p[i + 2].x - p[i].x));
    };
    double squares = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < points.size(); i += 3) {
        const double change = area(after, i) - area(points, i);
        squares += change * change, sum += area(points, i);
    }
    return 100.0 * std::sqrt(squares / count) / (sum / count);
}

// A corner drifts by `step` pixels a frame: the frames, in per cent, in which it stands still.
template <class Snap>
double standsStill(Snap snap, double step)
{
    std::vector<Point> path;
    for (int frame = 0; frame <= 4096; ++frame) path.push_back({100.0 + step * frame, 0.0});
    const std::vector<Point> seen = placed(snap, path);
    int still = 0;
    for (std::size_t i = 1; i < seen.size(); ++i) still += seen[i].x == seen[i - 1].x;
    return 100.0 * still / 4096.0;
}

// Two corners drift together: by how much their distance changes from frame to frame, at most.
template <class Snap>
double swims(Snap snap, int count)
{
    double largest = 0.0;
    std::vector<Point> pairs = randomPoints(2 * count, 100.0, 34);
    std::vector<Point> before = placed(snap, pairs);
    for (int frame = 0; frame < 16; ++frame) {
        for (Point& p : pairs) p.x += 1.0 / 64.0 + 1e-3, p.y += 0.4e-3;
        const std::vector<Point> now = placed(snap, pairs);
        for (std::size_t i = 0; i < now.size(); i += 2) {
            const double was = distance(before[i], before[i + 1]), is = distance(now[i], now[i + 1]);
            largest = std::max(largest, std::abs(is - was));
        }
        before = now;
    }
    return largest;
}

template <class Snap>
void add(Experiment& e, const std::string& name, Snap snap, Effort effort, const std::shared_ptr<const Columns>& in)
{
    const int count = effort.samples(1 << 20, 1 << 13);
    const auto outcome = [=] {
        return Outcome(moved(snap, count, 1024.0),
                       {{"largest on 16384 px", moved(snap, count, 16384.0).max},
                        {"area off by %, 10 px", areaError(snap, effort.samples(1 << 16, 1 << 12))},
                        {"% frames still, 1/16 px", standsStill(snap, 1.0 / 16.0)},
                        {"% frames still, 1/1024 px", standsStill(snap, 1.0 / 1024.0)},
                        {"% frames still, 1/4096 px", standsStill(snap, 1.0 / 4096.0)},
                        {"swims by px", swims(snap, effort.samples(1 << 14, 1 << 9))}});
    };
    e.variants.push_back(laneVariant<2>(name, "", in, snap, outcome));
}

}  // namespace

Experiment snapping(Effort effort)
{
    Experiment e;
    e.id = "E-32";
    e.title = "Snapping corners";
    e.question =
        "Corners are rounded to fractions of a pixel before anything is drawn, so that coverage is exact integers. How "
        "far do they move with 4, 8 (Direct3D's and the engine's) and 12 bits of fraction, what does it do to the area "
        "of small triangles, and does a slow drift still look like one? Errors on a target of 1024 pixels, against "
        "doubles; unsnapped means floats, which are coarse themselves far from the origin.";
    e.item = "corner";
    e.unit = "pixels";
    const auto in = randomColumns({{0.0, 1024.0}, {0.0, 1024.0}});
    add(e, "4 bits", corner<4>, effort, in);
    add(e, "8 bits", corner<8>, effort, in);
    add(e, "12 bits", corner<12>, effort, in);
    add(e, "unsnapped", unsnapped, effort, in);

    // At most half a step in x and in y: sqrt(2) / 2^(bits + 1), which a corner in the middle of four comes to.
    const auto between = [](auto snap, double halfStep) {
        const std::vector<Point> middle = {{10.0 + halfStep, 20.0 + halfStep}};
        return distance(middle[0], placed(snap, middle)[0]);
    };
    e.checks.push_back({"4 bits, the most", .0441942, [=] { return between(corner<4>, 1.0 / 32.0); }, 1e-7});
    e.checks.push_back({"8 bits, the most", .00276214, [=] { return between(corner<8>, 1.0 / 512.0); }, 1e-8});
    const auto atMost = [&e](const std::string& what, double bound, std::function<double()> measured) {
        e.checks.push_back({what, bound, std::move(measured), 0.0, true});
    };
    const int count = effort.samples(1 << 20, 1 << 13);
    constexpr double kFloat = 4.4e-5;  // sqrt(2) * 2^-15: what a float of 512 to 1024 is rounded by
    atMost("4 bits, of random corners", .0441942 + kFloat, [=] { return moved(corner<4>, count, 1024.0).max; });
    atMost("8 bits, of random corners", .00276214 + kFloat, [=] { return moved(corner<8>, count, 1024.0).max; });
    atMost("12 bits, of random corners", .000172634 + kFloat, [=] { return moved(corner<12>, count, 1024.0).max; });

    e.finding = [](const Rows& rows) {
        const Row &four = rows("4 bits"), &eight = rows("8 bits"), &twelve = rows("12 bits"), &none = rows("unsnapped");
        const auto far = [](const Row& row) { return number(row.fact("largest on 16384 px"), 5); };
        const auto still = [](const Row& row) { return number(row.fact("% frames still, 1/1024 px"), 0) + " %"; };
        return "With 4 bits corners move by up to " + number(four.outcome.error.max, 4) + " pixels and the area of a " +
               "triangle of 10 pixels by " + number(four.fact("area off by %, 10 px"), 2) + " %; with 8 bits by " +
               number(eight.outcome.error.max, 4) + " and " + number(eight.fact("area off by %, 10 px"), 3) +
               " %. A drift of 1/1024 pixel a frame stands still in " + still(four) + " and " + still(eight) +
               " of the frames and then jumps, each corner in its own frame: edges swim by " +
               number(four.fact("swims by px"), 3) + " and " + number(eight.fact("swims by px"), 4) +
               " pixels. 12 bits are finer on small targets only: on 16384 pixels they are off by " + far(twelve) +
               ", unsnapped floats by " + far(none) +
               "; and edge functions would need 57 bits, more than a double holds "
               "exactly. A corner takes " +
               number(four.fastest, 3) + ", " + number(eight.fastest, 3) + " and " + number(twelve.fastest, 3) +
               " ns with 4, 8 and 12 bits: the same operations.";
    };
    return e;
}

}  // namespace relief::experiments
