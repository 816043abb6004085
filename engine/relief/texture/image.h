// Image files in and out. Read: PNG (8 and 16 bit), JPEG, TGA, BMP, Radiance HDR and PFM, always as four channels, row
// 0 on top. Written: PNG for pictures, HDR and PFM for floats. The numbers are the file's own: whether they are sRGB
// colours, heights or normals is decided where a texture is made of them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "relief/error.h"

namespace relief {

// RGBA, row 0 on top, no padding: pixels.size() is width * height * 4.
template <class Channel>
struct ImageOf
{
    int width = 0;
    int height = 0;
    std::vector<Channel> pixels;
};
using Image8 = ImageOf<std::uint8_t>;
using Image16 = ImageOf<std::uint16_t>;
using ImageFloat = ImageOf<float>;  // linear, finite, at most about 1.7e38; alpha is 1

// 8-bit files of every format, 16-bit PNG, HDR and PFM.
using ImageFile = std::variant<Image8, Image16, ImageFloat>;

inline constexpr int kMaxImageSide = 16384;                                   // pixels, D3D's own limit for textures
inline constexpr std::uint64_t kMaxDecodedBytes = std::uint64_t{1} << 30;     // 16384 x 16384 RGBA8
inline constexpr std::uint64_t kMaxWrittenPngBytes = std::uint64_t{1} << 29;  // before compression

// Reads an image file of any of the formats above. Missing channels are filled as stb_image does: grey becomes
// R = G = B, missing alpha becomes opaque; a colour that a palette does not have is black. An error when the file
// cannot be read, is no image, is of a kind that is not supported (unsupported.h), is truncated or damaged, or is
// larger than kMaxImageSide, kMaxDecodedBytes or the memory that is left; sizes are checked before anything is
// allocated for the pixels.
Expected<ImageFile> readImage(const std::string& path);

// The same for the bytes of a file that lie in another one. Errors begin with `name` in place of the path.
Expected<ImageFile> decodeImage(std::vector<std::uint8_t> bytes, const std::string& name);

// Writes 8-bit RGBA, row 0 on top, as PNG, through writeFileAtomically (file.h). The same pixels give the same bytes.
// An error when a side is not in 1..kMaxImageSide, the span is not width * height * 4 long or longer than
// kMaxWrittenPngBytes, or the file cannot be written.
Expected<void> writePng(const std::string& path, int width, int height, std::span<const std::uint8_t> rgba);

// The bytes of such a file, for another one. Errors begin with `name`.
Expected<std::vector<std::uint8_t>> encodePng(const std::string& name, int width, int height,
                                              std::span<const std::uint8_t> rgba);

// Writes RGB floats, row 0 on top, as little-endian PFM, bit for bit (NaN and infinity too), through
// writeFileAtomically. An error as in writePng, with three channels.
Expected<void> writePfm(const std::string& path, int width, int height, std::span<const float> rgb);

// Writes RGB floats, row 0 on top, as Radiance HDR (RGBE, not compressed), through writeFileAtomically. A channel is
// rounded to 1/255 of the pixel's largest at most; negative numbers and NaN become 0, and what is beyond 1.69e38
// becomes that. An error as in writePfm.
Expected<void> writeHdr(const std::string& path, int width, int height, std::span<const float> rgb);

}  // namespace relief
