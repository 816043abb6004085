// What docs/machines.md counts the instructions of: operations of the lanes, each as a function of its own.
#include "relief/lanes/native.h"

using namespace relief;
using namespace relief::native;

extern "C" {

unsigned lane_signBits(IntVector a)
{
    return signBits(a);
}
bool lane_any(MaskVector a)
{
    return maskBits(a) != 0;
}
unsigned lane_negativeBits(DoubleVector low, DoubleVector high)
{
    return negativeBits(low, high);
}
void lane_load(const std::byte* const* address, IntVector* out)
{
    loadTransposed<FourWords>([address](int lane) { return address[lane]; }, out);
}
void lane_loadPair(const std::byte* const* address, IntVector* out)
{
    loadTransposed<TwoWords>([address](int lane) { return address[lane]; }, out);
}
void lane_store(const IntVector* in, std::byte* const* address)
{
    storeTransposed(in, [address](int lane) { return address[lane]; });
}
IntVector lane_multiplyAddHalves(IntVector a, IntVector b)
{
    return multiplyAddHalves(a, b);
}
FloatVector lane_maxOrNaN(FloatVector a, FloatVector b)
{
    return maxOrNaN(a, b);
}
FloatVector lane_toFloat(DoubleVector low, DoubleVector high)
{
    return toFloat(low, high);
}

}  // extern "C"
