// Which pixels of the block that this thread is shading count: the quads with a covered pixel, whole. Values exist in
// the other lanes too, but nothing depends on them, so a texture fetch need not follow them to far mip levels.
#pragma once

#include "lanes/mask.h"

namespace relief {

inline constinit thread_local unsigned activeLanes = kAllLanes;

}  // namespace relief
