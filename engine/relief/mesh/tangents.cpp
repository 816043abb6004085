// MikkTSpace in five steps: weld vertices, differentiate each triangle, pair up edges, grow groups around vertices, sum
// up each group. A corner is a position in mesh.indices; corner c belongs to triangle c / 3.
#include "relief/mesh/tangents.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>

#include <glm/geometric.hpp>

#include "relief/lanes/environment.h"
#include "relief/lanes/math.h"
#include "relief/mesh/edges.h"
#include "relief/mesh/weld.h"

namespace relief {
namespace {

using Index = std::uint32_t;

glm::vec3 perpendicularTo(glm::vec3 normal, glm::vec3 v)
{
    return normalizedOrZero(v - glm::dot(normal, v) * normal);
}

// A unit vector at a right angle to the normal: Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6 (2017).
glm::vec4 anyTangent(glm::vec3 vertexNormal)
{
    const glm::dvec3 normal(vertexNormal);
    const double length = std::sqrt(glm::dot(normal, normal));
    const glm::dvec3 n = length > 0 ? normal / length : glm::dvec3(0, 0, 1);
    const double sign = std::copysign(1.0, n.z);
    const double a = -1.0 / (sign + n.z);
    return {glm::vec3(glm::dvec3(1.0 + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x)), -1.0f};
}

// The vectors times the power of two that brings the largest number to 0.5..1: exact, so that directions stay the same.
template <class Vector>
std::vector<Vector> scaledToOne(std::vector<Vector> vectors)
{
    float largest = 0;
    for (const Vector& vector : vectors) {
        for (int axis = 0; axis < Vector::length(); ++axis) largest = std::max(largest, std::fabs(vector[axis]));
    }
    int exponent = 0;
    std::frexp(largest, &exponent);
    for (Vector& vector : vectors) {
        for (int axis = 0; axis < Vector::length(); ++axis) vector[axis] = std::ldexp(vector[axis], -exponent);
    }
    return vectors;
}

struct Triangle
{
    glm::vec3 alongU{0}, alongV{0};  // of unit length, or zero
    bool isDegenerate = false;       // two corners at one position
    bool joinsAny = false;           // no area in the picture, or no direction of u or v
    bool keepsOrientation = false;   // the uvs turn like the corners
};

struct Group
{
    bool keepsOrientation;
    std::size_t begin, end;  // in Builder::members
};

class Builder
{
public:
    explicit Builder(const Mesh& mesh);
    std::vector<glm::vec4> tangents();

private:
    void differentiate(Index triangle);
    void growGroups();
    void growGroup(Index corner);
    void sumUpGroup(const Group& group);
    glm::vec3 sumOf(const std::vector<Index>& left) const;
    void copyToDegenerate();

    const Mesh& mesh;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec2> uvs;
    std::vector<Index> vertices;  // of each corner, welded
    std::vector<Triangle> triangles;
    std::vector<Index> acrossEdge;  // pairEdges()
    std::vector<bool> isAssigned;   // corners that belong to a group
    std::vector<Index> members;     // corners, group by group
    std::vector<Group> groups;
    std::vector<glm::vec4> results;  // w = 0 where there is none

