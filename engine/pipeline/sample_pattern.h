// Where a pixel is sampled: Direct3D's standard patterns (D3D 11.3, 19.2.4). Coverage, depth and blending are worked
// out at each sample; the fragment program runs once a pixel.
#pragma once

#include <array>

namespace relief {

inline constexpr int kMaxSamples = 8;

struct SamplePattern
{
    struct Position
    {
        int x, y;  // from the pixel's centre, in sub-pixels (1/256 px), y down
    };

    int count;
    int reach;  // no coordinate is further from the centre
    std::array<Position, kMaxSamples> position;

    bool isMultiple() const { return count > 1; }
};

namespace detail {

// In sixteenths of a pixel.
consteval SamplePattern sixteenths(int count, std::array<SamplePattern::Position, kMaxSamples> positions)
{
    int reach = 0;
    for (SamplePattern::Position& p : positions) {
        p = {16 * p.x, 16 * p.y};
        for (const int c : {p.x, -p.x, p.y, -p.y}) reach = c > reach ? c : reach;
    }
    return {count, reach, positions};
}

}  // namespace detail

inline constexpr SamplePattern kSamplePatterns[] = {
    detail::sixteenths(1, {{{0, 0}}}),
    detail::sixteenths(2, {{{4, 4}, {-4, -4}}}),
    detail::sixteenths(4, {{{-2, -6}, {6, -2}, {-6, 2}, {2, 6}}}),
    detail::sixteenths(8, {{{1, -3}, {-1, 3}, {5, 1}, {-3, -5}, {-5, 5}, {-7, -1}, {3, 7}, {7, -7}}}),
};
inline constexpr const SamplePattern& kOneSample = kSamplePatterns[0];

// The pattern of 1, 2, 4 or 8 samples; null for other numbers.
constexpr const SamplePattern* samplePattern(int count)
{
    for (const SamplePattern& pattern : kSamplePatterns) {
        if (pattern.count == count) return &pattern;
    }
    return nullptr;
}

}  // namespace relief
