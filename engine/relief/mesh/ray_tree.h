// Rays against the front faces of a mesh, in object space: a tree of boxes around its triangles. In: a mesh, a ray.
// Out: the triangle that is hit first, and where. What is hit depends on neither the order nor the shape of the tree.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "relief/mesh/mesh.h"

namespace relief {

// The points origin + t * direction for t in begin..end. The direction has unit length.
struct Ray
{
    glm::dvec3 origin, direction;
    double begin, end;
};

struct RayHit
{
    std::uint32_t triangle;
    double t;
    std::array<double, 3> weights;  // barycentric, of the triangle's corners: at least 0, their sum is 1
};

class RayTree
{
public:
    // Copies what it needs. The mesh must be valid. Time: n log n for n triangles.
    explicit RayTree(const Mesh& mesh);

    // The hit with the smallest t; of several at the same t, the one with the lowest triangle. Back faces, triangles
    // without area and those that the ray lies in are not hit. A ray through an edge or a vertex that front faces share
    // hits one of them: the test is watertight (Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", JCGT 2,
    // 2013).
    std::optional<RayHit> firstHit(const Ray& ray) const;

private:
    struct Triangle
    {
        std::array<glm::vec3, 3> corners;
        std::uint32_t number;  // in the mesh
    };

    // The first child of an inner node is the next node.
    struct Node
    {
        glm::vec3 low, high;
        std::uint32_t next;   // inner node: the second child; leaf: its first triangle
        std::uint32_t count;  // triangles of a leaf; 0 for an inner node
    };

    struct Builder;
    friend struct Builder;

    std::vector<Triangle> triangles;  // leaf by leaf
    std::vector<Node> nodes;
};

}  // namespace relief
