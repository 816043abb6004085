// Blocks of 4x4 texels: cut out of a level, encoded by stb_dxt, and decoded.
#include "relief/texture/dxt5.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include <stb/stb_dxt.h>

#include "relief/lanes/environment.h"

namespace relief {
namespace {

using Color = std::array<int, 3>;

// 5:6:5 bits to three codes.
Color expand565(int bits)
{
    const int red = bits >> 11 & 31, green = bits >> 5 & 63, blue = bits & 31;
    return {red << 3 | red >> 2, green << 2 | green >> 4, blue << 3 | blue >> 2};
}

constexpr std::uint8_t toCode(int value)
{
    return static_cast<std::uint8_t>(value);
}

// (a * (parts - share) + b * share) / parts, to nearest. Parts are odd, so there are no halves to decide on.
constexpr int between(int a, int b, int share, int parts)
{
    return (a * (parts - share) + b * share + parts / 2) / parts;
}

std::array<std::uint8_t, 8> alphaPalette(int a0, int a1)
{
    std::array<std::uint8_t, 8> palette = {toCode(a0), toCode(a1)};
    const int parts = a0 > a1 ? 7 : 5;
    for (int i = 1; i < parts; ++i) palette[static_cast<std::size_t>(i) + 1] = toCode(between(a0, a1, i, parts));
    if (parts == 5) {
        palette[6] = 0;
        palette[7] = 255;
    }
    return palette;
}

std::array<Color, 4> colorPalette(int bits0, int bits1)
{
    const Color c0 = expand565(bits0), c1 = expand565(bits1);
    std::array<Color, 4> palette = {c0, c1};
    for (std::size_t c = 0; c < 3; ++c) {
        palette[2][c] = between(c0[c], c1[c], 1, 3);
        palette[3][c] = between(c0[c], c1[c], 2, 3);
    }
    return palette;
}

// `count` bytes as one number, little-endian.
std::uint64_t littleEndian(const std::uint8_t* bytes, int count)
{
    std::uint64_t number = 0;
    for (int i = 0; i < count; ++i) number |= std::uint64_t{bytes[i]} << 8 * i;
    return number;
}

int blocksAlong(int side)
{
    return (side + kDxt5BlockSide - 1) / kDxt5BlockSide;
}

// Block (column, row) of a level, edges repeated.
Dxt5Texels texelsOf(const MipLevel& level, int column, int row)
{
    Dxt5Texels texels;
    auto* to = texels.data();
    for (int j = 0; j < kDxt5BlockSide; ++j) {
        for (int i = 0; i < kDxt5BlockSide; ++i, to += 4) {
            const int x = std::min(column * kDxt5BlockSide + i, level.width() - 1);
            const int y = std::min(row * kDxt5BlockSide + j, level.height() - 1);
            std::copy_n(level.texel<std::uint8_t>(x, y), 4, to);
        }
    }
    return texels;
}

}  // namespace

// stb compares whole texels of the colour part as unsigned ints, so they are handed over in memory that holds such, and
// with alpha at 255; the alpha part takes its own 16 bytes.
Dxt5Block encodeDxt5Block(const Dxt5Texels& texels)
{
    const DefaultFloatingPoint environment;
    std::array<unsigned int, 16> opaque;
    static_assert(sizeof(opaque) == sizeof(texels));
    std::memcpy(opaque.data(), texels.data(), sizeof(opaque));
    auto* bytes = reinterpret_cast<unsigned char*>(opaque.data());
    std::array<std::uint8_t, 16> alpha;
    for (std::size_t i = 0; i < alpha.size(); ++i) {
        alpha[i] = texels[i * 4 + 3];
        bytes[i * 4 + 3] = 255;
    }
    Dxt5Block block;
    stb_compress_bc4_block(block.data(), alpha.data());
    stb_compress_dxt_block(block.data() + 8, bytes, 0, STB_DXT_HIGHQUAL);
    return block;
}

Dxt5Texels decodeDxt5Block(const Dxt5Block& block)
{
    const auto alphas = alphaPalette(block[0], block[1]);
    const auto colors = colorPalette(block[8] | block[9] << 8, block[10] | block[11] << 8);
    std::uint64_t alphaSelectors = littleEndian(&block[2], 6), colorSelectors = littleEndian(&block[12], 4);
    Dxt5Texels texels;
    for (std::size_t i = 0; i < 64; i += 4, alphaSelectors >>= 3, colorSelectors >>= 2) {
        const Color& color = colors[colorSelectors & 3];
        for (std::size_t c = 0; c < 3; ++c) texels[i + c] = toCode(color[c]);
        texels[i + 3] = alphas[alphaSelectors & 7];
    }
    return texels;
}

std::vector<Dxt5Block> encodeDxt5(const MipLevel& level)
{
    const int columns = blocksAlong(level.width()), rows = blocksAlong(level.height());
    std::vector<Dxt5Block> blocks;
    blocks.reserve(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            blocks.push_back(encodeDxt5Block(texelsOf(level, column, row)));
        }
    }
    return blocks;
}

MipLevel decodeDxt5(const std::vector<Dxt5Block>& blocks, int width, int height)
{
    MipLevel level(TexelFormat::rgba8, width, height);
    const auto* block = blocks.data();
    for (int top = 0; top < height; top += kDxt5BlockSide) {
        for (int left = 0; left < width; left += kDxt5BlockSide, ++block) {
            const Dxt5Texels texels = decodeDxt5Block(*block);
            const auto columns = static_cast<std::size_t>(std::min(kDxt5BlockSide, width - left));
            for (int j = 0; j < std::min(kDxt5BlockSide, height - top); ++j) {
                std::memcpy(level.texel<std::uint8_t>(left, top + j), &texels[static_cast<std::size_t>(j) * 16],
                            columns * 4);
            }
        }
    }
    level.fillFrame();
    return level;
}

}  // namespace relief
