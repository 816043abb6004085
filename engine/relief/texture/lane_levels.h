// Mip levels for lanes that are on several: what a MipLevel is to a fetch, with every number once per lane. All lanes
// then fetch at once, however many levels there are.
#pragma once

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
    // `number` says which level is each lane's; others than `lanes` get level 0.
    template <class Levels>  // a Texture, a CubeMap
    LaneLevels(const Levels& of, Int number, unsigned lanes)
    {
        number = select(Mask::fromBits(lanes), number, Int(0));
        number.store(numbers);
        if (any(number >= of.levelsBuilt())) [[unlikely]]
            build(of);
        table = &of.levelTable();
        columns = sides(lookUp(table->width, number));
        rows = sides(lookUp(table->height, number));
        stride = lookUp(table->rowTexels, number);
        opaque = table->isOpaque[of.levelsBuilt() - 1];
    }

    Int width() const { return columns.texels; }
    Int height() const { return rows.texels; }
    const TextureSides& sideU() const { return columns; }
    const TextureSides& sideV() const { return rows; }
    Int rowTexels() const { return stride; }
    LaneTexels texels() const { return {table->texels, numbers}; }
    LaneTexels texelsAbove() const { return {table->texelsAbove, numbers}; }
    bool isOpaque() const { return opaque; }  // all of them

private:
    template <class Levels>
    [[gnu::noinline, gnu::cold]] void build(const Levels& of) const
    {
        for (const std::int32_t number : numbers) (void)of.level(number);
    }

    static TextureSides sides(Int texels) { return {texels, Float(texels) * static_cast<float>(kSubtexels)}; }

    // Of a table by level.
    static Int lookUp(const std::int32_t (&byLevel)[LevelTable::kSize], Int number)
    {
        Int result = permute(Int::load(byLevel), number & (kLanes - 1));
        for (int first = kLanes; first < LevelTable::kSize; first += kLanes)
            result = select(number >= first, permute(Int::load(byLevel + first), number & (kLanes - 1)), result);
        return result;
    }

    const LevelTable* table;
    TextureSides columns, rows;
    Int stride;
    alignas(Int) std::int32_t numbers[kLanes];
    bool opaque;
};

}  // namespace relief::inline RELIEF_WIDTH
