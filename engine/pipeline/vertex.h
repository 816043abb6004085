// The vertex stage: runs a vertex program on kLanes vertices at a time. Enters: a mesh's streams. Leaves: clip-space
// positions, their screen positions and codes, and the components to interpolate, vertex after vertex.
#pragma once

#include <algorithm>

#include "hlsl/semantics.h"
#include "mesh/mesh.h"
#include "pipeline/geometry.h"

namespace relief {

// The screen side of `count` <= kLanes vertices that start at `first`: draw.screen and draw.codes from clip positions.
void projectVertices(const DrawGeometry& draw, std::uint32_t first, std::uint32_t count, const float4& clip);

// Whether a mesh has a stream for a semantic, and for all of them.
template <class Field>
inline constexpr bool kMeshHas =
    std::is_same_v<Field, POSITION> || std::is_same_v<Field, NORMAL> || std::is_same_v<Field, TANGENT> ||
    std::is_same_v<Field, TEXCOORD<0, typename Field::Value>>;
template <class... Field>
constexpr bool meshHasAll(FieldList<Field...>)
{
    return (true && ... && kMeshHas<Field>);
}

namespace detail {

// Elements first ... first + count - 1 of a stream of float vectors, component by component. What the stream does not
// have keeps its value.
template <class Element>
void readLanes(const std::vector<Element>& stream, std::uint32_t first, std::uint32_t count, Float (&lanes)[4])
{
    constexpr int components = static_cast<int>(sizeof(Element) / sizeof(float));
    if (count == kLanes && first + kLanes < stream.size()) {
        // Whole lanes, and an element after them: a word beyond an element can be read.
        const std::byte* address[kLanes];
        for (std::uint32_t i = 0; i < kLanes; ++i) address[i] = reinterpret_cast<const std::byte*>(&stream[first + i]);
        native::IntVector word[4];
        if constexpr (components == 2) {
            native::loadTransposedPair(address, word);
        } else {
            native::loadTransposed(address, word);
        }
        for (int c = 0; c < components; ++c) lanes[c] = asFloat(Int(word[c]));
        return;
    }
    for (int c = 0; c < components; ++c) {
        float lane[kLanes];
        lanes[c].store(lane);
        for (std::uint32_t i = 0; i < count && first + i < stream.size(); ++i) lane[i] = stream[first + i][c];
        lanes[c] = Float::load(lane);
    }
}

// Reads one semantic of up to kLanes vertices. What the mesh does not have, for all or for some, reads as zeros.
template <class Field>
void fetch(const Mesh& mesh, std::uint32_t first, std::uint32_t count, Field& field)
{
    static_assert(kMeshHas<Field>);
    Float lanes[4] = {0.0f, 0.0f, 0.0f, std::is_same_v<Field, POSITION> ? 1.0f : 0.0f};
    if constexpr (std::is_same_v<Field, POSITION>) {
        readLanes(mesh.positions, first, count, lanes);
    } else if constexpr (std::is_same_v<Field, NORMAL>) {
        readLanes(mesh.normals, first, count, lanes);
    } else if constexpr (std::is_same_v<Field, TANGENT>) {
        readLanes(mesh.tangents, first, count, lanes);
    } else {
        readLanes(mesh.uvs, first, count, lanes);
    }
    for (int c = 0; c < kComponents<typename Field::Value>; ++c)
        component(static_cast<typename Field::Value&>(field), c) = lanes[c];
}

}  // namespace detail

// Shades vertices first ... first + count - 1 of the draw's mesh.
template <class VertexData, class VertexProgram>
void shadeVertices(const VertexProgram& program, const Mesh& mesh, const DrawGeometry& draw, std::uint32_t first,
                   std::uint32_t count)
{
    for (std::uint32_t begin = first; begin < first + count; begin += kLanes) {
        const std::uint32_t n = std::min<std::uint32_t>(kLanes, first + count - begin);
        VertexData vertex;
        forEachField(vertex, [&](auto& field) { detail::fetch(mesh, begin, n, field); });

        auto interpolators = program(vertex);

        // From one value per lane to one vertex after the other, which is how triangles will ask for them.
        int slot = 0;
        forEachField(interpolators, [&]<class Field>(Field& field) {
            if constexpr (Field::kIsPosition) {
                projectVertices(draw, begin, n, field);
            } else {
                for (int c = 0; c < kComponents<typename Field::Value>; ++c, ++slot) {
                    float lanes[kLanes];
                    component(static_cast<typename Field::Value&>(field), c).store(lanes);
                    float* out = draw.components + static_cast<std::size_t>(begin) * draw.componentCount + slot;
                    for (std::uint32_t i = 0; i < n; ++i) out[i * draw.componentCount] = lanes[i];
                }
            }
        });
    }
}

}  // namespace relief
