#include "view/pixels.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <span>

#include "relief/check/compare.h"
#include "relief/texture/color_space.h"
#include "relief/texture/image.h"

namespace relief::samples {

namespace {

std::uint32_t pack(const std::uint8_t* channel)
{
    return channel[0] | std::uint32_t{channel[1]} << 8 | std::uint32_t{channel[2]} << 16 |
           std::uint32_t{channel[3]} << 24;
}

std::uint8_t channel(std::uint32_t color, int index)
{
    return static_cast<std::uint8_t>(color >> (8 * index));
}

std::vector<std::uint8_t> bytesOf(const Pixels& picture)
{
    std::vector<std::uint8_t> bytes;
    bytes.reserve(picture.colors.size() * 4);
    for (const std::uint32_t color : picture.colors) {
        for (int i = 0; i < 4; ++i) bytes.push_back(channel(color, i));
    }
    return bytes;
}

}  // namespace

Expected<Pixels> readPixels(const std::string& path)
{
    const Expected<ImageFile> file = readImage(path);
    if (!file) return tl::unexpected(file.error());
    const auto* const image = std::get_if<Image8>(&*file);
    if (image == nullptr) return fail(path + ": has more than 8 bits per channel; take an 8-bit picture");
    Pixels picture{image->width, image->height, {}};
    picture.colors.resize(image->pixels.size() / 4);
    for (std::size_t i = 0; i < picture.colors.size(); ++i) picture.colors[i] = pack(&image->pixels[4 * i]);
    return picture;
}

Expected<void> writePixels(const std::string& path, const Pixels& picture)
{
    return writePng(path, picture.width, picture.height, bytesOf(picture));
}

Pixels beside(const Pixels& left, const Pixels& right, int column)
{
    Pixels both = right;
    const auto width = static_cast<std::size_t>(right.width);
    const auto part = static_cast<std::size_t>(std::clamp(column, 0, right.width));
    for (std::size_t row = 0; row < both.colors.size(); row += width) {
        std::copy_n(left.colors.data() + row, part, both.colors.data() + row);
    }
    return both;
}

Pixels grid(const Pixels& first, const Pixels& second, const Pixels& third)
{
    const auto width = static_cast<std::size_t>(first.width), height = static_cast<std::size_t>(first.height);
    Pixels all{2 * first.width, 2 * first.height, std::vector<std::uint32_t>(4 * width * height, 0xff000000u)};
    const auto put = [&](const Pixels& part, std::size_t column, std::size_t row) {
        for (std::size_t y = 0; y < height; ++y) {
            const auto from = part.colors.begin() + static_cast<std::ptrdiff_t>(y * width);
            const std::size_t to = (y + row * height) * 2 * width + column * width;
            std::copy(from, from + first.width, all.colors.begin() + static_cast<std::ptrdiff_t>(to));
        }
    };
    put(first, 0, 0);
    put(second, 1, 0);
    put(third, 0, 1);
    return all;
}

Difference differenceOf(const Pixels& a, const Pixels& b, int enlargement)
{
    Difference result;
    result.picture = {a.width, a.height, std::vector<std::uint32_t>(a.colors.size(), 0xff000000u)};
    result.pixels = compare(a.width, a.height, bytesOf(a), bytesOf(b)).differing;
    if (result.pixels == 0) return result;
    for (std::size_t i = 0; i < a.colors.size(); ++i) {
        std::uint8_t enlarged[4] = {0, 0, 0, 255};
        for (int k = 0; k < 4; ++k) {
            const int difference = std::abs(channel(a.colors[i], k) - channel(b.colors[i], k));
            if (k < 3) enlarged[k] = static_cast<std::uint8_t>(std::min(255, difference * enlargement));
            if (difference <= result.largest) continue;
            result.largest = difference;
            result.x = static_cast<int>(i) % a.width;
            result.y = static_cast<int>(i) / a.width;
        }
        result.picture.colors[i] = pack(enlarged);
    }
    return result;
}

std::string storedText(std::uint32_t color)
{
    char text[32];
    std::snprintf(text, sizeof text, "%d %d %d %d", channel(color, 0), channel(color, 1), channel(color, 2),
                  channel(color, 3));
    return text;
}

std::string decodedText(std::uint32_t color)
{
    const auto light = [&](int i) { return static_cast<double>(srgbToLinear(channel(color, i))); };
    char text[64];
    std::snprintf(text, sizeof text, "%.4f %.4f %.4f %.4f", light(0), light(1), light(2), channel(color, 3) / 255.0);
    return text;
}

Pixels shrunk(const Pixels& picture, int width, int height)
{
    Pixels small{width, height, {}};
    small.colors.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (int y = 0; y < height; ++y) {
        const int top = y * picture.height / height, bottom = std::max(top + 1, (y + 1) * picture.height / height);
        for (int x = 0; x < width; ++x) {
            const int left = x * picture.width / width, right = std::max(left + 1, (x + 1) * picture.width / width);
            int sums[4] = {};
            for (int row = top; row < bottom; ++row) {
                for (int column = left; column < right; ++column) {
                    for (int k = 0; k < 4; ++k) sums[k] += channel(picture.at(column, row), k);
                }
            }
            std::uint8_t mean[4];
            const int count = (bottom - top) * (right - left);
            for (int k = 0; k < 4; ++k) mean[k] = static_cast<std::uint8_t>(sums[k] / count);
            small.colors.push_back(pack(mean));
        }
    }
    return small;
}

}  // namespace relief::samples
