// OBJ in four steps: check the text, let tinyobjloader gather numbers and faces, cut the faces into triangles, weld and
// convert. tinyobjloader's own triangulation is not used: it drops or doubles parts of concave polygons, depending on
// where in space they lie.
#include "mesh/obj.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include <tiny_obj_loader.h>

#include "file.h"
#include "mesh/obj_check.h"
#include "mesh/triangulate.h"
#include "path.h"

namespace relief {
namespace {

constexpr std::int64_t kNone = -1;

// Which position, uv and normal of the file a corner uses, counted from 0, or kNone.
struct Corner
{
    std::int64_t position = kNone;
    std::int64_t uv = kNone;
    std::int64_t normal = kNone;

    bool operator==(const Corner&) const = default;
};

struct CornerHash
{
    std::size_t operator()(const Corner& corner) const
    {
        auto hash = static_cast<std::uint64_t>(corner.position) * 0x9e3779b97f4a7c15u;
        hash = (hash ^ static_cast<std::uint64_t>(corner.uv)) * 0xbf58476d1ce4e5b9u;
        hash = (hash ^ static_cast<std::uint64_t>(corner.normal)) * 0x94d049bb133111ebu;
        return static_cast<std::size_t>(hash ^ (hash >> 32));
    }
};

// What the file holds, positions and normals already left-handed, faces still in the file's order.
struct Gathered
{
    std::vector<glm::vec3> positions;
    std::vector<glm::vec2> uvs;
    std::vector<glm::vec3> normals;
    std::vector<Corner> corners;           // of all faces, one face after the other
    std::vector<std::size_t> faceLengths;  // corners per face
};

// 0 - x instead of -x, so that 0 stays +0.
glm::vec3 leftHanded(float x, float y, float z)
{
    return {0.0f - x, y, z};
}

// OBJ counts from 1, backwards from the end so far if negative, and 0 is tinyobjloader's word for "not given".
std::int64_t resolve(int index, std::size_t countSoFar)
{
    if (index == 0) return kNone;
    return index > 0 ? std::int64_t{index} - 1 : static_cast<std::int64_t>(countSoFar) + index;
}

void gatherFace(void* user, tinyobj::index_t* indices, int count)
{
    Gathered& gathered = *static_cast<Gathered*>(user);
    for (int i = 0; i < count; ++i) {
        gathered.corners.push_back({resolve(indices[i].vertex_index, gathered.positions.size()),
                                    resolve(indices[i].texcoord_index, gathered.uvs.size()),
                                    resolve(indices[i].normal_index, gathered.normals.size())});
    }
    gathered.faceLengths.push_back(static_cast<std::size_t>(count));
}

bool gather(const std::string& text, Gathered& gathered)
{
    tinyobj::callback_t callbacks;
    callbacks.vertex_cb = [](void* user, float x, float y, float z, float) {
        static_cast<Gathered*>(user)->positions.push_back(leftHanded(x, y, z));
    };
    callbacks.texcoord_cb = [](void* user, float u, float v, float) {
        static_cast<Gathered*>(user)->uvs.emplace_back(u, v);
    };
    callbacks.normal_cb = [](void* user, float x, float y, float z) {
        static_cast<Gathered*>(user)->normals.push_back(leftHanded(x, y, z));
    };
    callbacks.index_cb = gatherFace;
    std::istringstream stream(text);
    return tinyobj::LoadObjWithCallback(stream, callbacks, &gathered);
}

// checkObj has made sure of this; should tinyobjloader cut a line differently, it ends here and not beyond an array.
bool referencesExist(const Gathered& gathered)
{
    const auto exists = [](std::int64_t index, std::size_t count) {
        return index >= kNone && index < static_cast<std::int64_t>(count);
    };
    for (const Corner& corner : gathered.corners) {
        if (corner.position == kNone || !exists(corner.position, gathered.positions.size())) return false;
        if (!exists(corner.uv, gathered.uvs.size()) || !exists(corner.normal, gathered.normals.size())) return false;
    }
    return true;
}

// The corners of all triangles, reversed: negating x has turned every front into a back.
std::vector<Corner> cutIntoTriangles(const Gathered& gathered)
{
    std::vector<Corner> triangles;
    std::vector<glm::vec3> polygon;
    std::size_t first = 0;
    for (const std::size_t length : gathered.faceLengths) {
        polygon.clear();
        for (std::size_t i = first; i < first + length; ++i) {
            polygon.push_back(gathered.positions[static_cast<std::size_t>(gathered.corners[i].position)]);
        }
        for (const auto& [a, b, c] : triangulate(polygon)) {
            for (const std::uint32_t corner : {a, c, b}) triangles.push_back(gathered.corners[first + corner]);
        }
        first += length;
    }
    return triangles;
}

// Smooth normals, one per position of the file, so that vertices which differ only in their uv get the same.
std::vector<glm::vec3> smoothNormals(const Gathered& gathered, const std::vector<Corner>& triangles)
{
    Mesh mesh;
    mesh.positions = gathered.positions;
    for (const Corner& corner : triangles) mesh.indices.push_back(static_cast<std::uint32_t>(corner.position));
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
Mesh weld(const Gathered& gathered, std::vector<Corner> triangles)
{
    bool anyUv = false;
    bool anyNormalMissing = false;
    for (Corner& corner : triangles) {
        if (corner.normal != kNone && gathered.normals[static_cast<std::size_t>(corner.normal)] == glm::vec3(0)) {
            corner.normal = kNone;
        }
        anyUv = anyUv || corner.uv != kNone;
        anyNormalMissing = anyNormalMissing || corner.normal == kNone;
    }
    const std::vector<glm::vec3> computed =
        anyNormalMissing ? smoothNormals(gathered, triangles) : std::vector<glm::vec3>();

    Mesh mesh;
    mesh.indices.reserve(triangles.size());
    std::unordered_map<Corner, std::uint32_t, CornerHash> vertexOf;
    for (const Corner& corner : triangles) {
        const auto [entry, isNew] = vertexOf.try_emplace(corner, static_cast<std::uint32_t>(mesh.positions.size()));
        mesh.indices.push_back(entry->second);
        if (!isNew) continue;
        const auto position = static_cast<std::size_t>(corner.position);
        mesh.positions.push_back(gathered.positions[position]);
        mesh.normals.push_back(corner.normal == kNone
                                   ? computed[position]
                                   : unit(gathered.normals[static_cast<std::size_t>(corner.normal)]));
        if (!anyUv) continue;
        mesh.uvs.push_back(corner.uv == kNone ? glm::vec2(0) : gathered.uvs[static_cast<std::size_t>(corner.uv)]);
    }
    return mesh;
}

}  // namespace

Expected<Mesh> readObj(const std::string& path)
{
    const Expected<std::vector<std::uint8_t>> bytes = readFile(path);
    if (!bytes) return tl::unexpected(bytes.error());
    std::string text(bytes->begin(), bytes->end());
    blankComments(text);
    if (const Expected<void> checked = checkObj(text); !checked) {
        return fail(path + ": " + checked.error().message);
    }

    Gathered gathered;
    if (!gather(text, gathered) || !referencesExist(gathered)) {
        return fail(path + ": is damaged; export it again");
    }
    Mesh mesh = weld(gathered, cutIntoTriangles(gathered));
    mesh.name = utf8Of(pathOf(path).stem());
    if (const Expected<void> valid = validate(mesh); !valid) return fail(path + ": " + valid.error().message);
    return mesh;
}

}  // namespace relief
