#include "doctor/marks.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace relief::samples::doctor {

namespace {

// Blue says little, and changes sign where normals point below the surface.
constexpr std::size_t kTelling[] = {0, 1, 3};

// The sum of the steps of these channels between two texels.
double stepBetween(const std::array<float, 4>& a, const std::array<float, 4>& b)
{
    double step = 0.0;
    for (const std::size_t c : kTelling) step += std::abs(static_cast<double>(a[c]) - static_cast<double>(b[c]));
    return step;
}

// How far a step differs from the mean of the steps before and after it: smooth pictures have little of it.
double kinkAt(const std::array<float, 4>& a, const std::array<float, 4>& b, const std::array<float, 4>& c,
              const std::array<float, 4>& d)
{
    double kink = 0.0;
    for (const std::size_t i : kTelling) kink += std::abs((c[i] - b[i]) - 0.5f * ((b[i] - a[i]) + (d[i] - c[i])));
    return kink;
}

// A picture's lines: its columns from left to right, or its rows from the top, where blocks begin.
struct Lines
{
    const Channels& p;
    bool rows;
    [[nodiscard]] int count() const { return rows ? p.height : p.width; }
    [[nodiscard]] int length() const { return rows ? p.width : p.height; }
    [[nodiscard]] const std::array<float, 4>& at(int line, int i) const
    {
        return rows ? p.texels[p.at(i, p.height - 1 - line)] : p.texels[p.at(line, i)];
    }
};

// Whether the picture itself repeats every `period` lines: then its own steps fall together with those of blocks. Lines
// that far apart differ by less than a quarter of what some pair between them differs by.
bool repeats(const Lines& lines, int period)
{
    double largest = 0.0, last = 0.0;
    for (int lag = 1; lag <= period; ++lag) {
        largest = std::max(largest, last);
        last = 0.0;
        for (int k = 0; k + period < lines.count(); ++k) {
            for (int i = 0; i < lines.length(); i += 8) last += stepBetween(lines.at(k, i), lines.at(k + lag, i));
        }
    }
    return last < 0.25 * largest;
}

// The kinks between lines k - 1 and k for every k that `period` divides, and for all others: the ratio of their
// medians. A pattern of its own may have a few such lines, and blocks have all of them. 1 where it can't be told.
double standsOut(const Lines& lines, int period)
{
    if (lines.count() <= 2 * period || repeats(lines, 2 * period)) return 1.0;
    std::vector<double> first, rest;
    for (int k = 2; k + 1 < lines.count(); ++k) {
        double sum = 0.0;
        for (int i = 0; i < lines.length(); ++i) {
            sum += kinkAt(lines.at(k - 2, i), lines.at(k - 1, i), lines.at(k, i), lines.at(k + 1, i));
        }
        (k % period == 0 ? first : rest).push_back(sum / lines.length());
    }
    const auto median = [](std::vector<double>& list) {
        const auto middle = list.begin() + static_cast<std::ptrdiff_t>(list.size() / 2);
        std::nth_element(list.begin(), middle, list.end());
        return *middle;
    };
    constexpr double kLeast = 1e-4;  // a fortieth of a code
    return (median(first) + kLeast) / (median(rest) + kLeast);
}

double fewColors(const Channels& p)
{
    int varied = 0, few = 0;
    for (int y = 0; y + 4 <= p.height; y += 4) {
        for (int x = 0; x + 4 <= p.width; x += 4) {
            std::set<std::array<float, 3>> colors;
            bool variesAlong = false, variesAcross = false;
            float low[3] = {1, 1, 1}, high[3] = {0, 0, 0};
            for (int i = 0; i < 16; ++i) {
                const std::array<float, 4>& t = p.texels[p.at(x + i % 4, p.height - 1 - (y + i / 4))];
                colors.insert({t[0], t[1], t[2]});
                variesAlong = variesAlong || t != p.texels[p.at(x, p.height - 1 - (y + i / 4))];
                variesAcross = variesAcross || t != p.texels[p.at(x + i % 4, p.height - 1 - y)];
                for (std::size_t c = 0; c < 3; ++c) {
                    low[c] = std::min(low[c], t[c]);
                    high[c] = std::max(high[c], t[c]);
                }
            }
            const float variety = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
            if (variety < 8.0f / 255.0f || !variesAlong || !variesAcross) continue;  // stripes have few colours anyway
            ++varied;
            few += colors.size() <= 4;
        }
    }
    return varied < 16 ? 0.0 : static_cast<double>(few) / varied;
}

// Whether all rows, or all columns, are the same: then it has few codes anyway.
bool isStriped(const Channels& p)
{
    bool rows = true, columns = true;
    for (int y = 0; y < p.height; ++y) {
        for (int x = 0; x < p.width; ++x) {
            const std::array<float, 4>& texel = p.texels[p.at(x, y)];
            rows = rows && texel == p.texels[p.at(x, 0)];
            columns = columns && texel == p.texels[p.at(0, y)];
        }
    }
    return rows || columns;
}

// How much of a list of codes lies evenly, up to rounding: of all stretches of so many codes, those in which none is
// farther than one code from the straight line. A pattern that repeats often has few codes, too, but not evenly.
double evenPart(const std::vector<int>& codes)
{
    const std::size_t stretch = std::min<std::size_t>(codes.size(), 16) - 1;
    int even = 0, all = 0;
    for (std::size_t i = 0; i + stretch < codes.size(); ++i, ++all) {
        const double slope = static_cast<double>(codes[i + stretch] - codes[i]) / static_cast<double>(stretch);
        bool isEven = true;
        for (std::size_t k = 1; k < stretch; ++k)
            isEven = isEven && std::abs(codes[i + k] - codes[i] - slope * static_cast<double>(k)) <= 1.0;
        even += isEven;
    }
    return static_cast<double>(even) / all;
}

}  // namespace

