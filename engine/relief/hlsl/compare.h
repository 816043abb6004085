// Comparisons that a state names: of depths, stencils and what a shadow map holds.
#pragma once

#include "relief/lanes/float.h"
#include "relief/lanes/int.h"

namespace relief {

enum class Compare
{
    never,
    less,
    equal,
    lessEqual,
    greater,
    notEqual,
    greaterEqual,
    always
};

inline namespace RELIEF_WIDTH {

// Lane by lane, of floats or integers.
template <class T>
Mask compareBy(Compare compare, T a, T b)
{
    switch (compare) {
        case Compare::never:
            return Mask(false);
        case Compare::less:
            return a < b;
        case Compare::equal:
            return a == b;
        case Compare::lessEqual:
            return a <= b;
        case Compare::greater:
            return a > b;
        case Compare::notEqual:
            return a != b;
        case Compare::greaterEqual:
            return a >= b;
        case Compare::always:
            break;
    }
    return Mask(true);
}

}  // namespace RELIEF_WIDTH

}  // namespace relief
