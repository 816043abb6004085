// The few operations that compiler vectors do not have (comparison to mask, square root, rounding, transposed loads and
// stores), once per instruction set. Everything above this file is written with these and + - * / on compiler vectors.
// Each function here gives the same bits in all four variants: that is what tests/lanes.cpp checks.
//
// This is the only place in the engine that knows an instruction set by name.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "lanes/width.h"

namespace relief::native {

typedef float FloatVector __attribute__((vector_size(4 * kLanes)));
typedef std::int32_t IntVector __attribute__((vector_size(4 * kLanes)));
typedef std::uint32_t UintVector __attribute__((vector_size(4 * kLanes)));
typedef double DoubleVector __attribute__((vector_size(4 * kLanes)));  // half of the lanes

}  // namespace relief::native

#if RELIEF_LANES == 16
#include "lanes/native_avx512.h"
#elif RELIEF_LANES == 8
#include "lanes/native_avx2.h"
#elif defined(__SSE2__) && !defined(RELIEF_PORTABLE)
#include "lanes/native_sse2.h"
#else
#include "lanes/native_portable.h"
#endif
