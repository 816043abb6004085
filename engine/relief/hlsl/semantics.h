// Semantics: what the fields of a shader's structs mean. A field's type names its meaning and its value's type:
//
//     struct Interpolators { SV_POSITION position; TEXCOORD<0, float4> uv; TEXCOORD<1, float3> normal; };
//
// A field is used like its value. There is no list of fields to keep beside the struct: forEachField() walks a struct
// as it is written.
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

#include "relief/hlsl/types.h"

namespace relief::inline RELIEF_WIDTH {

// How a value gets from the vertices to a pixel: linear in space, linear on the screen, or the first vertex's.
// Centroid: linear in space, at a place that the triangle covers where it does not cover the pixel's centre.
enum class Interpolation
{
    perspective,
    affine,
    flat,
    centroid
};

// What the pipeline has to do with a value, beside carrying it.
enum class SystemValue
{
    none,
    position,      // takes it from the vertex program, and gives the pixel's
    id,            // counts it
    facing,        // gives it to the fragment program
    clipDistance,  // takes it from the vertex program, and carries it, too
    target,        // takes it from the fragment program, and so the next two
    depth,
    coverage
};

// Whether it travels from the vertices to the pixels, and is interpolated on the way.
constexpr bool isInterpolated(SystemValue value)
{
    return value == SystemValue::none || value == SystemValue::clipDistance;
}

// A value with a meaning. `Meaning` is the semantic's tag, `T` one of Float, float2, float3, float4, Int, int2 ...
// int4, Mask. A field that nobody assigns is 0.
template <class Meaning, class T>
struct Semantic : T
{
    using Value = T;
    static constexpr const char* kName = Meaning::kName;
    static constexpr int kIndex = Meaning::kIndex;
    static constexpr SystemValue kSystemValue = Meaning::kSystemValue;
    static constexpr bool kIsPosition = kSystemValue == SystemValue::position;
    static constexpr bool kIsInterpolated = isInterpolated(kSystemValue);
    static constexpr Interpolation kInterpolation = Meaning::kInterpolation;

