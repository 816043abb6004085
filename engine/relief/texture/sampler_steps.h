// What samplers of all kinds do around their filters: the level of detail within its limits, and the counters. A
// Sampler is a sampler2D or a samplerCUBE; what only one of them has is in its own file.
#pragma once

#include <algorithm>

#include "relief/hlsl/intrinsics.h"
#include "relief/texture/cube_sampler.h"
#include "relief/texture/filter.h"
#include "relief/texture/shading_scope.h"

namespace relief::inline RELIEF_WIDTH {

inline bool isAnisotropic(const sampler2D& s)
{
    return s.maxAnisotropy > 1 && s.filter == Filter::trilinear;
}

inline bool isAnisotropic(const samplerCUBE&)
{
    return false;
}

// --- the level of detail ---

// The bias of the sampler and of a call, within D3D's limits (7.18.10).
template <class Sampler>
inline Float limitBias(const Sampler& s, Float bias)
{
    return clamp(bias + s.lodBias, -16.0f, 15.99f);
}

// `lod` after bias, NaN included, limited by the sampler (minLod wins where it is above maxLod) and to `levels`, those
// that exist. NaN becomes the upper limit.
template <class Sampler>
inline Float limitedLevel(const Sampler& s, int levels, Float lod)
{
    const auto last = static_cast<float>(levels - 1);
    const float low = std::min(std::max(0.0f, s.minLod), last);  // std::max and std::min give the first where the
    const float high = std::max(low, std::min(last, s.maxLod));  // second is NaN
    return Float(native::max(native::min(lod.value, Float(high).value), Float(low).value));
}

// What sampleMipLevels takes.
template <class Sampler>
inline Int fixedLevel(const Sampler& s, int levels, Float lod)
{
    const Float limited = limitedLevel(s, levels, lod);
    return Int(native::roundToInt((limited * static_cast<float>(kLodOne)).value));
}

// The level that a block most likely wants, quickly: half the exponent of the first lane's `square` is the integer part
// of its level, before bias and limits. `square` is that of the coordinate's longer change, in texels.
template <class Sampler>
inline int likelyLevel(const Sampler& s, int levels, Float square)
{
    const int exponent = (asInt(square)[0] >> 23) - 127;
    const int level = (s.filter == Filter::trilinear ? exponent : exponent + 1) >> 1;
    return std::clamp(level, 0, levels - 1);
}

// --- counting (see fetch_counters.h) ---

inline std::uint64_t countOf(unsigned lanes)
{
    return static_cast<std::uint64_t>(countBits(lanes));
}

template <class Sampler>
inline void countSample(const Sampler& s)
{
    const std::uint64_t n = countOf(shading.activeLanes);
    if (isAnisotropic(s))
        shading.fetches.anisotropic += n;
    else if (s.filter == Filter::trilinear)
        shading.fetches.trilinear += n;
    else if (s.filter == Filter::bilinear)
        shading.fetches.bilinear += n;
    else
        shading.fetches.nearest += n;
}

template <class Sampler>
inline void countOneLevel(const Sampler& s, unsigned onFinest, unsigned onOneLevel)
{
    shading.fetches.magnified += countOf(onFinest & shading.activeLanes);
    if (s.filter == Filter::trilinear) shading.fetches.secondLevelSkipped += countOf(onOneLevel & shading.activeLanes);
}

// Lanes of which one level is enough, with the bit kWatched where it is set: 0 in most blocks.
inline unsigned lanesOnOneLevel(Int fixed)
{
    return shading.activeLanes & ~((fixed & (kLodOne - 1)) > 0).bits();
}

inline void countNoDerivatives()
{
    shading.fetches.noDerivatives += countOf(shading.activeLanes);
}

// For an instrument: Shading::levels.
template <class Sampler>
inline void noteLevels(const Sampler& s, Int fixed)
{
    const Int level = s.filter == Filter::trilinear ? fixed : (fixed + kLodOne / 2) & -kLodOne;
    const Int before = Int::load(shading.levels);
    select(Mask::fromBits(shading.activeLanes & kAllLanes), max(before, level), before).store(shading.levels);
}

}  // namespace relief::inline RELIEF_WIDTH
