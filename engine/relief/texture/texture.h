// A texture: a picture decoded to linear numbers, and its smaller versions (mip levels), which are built when first
// asked for. Row 0 in memory is the picture's lower row, so that uv (0, 0) is its lower left corner; pictures come in
// with row 0 on top, as files have it, and are flipped once here.
//
// sRGB pictures are decoded when they come in, to 16 bits of linear light: a fetch then decodes nothing, and levels are
// averaged in linear light without losing bits. Decoding to 16 bits costs at most 0.025 of an 8-bit sRGB code.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>

#include <glm/vec4.hpp>

#include "relief/error.h"
#include "relief/texture/color_space.h"
#include "relief/texture/mip_chain.h"

namespace relief {

class Texture
{
public:
    // From RGBA pixels, row 0 on top: width * height * 4 numbers. `srgb` decodes red, green and blue (alpha is always
    // linear) and stores 16 bits per channel; `linear` stores the numbers as they are. An error when a side is not in
    // 1..kMaxTextureSide, the span has another length, or the texture and its levels do not fit into memory.
    static Expected<Texture> fromRgba8(int width, int height, std::span<const std::uint8_t> rgba, ColorSpace meaning);
    static Expected<Texture> fromRgba16(int width, int height, std::span<const std::uint16_t> rgba, ColorSpace meaning);

    // High dynamic range, linear. Texels should be finite and at most 1.7e38 (half the range of floats, so that
    // differences are finite too); a NaN or infinity spreads to the fetches that give it a weight above 0 and to the
    // coarser levels, and nowhere else.
    static Expected<Texture> fromRgbaFloat(int width, int height, std::span<const float> rgba);

    // The same with one number a texel, width * height of them: depths, heights.
    static Expected<Texture> fromRed(int width, int height, std::span<const float> red);

    // From levels that somebody makes when they are first asked for, level 0 included. `make` is called once per level,
    // in order from 0, by one thread at a time; it gets the level's number and the level before (null for level 0), and
    // returns one of `format`, frame filled, with sides width, height or nextSide() of those before. It is dropped with
    // all it holds after the last level. A texture of one texel is made at once. An error when a side is not in
    // 1..kMaxTextureSide, or the texture and its levels do not fit into memory.
    using MakeLevel = std::function<MipLevel(int level, const MipLevel* finer)>;
    static Expected<Texture> fromLevels(TexelFormat format, int width, int height, MakeLevel make);

    // One that is drawn into, again and again (framebuffer.h): what is sampled stays as it is until show(). All texels
    // are 0 at first. An error as above.
    static Expected<Texture> forDrawing(TexelFormat format, int width, int height);

    // The level to draw into next: all texels, and not the frame. Only a texture made by forDrawing() has one.
    MipLevel& hidden() { return *chain->hidden; }

    // What was drawn is level 0 from now on, what was level 0 is hidden, and coarser levels are built anew when they
    // are asked for. Not while anybody samples.
    void show();

    // One texel of a constant: what a material samples that has no texture of its own.
    static const Texture& white();       // (1, 1, 1, 1)
    static const Texture& grey();        // sRGB code 128 in linear light, (0.2158, 0.2158, 0.2158, 1)
    static const Texture& black();       // (0, 0, 0, 1)
    static const Texture& flatNormal();  // (0.5, 0.5, 1, 0.5): exactly (0, 0, 1), read as RGB or as AG (DXT5nm)

    int width() const { return columns; }
    int height() const { return rows; }
    TexelFormat format() const { return texelFormat; }
    int levelCount() const { return levels; }

    // (1 / width, 1 / height, width, height): Unity's _TexelSize.
    const glm::vec4& texelSize() const { return sizes; }

    // A texel of level 0 as a fetch gives it, x = 0..width - 1 from the left, y = 0..height - 1 from below.
    glm::vec4 texel(int x, int y) const;

    // A texture of one texel is the same everywhere: constant() is texel(0, 0), and nothing for other textures.
    bool isConstant() const { return levels == 1; }
    const glm::vec4& constant() const { return firstTexel; }

    // Level k in 0..levelCount() - 1. The first call for a level builds it, and those between; any number of threads
    // may ask at once. The reference stays valid as long as the texture, also when the texture is moved.
    const MipLevel& level(int k) const
    {
        return k < levelsBuilt() ? *chain->levels[static_cast<std::size_t>(k)] : buildLevel(k);
    }

    // How many levels exist in memory by now: 1 for a texture that was only ever magnified, 0 for one from fromLevels
    // that was never sampled.
    int levelsBuilt() const { return chain->built.load(std::memory_order_acquire); }

    // Of these.
    const LevelTable& levelTable() const { return chain->table; }

private:
    // Behind a pointer, so that a texture can be moved although other threads hold on to its levels.
    struct Chain
    {
        std::atomic<int> built{0};
        std::array<std::optional<MipLevel>, kMaxMipLevels> levels;  // written under the mutex, once each
        LevelTable table;                                           // its texels, too
        std::optional<MipLevel> hidden;                             // where it is drawn into
        MakeLevel make;
        std::mutex building;
    };

    Texture(TexelFormat format, int width, int height, MakeLevel make);
    Texture(TexelFormat format, MipLevel finest);  // coarser levels by coarserLevel()
    const MipLevel& buildLevel(int k) const;
    void add(MipLevel level) const;

    std::unique_ptr<Chain> chain;
    glm::vec4 firstTexel, sizes;
    TexelFormat texelFormat;
    int columns, rows, levels;
};

}  // namespace relief
