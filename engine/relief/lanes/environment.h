// The floating-point environment that the results are defined in: round to nearest, subnormal numbers kept. A caller
// may have set something else (audio code likes to flush subnormals), and a thread inherits it: every thread that
// shades holds one of these while it does.
#pragma once

#include <cstdint>

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
    DefaultFloatingPoint() = default;  // has one environment only, this one
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

}  // namespace relief
