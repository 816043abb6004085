// Texels from memory to lanes, one type per texel format. What comes out is "raw": the numbers of the format times a
// constant per channel (kOne is what 1.0 is). Filters mix raw values, and only the end result is scaled by toUnit.
//
// This is where a frame spends its time. So the formats avoid what is slow in wide registers: converting integers to
// floats. A number below 2^16 put into the low mantissa bits of 2^23 is a float already, 2^23 + number, and the
// difference of two such floats is exact; and a channel that sits in bits 8..15 stays there and counts 256-fold.
#pragma once

#include <cstddef>
#include <utility>

#include "hlsl/types.h"
#include "texture/address.h"
#include "texture/mip_chain.h"

namespace relief {

namespace detail {

using Addresses = const std::byte* [kLanes];
using EachLane = std::make_index_sequence<static_cast<std::size_t>(kLanes)>;

// One texel index per lane, in memory: what 16 loads take their addresses from.
class TexelIndices
{
public:
    explicit TexelIndices(Int index) { index.store(indices); }

    // The addresses of the texels from `base` on. Written out lane by lane: as a loop they would go through memory.
    // Every call reads the indices again, on purpose: kept in registers from one call to the next, they do not fit, and
    // moving them out and in costs more than the reading.
    template <int bytesPerTexel>
    void addresses(const std::byte* base, Addresses& out)
    {
        asm("" : "+m"(indices));
        fill<bytesPerTexel>(base, out, EachLane{});
    }

private:
    template <int bytesPerTexel, std::size_t... lane>
    void fill(const std::byte* base, Addresses& out, std::index_sequence<lane...>) const
    {
        ((out[lane] = base + std::size_t{static_cast<std::uint32_t>(indices[lane])} * bytesPerTexel), ...);
    }

    alignas(64) std::int32_t indices[kLanes];
};

inline constexpr float kBias = 8388608.0f;             // 2^23
inline constexpr std::int32_t kBiasBits = 0x4b000000;  // its bits

// The channel in bits 0..7, in bits 8..15 (256-fold), or in bits 0..15, plus kBias.
inline Float biasedLowByte(Int word)
{
    return asFloat((word & 0xff) | kBiasBits);
}
inline Float biasedHighByte(Int word)
{
    return asFloat((word & 0xff00) | kBiasBits);
}
inline Float biasedHalf(Int word)
{
    return asFloat((word & 0xffff) | kBiasBits);
}

// Both with kBias, the result without. Exact in b - a and a - kBias; rounded twice at most, never beyond a and b.
inline Float mixBiased(Float a, Float b, Float t)
{
    return (a - kBias) + (b - a) * t;
}

inline Float mix(Float a, Float b, Float t)
{
    return a + (b - a) * t;
}
inline float4 mix(const float4& a, const float4& b, Float t)
{
    return {mix(a.x, b.x, t), mix(a.y, b.y, t), mix(a.z, b.z, t), mix(a.w, b.w, t)};
}

}  // namespace detail

// RGBA8: red and blue are 0..255, green and alpha 0..255 * 256.
struct FetchRgba8
{
    static constexpr int kBytes = 4;
    static constexpr float kOne[4] = {255.0f, 65280.0f, 255.0f, 65280.0f};

    // The texel at `index`, counted from level.texels().
    static float4 nearest(const MipLevel& level, Int index)
    {
        detail::TexelIndices indices(index);
        detail::Addresses address;
        indices.addresses<kBytes>(level.texels(), address);
        native::IntVector words[2];
        native::loadTransposedPair(address, words);
        const Int rg(words[0]), ba = shiftRightLogical(rg, 16);
        return {detail::biasedLowByte(rg) - detail::kBias, detail::biasedHighByte(rg) - detail::kBias,
                detail::biasedLowByte(ba) - detail::kBias, detail::biasedHighByte(ba) - detail::kBias};
    }

    // Between the texels at index and index + 1, and the two in the row above.
    static float4 bilinear(const MipLevel& level, Int index, Float fx, Float fy)
    {
        detail::TexelIndices indices(index);
        detail::Addresses address;
        indices.addresses<kBytes>(level.texels(), address);
        native::IntVector lower[2], upper[2];
        native::loadTransposedPair(address, lower);
        indices.addresses<kBytes>(level.texels() + level.rowBytes(), address);
        native::loadTransposedPair(address, upper);
        return detail::mix(alongRow(lower, fx), alongRow(upper, fx), fy);
    }

    static Float mix(Float a, Float b, Float t) { return detail::mix(a, b, t); }

