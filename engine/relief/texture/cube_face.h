// The six faces of a cube map: how their pictures are turned, and from a direction to a face and a place on it.
//
// Faces come in Direct3D's order, +x, -x, +y, -y, +z, -z, and are turned as Direct3D has them. The world is left-handed
// with y up (hlsl/conventions.h), and seen from the cube's middle every picture is the right way round, not mirrored:
// who looks along +z has +x to the right and +y above.
//
//   face   its middle   right in the picture   up in the picture
//   0      +x           -z                     +y
//   1      -x           +z                     +y
//   2      +y           +x                     -z
//   3      -y           +x                     +z
//   4      +z           +x                     +y
//   5      -z           -x                     +y
#pragma once

#include <array>

#include <glm/vec3.hpp>

#include "relief/hlsl/types.h"

namespace relief {

inline constexpr int kCubeFaces = 6;
inline constexpr std::array<const char*, kCubeFaces> kCubeFaceNames = {"+x", "-x", "+y", "-y", "+z", "-z"};

// Unit vectors of the world.
struct CubeFaceAxes
{
    glm::ivec3 middle, right, up;
};
inline constexpr std::array<CubeFaceAxes, kCubeFaces> kCubeFaceAxes = {{
    {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
    {{-1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
    {{0, 1, 0}, {1, 0, 0}, {0, 0, -1}},
    {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}},
    {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}},
    {{0, 0, -1}, {-1, 0, 0}, {0, 1, 0}},
}};

inline namespace RELIEF_WIDTH {

// The face that a direction passes through, in each lane: the axis of its largest component, of equal ones z before y
// before x.
class CubeFaceOf
{
public:
    explicit CubeFaceOf(const float3& direction)
    {
        const Float x = abs(direction.x), y = abs(direction.y), z = abs(direction.z);
        isZ = (z >= x) & (z >= y);
        isY = (!isZ) & (y >= x);
        const Mask backward = along(direction) < 0.0f;
        sign = select(backward, Float(-1.0f), Float(1.0f));
        number = select(isZ, Int(4), select(isY, Int(2), Int(0))) + select(backward, Int(1), Int(0));
        isOneForAll = all(number == number[0]);
    }

    Int face() const { return number; }  // 0..5

    // A vector's components along the face's right, up and middle.
    [[gnu::always_inline]] float3 components(const float3& v) const
    {
        if (isOneForAll) [[likely]]
            return componentsOn(number[0], v);
        const Float right = select(isY, v.x, sign * select(isZ, v.x, -v.z));
        const Float up = select(isY, -(sign * v.z), v.y);
        return {right, up, sign * along(v)};
    }

private:
    Float along(const float3& v) const { return select(isZ, v.z, select(isY, v.y, v.x)); }

    // The same where all lanes are on one face, as they mostly are: nothing is selected.
    static float3 componentsOn(int face, const float3& v)
    {
        switch (face) {
            case 0:
                return {-v.z, v.y, v.x};
            case 1:
                return {v.z, v.y, -v.x};
            case 2:
                return {v.x, -v.z, v.y};
            case 3:
                return {v.x, v.z, -v.y};
            case 4:
                return v;
            default:
                return {-v.x, v.y, -v.z};
        }
    }

    Mask isY, isZ;
    Float sign;
    Int number;
    bool isOneForAll;
};

// The direction of a place on a face, from the cube's middle to the cube of side 2: s and t are -1..1, to the right and
// up in the picture. The longest component is 1.
inline float3 cubeDirection(int face, Float s, Float t)
{
    const CubeFaceAxes& axes = kCubeFaceAxes[static_cast<std::size_t>(face)];
    float3 direction;
    for (int i = 0; i < 3; ++i) {
        direction[i] = static_cast<float>(axes.middle[i]) + static_cast<float>(axes.right[i]) * s +
                       static_cast<float>(axes.up[i]) * t;
    }
    return direction;
}

}  // namespace RELIEF_WIDTH

}  // namespace relief
