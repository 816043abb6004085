// What the engine's check says of a floating-point environment: ROUNDING is a mode of <cfenv>, CONTROL bits of MXCSR.
#include <cfenv>
#include <cstdio>

#include <xmmintrin.h>

#include "relief/lanes/environment.h"

int main()
{
#if defined(ROUNDING)
    std::fesetround(ROUNDING);
#elif defined(CONTROL)
    _mm_setcsr(_mm_getcsr() | CONTROL);
#endif
    const char* const problem = relief::floatingPointProblem();
    std::printf("%s\n", problem != nullptr ? problem : "nothing");
}
