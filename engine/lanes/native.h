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
typedef std::uint16_t HalfVector __attribute__((vector_size(4 * kLanes)));  // two in each lane
typedef double DoubleVector __attribute__((vector_size(4 * kLanes)));       // half of the lanes

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

namespace relief::native {

// Calls visit.operator()<quad>() for every quad of a block.
template <class Visit>
[[gnu::always_inline]] inline void forEachQuad(const Visit& visit)
{
    visit.template operator()<0>();
    if constexpr (kLanes > 4) visit.template operator()<1>();
    if constexpr (kLanes > 8) {
        visit.template operator()<2>();
        visit.template operator()<3>();
    }
}

// out[k] lane i = the k-th 32-bit word at address(i). Words is FourWords or TwoWords: 16 or 8 bytes are read per lane.
template <class Words, class Address>
[[gnu::always_inline]] inline void loadTransposed(const Address& address, IntVector* out)
{
    Words words;
    forEachQuad([&]<int quad>() __attribute__((always_inline)) {
        words.template add<quad>(address(4 * quad), address(4 * quad + 1), address(4 * quad + 2),
                                 address(4 * quad + 3));
    });
    words.transposed(out);
}

// From two addresses per lane, lane by lane: what both are made of, such as an index, is then read only once.
template <class Words, class Address, class OtherAddress>
[[gnu::always_inline]] inline void loadTransposed(const Address& address, const OtherAddress& other, IntVector* out,
                                                  IntVector* otherOut)
{
    Words words, otherWords;
    forEachQuad([&]<int quad>() __attribute__((always_inline)) {
        constexpr int a = 4 * quad, b = a + 1, c = a + 2, d = a + 3;
        words.template add<quad>(address(a), address(b), address(c), address(d));
        otherWords.template add<quad>(other(a), other(b), other(c), other(d));
    });
    words.transposed(out);
    otherWords.transposed(otherOut);
}

inline void loadTransposed(const std::byte* const* address, IntVector out[4])
{
    loadTransposed<FourWords>([address](int lane) { return address[lane]; }, out);
}
inline void loadTransposedPair(const std::byte* const* address, IntVector out[2])
{
    loadTransposed<TwoWords>([address](int lane) { return address[lane]; }, out);
}

}  // namespace relief::native
