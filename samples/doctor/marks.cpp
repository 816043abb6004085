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

// The mean kink between columns k - 1 and k (or rows), for k modulo `period`; the first's ratio to the others' mean.
double standsOut(const Channels& p, int period, bool rows)
{
    std::vector<double> sum(static_cast<std::size_t>(period), 0.0), count(sum.size(), 0.0);
    const int length = rows ? p.height : p.width, other = rows ? p.width : p.height;
    const auto texel = [&](int along, int across) -> const std::array<float, 4>& {
        // Blocks begin at the picture's upper left corner.
        return rows ? p.texels[p.at(across, p.height - 1 - along)] : p.texels[p.at(along, across)];
    };
    for (int k = 2; k + 1 < length; ++k) {
        for (int i = 0; i < other; ++i) {
            sum[static_cast<std::size_t>(k % period)] +=
                kinkAt(texel(k - 2, i), texel(k - 1, i), texel(k, i), texel(k + 1, i));
            ++count[static_cast<std::size_t>(k % period)];
        }
    }
    double first = 0.0, rest = 0.0;
    for (std::size_t k = 0; k < sum.size(); ++k) {
        if (count[k] == 0.0) return 1.0;
        (k == 0 ? first : rest) += sum[k] / count[k] / (k == 0 ? 1.0 : period - 1.0);
    }
    return rest > 1e-6 ? first / rest : 1.0;
}

double fewColors(const Channels& p)
{
    int varied = 0, few = 0;
    for (int y = 0; y + 4 <= p.height; y += 4) {
        for (int x = 0; x + 4 <= p.width; x += 4) {
            std::set<std::array<float, 3>> colors;
            float low[3] = {1, 1, 1}, high[3] = {0, 0, 0};
            for (int i = 0; i < 16; ++i) {
                const std::array<float, 4>& t = p.texels[p.at(x + i % 4, p.height - 1 - (y + i / 4))];
                colors.insert({t[0], t[1], t[2]});
                for (std::size_t c = 0; c < 3; ++c) {
                    low[c] = std::min(low[c], t[c]);
                    high[c] = std::max(high[c], t[c]);
                }
            }
            const float variety = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
            if (variety < 8.0f / 255.0f) continue;
            ++varied;
            few += colors.size() <= 4;
        }
    }
    return varied < 16 ? 0.0 : static_cast<double>(few) / varied;
}

}  // namespace

Levels levelsOf(const Channels& channels, Layout layout)
{
    Levels worst;
    if (channels.step != 1.0f / 255.0f) return worst;
    for (const std::size_t c : {layout == Layout::alphaGreen ? std::size_t{3} : std::size_t{0}, std::size_t{1}}) {
        std::array<double, 256> count{};
        for (const auto& t : channels.texels) ++count[static_cast<std::size_t>(t[c] * 255.0f + 0.5f)];
        // What one would expect: the mean of the sixteen codes around, the code itself left out.
        int expected = 0, missing = 0, first = -1, last = -1;
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
            missing += count[static_cast<std::size_t>(k)] == 0.0;
            if (first < 0) first = k;
            last = k;
        }
        if (expected < 16) continue;
        const double part = static_cast<double>(missing) / expected;
        if (part <= worst.missing) continue;
        const int is = expected - missing;
        worst = {part, is > 1 ? static_cast<double>(last - first) / (is - 1) : static_cast<double>(expected)};
    }
    return worst;
}

Blocks blocksOf(const Channels& channels)
{
    Blocks blocks;
    blocks.eight = std::max(standsOut(channels, 8, false), standsOut(channels, 8, true));
    blocks.four = std::max(standsOut(channels, 4, false), standsOut(channels, 4, true));
    blocks.fewColors = fewColors(channels);
    return blocks;
}

Seam seamOf(const Channels& p)
{
    const auto ratio = [&](int length, int other, const auto& texel) {
        double over = 0.0, beside = 0.0;
        for (int i = 0; i < other; ++i) {
            over += stepBetween(texel(length - 1, i), texel(0, i));
            for (int k = 1; k <= 4; ++k) {
                beside += 0.125 * (stepBetween(texel(k - 1, i), texel(k, i)) +
                                   stepBetween(texel(length - 1 - k, i), texel(length - k, i)));
            }
        }
        const double least = other * 0.5 / 255.0;
        return (over + least) / (beside + least);
    };
    return {ratio(
                p.width, p.height, [&](int x, int y) -> const auto& { return p.texels[p.at(x, y)]; }),
            ratio(
                p.height, p.width, [&](int y, int x) -> const auto& { return p.texels[p.at(x, y)]; })};
}

}  // namespace relief::samples::doctor
