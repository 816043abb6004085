// glTF 2.0 files in (Khronos, "glTF 2.0 Specification"): .gltf with its buffers and pictures beside it or as data URIs,
// and .glb. tinygltf takes the JSON apart; what it says is checked here before anything is read by it.
#pragma once

#include <string>

#include "relief/scene/scene_file.h"

namespace relief::inline RELIEF_WIDTH {

// Limits of a file, beside kMaxFileBytes: what a small file could otherwise ask for by naming the same data again.
inline constexpr std::size_t kMaxSceneVertices = std::size_t{1} << 24;  // of all meshes
inline constexpr std::size_t kMaxReadVertices = std::size_t{1} << 26;   // of all primitives, which may share them
inline constexpr std::size_t kMaxSceneIndices = std::size_t{1} << 26;   // of all meshes
inline constexpr std::size_t kMaxSceneInstances = std::size_t{1} << 17;
inline constexpr std::size_t kMaxDrawnIndices = std::size_t{1} << 30;  // of all instances
inline constexpr std::size_t kMaxSceneLights = 256;
inline constexpr std::size_t kMaxSceneTexels = std::size_t{1} << 28;  // of all textures

// Reads the file's default scene, or its first, or, where it has none, all nodes without a parent.
//
// - glTF is right-handed with counter-clockwise fronts and uv (0, 0) at the upper left. x is negated, in matrices too
//   (S M S with S = diag(-1, 1, 1, 1)), triangles are reversed, and v becomes 1 - v. glTF's binormal, cross(normal,
//   tangent) * w, points up in the picture, which is our +v; x negated turns the cross product round, so w is negated.
// - Strips and fans become lists; points and lines are left out, with a note. Without normals they are flat, as the
//   specification asks; without tangents and under a normal map MikkTSpace's (mesh/tangents.h).
// - Pictures are read by texture/image.h, 16-bit ones with all their bits. Textures are decoded once for each
//   combination of picture and colour space. Magnification by nearest texels counts for minification too: sampler2D has
//   one filter.
// - Understood extensions: KHR_texture_transform, KHR_materials_unlit, KHR_materials_emissive_strength,
//   KHR_mesh_quantization, KHR_lights_punctual. Others that are used get a note. Orthographic cameras, animations,
//   skins and morph targets are left out, with a note: meshes stand as they were bound.
//
// An error of one line, with the file's name and the field (accessors[3].bufferView), when a file cannot be read, is no
// glTF 2.0, requires another extension, names something that is not there, holds numbers that are not finite, has a
// light whose numbers are out of their range, has nodes that form a cycle or have two parents, exceeds a limit, or has
// nothing to draw. `path` is UTF-8.
Expected<SceneFile> readGltf(const std::string& path);

}  // namespace relief::inline RELIEF_WIDTH
