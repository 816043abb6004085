// What tinygltf can be given. Releases up to 2.8 take what they do not expect for something else: integers lose their
// upper bits, what should be numbers and is not counts as missing, deep nesting ends in a stack overflow, and a BIN
// chunk that is too long is read past its end. So the file is looked through before.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "relief/error.h"

namespace relief {

inline constexpr int kMaxJsonDepth = 64;

struct GltfText
{
    std::string_view json;
    bool isBinary;  // it is the first chunk of a .glb
};

// The JSON within the bytes of a .gltf or .glb file; refers to them. An error, without the file's name, where a .glb's
// header and chunks do not fit the file.
Expected<GltfText> gltfText(std::span<const std::uint8_t> file);

// Whether readGltf (gltf.h) knows what an extension means.
bool isUnderstood(std::string_view extension);

// What the JSON says of a buffer; without an address it is within the .glb.
struct GltfBuffer
{
    std::string uri;
    std::uint64_t byteLength = 0;
};

// The buffers that it names, if it is JSON, nested at most kMaxJsonDepth deep, with integers of 0 ... 2^31 - 1 wherever
// glTF has indices, counts and offsets, with so many numbers as there have to be where nodes, materials and cameras
// have some, and with buffers that have at most kMaxFileBytes (file.h) together. What `extras` and `extensions` hold
// may be anything. No extension is required that is not understood. An error names the field, without the file's name.
Expected<std::vector<GltfBuffer>> checkGltfText(std::string_view json);

}  // namespace relief
