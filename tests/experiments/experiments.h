// The experiments, one file each: eNN_subject.cpp.
#pragma once

#include "experiment.h"

namespace relief::experiments {

Experiment zDecode(Effort effort);
Experiment triplanarMethods(Effort effort);
Experiment triplanarWeights(Effort effort);
Experiment tangentFrames(Effort effort);
Experiment reciprocal(Effort effort);
Experiment exponentials(Effort effort);
Experiment srgb(Effort effort);
Experiment lights(Effort effort);
Experiment depth(Effort effort);
Experiment tileSizes(Effort effort);
Experiment lanes(Effort effort);
Experiment threads(Effort effort);
Experiment snapping(Effort effort);

// A number with so many digits after the point.
std::string number(double value, int digits);

}  // namespace relief::experiments
