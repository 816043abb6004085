// Which of many records are the same, word for word, in time linear in their number; and vertices split where corners
// disagree. Records are plain words, so that the answer is exact and does not depend on the order of a hash table.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "relief/bits.h"
#include "relief/mesh/mesh.h"

namespace relief {

// The word that stands for a number in a record: its bits, where -0 is 0, because the two compare equal.
inline std::uint32_t weldWord(float number)
{
    return bitCast<std::uint32_t>(number + 0.0f);
}

// For each record the index of the first record that is equal to it: its own, if it is the first.
template <std::size_t kWords>
std::vector<std::uint32_t> firstEqual(const std::vector<std::array<std::uint32_t, kWords>>& records)
{
    // A table with open addressing, at most half full.
    constexpr std::uint32_t kEmpty = 0xffffffffu;
    std::size_t size = 16;
    while (size < 2 * records.size()) size *= 2;
    std::vector<std::uint32_t> table(size, kEmpty);
    std::vector<std::uint32_t> first(records.size());
    for (std::size_t i = 0; i < records.size(); ++i) {
        std::uint64_t hash = 0;
        for (const std::uint32_t word : records[i]) {
            hash = (hash ^ word) * 0x9e3779b97f4a7c15u;  // 2^64 divided by the golden ratio
            hash ^= hash >> 29;
        }
        std::size_t slot = hash & (size - 1);
        while (table[slot] != kEmpty && records[table[slot]] != records[i]) slot = (slot + 1) & (size - 1);
        if (table[slot] == kEmpty) table[slot] = static_cast<std::uint32_t>(i);
        first[i] = table[slot];
    }
    return first;
}

// For each vertex the first with the same position, normal and uv. The mesh must be valid and have uvs.
inline std::vector<std::uint32_t> firstEqualVertices(const Mesh& mesh)
{
    std::vector<std::array<std::uint32_t, 8>> records;
    records.reserve(mesh.positions.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3 position = mesh.positions[i];
        const glm::vec3 normal = mesh.normals[i];
        const glm::vec2 uv = mesh.uvs[i];
        records.push_back({weldWord(position.x), weldWord(position.y), weldWord(position.z), weldWord(normal.x),
                           weldWord(normal.y), weldWord(normal.z), weldWord(uv.x), weldWord(uv.y)});
    }
    return firstEqual(records);
}

// Gives corner i, which is mesh.indices[i], the value values[i] of one of the mesh's streams, for example
// &Mesh::tangents. The stream must have one value for each vertex; vertices without a corner keep theirs. A vertex
// whose corners disagree is split: the value of its first corner keeps the index, and copies with the others are
// appended in the order of first use. The mesh must be valid.
template <class Vector>
void setPerCorner(Mesh& mesh, std::vector<Vector> Mesh::*stream, const std::vector<Vector>& values)
{
    std::vector<std::array<std::uint32_t, Vector::length() + 1>> records(values.size());
    for (std::size_t corner = 0; corner < values.size(); ++corner) {
        for (int axis = 0; axis < Vector::length(); ++axis) {
            records[corner][static_cast<std::size_t>(axis)] = weldWord(values[corner][axis]);
        }
        records[corner].back() = mesh.indices[corner];
    }
    const std::vector<std::uint32_t> first = firstEqual(records);

    std::vector<bool> isUsed(mesh.positions.size(), false);
    const auto append = [](auto& vectors, std::uint32_t vertex) {
        if (vertex < vectors.size()) vectors.push_back(vectors[vertex]);  // streams that the mesh lacks stay empty
    };
    const auto appendAll = [](auto& numbers, std::size_t components, std::uint32_t vertex) {
        if (numbers.empty()) return;
        for (std::size_t i = 0; i < components; ++i) numbers.push_back(numbers[vertex * components + i]);
    };
    for (std::size_t corner = 0; corner < values.size(); ++corner) {
        std::uint32_t& index = mesh.indices[corner];
        if (first[corner] != corner) {
            index = mesh.indices[first[corner]];
            continue;
        }
        if (isUsed[index]) {
            append(mesh.positions, index);
            append(mesh.normals, index);
            append(mesh.uvs, index);
            append(mesh.tangents, index);
            append(mesh.colors, index);
            for (VertexStream& other : mesh.streams) {
                if (other.perInstance) continue;
                appendAll(other.floats, static_cast<std::size_t>(other.components), index);
                appendAll(other.integers, static_cast<std::size_t>(other.components), index);
            }
            index = static_cast<std::uint32_t>(mesh.positions.size() - 1);
        } else {
            isUsed[index] = true;
        }
        (mesh.*stream)[index] = values[corner];
    }
}

}  // namespace relief
