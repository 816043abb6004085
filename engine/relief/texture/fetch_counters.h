// How often a frame's fragment programs sampled textures, and how. The numbers count lanes that a block shades
// (Shading::activeLanes), so they are the same for every number of lanes.
#pragma once

#include <cstdint>

namespace relief {

struct FetchCounters
{
    // Samples by what the sampler asked for: every sample is counted in exactly one of these four.
    std::uint64_t nearest = 0;
    std::uint64_t bilinear = 0;
    std::uint64_t trilinear = 0;
    std::uint64_t anisotropic = 0;

    // Of those:
    std::uint64_t constant = 0;            // of a texture of one texel: nothing was fetched
    std::uint64_t magnified = 0;           // level 0 was enough: a level of detail of 0 or below, or no mip levels
    std::uint64_t taps = 0;                // samples along the footprint, of the anisotropic ones
    std::uint64_t secondLevelSkipped = 0;  // trilinear taps that lie exactly on a level (magnified ones included)
    std::uint64_t noDerivatives = 0;       // the coordinate was not compared with the neighbouring pixels': no level of
                                           // detail to choose, or one that the program gave (tex2Dlod, tex2Dgrad)

    std::uint64_t samples() const { return nearest + bilinear + trilinear + anisotropic; }
    std::uint64_t fetched() const { return samples() - constant; }  // where there was something to fetch

    FetchCounters& operator+=(const FetchCounters& other)
    {
        nearest += other.nearest;
        bilinear += other.bilinear;
        trilinear += other.trilinear;
        anisotropic += other.anisotropic;
        constant += other.constant;
        magnified += other.magnified;
        taps += other.taps;
        secondLevelSkipped += other.secondLevelSkipped;
        noDerivatives += other.noDerivatives;
        return *this;
    }
    friend bool operator==(const FetchCounters&, const FetchCounters&) = default;
};

}  // namespace relief
