// Vertex streams: what a draw reads of a mesh, as a list of {semantic, index, components, data}. A vertex program's
// VertexData names what it wants by semantic and index; a stream that holds fewer components than the field has is
// filled up with (0, 0, 0, 1), as in Direct3D.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace relief {

// An attribute that a mesh has beside its positions, normals, uvs, tangents and colours: a second uv set, the matrices
// of instances, integers.
struct VertexStream
{
    std::string semantic = {};                // as in HLSL: "TEXCOORD", "COLOR"
    int index = 0;                            // TEXCOORD<index>
    int components = 1;                       // 1 ... 4
    std::vector<float> floats = {};           // `components` for each vertex
    std::vector<std::int32_t> integers = {};  // in place of them, for Int, int2 ... int4
    bool perInstance = false;                 // an element for each instance of a draw, not for each vertex
};

// A stream as a draw reads it. It refers to the mesh.
struct StreamView
{
    const char* semantic;
    int index;
    int components;  // 1 ... 4
    bool isInteger, perInstance;
    const std::uint32_t* words;  // `components` for each element: floats or integers
    std::size_t count;           // elements
};

}  // namespace relief
