// Matrices of the CPU's side: where a camera looks from, how it projects, and how objects are placed. Left-handed, Y
// up, depth 0 ... w in clip space: see hlsl/conventions.h. Exact operations only, with the engine's own sine and cosine
// (GLM's functions call the C library's), so every machine gets the same matrices:
//
//     clipFromWorld = perspective(40, width / height, 0.05f, 100) * lookAt(position, target)
//     worldFromObject = translation(place) * rotationY(30) * scaling(glm::vec3(2))
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace relief {

// viewFromWorld of a camera at `position`: +z is forward, towards `target`, and +y as near to `up`, of unit length, as
// it can be. Where the camera looks along `up`, a horizontal axis takes its place. Not a number where target is
// position.
glm::mat4 lookAt(const glm::vec3& position, const glm::vec3& target, const glm::vec3& up = {0.0f, 1.0f, 0.0f});

// The same for a camera that looks along `direction`, whose length may be 1e-15 to 1e15.
glm::mat4 lookAlong(const glm::vec3& position, const glm::vec3& direction, const glm::vec3& up = {0.0f, 1.0f, 0.0f});

// The same for a camera that looks through a face of the cube around it, 0..5, turned as cube maps are
// (texture/cube_face.h): six pictures with perspective(90, 1, ...) show everything around `position`, and each of them
// once.
glm::mat4 lookThroughFace(const glm::vec3& position, int face);

// clipFromView. The field of view is the vertical one, in degrees; aspect = width / height. Depth is 0 at the near
// plane and 1 at the far plane, which may be at infinity.
glm::mat4 perspective(float fieldOfView, float aspect, float nearPlane, float farPlane);

// The same with depth 1 at the near plane and 0 at the far one, for Compare::greater and depth cleared to 0: floats are
// densest near 0, where the far half of a scene is.
glm::mat4 perspectiveReversed(float fieldOfView, float aspect, float nearPlane, float farPlane);

// clipFromView without perspective: a box, `width` and `height` across and centred on the view's axis.
glm::mat4 orthographic(float width, float height, float nearPlane, float farPlane);

// Turns by an angle in degrees about one axis, as Unity's inspector shows it: X takes y to z, Y takes z to x, Z takes x
// to y.
glm::mat4 rotationX(float degrees);
glm::mat4 rotationY(float degrees);
glm::mat4 rotationZ(float degrees);
glm::mat4 translation(const glm::vec3& offset);
glm::mat4 scaling(const glm::vec3& factors);

}  // namespace relief
