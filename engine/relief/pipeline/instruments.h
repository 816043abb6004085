// Instruments: what one may want to know about a frame beside its picture. They are clients of the pipeline; nothing in
// it knows of them but for Frame::Storage::poison.
#pragma once

#include <string>

#include "relief/pipeline/frame.h"

namespace relief::inline RELIEF_WIDTH {

// How many components (words) a draw interpolates, and what its vertex program hands on, as the table that Direct3D's
// compiler prints (hlsl/signature.h). Draws are counted from 0 to frame.drawCount() - 1; an error for others.
Expected<int> componentCount(const Frame& frame, int draw);
Expected<std::string> outputSignature(const Frame& frame, int draw);

// Whether any pixel of the frame, drawn onto what the target holds now, depends on an interpolated component: draws it
// as it is, and with NaN in the component at every vertex. The target holds the same afterwards as before. A frame that
// does not clear all that it keeps has to be asked before it runs, or it is drawn onto itself. An error for a draw or a
// component that is not there.
Expected<bool> dependsOn(Frame& frame, int draw, int component);

// What a draw asks for: its mesh's name; what it may write of the frame's target, a bit for each SV_Target<n>, depth
// and stencil; whether it tests a stencil that the target has; and whether its fragment program runs, which it does not
// where no colour is kept and it decides nothing. An error for a draw that is not there.
struct DrawFacts
{
    std::string mesh;
    unsigned colors;
    bool depth, stencil, testsStencil, program;
};
Expected<DrawFacts> factsOf(const Frame& frame, int draw);

// What one draw adds to the frame's statistics: the draws up to it are drawn onto what the target holds now, with it
// and without it. As with dependsOn, the target holds the same afterwards, and a frame that does not clear has to be
// asked before it runs.
Expected<Statistics> statisticsOf(Frame& frame, int draw);

// What the frame's fragment programs cost by themselves: runs each of them on `blocks` blocks in all, on the inputs of
// one block in every tile, without raster, depth test, blending and memory; the interpolation of what they read is
// theirs. After run(); nothing happens where there is nothing to draw. Returns a sum of the results.
float shadeAlone(const Frame& frame, std::uint64_t blocks);

}  // namespace relief::inline RELIEF_WIDTH
