#include "relief/lanes/environment.h"

#include <limits>

#include "relief/lanes/float.h"

namespace relief {

namespace {

// What the compiler must not work out itself.
float opaque(float number)
{
    volatile float memory = number;
    return memory;
}

}  // namespace

const char* floatingPointProblem()
{
    constexpr float ulp = std::numeric_limits<float>::epsilon(), smallest = std::numeric_limits<float>::min();
    const float one = opaque(1.0f), next = opaque(1.0f + ulp);

    // Half an ulp is a tie, which goes to the even number; more than half goes up, below zero down.
    if (one + opaque(0.5f * ulp) != one || one + opaque(0.75f * ulp) != next || -one - opaque(0.75f * ulp) != -next) {
        return "sums are not rounded to nearest";
    }
    // (1 + u)^2 - 1 - 2u is 0 where the product is rounded, u^2 where it is not.
    if (next * next - (one + 2.0f * opaque(ulp)) != 0.0f) return "products are contracted into fused multiply-adds";
    if (opaque(smallest) * opaque(0.5f) == 0.0f || opaque(0.5f * smallest) + opaque(0.5f * smallest) != smallest) {
        return "subnormal numbers are taken for 0";
    }
    const float nan = opaque(std::numeric_limits<float>::quiet_NaN());
    if (nan == nan || !(nan != nan) || one < nan) return "NaN compares like a number";
    // The same of lanes, which have instructions of their own.
    if (min(Float(nan), Float(one))[0] != one || min(Float(one), Float(nan))[0] != one) {
        return "the lanes' minimum of NaN and a number is not the number";
    }
    if (roundToInt(Float(opaque(2.5f)))[0] != 2 || roundToInt(Float(opaque(3.5f)))[0] != 4) {
        return "lanes are not rounded to nearest";
    }
    return nullptr;
}

}  // namespace relief
