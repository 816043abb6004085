// What instrumented sources call (samples/trace/instrument.h). Nothing else includes this.
#pragma once

#include <concepts>

#include "relief/hlsl/derivatives.h"
#include "relief/trace/events.h"

namespace relief::inline RELIEF_WIDTH::trace {

// What a source calls for the fields of a struct: fields("dir", light.dir).
class Fields;

namespace detail {

inline Float bitsOf(Float value)
{
    return value;
}
inline Float bitsOf(Int value)
{
    return asFloat(value);
}
inline Float bitsOf(Mask value)
{
    return asFloat(select(value, Int(1), Int(0)));
}

template <class T>
inline constexpr ValueKind kKind = std::is_same_v<T, Float> ? ValueKind::number
                                   : std::is_same_v<T, Int> ? ValueKind::integer
                                                            : ValueKind::truth;

template <class T>
void tellLanes(const Site& site, const std::string& field, const T& value)
{
    const Float bits = bitsOf(value);
    listener->value(site, field, {kKind<T>, 1, 1, &bits});
}

// What is derived from these, too: a semantic is a value.
template <class T, int n>
void tellColumns(const Site& site, const std::string& field, const LaneVector<T, n>& value)
{
    Float bits[4];
    for (int c = 0; c < n; ++c) bits[c] = bitsOf(value[c]);
    listener->value(site, field, {kKind<T>, n, 1, bits});
}
template <int n>
void tellColumns(const Site& site, const std::string& field, const LaneMatrix<n>& value)
{
    Float bits[16];
    for (int c = 0; c < n; ++c) {
        for (int r = 0; r < n; ++r) bits[c * n + r] = value[c][r];
    }
    listener->value(site, field, {ValueKind::number, n, n, bits});
}

template <class T>
void tell(const Site& site, const std::string& field, const T& value);

}  // namespace detail

class Fields
{
public:
    Fields(const Site& ofSite, const std::string& ofField) : site(ofSite), field(ofField) {}

