// A floor under many lamps, lit in three ways: what a pass for each light costs beside one pass for all of them.
#pragma once

#include <memory>

#include "relief/pipeline/frame.h"

namespace relief::benchmarks {

enum class LightsBy
{
    passes,       // a base pass, and an additive pass for each piece of the floor and each lamp that reaches it
    loop,         // one pass, whose fragment program adds up all lamps
    skippingLoop  // the same, leaving out a lamp for a block of pixels of which it reaches none
};

// Records the floor: 8 x 8 pieces, each drawn by itself, under one sun and as many lamps. A lamp has the same range,
// however many there are, and some 16 pieces within it. What is returned must live until the frame has run.
std::shared_ptr<const void> recordManyLights(Frame& frame, int width, int height, int lamps, LightsBy by);

}  // namespace relief::benchmarks
