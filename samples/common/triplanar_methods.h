// The methods of the triplanar chapter, each as the function of one plane that TriplanarNormal takes, the truths that
// they are measured by, and by how many degrees they differ. In a plane's coordinates, with z along the projection.
#pragma once

#include <string>
#include <vector>

#include "relief/shading/normals.h"

namespace relief::samples::triplanar {

// The map alone: the surface counts as flat. Right where it is.
struct Swizzle
{
    static constexpr const char* kName = "swizzle";
    float3 operator()(const float3&, const float3& bump) const { return bump; }
};

struct Udn
{
    static constexpr const char* kName = "UDN";
    float3 operator()(const float3& surface, const float3& bump) const
    {
        return {surface.x + bump.x, surface.y + bump.y, surface.z};
    }
};

struct GpuGems3
{
    static constexpr const char* kName = "GPU Gems 3";
    float3 operator()(const float3& surface, const float3& bump) const { return float3(bump.xy(), 0.0f) + surface; }
};

struct Whiteout
{
    static constexpr const char* kName = "whiteout";
    float3 operator()(const float3& surface, const float3& bump) const
    {
        return {surface.x + bump.x, surface.y + bump.y, surface.z * bump.z};
    }
};

struct Reoriented
{
    static constexpr const char* kName = "RNM";
    float3 operator()(const float3& surface, const float3& bump) const { return BlendNormalsRNM(surface, bump); }
};

// Tangent: perpendicular to the normal and to v. Binormal: perpendicular to both.
struct CrossProducts
{
    static constexpr const char* kName = "cross products";
    float3 operator()(const float3& surface, const float3& bump) const
    {
        const float3 tangent = normalize(float3(surface.z, 0.0f, -surface.x));
        const float3 binormal = normalize(float3(0, 1, 0) - surface * surface.y);
        return tangent * bump.x + binormal * bump.y + surface * bump.z;
    }
};

// The directions in which u and v grow along the surface, of the lengths of their slopes.
struct CotangentGradients
{
    static constexpr const char* kName = "cotangent gradients";
    float3 operator()(const float3& surface, const float3& bump) const
    {
        const float3 T = float3(1, 0, 0) - surface * surface.x, B = float3(0, 1, 0) - surface * surface.y;
        return T * bump.x + B * bump.y + surface * bump.z;
    }
};

// The same with the longer of the two made 1, as cotangent_frame() does.
struct CotangentFrame
{
    static constexpr const char* kName = "cotangent frame";
    float3 operator()(const float3& surface, const float3& bump) const
    {
        const Float square = 1.0f - min(surface.x * surface.x, surface.y * surface.y);
        const float3 steeper = {bump.x, bump.y, bump.z * sqrt(square)};
        return CotangentGradients()(surface, steeper);
    }
};

struct Derivatives
{
    static constexpr const char* kName = "derivatives";
    float3 operator()(const float3& surface, const float3& bump) const { return BlendNormalsDerivative(surface, bump); }
};

// --- what a bump could be meant to be: three truths ---

// The surface moved along the projection: its height over the plane, and the map's on top.
// (x, y, f(x, y) + h(x, y)), with the slopes of f = -surface.xy / surface.z.
struct AlongProjection
{
    float3 operator()(const float3& surface, const float3& bump) const
    {
        const float2 slope = surface.xy() / surface.z + bump.xy() / bump.z;
        return normalize(float3(slope.x, slope.y, 1.0f));
    }
};

// The surface moved along its own normal, with the map stretched as the projection stretches it: the cross product of
// P = S + h N along x and along y, S = (x, y, f(x, y)), to first order in h.
struct AlongNormal
{
    float3 operator()(const float3& surface, const float3& bump) const
    {
        const float3 Sx = {1.0f, 0.0f, -surface.x / surface.z}, Sy = {0.0f, 1.0f, -surface.y / surface.z};
        const Float hx = -bump.x / bump.z, hy = -bump.y / bump.z;
        return normalize(surface / surface.z + cross(surface, Sy) * hx + cross(Sx, surface) * hy);
    }
};

// The map laid on the surface without any stretch: turned by the smallest rotation that takes (0, 0, 1) to the normal.
struct Rotated
{
    float3 operator()(const float3& surface, const float3& bump) const
    {
        const float3 axis = {-surface.y, surface.x, 0.0f};
        return bump * surface.z + cross(axis, bump) + axis * (dot(axis, bump) / (1.0f + surface.z));
    }
};

// Degrees between a method and the truths AlongProjection, AlongNormal, Rotated.
struct MethodError
{
    std::string method;
    double maximum[3], rms[3];
};

// On a plane that is tilted by so many degrees (0 to 89), for bumps of this slope, over 64 directions of each.
std::vector<MethodError> triplanarErrors(float tiltDegrees, float slope);

// One line of a table.
std::string formatted(const MethodError& error);

}  // namespace relief::samples::triplanar
