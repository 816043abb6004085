// A quad and its programs: a round lens in front of nothing.
#pragma once

#include <relief/relief.h>

namespace lens {

using namespace relief;

struct VertexData
{
    POSITION position;
    TEXCOORD<0, float2> uv;
};

struct Interpolators
{
    SV_POSITION position;
    TEXCOORD<0, float2> uv;
};

struct Flat
{
    Interpolators operator()(VertexData v) const { return {v.position, v.uv}; }
};

struct Lens
{
    float3 light;
    float4 operator()(Interpolators i, Discard& discard) const
    {
        const Float r = length(i.uv * 2.0f - 1.0f);
        discard(r > 0.95f);
        return float4(0.2f + 0.8f * sqrt(saturate(1.0f - r * r)) * light, 1.0f);
    }
};

inline Mesh quad()
{
    Mesh mesh;
    mesh.name = "quad";
    mesh.positions = {{-1, -1, 0.5f}, {-1, 1, 0.5f}, {1, 1, 0.5f}, {1, -1, 0.5f}};
    mesh.uvs = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return mesh;
}

inline void draw(Frame& frame, const Mesh& mesh, const float3& light)
{
    frame.clear({0, 0, 0, 1});
    frame.draw(mesh, Flat{}, Lens{light});
    frame.run();
}

}  // namespace lens
