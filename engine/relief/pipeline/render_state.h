// Render state: a plain value of each draw.
#pragma once

#include <cstdint>

#include "relief/hlsl/compare.h"

namespace relief {

enum class Cull
{
    none,
    back,
    front
};

// What becomes of a source colour s and the destination d.  off: s.  additive: s + d.  alpha: s.a s + (1 - s.a) d.
enum class Blend
{
    off,
    additive,
    alpha
};

// What becomes of a pixel's 8-bit stencil.
enum class StencilOp
{
    keep,
    zero,
    replace,         // by the reference
    incrementClamp,  // at 255
    decrementClamp,  // at 0
    invert,
    incrementWrap,
    decrementWrap
};

// Of one side of triangles: the test is reference & readMask against stencil & readMask, before the depth test.
struct StencilFace
{
    Compare test = Compare::always;
    StencilOp fail = StencilOp::keep;       // what becomes of it where the stencil test fails
    StencilOp depthFail = StencilOp::keep;  // where only the depth test fails
    StencilOp pass = StencilOp::keep;       // where both pass

    friend bool operator==(const StencilFace&, const StencilFace&) = default;
};

// A target without a stencil attachment passes every test (D3D 11.3, 17.13).
struct Stencil
{
    std::uint8_t reference = 0, readMask = 0xff, writeMask = 0xff;
    StencilFace front = {}, back = {};

    bool isUsed() const { return front != StencilFace{} || back != StencilFace{}; }
};

// The same for both sides.
inline Stencil bothSides(std::uint8_t reference, const StencilFace& face)
{
    return {reference, 0xff, 0xff, face, face};
}

// What a mesh's indices are: three for a triangle, or two for a line (see line.h).
enum class Primitive
{
    triangles,
    lines
};

// Moves a triangle's depth away, so that a surface does not hide behind its own shadow map: `constant` steps of a float
// as large as the triangle's largest depth, and `slope` times what depth changes by from a pixel to the next one, to
// the right or down, whichever is more; both together at most `limit` where that is above 0, and at least `limit` where
// it is below (D3D 11.3, 15.10). Lines stay where they are.
struct DepthBias
{
    float constant = 0.0f, slope = 0.0f, limit = 0.0f;
};

struct RenderState
{
    Compare depthTest = Compare::less;  // `greater` with a depth cleared to 0 is reversed depth
    bool depthWrite = true;
    bool depthClip = true;  // false: z beyond near and far is clamped instead of clipped
    Cull cull = Cull::back;
    Blend blend = Blend::off;
    bool alphaToCoverage = false;  // of n samples the first alpha * n, rounded, are drawn; one: from alpha 0.5 on
    Primitive primitive = Primitive::triangles;
    int lineWidth = 1;  // pixels: 1 or 2
    DepthBias depthBias = {};
    bool colorWrite = true;  // false: nothing but depth and stencil
    Stencil stencil = {};
};

// Which indices of a mesh a draw takes, and how often. A triangle or a line that the last ones do not complete is not
// drawn, as on GPUs.
struct MeshPart
{
    std::uint32_t first = 0;
    std::uint32_t count = 0xffffffffu;  // up to the mesh's last
    std::uint32_t instances = 1;
};

}  // namespace relief
