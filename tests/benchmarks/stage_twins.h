// Stages as Mesa draws them: their programs in GLSL, formula by formula, with the meshes, matrices, textures and
// properties that their draw functions get.
#pragma once

#include "twins.h"

namespace relief::benchmarks {

Expected<MesaDrawing> litScene(Mesa& mesa, const SceneData& data);           // 1.25
Expected<MesaDrawing> twoLights(Mesa& mesa, const SceneData& data);          // 2.06
Expected<MesaDrawing> reorientedNormals(Mesa& mesa, const SceneData& data);  // 4.07

}  // namespace relief::benchmarks
