// A picture's pixels as the finest level of a texture: turned so that row 0 is the lower row, and decoded to linear
// numbers once, so that a fetch decodes nothing. sRGB codes become 16 bits of linear light, which costs at most 0.025
// of an 8-bit code; everything else stays as it is.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include <glm/vec4.hpp>

#include "relief/texture/color_space.h"
#include "relief/texture/image.h"
#include "relief/texture/mip_chain.h"

namespace relief {

// What is wrong with a picture of width x height made of `numbers` channel values; empty where it can become a texture:
// each side in 1..kMaxTextureSide, and width * height * channels numbers.
std::string problemWithPixels(int width, int height, int channels, std::size_t numbers);
std::string problemWithPixels(const ImageFile& picture);

// The format that a picture is stored in: rgba8 and rgba16 for linear codes of these widths, rgba16 for sRGB codes of
// both, rgba32Float for floats.
TexelFormat formatOf(const ImageFile& picture, ColorSpace meaning);

// The level, frame filled. RGBA, row 0 on top; problemWithPixels must have nothing to say. Alpha is always linear.
// Floats are linear already.
MipLevel levelFromRgba8(int width, int height, std::span<const std::uint8_t> rgba, ColorSpace meaning);
MipLevel levelFromRgba16(int width, int height, std::span<const std::uint16_t> rgba, ColorSpace meaning);
MipLevel levelFromRgbaFloat(int width, int height, std::span<const float> rgba);
MipLevel levelFromRed(int width, int height, std::span<const float> red);
MipLevel levelFromPicture(const ImageFile& picture, ColorSpace meaning);

// A texel of a level as a fetch gives it: UNORM codes in 0..1. x and y as MipLevel::texel takes them.
glm::vec4 readTexel(TexelFormat format, const MipLevel& level, int x, int y);

// 16-bit linear light to the 16-bit sRGB code and back, from tables: linearToSrgb and srgbToLinear16 (color_space.h).
std::uint16_t encodeSrgb16(std::uint16_t linear);
std::uint16_t decodeSrgb16(std::uint16_t code);

}  // namespace relief
