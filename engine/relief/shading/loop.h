// Loops whose lanes end at different times: HLSL's `while (condition)` in a shader, where each pixel goes on for
// itself.
#pragma once

#include "relief/lanes/mask.h"
#include "relief/texture/shading_scope.h"

namespace relief::inline RELIEF_WIDTH {

// Calls body() as long as any pixel of the block is running. The body clears the lanes of `running` that are done, and
// changes nothing of those that are not running: h = select(running, h + step, h).
//
//     Mask running = true;
//     whileAny(running, [&] {
//         height = select(running, height - step, height);
//         running &= tex2Dgrad(heights, uv + offset * height, dx, dy).x < height;
//     });
//
// Pixels outside of what is drawn, which are there to fill up a block, do not keep it going; those that a quad needs
// for its derivatives do. Derivatives are to be taken before the loop (tex2Dgrad, tex2Dlod within): the pixels of a
// quad end at different times, and a difference between two steps means nothing.
template <class Body>
void whileAny(Mask& running, const Body& body)
{
    for (running &= Mask::fromBits(shading.activeLanes); any(running);) body();
}

}  // namespace relief::inline RELIEF_WIDTH
