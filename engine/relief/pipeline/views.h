// What there is to see in a frame beside its colours: a list, made from what was recorded. inspect.h looks.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "relief/pipeline/frame.h"

namespace relief::inline RELIEF_WIDTH {

enum class Sight
{
    color,
    depth,
    interpolator,
    mipLevel,
    triangles,
    blocks,
    overdraw,
    lanes,
    samples,
    time
};

struct View
{
    std::string name;     // "depth", "TEXCOORD1"
    std::string meaning;  // a few words
    std::string unit;     // of its numbers; may be empty
    Sight sight = Sight::color;
};

// All views of a frame: "color", "depth", "normal" and "uv" where a vertex program hands them on, every interpolator by
// its semantic, and what the frame costs. inspect() also takes one component of an interpolator, as in "TEXCOORD0.w".
std::vector<View> viewsOf(const Frame& frame);

// The view of a name; an error names those that there are.
Expected<View> findView(const Frame& frame, const std::string& name);

// Where a draw's interpolated components hold an interpolator: its semantic, "normal" or "uv", maybe with ".x" behind.
// "normal" is the first one of three components that is made from the mesh's normals alone, "uv" the first one of at
// least two that is made from TEXCOORD0 alone.
struct Slots
{
    int first, count;  // 1 ... 4
    Interpolation interpolation;
    bool isInteger;
};
std::optional<Slots> slotsOf(const Draw& draw, const std::string& name);

}  // namespace relief::inline RELIEF_WIDTH
