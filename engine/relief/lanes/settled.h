// For functions that hold a DefaultFloatingPoint (environment.h) and return floats: compilers do not know that
// arithmetic depends on the environment, and may finish it when the caller's is back.
#pragma once

namespace relief {

// The value, worked out by now.
template <class T>
inline T settled(T value)
{
    asm volatile("" : "+m"(value));
    return value;
}

}  // namespace relief
