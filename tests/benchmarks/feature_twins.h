// The scenes of feature_scenes.h as Mesa draws them. Beside each: which of 1920 x 1080 pixels differ by more than 1/255
// (Mesa 22.3.6). The test's bound is that of all scenes: one in a thousand, and coverage at edges alone.
#pragma once

#include "twins.h"

namespace relief::benchmarks {

// The scene `multisampled`. llvmpipe's four samples lie where Direct3D's do (sample_pattern.h), and both store the mean
// of 8-bit linear colours. 29 pixels: 24 have a sample within 1/256 of a pixel of an edge, the others differ by 3/255
// at most.
Expected<MesaDrawing> sunlit(Mesa& mesa, const SceneData& data);

// 6 pixels: the comparison with a texel of the map, at a shadow's edge, has another result, or where a cube meets the
// floor the depth test has.
Expected<MesaDrawing> shadowed(Mesa& mesa, const SceneData& data);

// 79 pixels, all of them by 28/255 or less, and most by 2/255. Bumps turn neighbouring pixels' directions away from
// each other, and with them what rounding does to a direction and to the level of detail; of a smooth sphere it is 1
// pixel.
Expected<MesaDrawing> reflecting(Mesa& mesa, const SceneData& data);

// 228 pixels, 227 of them by 3/255 or less: the normal's 8-bit code is the next one, and the highlight shows that. One
// is where a cube meets the floor, as above.
Expected<MesaDrawing> deferred(Mesa& mesa, const SceneData& data);

}  // namespace relief::benchmarks