    struct Member
    {
        glm::vec3 alongU, alongV;
        float angle;
        Index corner;
    };
    std::vector<Member> gathered;  // those of the group that is summed up, which have a direction to add
};

Builder::Builder(const Mesh& m) : mesh(m), positions(scaledToOne(m.positions)), uvs(scaledToOne(m.uvs)) {}

// Where +u and +v point on a triangle: the first derivatives of its position by its uv, times the uvs' area.
void Builder::differentiate(Index number)
{
    Triangle& triangle = triangles[number];
    const Index* const of = &vertices[3 * std::size_t{number}];
    const glm::vec3 a = positions[of[0]];
    const glm::vec3 ab = positions[of[1]] - a;
    const glm::vec3 ac = positions[of[2]] - a;
    const glm::vec2 uvAb = uvs[of[1]] - uvs[of[0]];
    const glm::vec2 uvAc = uvs[of[2]] - uvs[of[0]];
    constexpr float kSmallest = std::numeric_limits<float>::min();

    const float twiceArea = uvAb.x * uvAc.y - uvAb.y * uvAc.x;
    triangle.isDegenerate = a == positions[of[1]] || a == positions[of[2]] || positions[of[1]] == positions[of[2]];
    triangle.keepsOrientation = twiceArea > 0;
    triangle.joinsAny = true;
    if (std::fabs(twiceArea) <= kSmallest) return;

    const glm::vec3 alongU = uvAc.y * ab - uvAb.y * ac;
    const glm::vec3 alongV = uvAb.x * ac - uvAc.x * ab;
    const float lengthU = std::sqrt(glm::dot(alongU, alongU));
    const float lengthV = std::sqrt(glm::dot(alongV, alongV));
    const float sign = triangle.keepsOrientation ? 1.0f : -1.0f;
    if (lengthU > kSmallest) triangle.alongU = (sign / lengthU) * alongU;
    if (lengthV > kSmallest) triangle.alongV = (sign / lengthV) * alongV;
    triangle.joinsAny = lengthU / std::fabs(twiceArea) <= kSmallest || lengthV / std::fabs(twiceArea) <= kSmallest;
}

// All corners at the vertex that can be reached across edges, through triangles of the same orientation.
void Builder::growGroup(Index first)
{
    const bool orientation = triangles[first / 3].keepsOrientation;
    Group group{orientation, members.size(), members.size()};
    const auto join = [&](Index corner) {
        if (corner == kNoEdge || isAssigned[corner]) return;
        Triangle& triangle = triangles[corner / 3];
        const Index begin = corner - corner % 3;
        const bool isFree = !isAssigned[begin] && !isAssigned[begin + 1] && !isAssigned[begin + 2];
        if (triangle.joinsAny && isFree) triangle.keepsOrientation = orientation;  // the first group decides
        if (triangle.keepsOrientation != orientation) return;
        isAssigned[corner] = true;
        members.push_back(corner);
    };
    join(first);
    for (std::size_t i = group.begin; i < members.size(); ++i) {
        // Over the edge that begins at this vertex the neighbour's one ends here; over the one that ends here it
        // begins.
        const Index over = acrossEdge[members[i]];
        join(over == kNoEdge ? kNoEdge : nextCorner(over));
        join(acrossEdge[previousCorner(members[i])]);
    }
    group.end = members.size();
    std::sort(members.begin() + static_cast<std::ptrdiff_t>(group.begin), members.end());
    groups.push_back(group);
}

void Builder::growGroups()
{
    isAssigned.assign(vertices.size(), false);
    members.reserve(vertices.size());
    for (Index corner = 0; corner < vertices.size(); ++corner) {
        const Triangle& triangle = triangles[corner / 3];
        if (!triangle.isDegenerate && !triangle.joinsAny && !isAssigned[corner]) growGroup(corner);
    }
}

// The sum over those gathered but `left` out, in order.
glm::vec3 Builder::sumOf(const std::vector<Index>& left) const
{
    glm::vec3 sum(0);
    auto skip = left.begin();
    for (const Member& member : gathered) {
        if (skip != left.end() && *skip == member.corner) {
            ++skip;
            continue;
        }
        sum += member.angle * member.alongU;
    }
    return normalizedOrZero(sum);
}

void Builder::sumUpGroup(const Group& group)
{
    const Index vertex = vertices[members[group.begin]];
    const glm::vec3 normal = mesh.normals[vertex];
    gathered.clear();
    for (std::size_t i = group.begin; i < group.end; ++i) {
        const Index corner = members[i];
        const Triangle& triangle = triangles[corner / 3];
        if (triangle.joinsAny) continue;
        const glm::vec3 position = positions[vertex];
        const glm::vec3 before = perpendicularTo(normal, positions[vertices[previousCorner(corner)]] - position);
        const glm::vec3 after = perpendicularTo(normal, positions[vertices[nextCorner(corner)]] - position);
        const float cosine = std::clamp(glm::dot(before, after), -1.0f, 1.0f);
        const float angle = atan2(std::sqrt((1.0f - cosine) * (1.0f + cosine)), cosine);
        gathered.push_back(
            {perpendicularTo(normal, triangle.alongU), perpendicularTo(normal, triangle.alongV), angle, corner});
    }

    // Directions within 41 degrees of the first are within 83 of each other: none is opposite to another.
    const bool isNarrow = std::all_of(gathered.begin(), gathered.end(), [&](const Member& member) {
        return glm::dot(gathered[0].alongU, member.alongU) > 0.75f &&
               glm::dot(gathered[0].alongV, member.alongV) > 0.75f;
    });
    const float w = group.keepsOrientation ? 1.0f : -1.0f;
    const glm::vec4 whole(sumOf({}), w);
    for (std::size_t i = group.begin; i < group.end; ++i) results[members[i]] = whole;
    if (isNarrow) return;

    std::map<std::vector<Index>, glm::vec4> known = {{{}, whole}};  // by the members that are left out
    std::vector<Index> opposite;
    for (const Member& member : gathered) {
        opposite.clear();
        for (const Member& other : gathered) {
            if (glm::dot(member.alongU, other.alongU) > -1.0f && glm::dot(member.alongV, other.alongV) > -1.0f)
                continue;
            opposite.push_back(other.corner);
        }
        auto found = known.find(opposite);
        if (found == known.end()) found = known.emplace(opposite, glm::vec4(sumOf(opposite), w)).first;
        results[member.corner] = found->second;
    }
}

void Builder::copyToDegenerate()
{
    std::vector<Index> firstCorner(positions.size(), kNoEdge);
    for (Index corner = 0; corner < vertices.size(); ++corner) {
        Index& first = firstCorner[vertices[corner]];
        if (first == kNoEdge && !triangles[corner / 3].isDegenerate) first = corner;
    }
    for (Index corner = 0; corner < vertices.size(); ++corner) {
        const Index first = firstCorner[vertices[corner]];
        if (triangles[corner / 3].isDegenerate && first != kNoEdge) results[corner] = results[first];
    }
}

std::vector<glm::vec4> Builder::tangents()
{
    const std::vector<Index> first = firstEqualVertices(mesh);
    vertices.reserve(mesh.indices.size());
    for (const Index index : mesh.indices) vertices.push_back(first[index]);
    triangles.resize(vertices.size() / 3);
    for (Index t = 0; t < triangles.size(); ++t) differentiate(t);
    std::vector<Index> collapsed = vertices;  // degenerate triangles have no neighbours
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        if (triangles[t].isDegenerate) collapsed[3 * t + 1] = collapsed[3 * t + 2] = collapsed[3 * t];
    }
    acrossEdge = pairEdges(collapsed);
    growGroups();
    results.assign(vertices.size(), glm::vec4(0));
    for (const Group& group : groups) sumUpGroup(group);
    copyToDegenerate();
    for (std::size_t corner = 0; corner < results.size(); ++corner) {
        const glm::vec3 tangent(results[corner]);
        const bool isUnit = std::fabs(glm::dot(tangent, tangent) - 1.0f) < 1e-4f;  // not for NaN
        if (isUnit) continue;
        const float w = results[corner].w;
        results[corner] = anyTangent(mesh.normals[vertices[corner]]);
        if (w != 0.0f) results[corner].w = w;
    }
    return std::move(results);
}

}  // namespace

