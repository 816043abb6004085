// What the engine leaves out wherever a scene does not need it, by name, and where each is decided. No picture depends
// on any of it: tests draw every stage with all of it put back in and hold it to the same hash.
//
// Ordinary builds cannot put anything back: the names are constants, and a constant costs nothing. Builds with
// RELIEF_SWITCHES read the environment once, when the program starts: RELIEF_GENERIC="alpha clipping" does these two
// in full, RELIEF_GENERIC=all does everything. `relief report leave-out` measures with it what each saves.
#pragma once

#include <string_view>

#include "relief/error.h"

namespace relief::leavesOut {

// Of each its name, the file where it is decided, and what putting it back means.
// clang-format off
#define RELIEF_LEAVES_OUT(each)                                                                             \
    each(constants, "texture/sampler.cpp", "textures of one texel are fetched from")                        \
    each(alpha, "texture/filter.h", "alpha is filtered where it is 1 everywhere")                           \
    each(logarithms, "texture/sampler.cpp", "the level of detail is worked out where a block is magnified") \
    each(coarserLevel, "texture/filter.h", "the second mip level is fetched where its part is 0")           \
    each(planes, "texture/sampler.cpp", "planes without weight are fetched (triplanar)")                    \
    each(clipping, "pipeline/setup.cpp", "every triangle goes through the clipper")                         \
    each(tiles, "pipeline/frame.cpp", "tiles without triangles are drawn in tile memory")                   \
    each(hidden, "pipeline/draw.cpp", "hidden pixels are shaded")                                           \
    each(emptyQuads, "pipeline/draw.cpp", "a block with few live quads runs by itself")                     \
    each(colors, "pipeline/draw.cpp", "programs run where no target keeps their colours")                   \
    each(discarded, "pipeline/program.h", "programs go on where they have thrown all of a block away")
// clang-format on

struct LeftOut
{
    const char* name;
    const char* decidedIn;
    const char* putBack;
};

#define RELIEF_ROW(name, decidedIn, putBack) {#name, decidedIn, putBack},
inline constexpr LeftOut kAll[] = {RELIEF_LEAVES_OUT(RELIEF_ROW)};
#undef RELIEF_ROW

// What RELIEF_GENERIC says; empty in builds without switches.
std::string_view generic();

// Whether words with spaces between them put this name back; and an error that names the first of them that is no name.
bool putsBack(std::string_view words, std::string_view name);
Expected<void> checkGeneric(std::string_view words);

#if defined(RELIEF_SWITCHES)
#define RELIEF_SWITCH(name, decidedIn, putBack) inline const bool name = !putsBack(generic(), #name);
#else
#define RELIEF_SWITCH(name, decidedIn, putBack) inline constexpr bool name = true;
#endif
RELIEF_LEAVES_OUT(RELIEF_SWITCH)
#undef RELIEF_SWITCH
#undef RELIEF_LEAVES_OUT

}  // namespace relief::leavesOut
