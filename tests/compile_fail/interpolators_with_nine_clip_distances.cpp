// Mistake: more planes to clip at than there can be.
#include "relief/hlsl/intrinsics.h"
#include "relief/pipeline/frame.h"

using namespace relief;

struct VertexData
{
    POSITION position;
    NORMAL normal;
    TEXCOORD<0, float2> uv;
};

struct Interpolators
{
    SV_POSITION position;
    TEXCOORD<0, float2> uv;
    TEXCOORD<1, float3> normal;
    SV_ClipDistance<0, float4> first;
    SV_ClipDistance<1, float4> second;
    SV_ClipDistance<2, Float> third;
};

struct MyVertexProgram
{
    Interpolators operator()(VertexData v) const
    {
        return {v.position, v.uv, v.normal, v.position, v.position, v.uv.x};
    }
};

struct MyFragmentProgram
{
    float4 operator()(Interpolators i) const { return float4(i.normal, 1.0f); }
};

void draw(Frame& frame, const Mesh& mesh)
{
    frame.draw(mesh, MyVertexProgram{}, MyFragmentProgram{});
}
