// Mistake: a colour of the fragment program among the Interpolators.
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
    SV_Target<0> color;
};

struct MyVertexProgram
{
    Interpolators operator()(VertexData v) const { return {v.position, v.uv, v.normal, float4(1.0f)}; }
};

struct MyFragmentProgram
{
    float4 operator()(Interpolators i) const { return i.color; }
};

void draw(Frame& frame, const Mesh& mesh)
{
    frame.draw(mesh, MyVertexProgram{}, MyFragmentProgram{});
}
