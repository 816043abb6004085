// From a glTF file's bytes to tinygltf's model of it.
#pragma once

#include <string>

#include "relief/error.h"

namespace tinygltf {
class Model;
}

namespace relief {

// Reads a .gltf or .glb file and the buffers that it names; `model` is empty before. Pictures stay as bytes: those of a
// data URI in Image::image, others where Image::bufferView or Image::uri says. An error when a file cannot be read, is
// refused by gltf_text.h or by tinygltf, or is of another version than 2.
Expected<void> parseGltf(const std::string& path, tinygltf::Model& model);

// The path of a file that a glTF file names, relative to it: "my%20picture.png".
std::string pathBeside(const std::string& gltfPath, const std::string& uri);

}  // namespace relief