Levels levelsOf(const Channels& channels, Layout layout)
{
    Levels worst;
    if (channels.step != 1.0f / 255.0f || isStriped(channels)) return worst;
    for (const std::size_t c : {layout == Layout::alphaGreen ? std::size_t{3} : std::size_t{0}, std::size_t{1}}) {
        std::array<double, 256> count{};
        for (const auto& t : channels.texels) ++count[static_cast<std::size_t>(t[c] * 255.0f + 0.5f)];
        // Where a code should be: the sixteen around it are common. Those that are.
        int expected = 0, missing = 0;
        std::vector<int> present;
        for (int k = 8; k < 248; ++k) {
            double around = 0.0;
            int there = 0;
            for (int i = -8; i <= 8; ++i) {
                const double n = i == 0 ? 0.0 : count[static_cast<std::size_t>(k + i)];
                around += n;
                there += n > 0.0;
            }
            if (around / 16.0 < 24.0 || there < 2) continue;
            ++expected;
            if (count[static_cast<std::size_t>(k)] == 0.0) {
                ++missing;
                continue;
            }
            present.push_back(k);
        }
        if (expected < 16 || present.size() < 5) continue;
        const double part = static_cast<double>(missing) / expected;
        const double spacing =
            static_cast<double>(present.back() - present.front()) / static_cast<double>(present.size() - 1);
        const bool isEven = evenPart(present) > 0.75;
        if (isEven && part > worst.missing) worst = {part, spacing};
    }
    return worst;
}

Blocks blocksOf(const Channels& channels)
{
    Blocks blocks;
    const Lines columns{channels, false}, rows{channels, true};
    blocks.eight = std::max(standsOut(columns, 8), standsOut(rows, 8));
    blocks.four = std::max(standsOut(columns, 4), standsOut(rows, 4));
    blocks.fewColors = fewColors(channels);
    return blocks;
}

Seam seamOf(const Channels& p)
{
    const auto ratio = [](int length, int other, const auto& texel) {
        std::vector<double> steps;  // the mean step from each line to the next; the last one goes over the side
        for (int k = 0; k < length; ++k) {
            double sum = 0.0;
            for (int i = 0; i < other; ++i) sum += stepBetween(texel(k, i), texel((k + 1) % length, i));
            steps.push_back(sum / other);
        }
        const double over = steps.back();
        steps.pop_back();
        double beside = 0.0;
        const std::size_t last = steps.size() - 1;
        for (std::size_t k = 0; k < 4; ++k) beside += 0.125 * (steps[k] + steps[last - k]);
        // A pattern with steps of its own may have one at the side.
        const auto large = steps.begin() + static_cast<std::ptrdiff_t>(0.98 * static_cast<double>(last));
        std::nth_element(steps.begin(), large, steps.end());
        const double least = 0.5 / 255.0;
        return (over + least) / (std::max(beside, *large) + least);
    };
    return {ratio(
                p.width, p.height, [&](int x, int y) -> const auto& { return p.texels[p.at(x, y)]; }),
            ratio(
                p.height, p.width, [&](int y, int x) -> const auto& { return p.texels[p.at(x, y)]; })};
}

}  // namespace relief::samples::doctor
