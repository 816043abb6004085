// Mistake: the fragment program gives what only goes to it.
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
    SV_Target<0> color;
    TEXCOORD<0, float2> uv;
};

struct MyFragmentProgram
{
    Colors operator()(Interpolators i) const { return {float4(i.normal, 1.0f), i.uv}; }
};

void draw(Frame& frame, const Mesh& mesh)
{
    frame.draw(mesh, MyVertexProgram{}, MyFragmentProgram{});
}
