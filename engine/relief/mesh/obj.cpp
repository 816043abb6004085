// OBJ in three steps: take the text apart (obj_text.h), cut the faces into triangles, weld and convert.
#include "relief/mesh/obj.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "relief/file.h"
#include "relief/lanes/environment.h"
#include "relief/mesh/obj_text.h"
#include "relief/mesh/triangulate.h"
#include "relief/path.h"

namespace relief {
namespace {

using Corner = ObjCorner;
constexpr std::uint32_t kNone = Corner::kNone;

struct CornerHash
{
    std::size_t operator()(const Corner& corner) const
    {
        auto hash = std::uint64_t{corner.position} * 0x9e3779b97f4a7c15u;
        hash = (hash ^ corner.uv) * 0xbf58476d1ce4e5b9u;
        hash = (hash ^ corner.normal) * 0x94d049bb133111ebu;
        return static_cast<std::size_t>(hash ^ (hash >> 32));
    }
};

// 0 - x instead of -x, so that 0 stays +0.
void makeLeftHanded(std::vector<glm::vec3>& vectors)
{
    for (glm::vec3& v : vectors) v.x = 0.0f - v.x;
}

// The corners of all triangles, reversed: negating x has turned every front into a back.
std::vector<Corner> cutIntoTriangles(const ObjText& file)
{
    std::vector<Corner> triangles;
    std::vector<glm::vec3> polygon;
    std::size_t first = 0;
    for (const std::uint32_t length : file.faceLengths) {
        polygon.clear();
        for (std::size_t i = first; i < first + length; ++i) {
            polygon.push_back(file.positions[file.corners[i].position]);
        }
        for (const auto& [a, b, c] : triangulate(polygon)) {
            for (const std::uint32_t corner : {a, c, b}) triangles.push_back(file.corners[first + corner]);
        }
        first += length;
    }
    return triangles;
}

// Smooth normals, one per position of the file, so that vertices which differ only in their uv get the same.
std::vector<glm::vec3> smoothNormals(const ObjText& file, const std::vector<Corner>& triangles)
{
    Mesh mesh;
    mesh.positions = file.positions;
    for (const Corner& corner : triangles) mesh.indices.push_back(corner.position);
    computeNormals(mesh);
    return std::move(mesh.normals);
}

// Exporters round normals to a few digits; a mesh promises unit length.
glm::vec3 unit(glm::vec3 normal)
{
    const glm::dvec3 n = normal;
    return glm::vec3(n / std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z));
}

// One vertex for each different corner. A normal of length zero counts as missing.
Mesh weld(const ObjText& file, std::vector<Corner> triangles)
{
    bool anyUv = false;
    bool anyNormalMissing = false;
    for (Corner& corner : triangles) {
        if (corner.normal != kNone && file.normals[corner.normal] == glm::vec3(0)) {
            corner.normal = kNone;
        }
        anyUv = anyUv || corner.uv != kNone;
        anyNormalMissing = anyNormalMissing || corner.normal == kNone;
    }
    const std::vector<glm::vec3> computed =
        anyNormalMissing ? smoothNormals(file, triangles) : std::vector<glm::vec3>();

    Mesh mesh;
    mesh.indices.reserve(triangles.size());
    std::unordered_map<Corner, std::uint32_t, CornerHash> vertexOf;
    for (const Corner& corner : triangles) {
        const auto [entry, isNew] = vertexOf.try_emplace(corner, static_cast<std::uint32_t>(mesh.positions.size()));
        mesh.indices.push_back(entry->second);
        if (!isNew) continue;
        mesh.positions.push_back(file.positions[corner.position]);
        if (!file.colors.empty()) mesh.colors.emplace_back(file.colors[corner.position], 1.0f);
        mesh.normals.push_back(corner.normal == kNone ? computed[corner.position] : unit(file.normals[corner.normal]));
        if (!anyUv) continue;
        mesh.uvs.push_back(corner.uv == kNone ? glm::vec2(0) : file.uvs[corner.uv]);
    }
    return mesh;
}

}  // namespace

Expected<Mesh> readObj(const std::string& path)
{
    const Expected<std::vector<std::uint8_t>> bytes = readFile(path);
    if (!bytes) return tl::unexpected(bytes.error());
    const DefaultFloatingPoint environment;
    Expected<ObjText> file = parseObj({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
    if (!file) return fail(path + ": " + file.error().message);
    makeLeftHanded(file->positions);
    makeLeftHanded(file->normals);
    Mesh mesh = weld(*file, cutIntoTriangles(*file));
    mesh.name = utf8Of(pathOf(path).stem());
    if (const Expected<void> valid = validate(mesh); !valid) return fail(path + ": " + valid.error().message);
    return mesh;
}

}  // namespace relief
