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
    using Positions = std::array<Position, kMaxSamples>;

    int count;
    int reach = 0;  // no coordinate is further from the centre
    Positions position;

    // Of positions in sixteenths of a pixel, as Direct3D gives them.
    consteval SamplePattern(int number, const Positions& sixteenths) : count(number), position(sixteenths)
    {
        for (Position& p : position) {
            p = {16 * p.x, 16 * p.y};
            for (const int c : {p.x, -p.x, p.y, -p.y}) reach = c > reach ? c : reach;
        }
    }

    bool isMultiple() const { return count > 1; }
};

inline constexpr SamplePattern kSamplePatterns[] = {
    {1, {{{0, 0}}}},
    {2, {{{4, 4}, {-4, -4}}}},
    {4, {{{-2, -6}, {6, -2}, {-6, 2}, {2, 6}}}},
    {8, {{{1, -3}, {-1, 3}, {5, 1}, {-3, -5}, {-5, 5}, {-7, -1}, {3, 7}, {7, -7}}}},
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
