// Texels from memory to lanes, one type per texel format. What comes out is "raw": the numbers of the format times a
// constant (kOne is what 1.0 is). Filters mix raw values, and only the end result is scaled by toUnit. A Level is a
// MipLevel, or one for each lane (LaneLevels).
//
// This is where a frame spends its time. So 8-bit texels are weighted in integers, two products at a time, and 16-bit
// ones avoid the conversion to floats: a number below 2^16 put into the low mantissa bits of 2^23 is a float already,
// 2^23 + number, and the difference of two such floats is exact.
#pragma once

#include <bit>
#include <cstddef>
#include <type_traits>

#include "relief/hlsl/types.h"
#include "relief/texture/address.h"
#include "relief/texture/lane_levels.h"

namespace relief::inline RELIEF_WIDTH {

namespace detail {

// One texel index per lane, in memory: what the loads take their addresses from.
class TexelIndices
{
public:
    explicit TexelIndices(Int index)
    {
        index.store(indices);
        asm("" : "+m"(indices));  // or the compiler would take the lanes out of the register, one shuffle each
    }

    // Where a lane's texel is. Texels: the address of all lanes' level, or LaneTexels.
    template <int bytesPerTexel, class Texels>
    struct Address
    {
        Texels texels;
        const std::int32_t* indices;

        [[gnu::always_inline]] const std::byte* operator()(int lane) const
        {
            const std::size_t offset = std::size_t{static_cast<std::uint32_t>(indices[lane])} * bytesPerTexel;
            if constexpr (std::is_same_v<Texels, LaneTexels>) {
                return texels[lane] + offset;
            } else {
                return texels + offset;
            }
        }
    };

