// Wavefront OBJ files in: positions with or without colours, normals, uvs and faces. Materials, groups, lines, points
// and free-form surfaces are passed over, so that a file becomes one mesh.
#pragma once

#include <string>

#include "relief/mesh/mesh.h"

namespace relief {

// Reads an OBJ file, welds corners with the same position, uv and normal to one vertex (in the order of first use) and
// cuts polygons into triangles.
// OBJ is right-handed with counter-clockwise fronts. As in Unity's importer, x is negated to make it left-handed, and
// every triangle is reversed so that its front stays its front, now clockwise; uv (0,0) is the lower left in both.
// Normals are scaled to unit length; those that the file lacks are computed, smooth across uv seams. uvs are empty if
// the file uses none, and (0,0) where only some corners have one. Colours ("v x y z r g b") are taken as linear; they
// are empty if the file has none, and white where only some vertices have one. The mesh has no tangents, and is named
// like the file without its extension. An error, with the line where there is one, when the file cannot be read or is
// not a sound OBJ file (obj_text.h). `path` is UTF-8.
Expected<Mesh> readObj(const std::string& path);

}  // namespace relief