Expected<std::vector<glm::vec4>> cornerTangents(const Mesh& mesh)
{
    const DefaultFloatingPoint environment;
    if (const Expected<void> valid = validate(mesh); !valid) return tl::unexpected(valid.error());
    if (mesh.indices.empty()) return {};
    if (mesh.uvs.empty()) {
        return fail("mesh '" + mesh.name + "': tangents need uvs; give every vertex one (withSphericalUvs)");
    }
    return Builder(mesh).tangents();
}

Expected<Mesh> withTangents(Mesh mesh)
{
    const DefaultFloatingPoint environment;
    mesh.tangents.clear();
    const Expected<std::vector<glm::vec4>> tangents = cornerTangents(mesh);
    if (!tangents) return tl::unexpected(tangents.error());
    for (const glm::vec3& normal : mesh.normals) mesh.tangents.push_back(anyTangent(normal));
    setPerCorner(mesh, &Mesh::tangents, *tangents);
    return mesh;
}

glm::vec3 normalizedOrZero(const glm::vec3& v)
{
    constexpr float kSmallest = std::numeric_limits<float>::min();
    const bool isZero = std::fabs(v.x) <= kSmallest && std::fabs(v.y) <= kSmallest && std::fabs(v.z) <= kSmallest;
    if (isZero) return v;
    const float square = glm::dot(v, v);
    if (square > 1e-30f && square < HUGE_VALF) return (1.0f / std::sqrt(square)) * v;
    const glm::dvec3 exact = v;  // squares of floats are within its range
    return glm::vec3(exact / std::sqrt(glm::dot(exact, exact)));
}

}  // namespace relief