    // Correctly rounded c / 255, without a division: 1/255 = 1/256 + 1/65280 (tests/sampler.cpp tries all codes).
    static float4 toUnit(const float4& raw)
    {
        constexpr float large = 1.0f / 256.0f, small = 1.0f / 65280.0f;
        constexpr float large256 = large / 256.0f, small256 = small / 256.0f;
        return {raw.x * large + raw.x * small, raw.y * large256 + raw.y * small256, raw.z * large + raw.z * small,
                raw.w * large256 + raw.w * small256};
    }

private:
    static float4 alongRow(const native::IntVector words[2], Float fx)
    {
        const Int rg0(words[0]), ba0 = shiftRightLogical(rg0, 16);
        const Int rg1(words[1]), ba1 = shiftRightLogical(rg1, 16);
        return {detail::mixBiased(detail::biasedLowByte(rg0), detail::biasedLowByte(rg1), fx),
                detail::mixBiased(detail::biasedHighByte(rg0), detail::biasedHighByte(rg1), fx),
                detail::mixBiased(detail::biasedLowByte(ba0), detail::biasedLowByte(ba1), fx),
                detail::mixBiased(detail::biasedHighByte(ba0), detail::biasedHighByte(ba1), fx)};
    }
};

// RGBA16: 0..65535.
struct FetchRgba16
{
    static constexpr int kBytes = 8;
    static constexpr float kOne[4] = {65535.0f, 65535.0f, 65535.0f, 65535.0f};

    static float4 nearest(const MipLevel& level, Int index)
    {
        detail::TexelIndices indices(index);
        detail::Addresses address;
        indices.addresses<kBytes>(level.texels(), address);
        native::IntVector words[2];
        native::loadTransposedPair(address, words);
        const Int rg(words[0]), ba(words[1]);
        return {detail::biasedHalf(rg) - detail::kBias, detail::biasedHalf(shiftRightLogical(rg, 16)) - detail::kBias,
                detail::biasedHalf(ba) - detail::kBias, detail::biasedHalf(shiftRightLogical(ba, 16)) - detail::kBias};
    }

    static float4 bilinear(const MipLevel& level, Int index, Float fx, Float fy)
    {
        detail::TexelIndices indices(index);
        detail::Addresses address;
        indices.addresses<kBytes>(level.texels(), address);
        native::IntVector lower[4], upper[4];
        native::loadTransposed(address, lower);
        indices.addresses<kBytes>(level.texels() + level.rowBytes(), address);
        native::loadTransposed(address, upper);
        return detail::mix(alongRow(lower, fx), alongRow(upper, fx), fy);
    }

    static Float mix(Float a, Float b, Float t) { return detail::mix(a, b, t); }

    // Correctly rounded c / 65535, as above.
    static float4 toUnit(const float4& raw)
    {
        constexpr float large = 1.0f / 65536.0f, small = 1.0f / (65536.0f * 65535.0f);
        return {raw.x * large + raw.x * small, raw.y * large + raw.y * small, raw.z * large + raw.z * small,
                raw.w * large + raw.w * small};
    }

private:
    static float4 alongRow(const native::IntVector words[4], Float fx)
    {
        const Int rg0(words[0]), ba0(words[1]), rg1(words[2]), ba1(words[3]);
        const auto mixHalves = [fx](Int a, Int b) {
            return detail::mixBiased(detail::biasedHalf(a), detail::biasedHalf(b), fx);
        };
        return {mixHalves(rg0, rg1), mixHalves(shiftRightLogical(rg0, 16), shiftRightLogical(rg1, 16)),
                mixHalves(ba0, ba1), mixHalves(shiftRightLogical(ba0, 16), shiftRightLogical(ba1, 16))};
    }
};

// RGBA32F: as they are.
struct FetchRgba32Float
{
    static constexpr int kBytes = 16;
    static constexpr float kOne[4] = {1.0f, 1.0f, 1.0f, 1.0f};

    static float4 nearest(const MipLevel& level, Int index)
    {
        detail::TexelIndices indices(index);
        detail::Addresses address;
        indices.addresses<kBytes>(level.texels(), address);
        return load(address);
    }

    static float4 bilinear(const MipLevel& level, Int index, Float fx, Float fy)
    {
        detail::TexelIndices indices(index);
        detail::Addresses address;
        indices.addresses<kBytes>(level.texels(), address);
        const float4 lowerLeft = load(address);
        indices.addresses<kBytes>(level.texels() + kBytes, address);
        const float4 lowerRight = load(address);
        indices.addresses<kBytes>(level.texels() + level.rowBytes(), address);
        const float4 upperLeft = load(address);
        indices.addresses<kBytes>(level.texels() + level.rowBytes() + kBytes, address);
        const float4 upperRight = load(address);
        float4 result;
        for (int c = 0; c < 4; ++c) {
            result[c] = mix(mix(lowerLeft[c], lowerRight[c], fx), mix(upperLeft[c], upperRight[c], fx), fy);
        }
        return result;
    }

    // A weight of 0 keeps out what a multiplication by 0 would let in: NaN and infinities.
    static Float mix(Float a, Float b, Float t) { return select(t == 0.0f, a, detail::mix(a, b, t)); }

    static float4 toUnit(const float4& raw) { return raw; }

private:
    static float4 load(const detail::Addresses& address)
    {
        native::IntVector words[4];
        native::loadTransposed(address, words);
        return {asFloat(Int(words[0])), asFloat(Int(words[1])), asFloat(Int(words[2])), asFloat(Int(words[3]))};
    }
};

}  // namespace relief
