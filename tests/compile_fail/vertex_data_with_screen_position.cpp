// Mistake: VertexData holds the position on the screen, which the vertex program is to give.
#include "relief/hlsl/intrinsics.h"
#include "relief/pipeline/frame.h"

using namespace relief;

struct VertexData
{
    SV_POSITION position;
    NORMAL normal;
    TEXCOORD<0, float2> uv;
};

struct Interpolators
{
    SV_POSITION position;
    TEXCOORD<0, float2> uv;
    noperspective<TEXCOORD<1, float3>> normal;
};

struct MyVertexProgram
{
    Interpolators operator()(VertexData v) const { return {v.position, v.uv, v.normal}; }
};

struct MyFragmentProgram
{
    float4 operator()(Interpolators i) const { return float4(i.normal * 0.5f + 0.5f, 1.0f); }
};

void draw(Frame& frame, const Mesh& mesh)
{
    frame.draw(mesh, MyVertexProgram{}, MyFragmentProgram{});
}
