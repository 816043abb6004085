// Whether a text is an OBJ file that tinyobjloader can be trusted with. That loader takes "abc" for 0, drops faces
// whose vertices do not exist with a warning without a place, and reads past its arrays for some of them.
#pragma once

#include <string>

#include "error.h"

namespace relief {

inline constexpr int kMaxFaceCorners = 1024;  // triangulate() takes a tenth of a second for so many at worst

// Blanks what only gets in a loader's way and keeps every line where it is: a byte order mark and comments.
void blankComments(std::string& text);

// Fails with "line <n>: <what>; <remedy>" at the first v, vt or vn line whose numbers are no plain decimal numbers or
// too few, and the first face with less than three or more than kMaxFaceCorners corners or with a reference that names
// nothing; with "<what>; <remedy>" for a text that is not text or has no face at all. The text is without comments.
Expected<void> checkObj(const std::string& text);

}  // namespace relief
