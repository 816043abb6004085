// Vectors of lanes: their components and swizzles, what they are made of, and what may stand beside one in an operator.
#include "relief/hlsl/vector.h"

#include <initializer_list>
#include <limits>
#include <type_traits>

#include <doctest/doctest.h>

#include "relief/hlsl/semantics.h"

using namespace relief;

namespace {

bool same(Mask a, Mask b)
{
    return a.bits() == b.bits();
}
template <class T>
bool same(T a, T b)
{
    return all(a == b);
}

// Whether a vector has these components in every lane, exactly.
template <class T, int n>
bool is(const LaneVector<T, n>& v, std::initializer_list<std::type_identity_t<T>> expected)
{
    bool equal = expected.size() == n;
    for (int i = 0; i < n; ++i) equal = equal && same(v[i], expected.begin()[i]);
    return equal;
}

const float2 kTwo(1, 2);
const float3 kThree(1, 2, 4);
const float4 kFour(1, 2, 4, 8);

}  // namespace

TEST_CASE("vector: components by name, by colour and by number")
{
    float4 v = kFour;
    CHECK((v.x[0] == 1 && v.y[0] == 2 && v.z[0] == 4 && v.w[0] == 8));
    CHECK((v.r[0] == 1 && v.g[0] == 2 && v.b[0] == 4 && v.a[0] == 8));
    v.g = 5.0f;
    v[3] = 6.0f;
    CHECK(is(v, {1, 5, 4, 6}));
    CHECK(sizeof(float4) == 4 * sizeof(Float));
    CHECK(is(float3(), {0, 0, 0}));
}

TEST_CASE("vector: swizzles of two to four letters")
{
    CHECK(is(kTwo.yx(), {2, 1}));
    CHECK(is(kTwo.xyxy(), {1, 2, 1, 2}));
    CHECK(is(kThree.zy(), {4, 2}));
    CHECK(is(kThree.zzx(), {4, 4, 1}));
    CHECK(is(kThree.xzyx(), {1, 4, 2, 1}));
    CHECK(is(kFour.wy(), {8, 2}));
    CHECK(is(kFour.yzw(), {2, 4, 8}));
    CHECK(is(kFour.wzyx(), {8, 4, 2, 1}));
    CHECK(is(kFour.ag(), {8, 2}));
    CHECK(is(kFour.rgb(), {1, 2, 4}));
    CHECK(is(kFour.bgra(), {4, 2, 1, 8}));
    CHECK(is(int3(1, 2, 3).zyx(), {3, 2, 1}));
    CHECK(is(bool2(true, false).yx(), {false, true}));
}

TEST_CASE("vector: made of one value, of parts, of a longer vector, of other components")
{
    const float3 fromInt = 7, fromFloat = Float(0.5f);
    CHECK(is(fromInt, {7, 7, 7}));
    CHECK(is(fromFloat, {0.5f, 0.5f, 0.5f}));
    CHECK(is(float3(kTwo, 3), {1, 2, 3}));
    CHECK(is(float3(3, kTwo), {3, 1, 2}));
    CHECK(is(float4(kTwo, 3, 4), {1, 2, 3, 4}));
    CHECK(is(float4(3, kTwo, 4), {3, 1, 2, 4}));
    CHECK(is(float4(3, 4, kTwo), {3, 4, 1, 2}));
    CHECK(is(float4(kTwo, kTwo), {1, 2, 1, 2}));
    CHECK(is(float4(kThree, 1), {1, 2, 4, 1}));
    CHECK(is(float4(1, kThree), {1, 1, 2, 4}));
    CHECK(is(float2(kFour), {1, 2}));
    CHECK(is(float3(kFour), {1, 2, 4}));
    CHECK(is(int3(float3(1.9f, -1.9f, 4)), {1, -1, 4}));
    CHECK(is(float3(int3(1, -2, 3)), {1, -2, 3}));
    CHECK(is(bool3(float3(0, -0.0f, 0.1f)), {false, false, true}));
    CHECK(is(float2(bool2(true, false)), {1, 0}));
    // A number is no part: float3(x, 1) is a mistake.
    static_assert(!std::is_constructible_v<float3, Float, float>);
    static_assert(!std::is_constructible_v<float4, Float, Float, float>);
    static_assert(!std::is_convertible_v<float2, float3>);
}

TEST_CASE("vector: a plain vector of GLM is one, alone and in arithmetic")
{
    const glm::vec3 plain(1, 2, 4);
    const float3 v = plain;
    CHECK(is(v, {1, 2, 4}));
    CHECK(is(kThree + plain, {2, 4, 8}));
    CHECK(is(plain - kThree, {0, 0, 0}));
    CHECK(is(kThree * plain, {1, 4, 16}));
    CHECK(is(plain / kThree, {1, 1, 1}));
    CHECK(is(plain * Float(2.0f), {2, 4, 8}));
    CHECK(is(Float(8.0f) / plain, {8, 4, 2}));
    CHECK(is(Float(1.0f) - glm::vec2(1, 2), {0, -1}));
    CHECK(is(glm::vec4(1, 2, 3, 4) + Float(1.0f), {2, 3, 4, 5}));
    CHECK(is(kThree < plain, {false, false, false}));
    float3 sum = kThree;
    sum += plain;
    CHECK(is(sum, {2, 4, 8}));
    // GLM's own arithmetic stays GLM's.
    static_assert(std::is_same_v<decltype(plain * 2.0f), glm::vec3>);
    static_assert(std::is_same_v<decltype(plain + plain), glm::vec3>);
}

