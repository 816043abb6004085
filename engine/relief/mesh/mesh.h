// A triangle mesh: what every producer (primitives.h, obj.h) hands over and every draw consumes. Object space,
// left-handed, Y up; front faces are clockwise seen from the front, as in Unity, so that for a triangle a, b, c
// the vector cross(b - a, c - a) points out of the front. Plain floats: lanes begin where vertices are shaded.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "relief/error.h"
#include "relief/mesh/vertex_stream.h"

namespace relief {

// Every field has a default, so that no compiler warns of those that a program leaves out.
struct Mesh
{
    std::string name = {};
    std::vector<glm::vec3> positions = {};
    std::vector<glm::vec3> normals = {};      // as many as positions, unit length; or none
    std::vector<glm::vec2> uvs = {};          // as many as positions or none; (0,0) is the picture's lower left
    std::vector<glm::vec4> tangents = {};     // as many as positions or none; xyz along +u, w the binormal's handedness
                                              // sign: cross(normal, tangent.xyz) * tangent.w points along +v
    std::vector<glm::vec4> colors = {};       // as many as positions or none; linear, 1 in alpha where a file has none
    std::vector<VertexStream> streams = {};   // whatever else vertices or instances have
    std::vector<std::uint32_t> indices = {};  // three per triangle, or two per line
};

// All of it as a list: POSITION, NORMAL, TEXCOORD0, TANGENT and COLOR0, as far as they are there, and mesh.streams.
std::vector<StreamView> streamsOf(const Mesh& mesh);

// For whoever works on a mesh with normals, as withTangents() does; a draw checks for itself what its VertexData asks
// for. Fails, naming the first thing that is wrong, unless every position has a normal, the lengths agree, there are
// whole triangles (lines, of meshes for lines), every index names a position and every number is finite. A mesh without
// any triangle is valid.
Expected<void> validate(const Mesh& mesh, int indicesPerPrimitive = 3);

// Replaces the normals by smooth ones: the sum of the normals of the triangles around each vertex, weighted by their
// area. Straight up (+Y) where that sum is zero, so that every normal has unit length. The mesh's positions and indices
// must be valid.
void computeNormals(Mesh& mesh);

// The same shape with its picture mirrored: u becomes 1 - u, tangents turn round, and so does their handedness sign.
Mesh withMirroredUv(const Mesh& mesh);

}  // namespace relief
