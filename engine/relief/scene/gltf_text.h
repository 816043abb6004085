// What tinygltf can be given. Releases up to 2.8 take what they do not expect for something else: integers lose their
// upper bits, numbers that are strings count as missing, deep nesting ends in a stack overflow, and a BIN chunk that is
// too long is read past its end. So the file is looked through before.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

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

// Whether it is JSON, nested at most kMaxJsonDepth deep, with integers of 0 ... 2^31 - 1 wherever glTF has indices,
// counts and offsets, and buffers that have at most kMaxFileBytes (file.h) together. What `extras` and `extensions`
// hold may be anything. No extension is required that is not understood. An error names the field, without the file's
// name.
Expected<void> checkGltfText(std::string_view json);

}  // namespace relief
