// Number: a plain number, which becomes a Float or an Int of all lanes where it stands beside one.
#pragma once

#include "relief/lanes/width.h"

namespace relief::inline RELIEF_WIDTH {

// As std::is_arithmetic. That walks through lists of types, which a compiler that reads precompiled headers loads again
// for every file; and each operator on lanes asks.
template <class N>
concept Number = !__is_class(N) && !__is_enum(N) && !__is_union(N) && requires(N n)
{
    n* n;
    static_cast<bool>(n);
};

// A number without a fraction.
template <class N>
concept WholeNumber = Number<N> && requires(N n)
{
    n % n;
};

}  // namespace relief::inline RELIEF_WIDTH
