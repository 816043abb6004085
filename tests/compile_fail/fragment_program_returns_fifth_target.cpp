// Mistake: the fragment program gives a fifth colour.
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
    noperspective<TEXCOORD<1, float3>> normal;
};

struct MyVertexProgram
{
    Interpolators operator()(VertexData v) const { return {v.position, v.uv, v.normal}; }
};

struct Colors
{
    SV_Target<0> first;
    SV_Target<4> fifth;
};

struct MyFragmentProgram
{
    Colors operator()(Interpolators i) const { return {float4(i.normal, 1.0f), float4(i.normal, 1.0f)}; }
};

void draw(Frame& frame, const Mesh& mesh)
{
    frame.draw(mesh, MyVertexProgram{}, MyFragmentProgram{});
}