    template <int bytesPerTexel, class Texels>
    Address<bytesPerTexel, Texels> from(Texels texels) const
    {
        return {texels, indices};
    }

private:
    alignas(native::IntVector) std::int32_t indices[kLanes];
};

// A word of four bytes of memory, or of two halves, with the first one lowest: as it is, but for machines that put the
// last one there.
inline Int wordOfBytes(native::IntVector loaded)
{
    const Int word(loaded);
    if constexpr (std::endian::native == std::endian::little) return word;
    return shiftRightLogical(word, 24) | (shiftRightLogical(word, 8) & 0xff00) | (word << 8 & 0xff0000) | word << 24;
}

inline Int wordOfHalves(native::IntVector loaded)
{
    const Int word(loaded);
    if constexpr (std::endian::native == std::endian::little) return word;
    return shiftRightLogical(word, 16) | word << 16;
}

inline constexpr float kBias = 8388608.0f;             // 2^23
inline constexpr std::int32_t kBiasBits = 0x4b000000;  // its bits

// The low 16 bits plus kBias.
inline Float biasedHalf(Int word)
{
    return asFloat((word & 0xffff) | kBiasBits);
}

// The same of the high 16 bits.
inline Float biasedUpperHalf(Int word)
{
    return asFloat(shiftRightLogical(word, 16) | kBiasBits);
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

// RGBA8: 0..255, times 4096.
struct FetchRgba8
{
    static constexpr int kBytes = 4;
    static constexpr float kOne = 255.0f * kSubtexels;

    // The texel at `index`, counted from level.texels().
    template <class Level>
    static float4 nearest(const Level& level, Int index)
    {
        native::IntVector words[2];
        const detail::TexelIndices indices(index);
        native::loadTransposed<native::TwoWords>(indices.from<kBytes>(level.texels()), words);
        const Int rgba = detail::wordOfBytes(words[0]);
        const auto channel = [rgba](int shift) { return Float((rgba >> shift & 255) << kSubtexelBits); };
        return {channel(0), channel(8), channel(16), channel(24)};
    }

    // Between the texels at index and index + 1, and the two in the row above. fx and fy count 1/4096.
    //
    // Along the rows in integers, which are exact (20 bits), with red and green of both texels in one register, blue
    // and alpha in the other; then between the rows in floats.
    template <class Level>
    [[gnu::always_inline]] static float4 bilinear(const Level& level, Int index, Int fx, Int fy)
    {
        native::IntVector lower[2], upper[2];
        const detail::TexelIndices indices(index);
        native::loadTransposed<native::TwoWords>(indices.from<kBytes>(level.texels()),
                                                 indices.from<kBytes>(level.texelsAbove()), lower, upper);
        const Int weights =
            (fx << 16) + (kSubtexels - fx);  // of the left texel in the low half, of the right one above
        const Row a = alongRow(lower, weights), b = alongRow(upper, weights);
        const Float t = Float(fy) * (1.0f / kSubtexels);
        const auto between = [t](Int l, Int u) { return Float(l) + Float(u - l) * t; };
        return {between(a.red, b.red), between(a.green, b.green), between(a.blue, b.blue), between(a.alpha, b.alpha)};
    }

    static Float mix(Float a, Float b, Float t) { return detail::mix(a, b, t); }

    // Correctly rounded c / 255, without a division: 1/255 = 1/256 + 1/65280 (tests/sampler.cpp tries all codes).
    static float4 toUnit(const float4& raw)
    {
        constexpr float large = 1.0f / (256.0f * kSubtexels), small = 1.0f / (65280.0f * kSubtexels);
        return {raw.x * large + raw.x * small, raw.y * large + raw.y * small, raw.z * large + raw.z * small,
                raw.w * large + raw.w * small};
    }

private:
    struct Row
    {
        Int red, green, blue, alpha;
    };

    static Row alongRow(const native::IntVector texels[2], Int weights)
    {
        const Int left = detail::wordOfBytes(texels[0]), right = detail::wordOfBytes(texels[1]);
        const Int rg = (left & 0xffff) | right << 16;
        const Int ba = shiftRightLogical(left, 16) | (right & static_cast<std::int32_t>(0xffff0000));
        const auto lower = [weights](Int bytes) { return multiplyAddHalves(bytes & 0x00ff00ff, weights); };
        const auto upper = [weights](Int bytes) { return multiplyAddHalves(upperBytes(bytes), weights); };
        return {lower(rg), upper(rg), lower(ba), upper(ba)};
    }
};

// RGBA16: 0..65535.
struct FetchRgba16
{
    static constexpr int kBytes = 8;
    static constexpr float kOne = 65535.0f;

    template <class Level>
    static float4 nearest(const Level& level, Int index)
    {
        native::IntVector words[2];
        const detail::TexelIndices indices(index);
        native::loadTransposed<native::TwoWords>(indices.from<kBytes>(level.texels()), words);
        const Int rg = detail::wordOfHalves(words[0]), ba = detail::wordOfHalves(words[1]);
        return {detail::biasedHalf(rg) - detail::kBias, detail::biasedUpperHalf(rg) - detail::kBias,
                detail::biasedHalf(ba) - detail::kBias, detail::biasedUpperHalf(ba) - detail::kBias};
    }

    template <class Level>
    [[gnu::always_inline]] static float4 bilinear(const Level& level, Int index, Int fx, Int fy)
    {
        native::IntVector lower[4], upper[4];
        const detail::TexelIndices indices(index);
        native::loadTransposed<native::FourWords>(indices.from<kBytes>(level.texels()),
                                                  indices.from<kBytes>(level.texelsAbove()), lower, upper);
        const Float tx = Float(fx) * (1.0f / kSubtexels), ty = Float(fy) * (1.0f / kSubtexels);
        return detail::mix(alongRow(lower, tx), alongRow(upper, tx), ty);
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
    [[gnu::always_inline]] static float4 alongRow(const native::IntVector words[4], Float fx)
    {
        const Int rg0 = detail::wordOfHalves(words[0]), ba0 = detail::wordOfHalves(words[1]);
        const Int rg1 = detail::wordOfHalves(words[2]), ba1 = detail::wordOfHalves(words[3]);
        const auto lower = [fx](Int a, Int b) {
            return detail::mixBiased(detail::biasedHalf(a), detail::biasedHalf(b), fx);
        };
        const auto upper = [fx](Int a, Int b) {
            return detail::mixBiased(detail::biasedUpperHalf(a), detail::biasedUpperHalf(b), fx);
        };
        return {lower(rg0, rg1), upper(rg0, rg1), lower(ba0, ba1), upper(ba0, ba1)};
    }
};

// RGBA32F: as they are.
struct FetchRgba32Float
{
    static constexpr int kBytes = 16;
    static constexpr float kOne = 1.0f;

    template <class Level>
    static float4 nearest(const Level& level, Int index)
    {
        return load(level.texels(), index);
    }

    template <class Level>
    static float4 bilinear(const Level& level, Int index, Int fx, Int fy)
    {
        const float4 lowerLeft = load(level.texels(), index), lowerRight = load(level.texels(), index, kBytes);
        const float4 upperLeft = load(level.texelsAbove(), index);
        const float4 upperRight = load(level.texelsAbove(), index, kBytes);
        const Float tx = Float(fx) * (1.0f / kSubtexels), ty = Float(fy) * (1.0f / kSubtexels);
        float4 result;
        for (int c = 0; c < 4; ++c) {
            result[c] = mix(mix(lowerLeft[c], lowerRight[c], tx), mix(upperLeft[c], upperRight[c], tx), ty);
        }
        return result;
    }

    // A weight of 0 keeps out what a multiplication by 0 would let in: NaN and infinities.
    static Float mix(Float a, Float b, Float t) { return select(t == 0.0f, a, detail::mix(a, b, t)); }

    static float4 toUnit(const float4& raw) { return raw; }

private:
    template <class Texels>
    static float4 load(Texels texels, Int index, int bytesAfter = 0)
    {
        native::IntVector words[4];
        const detail::TexelIndices indices(index);
        const auto at = indices.from<kBytes>(texels);
        native::loadTransposed<native::FourWords>([&](int lane) { return at(lane) + bytesAfter; }, words);
        return {asFloat(Int(words[0])), asFloat(Int(words[1])), asFloat(Int(words[2])), asFloat(Int(words[3]))};
    }
};

// R32F: red as it is, and (0, 0, 1).
struct FetchR32Float
{
    static constexpr int kBytes = 4;
    static constexpr float kOne = 1.0f;

    // The 2x2 texels from `index` on.
    struct Square
    {
        Float lowerLeft, lowerRight, upperLeft, upperRight;
    };
    template <class Level>
    static Square square(const Level& level, Int index)
    {
        native::IntVector lower[2], upper[2];
        const detail::TexelIndices indices(index);
        native::loadTransposed<native::TwoWords>(indices.from<kBytes>(level.texels()),
                                                 indices.from<kBytes>(level.texelsAbove()), lower, upper);
        return {asFloat(Int(lower[0])), asFloat(Int(lower[1])), asFloat(Int(upper[0])), asFloat(Int(upper[1]))};
    }

    template <class Level>
    static float4 nearest(const Level& level, Int index)
    {
        native::IntVector words[2];
        const detail::TexelIndices indices(index);
        native::loadTransposed<native::TwoWords>(indices.from<kBytes>(level.texels()), words);
        return red(asFloat(Int(words[0])));
    }

    template <class Level>
    static float4 bilinear(const Level& level, Int index, Int fx, Int fy)
    {
        const Square s = square(level, index);
        const Float tx = Float(fx) * (1.0f / kSubtexels), ty = Float(fy) * (1.0f / kSubtexels);
        return red(mix(mix(s.lowerLeft, s.lowerRight, tx), mix(s.upperLeft, s.upperRight, tx), ty));
    }

    static Float mix(Float a, Float b, Float t) { return FetchRgba32Float::mix(a, b, t); }

    static float4 toUnit(const float4& raw) { return raw; }

private:
    static float4 red(Float value) { return {value, Float(0.0f), Float(0.0f), Float(1.0f)}; }
};

// Calls function.operator()<Fetch>() with the type for a format.
template <class Function>
[[gnu::always_inline]] inline auto withFetch(TexelFormat format, const Function& function)
{
    switch (format) {
        case TexelFormat::rgba8:
            return function.template operator()<FetchRgba8>();
        case TexelFormat::rgba16:
            return function.template operator()<FetchRgba16>();
        case TexelFormat::r32Float:
            return function.template operator()<FetchR32Float>();
        case TexelFormat::rgba32Float:
            break;
    }
    return function.template operator()<FetchRgba32Float>();
}

// The same for levels whose alpha is 1 everywhere: a quarter of the filter is left out.
template <class Fetch>
struct Opaque : Fetch
{
    template <class Level>
    static float4 nearest(const Level& level, Int index)
    {
        const float4 c = Fetch::nearest(level, index);
        return {c.x, c.y, c.z, Float(Fetch::kOne)};
    }

    template <class Level>
    [[gnu::always_inline]] static float4 bilinear(const Level& level, Int index, Int fx, Int fy)
    {
        const float4 c = Fetch::bilinear(level, index, fx, fy);
        return {c.x, c.y, c.z, Float(Fetch::kOne)};
    }
};

template <class Fetch>
inline constexpr bool kIsOpaque = false;
template <class Fetch>
inline constexpr bool kIsOpaque<Opaque<Fetch>> = true;

}  // namespace relief::inline RELIEF_WIDTH
