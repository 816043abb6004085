// What a block is shaded in: which of its lanes count, and where its texture fetches are counted. The pipeline sets it
// for every block; texture fetches look at it. Each thread has one.
#pragma once

#include <cstdint>

#include "relief/lanes/mask.h"
#include "relief/texture/fetch_counters.h"

namespace relief::inline RELIEF_WIDTH {

struct Shading
{
    // The quads with a pixel whose result counts, whole. Values exist in the other lanes too, but nothing depends on
    // them, so a texture fetch need not follow them to far mip levels.
    unsigned activeLanes = kAllLanes;

    FetchCounters fetches;

    // Of each lane the coarsest mip level that was sampled, in 1/256 of a level: for pipeline/inspect.cpp, which sets
    // it and kWatched in activeLanes. That bit is no lane. It makes every shortcut of a sample fail its test of the
    // lanes, so that the long way alone has to ask for it, and a frame that nobody watches runs not one instruction
    // more.
    std::int32_t* levels = nullptr;
};

inline constexpr unsigned kWatched = 1u << 31;

inline constinit thread_local Shading shading;

// Everything that may run in the middle of a block and has nothing to do with it, such as making a mip level, holds one
// of these: all lanes count, and what is fetched is nobody's.
class ShadingScope
{
public:
    ShadingScope() : outer(shading) { shading = {}; }
    ~ShadingScope() { shading = outer; }
    ShadingScope(const ShadingScope&) = delete;
    ShadingScope& operator=(const ShadingScope&) = delete;

private:
    Shading outer;
};

}  // namespace relief::inline RELIEF_WIDTH
