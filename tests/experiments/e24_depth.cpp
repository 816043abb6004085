// E-24: what a depth buffer stores: 16 or 24 bits or a float; z/w, reversed z/w, 1/w or w itself.
#include <array>
#include <limits>

#include "experiments.h"
#include "lane_kernel.h"
#include "relief/pipeline/output_merger.h"

namespace relief::experiments {

namespace {

enum class Format
{
    d16,
    d24,
    d32f,
    reversed,
    inverseW,
    linear
};
constexpr Format kFormats[] = {Format::d16,      Format::d24,      Format::d32f,
                               Format::reversed, Format::inverseW, Format::linear};
constexpr const char* kNames[] = {"16 bits", "24 bits", "float", "reversed float", "float 1/w", "float w"};

struct Range
{
    double near, far;
};

// z = scale * w + offset: 0 ... 1 from near to far after the division by w; reversed 1 ... 0.
struct Projection
{
    float scale, offset;

    Projection(Format format, Range r)
    {
        const double depth = r.far - r.near;
        const bool reversed = format == Format::reversed;
        scale = static_cast<float>(reversed ? -r.near / depth : r.far / depth);
        offset = static_cast<float>(reversed ? r.near * r.far / depth : -r.near * r.far / depth);
    }
};

// What is stored of a fragment of clip-space z and w; integers as floats, which hold 24 bits.
template <Format format>
Float stored(Float z, Float w)
{
    if constexpr (format == Format::linear) return w;
    const Float inverseW = 1.0f / w;
    if constexpr (format == Format::inverseW) return inverseW;
    const Float depth = saturate(z * inverseW);
    if constexpr (format == Format::d16) return Float(roundToInt(depth * 65535.0f));
    if constexpr (format == Format::d24) return Float(roundToInt(depth * 16777215.0f));
    return depth;
}

template <Format format>
constexpr Compare kNearer = format == Format::reversed || format == Format::inverseW ? Compare::greater : Compare::less;

// The smallest distance between two surfaces at distance z that are stored as different numbers: a step of what is
// stored, by how fast it changes with z.
double smallestGap(Format format, Range r, double z)
{
    const double slope = r.near * r.far / ((r.far - r.near) * z * z);
    const auto step = [](double number) {
        const auto f = static_cast<float>(number);
        const double after = std::nextafter(f, std::numeric_limits<float>::max());
        return after - static_cast<double>(f);
    };
    switch (format) {
        case Format::d16:
            return 1.0 / 65535.0 / slope;
        case Format::d24:
            return 1.0 / 16777215.0 / slope;
        case Format::d32f:
            return step(r.far * (z - r.near) / (z * (r.far - r.near))) / slope;
        case Format::reversed:
            return step(r.near * (r.far - z) / (z * (r.far - r.near))) / slope;
        case Format::inverseW:
            return step(1.0 / z) * z * z;
        case Format::linear:
            break;
    }
    return step(z);
}

// Relative to the distance, at distances of even ratios.
Error gaps(Format format, Range r)
{
    ErrorSum sum;
    constexpr int steps = 2000;
    for (int i = 1; i < steps; ++i) {
        const double z = r.near * std::pow(r.far / r.near, static_cast<double>(i) / steps);
        sum.add(smallestGap(format, r, z) / z);
    }
    return sum.result();
}

// Of pairs of surfaces, one behind the other by 1e-5 of the distance: how many per cent are stored in another order or
// as the same. In floats, as the pipeline computes them.
template <Format format>
double wrongPairs(Range r, int pairs)
{
    const Projection p(format, r);
    Columns in(2);
    std::mt19937 random(24);
    for (int i = 0; i < pairs; ++i) {
        const double part = uniform(random), w = r.near * std::pow(r.far / r.near, part);
        in[0].push_back(static_cast<float>(w));
        in[1].push_back(static_cast<float>(w * (1.0 + 1e-5)));
    }
    const Columns right = evaluate<2>(in, [p](Float front, Float behind) {
        const Float a = stored<format>(front * p.scale + p.offset, front);
        const Float b = stored<format>(behind * p.scale + p.offset, behind);
        return select(compareBy(kNearer<format>, a, b), Float(1.0f), Float(0.0f));
    });
    double wrong = 0.0;
    for (const float ordered : right[0]) wrong += ordered == 0.0f;
    return 100.0 * wrong / pairs;
}

template <Format format>
void add(Experiment& e, Range r, Effort effort)
{
    const Projection p(format, r);
    auto in = std::make_shared<Columns>(*randomColumns({{0.0, 1.0}, {r.near, r.far}, {0.0, 1.0}}));
    for (std::size_t i = 0; i < in->front().size(); ++i) (*in)[0][i] = (*in)[1][i] * p.scale + p.offset;
    const auto kernel = [](Float z, Float w, Float old) {
        const Float depth = stored<format>(z, w);
        return select(compareBy(kNearer<format>, depth, old), depth, old);
    };
    const int pairs = effort.samples(1 << 18, 1 << 14);
    e.variants.push_back(laneVariant<3>(
        kNames[static_cast<int>(format)], number(r.near, 2) + " to " + number(r.far, 0), in, kernel, [=] {
            return Outcome(gaps(format, r), {{"gap at 1", smallestGap(format, r, 1.0)},
                                             {"gap at 100", smallestGap(format, r, 100.0)},
                                             {"gap at 999", smallestGap(format, r, 999.0)},
                                             {"% of pairs wrong", wrongPairs<format>(r, pairs)},
                                             {"bytes", format == Format::d16 ? 2.0 : 4.0}});
        }));
}

}  // namespace

Experiment depth(Effort effort)
{
    Experiment e;
    e.id = "E-24";
    e.title = "What a depth buffer stores";
    e.question =
        "z/w uses up nearly all of its range close to the camera. How far apart must two surfaces be to be told from "
        "each other, as a part of their distance, with 16 or 24 bits, a float, a float of reversed z/w, of 1/w, or of "
        "the distance itself? The error is that gap by storage alone; the pairs, 1e-5 of their distance apart, are "
        "projected and compared in floats as a pipeline does it. The engine stores floats, standard or reversed.";
    e.item = "fragment";
    e.unit = "gap / distance";
    e.rivals = Rivals::ofOneParameter;
    for (const Range r : {Range{.1, 1000}, Range{.01, 1e4}}) {
        add<Format::d16>(e, r, effort);
        add<Format::d24>(e, r, effort);
        add<Format::d32f>(e, r, effort);
        add<Format::reversed>(e, r, effort);
        add<Format::inverseW>(e, r, effort);
        add<Format::linear>(e, r, effort);
    }

    struct Reference
    {
        Range range;
        double z, gap[6];
    };
    constexpr Reference kReferences[] = {
        {{.1, 1000}, 1, {1.52575e-4, 5.95987e-7, 5.95987e-7, 7.44984e-8, 1.19209e-7, 1.19209e-7}},
        {{.1, 1000}, 10, {.0152575, 5.95987e-5, 5.95987e-5, 9.31229e-7, 7.45058e-7, 9.53674e-7}},
        {{.1, 1000}, 100, {1.52575, .00595987, .00595987, 5.82018e-6, 9.31323e-6, 7.62939e-6}},
        {{.1, 1000}, 999, {152.270, .594796, .594795, 7.09051e-8, 1.16183e-4, 6.10352e-5}},
        {{.01, 1e4}, 100, {15.2590, .0596046, .0596046, 7.27595e-6, 9.31323e-6, 7.62939e-6}},
        {{.01, 1e4}, 999, {1522.85, 5.94854, 5.94854, 9.07676e-5, 1.16183e-4, 6.10352e-5}}};
    for (const Reference& reference : kReferences) {
        for (const Format f : kFormats) {
            const int i = static_cast<int>(f);
            const Range range = reference.range;
            const double z = reference.z;
            e.checks.push_back({std::string(kNames[i]) + ", " + number(range.near, 2) + " to " + number(range.far, 0) +
                                    ", gap at " + number(z, 0),
                                reference.gap[i], [=] { return smallestGap(f, range, z); }, 1e-5 * reference.gap[i]});
        }
    }
    e.finding = [](const Rows& rows) {
        const char* const range = "0.10 to 1000";
        const Row &standard = rows("float", range), &d24 = rows("24 bits", range),
                  &reversed = rows("reversed float", range), &d16 = rows("16 bits", range);
        const auto wrong = [](const Row& row) { return number(row.fact("% of pairs wrong"), 1) + " %"; };
        const auto gap = [](const Row& row) { return number(row.fact("gap at 100") * 1000.0, 3); };
        return "At 100 m, seen from 0.1 m on, two surfaces must be " + gap(d16) + " mm apart in 16 bits, " + gap(d24) +
               " in 24, and " + gap(standard) +
               " as floats of z/w: a float's fine steps near 0 are spent where z/w is "
               "fine already. Reversed, they are where they are needed: " +
               gap(reversed) +
               " mm. Of pairs 1e-5 of "
               "their distance apart " +
               wrong(standard) + " come out wrong with floats of z/w, " + wrong(reversed) +
               " with reversed ones; a test takes " + number(standard.fastest, 3) + " and " +
               number(reversed.fastest, 3) + " ns.";
    };
    return e;
}

}  // namespace relief::experiments
