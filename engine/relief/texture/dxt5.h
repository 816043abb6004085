// DXT5, which Direct3D calls BC3: texels in blocks of 4x4, 16 bytes each. Enters and leaves a level of RGBA codes; what
// leaves is what a sampler of a compressed texture would see. stb_dxt encodes, the decoder is ours.
//
// A block holds two parts (Direct3D 11.3 functional specification, block compression formats, BC3):
//   bytes 0..7: two alphas a0 and a1, then 16 selectors of 3 bits, lowest bits first. Where a0 > a1, selectors 2..7 are
//     the six values between them, (6 a0 + a1) / 7 to (a0 + 6 a1) / 7; else 2..5 are (4 a0 + a1) / 5 to
//     (a0 + 4 a1) / 5, 6 is 0 and 7 is 255.
//   bytes 8..15: two colours of 5:6:5 bits, little-endian, red on top, then 16 selectors of 2 bits: c0, c1,
//     (2 c0 + c1) / 3, (c0 + 2 c1) / 3, in whatever order the colours are. 5 and 6 bits become 8 by repeating their
//     upper bits below.
// Values between two are rounded to the nearest of 256 codes. Direct3D leaves decoders some room here; nearest is the
// middle of it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "relief/texture/mip_chain.h"

namespace relief {

inline constexpr int kDxt5BlockSide = 4;  // texels

using Dxt5Block = std::array<std::uint8_t, 16>;
using Dxt5Texels = std::array<std::uint8_t, 64>;  // RGBA, 4 rows of 4 in the block's order

// The same texels give the same block with every compiler. A block of one colour comes back within 1 of it; exactly,
// what is 0 or 255 in the whole block, and an alpha that is constant there.
Dxt5Block encodeDxt5Block(const Dxt5Texels& texels);
Dxt5Texels decodeDxt5Block(const Dxt5Block& block);

// All blocks of an rgba8 level of any size, from its lower left, rows of ceil(width / 4) blocks; ceil(height / 4) rows.
// Where a side is no multiple of 4, the texels of its last column or row fill the blocks up.
std::vector<Dxt5Block> encodeDxt5(const MipLevel& level);

// The rgba8 level of width x height texels that these blocks hold, frame filled. There must be as many as encodeDxt5
// makes of that size.
MipLevel decodeDxt5(const std::vector<Dxt5Block>& blocks, int width, int height);

}  // namespace relief
