// What the engine leaves out wherever a scene does not need it, by name, and where each is decided. No picture depends
// on any of it: tests draw every stage with all of it put back in and hold it to the same hash.
//
// Ordinary builds cannot put anything back: the names are constants, and a constant costs nothing. Builds with
// RELIEF_SWITCHES read the environment once, when the program starts: RELIEF_GENERIC="alpha clipping" does these two
// in full, RELIEF_GENERIC=all does everything. `relief report leave-out` measures with it what each saves.
#pragma once

#if defined(RELIEF_SWITCHES)
#include <cstdlib>
#include <cstring>
#endif

namespace relief::leavesOut {

#if defined(RELIEF_SWITCHES)
inline bool unlessGeneric(const char* name)
{
    const char* const generic = std::getenv("RELIEF_GENERIC");
    return generic == nullptr || (std::strstr(generic, name) == nullptr && std::strcmp(generic, "all") != 0);
}
#define RELIEF_LEAVES_OUT(name) inline const bool name = unlessGeneric(#name)
#else
#define RELIEF_LEAVES_OUT(name) inline constexpr bool name = true
#endif

RELIEF_LEAVES_OUT(constants);     // fetches from a texture of one texel (texture/sampler.cpp)
RELIEF_LEAVES_OUT(alpha);         // alpha's arithmetic, where a mip level is opaque everywhere (texture/filter.h)
RELIEF_LEAVES_OUT(logarithms);    // the level of detail, where a block is magnified (texture/sampler.cpp)
RELIEF_LEAVES_OUT(coarserLevel);  // the second mip level, where its part is 0 (texture/filter.h)
RELIEF_LEAVES_OUT(planes);        // tex2DWhere's fetch, where no pixel of a block needs it (texture/sampler.cpp)
RELIEF_LEAVES_OUT(clipping);      // the clipper, for triangles within the guard band (pipeline/setup.cpp)
RELIEF_LEAVES_OUT(tiles);         // tile memory, where no triangle is (pipeline/frame.cpp)
RELIEF_LEAVES_OUT(hidden);        // the fragment program, where all of a block is hidden (pipeline/draw.h)

#undef RELIEF_LEAVES_OUT

}  // namespace relief::leavesOut
