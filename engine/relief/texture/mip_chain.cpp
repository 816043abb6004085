// Mip levels by area averages: what one coarse texel covers, the sum over it, and the frame around the result.
#include "relief/texture/mip_chain.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <type_traits>

#include "relief/lanes/environment.h"

namespace relief {
namespace {

constexpr int kCacheLine = 64;  // bytes

int paddedRowTexels(TexelFormat format, int width)
{
    const int bytes = (width + 2) * bytesPerTexel(format);
    const int linesNeeded = (bytes + kCacheLine - 1) / kCacheLine;
    return (linesNeeded | 1) * kCacheLine / bytesPerTexel(format);
}

// The fine texels first .. first + count - 1 that one coarse texel covers along one axis, and by how much.
struct Coverage
{
    int first = 0;
    int count = 1;
    std::array<std::uint32_t, 3> weights = {1, 0, 0};
    std::uint32_t total = 1;
};

// Coarse texel i of m covers the fine interval [i n/m, (i + 1) n/m) of n texels. For n = 2m that is two whole texels.
// For n = 2m + 1 it is [2i + i/m, 2i + 2 + (i + 1)/m): parts of three texels, in units of 1/m.
Coverage coverage(int fineSide, int i)
{
    if (fineSide == 1) return {};
    if (fineSide % 2 == 0) return {2 * i, 2, {1, 1, 0}, 2};
    const auto m = static_cast<std::uint32_t>(fineSide / 2);
    const auto part = static_cast<std::uint32_t>(i);
    return {2 * i, 3, {m - part, m, part + 1}, 2 * m + 1};
}

// Exact for every size: 16 bits of texel and 2 * 14 bits of weight fit 64-bit integers. A double holds the 24 bits of
// a float times 28 bits of weight, so that equal texels give themselves.
template <class Channel>
using Sum = std::conditional_t<std::is_floating_point_v<Channel>, double, std::uint64_t>;

template <class Channel>
Channel average(Sum<Channel> sum, Sum<Channel> total)
{
    if constexpr (std::is_floating_point_v<Channel>)
        return static_cast<Channel>(sum / total);
    else
        return static_cast<Channel>((2 * sum + total) / (2 * total));
}

template <class Channel, std::size_t channels>
void averageArea(const MipLevel& fine, const Coverage& across, const Coverage& along, Channel* coarse)
{
    std::array<Sum<Channel>, channels> sum{};
    for (int y = 0; y < along.count; ++y) {
        for (int x = 0; x < across.count; ++x) {
            const Channel* texel = fine.texel<Channel>(across.first + x, along.first + y);
            const auto weight = static_cast<Sum<Channel>>(across.weights[static_cast<std::size_t>(x)]) *
                                along.weights[static_cast<std::size_t>(y)];
            for (std::size_t c = 0; c < channels; ++c) sum[c] += texel[c] * weight;
        }
    }
    const auto total = static_cast<Sum<Channel>>(across.total) * along.total;
    for (std::size_t c = 0; c < channels; ++c) coarse[c] = average<Channel>(sum[c], total);
}

// One row of coarse texels where both sides are even, the usual case: the same result as averageArea, without weights.
template <class Channel, std::size_t n>
void averageRowOfPairs(const Channel* lower, const Channel* upper, Channel* coarse, int width)
{
    for (int x = 0; x < width; ++x, lower += 2 * n, upper += 2 * n, coarse += n) {
        for (std::size_t c = 0; c < n; ++c) {
            if constexpr (std::is_floating_point_v<Channel>) {
                const double sum = static_cast<double>(lower[c]) + lower[c + n] + upper[c] + upper[c + n];
                coarse[c] = static_cast<Channel>(sum * 0.25);
            } else {
                const std::uint32_t sum = std::uint32_t{lower[c]} + lower[c + n] + upper[c] + upper[c + n];
                coarse[c] = static_cast<Channel>((sum + 2) / 4);
            }
        }
    }
}

template <class Channel, std::size_t channels = 4>
void averageLevel(const MipLevel& fine, MipLevel& coarse)
{
    const bool evenSides = fine.width() % 2 == 0 && fine.height() % 2 == 0;
    for (int y = 0; y < coarse.height(); ++y) {
        if (evenSides) {
            averageRowOfPairs<Channel, channels>(fine.texel<Channel>(0, 2 * y), fine.texel<Channel>(0, 2 * y + 1),
                                                 coarse.texel<Channel>(0, y), coarse.width());
            continue;
        }
        const Coverage along = coverage(fine.height(), y);
        for (int x = 0; x < coarse.width(); ++x) {
            averageArea<Channel, channels>(fine, coverage(fine.width(), x), along, coarse.texel<Channel>(x, y));
        }
    }
}

// Stops at the first texel that is not.
template <class Channel>
bool hasFullAlpha(const MipLevel& level)
{
    for (int y = 0; y < level.height(); ++y) {
        const Channel* texel = level.texel<Channel>(0, y);
        for (int x = 0; x < level.width(); ++x) {
            if (texel[4 * x + 3] != std::numeric_limits<Channel>::max()) return false;
        }
    }
    return true;
}

}  // namespace

int mipLevelCount(int width, int height)
{
    return static_cast<int>(std::bit_width(static_cast<unsigned>(std::max(width, height))));
}

std::uint64_t levelBytes(TexelFormat format, int width, int height)
{
    const auto rowBytes = static_cast<std::uint64_t>(paddedRowTexels(format, width) * bytesPerTexel(format));
    return rowBytes * static_cast<std::uint64_t>(height + 2);
}

MipLevel::MipLevel(Unset, TexelFormat format, int width, int height)
    : lines(static_cast<std::size_t>(levelBytes(format, width, height) / kCacheLine)),
      texelFormat(format),
      columns(width),
      rows(height),
      stride(paddedRowTexels(format, width)),
      texelBytes(static_cast<std::size_t>(bytesPerTexel(format))),
      strideInBytes(static_cast<std::size_t>(stride) * texelBytes)
{
}

MipLevel::MipLevel(TexelFormat format, int width, int height) : MipLevel(Unset{}, format, width, height)
{
    std::memset(lines.data()->bytes, 0, lines.size() * kCacheLine);
}

MipLevel MipLevel::forOverwrite(TexelFormat format, int width, int height)
{
    return MipLevel(Unset{}, format, width, height);
}

void MipLevel::fillFrame()
{
    std::byte* base = lines.data()->bytes;
    const auto copy = [&](int toX, int toY, int fromX, int fromY, std::size_t texelsToCopy) {
        std::memcpy(base + offset(toX, toY) * texelBytes, base + offset(fromX, fromY) * texelBytes,
                    texelsToCopy * texelBytes);
    };
    const std::size_t framedBytes = static_cast<std::size_t>(width() + 2) * texelBytes;
    for (int y = 0; y < height(); ++y) {
        copy(-1, y, width() - 1, y, 1);
        copy(width(), y, 0, y, 1);
        std::memset(base + offset(-1, y) * texelBytes + framedBytes, 0, strideInBytes - framedBytes);
    }
    copy(-1, -1, -1, height() - 1, static_cast<std::size_t>(stride));
    copy(-1, height(), -1, 0, static_cast<std::size_t>(stride));
    opaque = (texelFormat == TexelFormat::rgba8 && hasFullAlpha<std::uint8_t>(*this)) ||
             (texelFormat == TexelFormat::rgba16 && hasFullAlpha<std::uint16_t>(*this));
}

void LevelTable::setSize(TexelFormat format, int number, int itsWidth, int itsHeight)
{
    width[number] = itsWidth;
    height[number] = itsHeight;
    rowTexels[number] = paddedRowTexels(format, itsWidth);
}

void LevelTable::setTexels(int number, const MipLevel& level)
{
    texels[number] = level.texels();
    texelsAbove[number] = level.texelsAbove();
    isOpaque[number] = level.isOpaque() && (number == 0 || isOpaque[number - 1]);
}

MipLevel coarserLevel(TexelFormat format, const MipLevel& fine)
{
    const DefaultFloatingPoint environment;
    MipLevel coarse = MipLevel::forOverwrite(format, nextSide(fine.width()), nextSide(fine.height()));
    switch (format) {
        case TexelFormat::rgba8:
            averageLevel<std::uint8_t>(fine, coarse);
            break;
        case TexelFormat::rgba16:
            averageLevel<std::uint16_t>(fine, coarse);
            break;
        case TexelFormat::rgba32Float:
            averageLevel<float>(fine, coarse);
            break;
        case TexelFormat::r32Float:
            averageLevel<float, 1>(fine, coarse);
            break;
    }
    coarse.fillFrame();
    return coarse;
}

}  // namespace relief
