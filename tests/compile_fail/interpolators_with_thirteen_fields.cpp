// Mistake: Interpolators has more fields than the engine can list.
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
    TEXCOORD<2, Float> a, b, c, d, e, f, g, h, i, j;
};

struct MyVertexProgram
{
    Interpolators operator()(VertexData v) const { return {v.position, v.uv, v.normal, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9}; }
};

struct MyFragmentProgram
{
    float4 operator()(Interpolators i) const { return float4(i.normal * 0.5f + 0.5f, 1.0f); }
};

void draw(Frame& frame, const Mesh& mesh)
{
    frame.draw(mesh, MyVertexProgram{}, MyFragmentProgram{});
}
