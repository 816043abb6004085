// The text of an OBJ file, checked and taken apart in one pass: what each line says, in the file's own order, its own
// right-handed space and its own winding. What becomes of it is the business of obj.cpp.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "relief/error.h"

namespace relief {

inline constexpr int kMaxFaceCorners = 1024;  // triangulate() takes a tenth of a second for so many at worst

// Which position, uv and normal of the file a corner uses, counted from 0.
struct ObjCorner
{
    static constexpr std::uint32_t kNone = 0xffffffffu;

    std::uint32_t position = kNone;  // never kNone in what parseObj returns
    std::uint32_t uv = kNone;
    std::uint32_t normal = kNone;

    bool operator==(const ObjCorner&) const = default;
};

struct ObjText
{
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> colors;  // as many as positions, or none; white where a line lacks one
    std::vector<glm::vec2> uvs;
    std::vector<glm::vec3> normals;
    std::vector<ObjCorner> corners;          // of all faces, one face after the other
    std::vector<std::uint32_t> faceLengths;  // corners per face
};

// Takes v (three numbers, or six with a colour; others behind the third are not used), vt, vn and f lines, and passes
// over all other words. References to normals that the file lacks count as none.
//
// Fails with "line <n>: <what>; <remedy>" at the first line whose numbers are no plain decimal numbers of a float's
// range or too few, or that is a face with less than three or more than kMaxFaceCorners corners or with a reference to
// nothing; whether what comes later exists is looked at last. Fails with "<what>; <remedy>" for a text that is not text
// or has no face at all.
Expected<ObjText> parseObj(std::string_view text);

}  // namespace relief
