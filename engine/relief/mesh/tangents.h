// Tangents for normal mapping, after MikkTSpace, the convention of Morten Mikkelsen (mikktspace.com; his thesis
// "Simulation of Wrinkled Surfaces Revisited", 2008), in which most normal maps are baked. Object space, our numbers as
// they are: clockwise fronts do not matter to it. Held against its reference in tests/fixtures/mikktspace.
#pragma once

#include <vector>

#include "relief/mesh/mesh.h"

namespace relief {

// One tangent per entry of mesh.indices: xyz of unit length, at a right angle to a unit normal, along +u; w is +1 where
// the triangle's uvs run counter-clockwise (u to the right, v up) and -1 where they run clockwise, which they do in
// pictures that are not mirrored, because our fronts are clockwise (makeQuad). The rules:
//
// - Vertices with the same position, normal and uv are one vertex, whatever their indices.
// - Around a vertex, triangles form a group that are joined by edges, which they run through in opposite directions,
// and
//   whose uvs run the same way. A corner's tangent is the sum over its group of the directions of +u, each made
//   perpendicular to the normal and weighted by the angle at the vertex; without those that are exactly opposite to its
//   own (an angular threshold of 180 degrees, MikkTSpace's default).
// - Triangles without area in the picture, or on which u or v has no direction, join any group and add nothing to it.
// - Triangles with two corners at the same position join none; each of their corners copies the first corner of another
//   triangle at the same vertex.
// - A corner that is still without a tangent, or whose sum has no direction, gets a unit vector perpendicular to the
//   normal, and w = -1 if it has no group (the reference gives (1, 0, 0) or (0, 0, 0)).
//
// Positions and uvs may have any size: they are scaled by powers of two, which is exact. The time grows in proportion
// to the mesh, except around a vertex where directions differ by more than 41 degrees: there, with the square of its
// triangles. An error if the mesh is not valid or has triangles but no uvs.
Expected<std::vector<glm::vec4>> cornerTangents(const Mesh& mesh);

// The mesh with these tangents, instead of those it had. Vertices whose corners got different ones are split: the first
// use keeps the index, the others are appended. Vertices without a triangle get a unit vector perpendicular to the
// normal. The same errors.
Expected<Mesh> withTangents(Mesh mesh);

// Of length 1; what has no direction stays as it is.
glm::vec3 normalizedOrZero(const glm::vec3& v);

}  // namespace relief
