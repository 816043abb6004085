// A number as a colour, and the scale that says which colour is which number.
#pragma once

#include "common/assets.h"
#include "common/scene.h"

namespace relief::samples {

// 0 black, 1/4 blue, 1/2 green, 3/4 yellow, 1 and more red; between them evenly, in linear colours.
inline float3 falseColor(Float part)
{
    const Float quarters = part * 4.0f;
    float3 color = float3(0.02f, 0.1f, 1.0f) * saturate(quarters);
    color = lerp(color, float3(0.0f, 0.6f, 0.05f), saturate(quarters - 1.0f));
    color = lerp(color, float3(1.0f, 0.9f, 0.0f), saturate(quarters - 2.0f));
    return lerp(color, float3(1.0f, 0.0f, 0.0f), saturate(quarters - 3.0f));
}

// Between two directions of any length.
inline Float degreesBetween(const float3& a, const float3& b)
{
    return atan2(length(cross(a, b)), dot(a, b)) / kDegree;
}

namespace detail {

struct ScaleVertexData
{
    POSITION position;
};

struct ScaleInterpolators
{
    SV_POSITION position;
    TEXCOORD<0, float2> uv;
};

// At the lower edge of the picture, wherever the camera is.
struct ScaleVertexProgram
{
    Float width;

    ScaleInterpolators operator()(ScaleVertexData v) const
    {
        const float2 corner = {v.position.x * 2.0f, v.position.y * 2.0f};
        return {.position = float4(corner.x * width, corner.y * 0.04f - 0.9f, 0.0f, 1.0f), .uv = corner};
    }
};

// A white line at each quarter.
struct ScaleFragmentProgram
{
    float4 operator()(ScaleInterpolators i) const
    {
        const Float part = i.uv.x * 0.5f + 0.5f, quarters = part * 4.0f;
        const Mask line = abs(quarters - floor(quarters + 0.5f)) < 0.03f;
        return float4(select(line, float3(1.0f, 1.0f, 1.0f), falseColor(part)), 1.0f);
    }
};

}  // namespace detail

// The angle between the normals of two fragment programs that have a function NormalDirection.
template <class Interpolators, class Program>
struct ShowAngle
{
    Program first, second;
    Float maximumAngle;  // degrees that are red

    float4 operator()(Interpolators i) const
    {
        const Float degrees = degreesBetween(first.NormalDirection(i), second.NormalDirection(i));
        return float4(falseColor(degrees / maximumAngle), 1.0f);
    }
};

// The scale from 0 (left) to 1 (right), which is so many degrees, in one of `count` columns of the picture.
inline void drawScale(const Scene& s, int count, Float maximumAngle)
{
    s.labelScale("0 to " + shortNumber(maximumAngle[0]) + " degrees");
    s.draw(primitive("quad"), detail::ScaleVertexProgram{0.85f / static_cast<float>(count)},
           detail::ScaleFragmentProgram{});
}

// The first object in three columns: by one fragment program, by another one, and the angle between their normals, with
// its scale.
template <class Interpolators, class VertexProgram, class FragmentProgram>
void drawBesideAngle(const Scene& s, const VertexProgram& vertex, const FragmentProgram& first,
                     const FragmentProgram& second, Float maximumAngle)
{
    s.cutCell(0, 3);
    s.draw(s.mesh, vertex, first);
    s.cutCell(1, 3);
    s.draw(s.mesh, vertex, second);
    s.cutCell(2, 3);
    s.draw(s.mesh, vertex, ShowAngle<Interpolators, FragmentProgram>{first, second, maximumAngle});
    drawScale(s, 3, maximumAngle);
}

}  // namespace relief::samples
