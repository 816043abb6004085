// The floating-point environment that the results are defined in: round to nearest, subnormal numbers kept. A caller
// may have set something else (audio code likes to flush subnormals), and a thread inherits it: every thread that
// shades holds one of these while it does.
#pragma once

#if defined(__SSE2__)
#include <xmmintrin.h>
#else
#include <cfenv>
#endif

namespace relief {

class DefaultFloatingPoint
{
public:
    DefaultFloatingPoint(const DefaultFloatingPoint&) = delete;
    DefaultFloatingPoint& operator=(const DefaultFloatingPoint&) = delete;

#if defined(__SSE2__)
    DefaultFloatingPoint() : callers(_mm_getcsr())
    {
        _mm_setcsr(0x1f80u);
    }  // the value after reset: all masked, RNE
    ~DefaultFloatingPoint()
    {
        _mm_setcsr(callers);
    }

private:
    unsigned callers;
#elif defined(__wasm__)
    DefaultFloatingPoint() {}  // has one environment only, this one (and a body: no object is "unused")
#else
    DefaultFloatingPoint()
    {
        std::fegetenv(&callers);
        std::fesetenv(FE_DFL_ENV);
    }
    ~DefaultFloatingPoint()
    {
        std::fesetenv(&callers);
    }

private:
    std::fenv_t callers;
#endif
};

// What this thread computes otherwise than the results are defined: that it contracts products, does not round to
// nearest, takes subnormal numbers for 0, or compares NaN like a number. A few words; null: nothing. Of the flags that
// the engine was compiled with, and of the environment that the caller is in.
const char* floatingPointProblem();

}  // namespace relief