    template <class T>
    void operator()(const char* name, const T& value) const
    {
        detail::tell(site, field + "." + name, value);
    }

private:
    const Site& site;
    const std::string& field;
};

// A value whose kind nobody knows is not told: a mesh, a lambda.
template <class T>
void detail::tell(const Site& site, const std::string& field, const T& value)
{
    if constexpr (std::is_same_v<T, bool>) {
        tellLanes(site, field, Mask(value));
    } else if constexpr (std::is_integral_v<T> || std::is_enum_v<T>) {
        tellLanes(site, field, Int(static_cast<std::int32_t>(value)));
    } else if constexpr (std::is_floating_point_v<T>) {
        tellLanes(site, field, Float(static_cast<float>(value)));
    } else if constexpr (std::derived_from<T, Float>) {
        tellLanes(site, field, static_cast<const Float&>(value));
    } else if constexpr (std::derived_from<T, Int>) {
        tellLanes(site, field, static_cast<const Int&>(value));
    } else if constexpr (std::derived_from<T, Mask>) {
        tellLanes(site, field, static_cast<const Mask&>(value));
    } else if constexpr (requires { tellColumns(site, field, value); }) {
        tellColumns(site, field, value);
    } else if constexpr (requires(const Fields& fields) { seeFields(fields, value); }) {
        seeFields(Fields(site, field), value);
    }
}

template <class T>
void see(const Site& site, const T& value)
{
    if (listener != nullptr) [[unlikely]]
        detail::tell(site, "", value);
}

// What a return statement gives.
template <class T>
T&& returned(const Site& site, T&& value)
{
    see(site, value);
    return static_cast<T&&>(value);
}

// A function's run, from its first line to its return.
class Call
{
public:
    explicit Call(const Site& site)
    {
        if (listener != nullptr) [[unlikely]] {
            listener->enter(site);
            told = true;
        }
    }
    ~Call()
    {
        if (told) listener->leave();
    }
    Call(const Call&) = delete;
    Call& operator=(const Call&) = delete;

private:
    bool told = false;
};

// --- textures, under the names that the sources call ---

namespace detail {

inline TextureCall callOf(TextureFunction function, const sampler2D& s, const float2& uv, const float2& dx,
                          const float2& dy, Float extra, unsigned lanes, const float4& result)
{
    return {function,           &s,    nullptr, nullptr, nullptr, {uv.x, uv.y, 0.0f}, {dx.x, dx.y, 0.0f},
            {dy.x, dy.y, 0.0f}, extra, lanes,   result};
}

inline TextureCall callOf(TextureFunction function, const samplerCUBE& s, const float3& d, const float3& dx,
                          const float3& dy, Float extra, const float4& result)
{
    return {function,           nullptr, nullptr,   nullptr, &s, {d.x, d.y, d.z}, {dx.x, dx.y, dx.z},
            {dy.x, dy.y, dy.z}, extra,   kAllLanes, result};
}

}  // namespace detail

inline float4 tex2D(const Site& site, const sampler2D& s, const float2& uv)
{
    const float4 result = relief::tex2D(s, uv);
    if (listener != nullptr)
        listener->sample(
            site, detail::callOf(TextureFunction::tex2D, s, uv, ddx(uv), ddy(uv), Float(0.0f), kAllLanes, result));
    return result;
}

inline float4 tex2DWhere(const Site& site, Mask needed, const sampler2D& s, const float2& uv)
{
    const float4 result = relief::tex2DWhere(needed, s, uv);
    if (listener != nullptr)
        listener->sample(site, detail::callOf(TextureFunction::tex2DWhere, s, uv, ddx(uv), ddy(uv), Float(0.0f),
                                              needed.bits(), result));
    return result;
}

inline float4 tex2Dgrad(const Site& site, const sampler2D& s, const float2& uv, const float2& dx, const float2& dy)
{
    const float4 result = relief::tex2Dgrad(s, uv, dx, dy);
    if (listener != nullptr)
        listener->sample(site,
                         detail::callOf(TextureFunction::tex2Dgrad, s, uv, dx, dy, Float(0.0f), kAllLanes, result));
    return result;
}

inline float4 tex2Dlod(const Site& site, const sampler2D& s, const float4& uvLod)
{
    const float4 result = relief::tex2Dlod(s, uvLod);
    const float2 none(0.0f);
    if (listener != nullptr)
        listener->sample(
            site, detail::callOf(TextureFunction::tex2Dlod, s, uvLod.xy(), none, none, uvLod.w, kAllLanes, result));
    return result;
}

inline float4 tex2Dbias(const Site& site, const sampler2D& s, const float4& uvBias)
{
    const float4 result = relief::tex2Dbias(s, uvBias);
    const float2 uv = uvBias.xy();
    if (listener != nullptr)
        listener->sample(
            site, detail::callOf(TextureFunction::tex2Dbias, s, uv, ddx(uv), ddy(uv), uvBias.w, kAllLanes, result));
    return result;
}

namespace detail {

inline void tellComparison(const Site& site, const SamplerComparisonState* s, const SamplerCubeComparisonState* cube,
                           const float3& coordinate, Float reference, Float result)
{
    if (listener == nullptr) return;
    const Float none(0.0f);
    TextureCall call{};
    call.function = TextureFunction::SampleCmp;
    call.comparison = s;
    call.cubeComparison = cube;
    for (int c = 0; c < 3; ++c) {
        call.coordinate[c] = coordinate[c];
        call.dx[c] = call.dy[c] = none;
    }
    call.extra = reference;
    call.lanes = kAllLanes;
    call.result = {result, none, none, none};
    listener->sample(site, call);
}

}  // namespace detail

inline Float SampleCmp(const Site& site, const SamplerComparisonState& s, const float2& uv, Float reference)
{
    const Float result = relief::SampleCmp(s, uv, reference);
    detail::tellComparison(site, &s, nullptr, float3(uv, 0.0f), reference, result);
    return result;
}

inline Float SampleCmp(const Site& site, const SamplerCubeComparisonState& s, const float3& direction, Float reference)
{
    const Float result = relief::SampleCmp(s, direction, reference);
    detail::tellComparison(site, nullptr, &s, direction, reference, result);
    return result;
}

inline float4 texCUBE(const Site& site, const samplerCUBE& s, const float3& direction)
{
    const float4 result = relief::texCUBE(s, direction);
    if (listener != nullptr)
        listener->sample(site, detail::callOf(TextureFunction::texCUBE, s, direction, ddx(direction), ddy(direction),
                                              Float(0.0f), result));
    return result;
}

inline float4 texCUBEgrad(const Site& site, const samplerCUBE& s, const float3& direction, const float3& dx,
                          const float3& dy)
{
    const float4 result = relief::texCUBEgrad(s, direction, dx, dy);
    if (listener != nullptr)
        listener->sample(site, detail::callOf(TextureFunction::texCUBEgrad, s, direction, dx, dy, Float(0.0f), result));
    return result;
}

inline float4 texCUBElod(const Site& site, const samplerCUBE& s, const float4& directionLod)
{
    const float4 result = relief::texCUBElod(s, directionLod);
    const float3 none(0.0f);
    if (listener != nullptr)
        listener->sample(site, detail::callOf(TextureFunction::texCUBElod, s, directionLod.xyz(), none, none,
                                              directionLod.w, result));
    return result;
}

inline float4 texCUBEbias(const Site& site, const samplerCUBE& s, const float4& directionBias)
{
    const float4 result = relief::texCUBEbias(s, directionBias);
    const float3 d = directionBias.xyz();
    if (listener != nullptr)
        listener->sample(site,
                         detail::callOf(TextureFunction::texCUBEbias, s, d, ddx(d), ddy(d), directionBias.w, result));
    return result;
}

}  // namespace relief::inline RELIEF_WIDTH::trace
