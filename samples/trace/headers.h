// What a traced stage's file includes, precompiled (samples/live/CMakeLists.txt): what instrumented sources call stands
// before all of them.
#pragma once

#include "relief/trace/see.h"

#include "live/headers.h"