TEST_CASE("vector: a field stands for its value, on either side")
{
    TEXCOORD<0, float3> normal;
    normal = kThree;
    TEXCOORD<1, Float> fog;
    fog = 2.0f;
    CHECK(is(normal * fog, {2, 4, 8}));
    CHECK(is(fog * normal, {2, 4, 8}));
    CHECK(is(kThree / fog, {0.5f, 1, 2}));
    CHECK(is(fog - kThree, {1, 0, -2}));
    CHECK(is(normal + normal, {2, 4, 8}));
    CHECK(is(normal * 0.5, {0.5f, 1, 2}));
    CHECK(is(1 - normal, {0, -1, -3}));
    CHECK(is(-normal, {-1, -2, -4}));
    CHECK(is(normal > 1, {false, true, true}));
    CHECK(is(float4(normal, fog), {1, 2, 4, 2}));
    normal *= fog;
    CHECK(is(normal, {2, 4, 8}));
    COLOR<0, float3> white;
    white = 1;
    CHECK(is(white, {1, 1, 1}));
}

TEST_CASE("vector: comparisons give a yes or no for each component")
{
    const float3 other(2, 2, 2);
    CHECK(is(kThree < other, {true, false, false}));
    CHECK(is(kThree <= other, {true, true, false}));
    CHECK(is(kThree > other, {false, false, true}));
    CHECK(is(kThree >= other, {false, true, true}));
    CHECK(is(kThree == other, {false, true, false}));
    CHECK(is(kThree != other, {true, false, true}));
    CHECK(is(!(kThree < 2), {false, true, true}));
    CHECK(is((kThree < 4) & (kThree > 1), {false, true, false}));
    CHECK(is((kThree < 2) | (kThree > 2), {true, false, true}));
}

TEST_CASE("vector: any and all of components are per pixel, of a mask they ask the block")
{
    const Mask odd = Mask::fromBits(0xaaaau);
    const bool3 mixed(odd, false, true);
    CHECK(all(any(mixed)));
    CHECK(none(all(mixed)));
    CHECK(all(bool2(odd, true)).bits() == odd.bits());
    CHECK(any(bool2(odd, false)).bits() == odd.bits());
    CHECK(all(any(float3(0, 0, 0.5f))));
    CHECK(none(all(float3(1, 0, 0.5f))));
}

TEST_CASE("vector: integers")
{
    const int3 v(1, -2, 12);
    CHECK(is(v + 1, {2, -1, 13}));
    CHECK(is(3 - v, {2, 5, -9}));
    CHECK(is(v * v, {1, 4, 144}));
    CHECK(is(v & 6, {0, 6, 4}));
    CHECK(is((v | 1) ^ 3, {2, -4, 14}));
    CHECK(is(-v, {-1, 2, -12}));
    CHECK(is(max(v, 0), {1, 0, 12}));
    CHECK(is(clamp(v, -1, 10), {1, -1, 10}));
    CHECK(is(abs(v), {1, 2, 12}));
    CHECK(is(sign(v), {1, -1, 1}));
    CHECK(is(v < 0, {false, true, false}));
    CHECK(is(select(v < 0, 0, v), {1, 0, 12}));
    CHECK(is(asfloat(asint(kThree)), {1, 2, 4}));
    int3 changing = v;
    CHECK(is(changing <<= int3(1, 2, 3), {2, -8, 96}));
    CHECK(is(changing %= 7, {2, -1, 5}));
    CHECK(is(changing ^= 3, {1, -4, 6}));
    CHECK(is(changing >>= 1, {0, -2, 3}));
}

TEST_CASE("vector: to integers as Direct3D converts, what does not fit becomes the nearest that does, and NaN 0")
{
    constexpr int kMost = std::numeric_limits<int>::max(), kLeast = std::numeric_limits<int>::min();
    const float infinity = std::numeric_limits<float>::infinity();
    CHECK(is(int3(float3(std::numeric_limits<float>::quiet_NaN(), 1e20f, -1e20f)), {0, kMost, kLeast}));
    CHECK(is(int3(float3(-std::numeric_limits<float>::quiet_NaN(), infinity, -infinity)), {0, kMost, kLeast}));
    CHECK(is(int3(float3(-2147483648.0f, 2147483648.0f, 2147483520.0f)), {kLeast, kMost, 2147483520}));
    CHECK(is(int3(float3(-2147483520.0f, 0.99f, -0.99f)), {-2147483520, 0, 0}));
}

TEST_CASE("vector: kComponents and component() of floats and integers, single and in vectors")
{
    static_assert(kComponents<Float> == 1 && kComponents<float3> == 3);
    static_assert(kComponents<Int> == 1 && kComponents<int4> == 4 && kComponents<FloatN<2>> == 2);
    int4 v(1, 2, 3, 4);
    component(v, 2) = Int(7);
    CHECK(is(v, {1, 2, 7, 4}));
    Int single = 1;
    component(single, 0) = Int(5);
    CHECK(all(single == 5));
}
