// PFM files in: pictures of floats, as writePfm() and many other programs write them.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "relief/texture/image.h"

namespace relief {

// Whether a file begins as a PFM: "PF" (three channels) or "Pf" (grey).
bool isPfm(std::span<const std::uint8_t> bytes);

// The picture, row 0 on top, grey as R = G = B. The header's scale says by its sign which byte comes first; its size is
// not applied. An error, with `name` in front, when the header is damaged, a side is not in 1..kMaxImageSide, the
// picture is larger than kMaxDecodedBytes or memory, numbers are missing, or one is NaN, infinite or beyond 1.7e38.
Expected<ImageFloat> decodePfm(const std::string& name, std::span<const std::uint8_t> bytes);

}  // namespace relief
