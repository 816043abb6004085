// Structs of semantics: how their fields are counted, listed and walked, and what counts as none.
#include "relief/hlsl/semantics.h"

#include "relief/hlsl/intrinsics.h"

#include <cstddef>
#include <cstring>
#include <new>
#include <string>
#include <type_traits>

#include <doctest/doctest.h>

using namespace relief;

namespace {

struct Nothing
{
};

struct One
{
    SV_POSITION position;
};

struct Interpolators
{
    SV_POSITION position;
    TEXCOORD<0, float4> uv;
    TEXCOORD<1, float3> normal;
    TEXCOORD<2, Float> fade;
    noperspective<TEXCOORD<3, float2>> screenUv;
    COLOR<1, float4> color;
};

struct Twelve
{
    SV_POSITION position;
    TEXCOORD<0, Float> a;
    TEXCOORD<1, Float> b;
    TEXCOORD<2, Float> c;
    TEXCOORD<3, Float> d;
    TEXCOORD<4, Float> e;
    TEXCOORD<5, Float> f;
    TEXCOORD<6, Float> g;
    TEXCOORD<7, Float> h;
    TEXCOORD<8, Float> i;
    TEXCOORD<9, Float> j;
    TEXCOORD<10, Float> k;
};

// Name and index of every field, in the order of forEachField.
template <class Struct>
std::string names()
{
    std::string text;
    Struct s;
    forEachField(s,
                 [&]<class Field>(Field&) { text += std::string(Field::kName) + std::to_string(Field::kIndex) + " "; });
    return text;
}

}  // namespace

TEST_CASE("semantics: fieldCount of structs of semantics")
{
    CHECK(fieldCount<Nothing>() == 0);
    CHECK(fieldCount<One>() == 1);
    CHECK(fieldCount<Interpolators>() == 6);
    CHECK(fieldCount<Twelve>() == 12);
}

TEST_CASE("semantics: more than twelve fields are too many")
{
    struct Thirteen
    {
        SV_POSITION position;
        TEXCOORD<0, Float> a, b, c, d, e, f, g, h, i, j, k, l;
    };
    CHECK(fieldCount<Thirteen>() == -1);
}

TEST_CASE("semantics: a plain number among the fields, wherever it is, makes fieldCount -1")
{
    struct First
    {
        float number;
        SV_POSITION position;
        TEXCOORD<0, float2> uv;
    };
    struct Middle
    {
        SV_POSITION position;
        float number;
        TEXCOORD<0, float2> uv;
    };
    struct Last
    {
        SV_POSITION position;
        TEXCOORD<0, float2> uv;
        float number;
    };
    struct Alone
    {
        int number;
    };
    CHECK(fieldCount<First>() == -1);
    CHECK(fieldCount<Middle>() == -1);
    CHECK(fieldCount<Last>() == -1);
    CHECK(fieldCount<Alone>() == -1);
}

TEST_CASE("semantics: a value of lanes without a meaning among the fields makes fieldCount -1")
{
    struct WithFloat
    {
        SV_POSITION position;
        Float number;
    };
    struct WithVector
    {
        float3 normal;
        SV_POSITION position;
    };
    struct WithMask
    {
        SV_POSITION position;
        Mask mask;
    };
    CHECK(fieldCount<WithFloat>() == -1);
    CHECK(fieldCount<WithVector>() == -1);
    CHECK(fieldCount<WithMask>() == -1);
}

TEST_CASE("semantics: pointers, strings and references among the fields make fieldCount -1")
{
    struct WithPointer
    {
        SV_POSITION position;
        const float* numbers;
    };
    struct WithString
    {
        std::string name;
        SV_POSITION position;
    };
    CHECK(fieldCount<WithPointer>() == -1);
    CHECK(fieldCount<WithString>() == -1);
}

