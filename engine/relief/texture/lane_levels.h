// Mip levels for lanes that are on several: what a MipLevel is to a fetch, with every number once per lane. All lanes
// then fetch at once, however many levels there are.
#pragma once

#include <bit>

#include "relief/texture/mip_chain.h"

namespace relief::inline RELIEF_WIDTH {

// The first byte of each lane's texels.
struct LaneTexels
{
    const std::byte* const* levels;  // by number
    const std::int32_t* numbers;     // of each lane's level

    [[gnu::always_inline]] const std::byte* operator[](int lane) const { return levels[numbers[lane]]; }
};

class LaneLevels
{
public:
    // `number` says which level is each lane's; others than `lanes`, of which there is one at least, get any of theirs.
    template <class Levels>  // a Texture, a CubeMap
    LaneLevels(const Levels& of, Int number, unsigned lanes)
    {
        number.store(numbers);
        const int first = numbers[std::countr_zero(lanes)];
        number = select(Mask::fromBits(lanes), number, first);
        number.store(numbers);
        set(first, of.level(first), true);
        for (unsigned waiting = lanes & ~(number == first).bits(); waiting != 0;) {
            const int next = numbers[std::countr_zero(waiting)];
            const Mask here = number == next;
            set(next, of.level(next), here);
            waiting &= ~here.bits();
        }
    }

    Int width() const { return columns.texels; }
    Int height() const { return rows.texels; }
    const TextureSides& sideU() const { return columns; }
    const TextureSides& sideV() const { return rows; }
    Int rowTexels() const { return stride; }
    LaneTexels texels() const { return {lower, numbers}; }
    LaneTexels texelsAbove() const { return {upper, numbers}; }
    bool isOpaque() const { return opaque; }  // all of them

private:
    void set(int number, const MipLevel& level, Mask here)
    {
        columns.texels = select(here, level.width(), columns.texels);
        columns.subtexels = select(here, level.sideU().subtexels, columns.subtexels);
        rows.texels = select(here, level.height(), rows.texels);
        rows.subtexels = select(here, level.sideV().subtexels, rows.subtexels);
        stride = select(here, level.rowTexels(), stride);
        lower[number] = level.texels();
        upper[number] = level.texelsAbove();
        opaque &= level.isOpaque();
    }

    TextureSides columns{0, 0.0f}, rows{0, 0.0f};
    Int stride = 0;
    alignas(Int) std::int32_t numbers[kLanes];
    const std::byte *lower[kMaxMipLevels], *upper[kMaxMipLevels];
    bool opaque = true;
};

}  // namespace relief::inline RELIEF_WIDTH
