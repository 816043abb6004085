// The experiments, one file each: eNN_subject.cpp.
#pragma once

#include "experiment.h"

namespace relief::experiments {

Experiment zDecode(Effort effort);
Experiment bumpScale(Effort effort);
Experiment heightDerivatives(Effort effort);
Experiment bakedNormalMap(Effort effort);
Experiment normalizing(Effort effort);
Experiment normalBlends(Effort effort);
Experiment triplanarMethods(Effort effort);
Experiment triplanarWeights(Effort effort);
Experiment tangentFrames(Effort effort);
Experiment derivatives(Effort effort);
Experiment levelForms(Effort effort);
Experiment filters(Effort effort);
Experiment weightPrecision(Effort effort);
Experiment mipGeneration(Effort effort);
Experiment minifiedSpecular(Effort effort);
Experiment normalStorage(Effort effort);
Experiment spanPerspective(Effort effort);
Experiment attributeSetup(Effort effort);
Experiment reciprocal(Effort effort);
Experiment exponentials(Effort effort);
Experiment srgb(Effort effort);
Experiment lightingModels(Effort effort);
Experiment lights(Effort effort);
Experiment depth(Effort effort);
Experiment supersampling(Effort effort);
Experiment halfInterpolants(Effort effort);
Experiment tileSizes(Effort effort);
Experiment lanes(Effort effort);
Experiment threads(Effort effort);
Experiment leaveOut(Effort effort);
Experiment visibilityAndFresnel(Effort effort);
Experiment snapping(Effort effort);
Experiment litScene(Effort effort);
Experiment environments(Effort effort);
Experiment parallaxMethods(Effort effort);
Experiment shadowMaps(Effort effort);
Experiment deferredNormals(Effort effort);

// A number with so many digits after the point.
std::string number(double value, int digits);

}  // namespace relief::experiments
