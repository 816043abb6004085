// What drawing a stage took, as counted while it ran. Behind `explain` and `report leave-out`.
#pragma once

#include "prepare.h"

namespace relief::samples {

struct Usage
{
    Statistics statistics;

    // Components (floats) that the stage's draws interpolate, and those that some pixel depends on: found by drawing
    // the picture again with one component after the other replaced by NaN.
    int componentsDeclared = 0, componentsUsed = 0;

    // Mip levels that exist in memory and that would, if every texture had its whole chain: of the stage's inputs and
    // of the textures that it made.
    int levelsBuilt = 0, levelsWhole = 0;

    // Passes before the picture, in order.
    std::vector<SceneLog::Pass> before;

    // Additive passes that were not drawn, because their light does not reach the object.
    int passesLeftOut = 0;
};

// What the passes point to is the stage's, and lives until it is recorded again.
Expected<Usage> usageOf(const PreparedStage& stage, Size size, int threads);

}  // namespace relief::samples