    Semantic() : T{} {}
    template <class U>
    requires requires(const U& source, void (&take)(T)) { take(source); }
    Semantic(const U& source) : T(source) {}
};

namespace semantic {

struct Plain
{
    static constexpr int kIndex = 0;
    static constexpr SystemValue kSystemValue = SystemValue::none;
    static constexpr Interpolation kInterpolation = Interpolation::perspective;
};
struct SvVertexId : Plain
{
    static constexpr const char* kName = "SV_VertexID";
    static constexpr SystemValue kSystemValue = SystemValue::id;
};
struct SvInstanceId : Plain
{
    static constexpr const char* kName = "SV_InstanceID";
    static constexpr SystemValue kSystemValue = SystemValue::id;
};
struct SvPosition : Plain
{
    static constexpr const char* kName = "SV_POSITION";
    static constexpr SystemValue kSystemValue = SystemValue::position;
};
struct SvIsFrontFace : Plain
{
    static constexpr const char* kName = "SV_IsFrontFace";
    static constexpr SystemValue kSystemValue = SystemValue::facing;
};
template <int index>
struct SvClipDistance : Plain
{
    static constexpr const char* kName = "SV_ClipDistance";
    static constexpr int kIndex = index;
    static constexpr SystemValue kSystemValue = SystemValue::clipDistance;
};
template <int index>
struct SvTarget : Plain
{
    static constexpr const char* kName = "SV_Target";
    static constexpr int kIndex = index;
    static constexpr SystemValue kSystemValue = SystemValue::target;
};
struct SvDepth : Plain
{
    static constexpr const char* kName = "SV_Depth";
    static constexpr SystemValue kSystemValue = SystemValue::depth;
};
struct SvCoverage : Plain
{
    static constexpr const char* kName = "SV_Coverage";
    static constexpr SystemValue kSystemValue = SystemValue::coverage;
};
struct Position : Plain
{
    static constexpr const char* kName = "POSITION";
};
struct Normal : Plain
{
    static constexpr const char* kName = "NORMAL";
};
struct Tangent : Plain
{
    static constexpr const char* kName = "TANGENT";
};
template <int index>
struct Texcoord : Plain
{
    static constexpr const char* kName = "TEXCOORD";
    static constexpr int kIndex = index;
};
template <int index>
struct Color : Plain
{
    static constexpr const char* kName = "COLOR";
    static constexpr int kIndex = index;
};
template <class Meaning, Interpolation interpolation>
struct Interpolated : Meaning
{
    static constexpr Interpolation kInterpolation = interpolation;
};

template <class T, Interpolation interpolation>
struct With;
template <class Meaning, class T, Interpolation interpolation>
struct With<Semantic<Meaning, T>, interpolation>
{
    using Type = Semantic<Interpolated<Meaning, interpolation>, T>;
};

}  // namespace semantic

// What a vertex program takes.
using POSITION = Semantic<semantic::Position, float4>;
using NORMAL = Semantic<semantic::Normal, float3>;
using TANGENT = Semantic<semantic::Tangent, float4>;          // xyz, and the binormal's sign in w
using SV_VertexID = Semantic<semantic::SvVertexId, Int>;      // the vertex's number in its mesh
using SV_InstanceID = Semantic<semantic::SvInstanceId, Int>;  // the instance's number in its draw

// What it gives: clip space there; pixels in xy, depth in z and the interpolated w in the fragment program.
using SV_POSITION = Semantic<semantic::SvPosition, float4>;

// Signed distances to planes of the vertex program's own: what is below 0 (or NaN) is cut off. T: Float ... float4, at
// most 8 components in all.
template <int index, class T>
using SV_ClipDistance = Semantic<semantic::SvClipDistance<index>, T>;

// What a fragment program finds among its Interpolators without a vertex program giving it: whether the triangle's
// front is seen; everywhere for lines.
using SV_IsFrontFace = Semantic<semantic::SvIsFrontFace, Mask>;

// What a fragment program gives, as one float4 or as a struct of these: the colour for the target's n-th colour
// attachment (n = 0 ... 3); the depth that is tested and written instead of the triangle's, limited to 0 ... 1; which
// of the pixel's samples may be drawn, a bit each.
template <int index>
using SV_Target = Semantic<semantic::SvTarget<index>, float4>;
using SV_Depth = Semantic<semantic::SvDepth, Float>;
using SV_Coverage = Semantic<semantic::SvCoverage, Int>;

// Both: anything, of one to four components.
template <int index, class T>
using TEXCOORD = Semantic<semantic::Texcoord<index>, T>;
template <int index, class T>
using COLOR = Semantic<semantic::Color<index>, T>;

// HLSL's interpolation modifiers: linear on the screen instead of in space; the triangle's first vertex's value, which
// integers must have; where a pixel has several samples and the triangle does not cover its centre, the value at the
// first sample that it covers, which no other triangle's colour bleeds into. Differences between pixels (ddx) of the
// last kind are unreliable there, as everywhere.
template <class S>
using noperspective = typename semantic::With<S, Interpolation::affine>::Type;
template <class S>
using nointerpolation = typename semantic::With<S, Interpolation::flat>::Type;
template <class S>
using centroid = typename semantic::With<S, Interpolation::centroid>::Type;

template <class T>
inline constexpr int kComponents = 1;
template <class T, int size>
inline constexpr int kComponents<LaneVector<T, size>> = size;

template <class T>
concept IsSemantic = requires
{
    typename T::Value;
    T::kName;
    T::kIndex;
    T::kSystemValue;
}
&&std::is_base_of_v<typename T::Value, T>;

// Component i of a value of lanes.
inline Float& component(Float& v, int)
{
    return v;
}
inline Int& component(Int& v, int)
{
    return v;
}
template <class T, int size>
T& component(LaneVector<T, size>& v, int i)
{
    return v[i];
}

// A component as a word: what streams and interpolators hold, a float's bits or an integer's.
inline void setWord(Float& component, Float word)
{
    component = word;
}
inline void setWord(Int& component, Float word)
{
    component = asInt(word);
}
inline Float wordOf(Float component)
{
    return component;
}
inline Float wordOf(Int component)
{
    return asFloat(component);
}

// Whether a value's components are integers.
template <class T>
inline constexpr bool kIsInteger = std::is_same_v<decltype(component(std::declval<T&>(), 0)), Int&>;
template <>
inline constexpr bool kIsInteger<Mask> = false;

namespace detail {

struct AnySemantic
{
    template <IsSemantic T>
    operator T() const;
};

struct Anything
{
    template <class T>
    operator T() const;
};

template <std::size_t>
using Any = AnySemantic;

// Whether braces with one semantic for each i, and then `Rest`, make a T.
template <class T, class... Rest, std::size_t... i>
constexpr bool takes(std::index_sequence<i...>)
{
    return requires
    {
        T{Any<i>{}..., Rest{}...};
    };
}

// A stand-in for a base class of T.
template <class T>
struct AnyBaseOf
{
    template <class Base>
    requires(std::is_base_of_v<Base, T> && !std::is_same_v<Base, T>) operator Base() const;
};

// Whether field i of a T is an array: braces of two values then make it.
template <class T, std::size_t... i>
constexpr bool isArrayAfter(std::index_sequence<i...>)
{
    return requires
    {
        T{Any<i>{}..., {AnySemantic{}, AnySemantic{}}};
    };
}

template <class T, std::size_t... i>
constexpr bool hasArray(std::index_sequence<i...>)
{
    return (false || ... || isArrayAfter<T>(std::make_index_sequence<i>()));
}

}  // namespace detail

inline constexpr int kMaxFields = 12;

// The number of fields of a struct whose fields are all semantics (at most 12); -1 for anything else.
template <class T, int n = 0>
constexpr int fieldCount()
{
    if constexpr (!std::is_aggregate_v<T>) {
        return -1;
    } else {
        using Fields = std::make_index_sequence<static_cast<std::size_t>(n)>;
        constexpr bool more = detail::takes<T, detail::AnySemantic>(Fields{});
        if constexpr (more && n < kMaxFields) {
            return fieldCount<T, n + 1>();
        } else {
            constexpr bool otherField = detail::takes<T, detail::Anything>(Fields{});
            constexpr bool hasBase = requires
            {
                T{detail::AnyBaseOf<T>{}};
            };
            return otherField || more || hasBase || detail::hasArray<T>(Fields{}) ? -1 : n;
        }
    }
}

// Calls function(fields...) with all fields of a struct, in order, and returns what it returns.
template <class Struct, class Function>
constexpr decltype(auto) withFields(Struct& s, Function&& function)
{
    constexpr int n = fieldCount<std::remove_const_t<Struct>>();
    static_assert(n >= 0, "every field of a shader's struct must be a semantic such as TEXCOORD<0, float4>");
    // clang-format off
    if constexpr (n == 0) { return function(); }
    if constexpr (n == 1) { auto& [a] = s; return function(a); }
    if constexpr (n == 2) { auto& [a, b] = s; return function(a, b); }
    if constexpr (n == 3) { auto& [a, b, c] = s; return function(a, b, c); }
    if constexpr (n == 4) { auto& [a, b, c, d] = s; return function(a, b, c, d); }
    if constexpr (n == 5) { auto& [a, b, c, d, e] = s; return function(a, b, c, d, e); }
    if constexpr (n == 6) { auto& [a, b, c, d, e, f] = s; return function(a, b, c, d, e, f); }
    if constexpr (n == 7) { auto& [a, b, c, d, e, f, g] = s; return function(a, b, c, d, e, f, g); }
    if constexpr (n == 8) { auto& [a, b, c, d, e, f, g, h] = s; return function(a, b, c, d, e, f, g, h); }
    if constexpr (n == 9) { auto& [a, b, c, d, e, f, g, h, i] = s; return function(a, b, c, d, e, f, g, h, i); }
    if constexpr (n == 10) { auto& [a, b, c, d, e, f, g, h, i, j] = s; return function(a, b, c, d, e, f, g, h, i, j); }
    if constexpr (n == 11) { auto& [a, b, c, d, e, f, g, h, i, j, k] = s; return function(a, b, c, d, e, f, g, h, i, j, k); }
    if constexpr (n == 12) { auto& [a, b, c, d, e, f, g, h, i, j, k, l] = s; return function(a, b, c, d, e, f, g, h, i, j, k, l); }
    // clang-format on
}

// Calls function(field) for every field of a struct, in order.
template <class Struct, class Function>
constexpr void forEachField(Struct& s, Function&& function)
{
    withFields(s, [&function](auto&... field) { (function(field), ...); });
}

// The types of a struct's fields.
template <class... Field>
struct FieldList
{
};

namespace detail {

struct ListFields
{
    template <class... Field>
    FieldList<std::remove_cv_t<Field>...> operator()(Field&...) const;
};

}  // namespace detail

template <class Struct>
using FieldsOf = decltype(withFields(std::declval<Struct&>(), detail::ListFields{}));

// The components (floats) of a list of fields that are to be interpolated: all but SV_POSITION's and SV_IsFrontFace.
template <class... Field>
constexpr int interpolatedComponents(FieldList<Field...>)
{
    return (0 + ... + (Field::kIsInterpolated ? kComponents<typename Field::Value> : 0));
}

// The components of a list of fields that mean the same to the pipeline.
template <SystemValue meaning, class... Field>
constexpr int componentsWith(FieldList<Field...>)
{
    return (0 + ... + (Field::kSystemValue == meaning ? kComponents<typename Field::Value> : 0));
}

// A bit for each index that these fields have.
template <SystemValue meaning, class... Field>
constexpr unsigned indicesWith(FieldList<Field...>)
{
    return (0u | ... | (Field::kSystemValue == meaning ? 1u << Field::kIndex : 0u));
}

// Whether the fields mean nothing else.
template <SystemValue... meanings, class... Field>
constexpr bool meanOnly(FieldList<Field...>)
{
    constexpr auto isAllowed = [](SystemValue value) { return (false || ... || (value == meanings)); };
    return (true && ... && isAllowed(Field::kSystemValue));
}

template <class... Field>
constexpr bool usesCentroid(FieldList<Field...>)
{
    return (false || ... || (Field::kInterpolation == Interpolation::centroid));
}

// What a vertex program may give and a fragment program takes: semantics only, and one SV_POSITION among them.
template <class... Field>
constexpr int positionCount(FieldList<Field...>)
{
    return (0 + ... + (Field::kIsPosition ? 1 : 0));
}

namespace detail {

constexpr bool sameName(const char* a, const char* b)
{
    while (*a != '\0' && *a == *b) {
        ++a;
        ++b;
    }
    return *a == *b;
}

}  // namespace detail

// Whether a semantic with its index stands twice in a list of fields.
template <class... Field>
constexpr bool namesTwice(FieldList<Field...>)
{
    constexpr std::size_t count = sizeof...(Field);
    const char* const names[count + 1] = {Field::kName..., ""};
    const int indices[count + 1] = {Field::kIndex..., 0};
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            if (indices[i] == indices[k] && detail::sameName(names[i], names[k])) return true;
        }
    }
    return false;
}

// Whether every integer among the interpolators is nointerpolation.
template <class... Field>
constexpr bool integersAreFlat(FieldList<Field...>)
{
    return (true && ... && (!kIsInteger<typename Field::Value> || Field::kInterpolation == Interpolation::flat));
}

}  // namespace relief::inline RELIEF_WIDTH