TEST_CASE("semantics: what is no plain struct has fieldCount -1")
{
    struct WithConstructor
    {
        WithConstructor() {}
        SV_POSITION position;
    };
    class Private
    {
        [[maybe_unused]] SV_POSITION position;
    };
    CHECK(fieldCount<WithConstructor>() == -1);
    CHECK(fieldCount<Private>() == -1);
    CHECK(fieldCount<float>() == -1);
    CHECK(fieldCount<Float>() == -1);
    CHECK(fieldCount<float4>() == -1);
    CHECK(fieldCount<SV_POSITION>() == -1);
}

TEST_CASE("semantics: forEachField goes through the fields as they are written")
{
    CHECK(names<Nothing>() == "");
    CHECK(names<Interpolators>() == "SV_POSITION0 TEXCOORD0 TEXCOORD1 TEXCOORD2 TEXCOORD3 COLOR1 ");
    CHECK(names<Twelve>() ==
          "SV_POSITION0 TEXCOORD0 TEXCOORD1 TEXCOORD2 TEXCOORD3 TEXCOORD4 TEXCOORD5 TEXCOORD6 "
          "TEXCOORD7 TEXCOORD8 TEXCOORD9 TEXCOORD10 ");
}

TEST_CASE("semantics: forEachField gives the fields themselves")
{
    Interpolators i;
    float next = 0.0f;
    forEachField(i, [&]<class Field>(Field& field) {
        auto& value = static_cast<typename Field::Value&>(field);
        for (int c = 0; c < kComponents<typename Field::Value>; ++c) component(value, c) = next++;
    });
    CHECK(next == 18.0f);
    CHECK(i.position.w[0] == 3.0f);
    CHECK(i.uv.x[kLanes - 1] == 4.0f);
    CHECK(i.normal.z[0] == 10.0f);
    CHECK(static_cast<Float&>(i.fade)[0] == 11.0f);
    CHECK(i.screenUv.y[0] == 13.0f);
    CHECK(i.color.w[0] == 17.0f);
}

TEST_CASE("semantics: withFields hands over all fields at once")
{
    One one;
    Twelve twelve;
    const auto number = [](auto&... field) { return static_cast<int>(sizeof...(field)); };
    CHECK(withFields(one, number) == 1);
    CHECK(withFields(twelve, number) == 12);
    const void* address = withFields(one, [](auto& field) -> const void* { return &field; });
    CHECK(address == &one.position);
}

TEST_CASE("semantics: FieldsOf lists the types")
{
    static_assert(std::is_same_v<FieldsOf<Nothing>, FieldList<>>);
    static_assert(std::is_same_v<FieldsOf<One>, FieldList<SV_POSITION>>);
    using Expected = FieldList<SV_POSITION, TEXCOORD<0, float4>, TEXCOORD<1, float3>, TEXCOORD<2, Float>,
                               noperspective<TEXCOORD<3, float2>>, COLOR<1, float4>>;
    static_assert(std::is_same_v<FieldsOf<Interpolators>, Expected>);
    static_assert(std::is_same_v<FieldsOf<const One>, FieldList<SV_POSITION>>);
    CHECK(true);
}

TEST_CASE("semantics: interpolatedComponents leaves the position out")
{
    CHECK(interpolatedComponents(FieldsOf<Nothing>{}) == 0);
    CHECK(interpolatedComponents(FieldsOf<One>{}) == 0);
    CHECK(interpolatedComponents(FieldsOf<Interpolators>{}) == 4 + 3 + 1 + 2 + 4);
    CHECK(interpolatedComponents(FieldsOf<Twelve>{}) == 11);
}

TEST_CASE("semantics: positionCount")
{
    struct Two
    {
        SV_POSITION a;
        TEXCOORD<0, float2> uv;
        SV_POSITION b;
    };
    CHECK(positionCount(FieldsOf<Nothing>{}) == 0);
    CHECK(positionCount(FieldsOf<Interpolators>{}) == 1);
    CHECK(positionCount(FieldsOf<Two>{}) == 2);
}

