// Palettes with a colour for every index: stb_image up to 2.28 leaves the entries that a file does not give as they
// were on the stack, and pixels can name them. It also looks for the palette of an OS/2 BMP in the wrong place.
#pragma once

#include <cstdint>
#include <vector>

namespace relief {

// Makes the palette of a PNG (colour type 3) or BMP (1, 4 or 8 bits) 256 entries long; the new ones are black. A BMP
// gets a header of 40 bytes if it had another one. Other files stay as they are, and damaged ones too, unless what is
// wrong with them lies elsewhere.
void fillPalette(std::vector<std::uint8_t>& file);

}  // namespace relief