TEST_CASE("semantics: a mesh's POSITION is not SV_POSITION")
{
    CHECK_FALSE(POSITION::kIsPosition);
    CHECK(SV_POSITION::kIsPosition);
    CHECK(std::string(POSITION::kName) == "POSITION");
}

TEST_CASE("semantics: noperspective changes the interpolation alone")
{
    using Plain = TEXCOORD<5, float3>;
    using Affine = noperspective<Plain>;
    CHECK(Plain::kInterpolation == Interpolation::perspective);
    CHECK(Affine::kInterpolation == Interpolation::affine);
    CHECK(std::string(Affine::kName) == "TEXCOORD");
    CHECK(Affine::kIndex == 5);
    CHECK_FALSE(Affine::kIsPosition);
    static_assert(std::is_same_v<Affine::Value, float3>);
    static_assert(IsSemantic<Affine>);
}

TEST_CASE("semantics: a field is used like its value")
{
    Interpolators i;
    i.normal = float3(1.0f, 2.0f, 3.0f);
    i.uv = float4(0.5f);
    i.fade = 0.25f;
    const float3 sum = i.normal + i.normal;
    CHECK(sum.z[0] == 6.0f);
    CHECK((i.normal * 2.0f).y[0] == 4.0f);
    CHECK((i.fade * 2.0f)[0] == 0.5f);
    CHECK(i.normal.zyx().x[0] == 3.0f);
    CHECK(i.uv.xy().y[kLanes - 1] == 0.5f);
}

TEST_CASE("semantics: a field in an intrinsic function is its value, where GLM has a function of that name too")
{
    Interpolators i;
    i.normal = float3(-3.0f, 0.0f, 4.0f);
    i.fade = -0.25f;
    CHECK(abs(i.normal).x[0] == 3.0f);
    CHECK(sign(i.normal).x[0] == -1.0f);
    CHECK(length(i.normal)[0] == 5.0f);
    CHECK(dot(i.normal, i.normal)[0] == 25.0f);
    CHECK(min(i.normal, i.normal).z[0] == 4.0f);
    CHECK(max(i.normal, i.normal).z[0] == 4.0f);
    CHECK(abs(i.fade)[0] == 0.25f);
    CHECK(max(i.fade, i.fade)[0] == -0.25f);
    static_assert(std::is_same_v<decltype(abs(i.normal)), float3>);
}

TEST_CASE("semantics: one semantic is made from another of the same value")
{
    const NORMAL normal = float3(1.0f, 2.0f, 3.0f);
    const TEXCOORD<1, float3> carried = normal;
    CHECK(carried.y[0] == 2.0f);
    static_assert(!std::is_convertible_v<float2, TEXCOORD<1, float3>>);
    static_assert(!std::is_convertible_v<NORMAL, TEXCOORD<1, float4>>);
    static_assert(!std::is_convertible_v<float2, TEXCOORD<1, Float>>);
}

TEST_CASE("semantics: a longer vector is cut off, as in HLSL")
{
    const TEXCOORD<0, float2> uv = float4(1.0f, 2.0f, 3.0f, 4.0f);
    CHECK(uv.x[0] == 1.0f);
    CHECK(uv.y[0] == 2.0f);
}

TEST_CASE("semantics: a field that nobody assigns is 0, whatever lay in its memory")
{
    // The compiler knows nothing of the memory, neither before nor after.
    alignas(Interpolators) std::byte memory[sizeof(Interpolators)];
    std::memset(memory, 0x41, sizeof memory);
    asm volatile("" : : "r"(memory) : "memory");
    Interpolators* const made = new (memory) Interpolators;
    asm volatile("" : : "r"(memory) : "memory");
    int notZero = 0;
    forEachField(*made, [&]<class Field>(Field& field) {
        for (int c = 0; c < kComponents<typename Field::Value>; ++c)
            notZero += any(asInt(component(static_cast<typename Field::Value&>(field), c)) != 0);
    });
    CHECK(notZero == 0);
}
