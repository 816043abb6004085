#include "doctor/normal_picture.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "relief/texture/color_space.h"

namespace relief::samples::doctor {

namespace {

std::optional<std::array<float, 4>> backgroundOf(const Channels& channels)
{
    std::map<std::array<float, 4>, std::size_t> count;
    for (const auto& t : channels.texels) {
        const float length = lengthOf({2 * t[0] - 1, 2 * t[1] - 1, 2 * t[2] - 1});
        if (std::abs(length - 1.0f) > 0.5f) ++count[t];
    }
    const auto most =
        std::max_element(count.begin(), count.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    if (most == count.end() || most->second * 20 < channels.texels.size()) return std::nullopt;
    return most->first;
}

}  // namespace

Channels channelsOf(const ImageFile& picture)
{
    Channels all = std::visit(
        [](const auto& image) {
            using Channel = std::decay_t<decltype(image.pixels[0])>;
            Channels channels;
            channels.width = image.width;
            channels.height = image.height;
            channels.step = std::is_same_v<Channel, std::uint8_t>    ? 1.0f / 255.0f
                            : std::is_same_v<Channel, std::uint16_t> ? 1.0f / 65535.0f
                                                                     : 0.0f;
            const float one = channels.step == 0.0f ? 1.0f : channels.step;
            channels.texels.resize(image.pixels.size() / 4);
            const auto row = static_cast<std::size_t>(image.width);
            for (std::size_t i = 0; i < channels.texels.size(); ++i) {
                const std::size_t from = (static_cast<std::size_t>(image.height) - 1 - i / row) * row + i % row;
                for (std::size_t c = 0; c < 4; ++c)
                    channels.texels[i][c] = static_cast<float>(image.pixels[from * 4 + c]) * one;
            }
            return channels;
        },
        picture);
    all.background = backgroundOf(all);
    return all;
}

float restored(float code, Transfer transfer)
{
    if (transfer == Transfer::wasEncoded) return static_cast<float>(decodeSrgb(code));
    if (transfer == Transfer::wasDecoded) return linearToSrgb(Float(code))[0];
    return code;
}

NormalField fieldOf(const Channels& channels, Layout layout, Transfer transfer)
{
    NormalField field{channels.width, channels.height, {}};
    field.normals.reserve(channels.texels.size());
    // A picture has few codes, and many texels.
    std::vector<float> table(256);
    for (std::size_t i = 0; i < table.size(); ++i)
        table[i] = 2.0f * restored(static_cast<float>(i) / 255.0f, transfer) - 1.0f;
    const bool isByte = channels.step == 1.0f / 255.0f;
    const auto number = [&](float code) {
        return isByte ? table[static_cast<std::size_t>(code * 255.0f + 0.5f)] : 2.0f * restored(code, transfer) - 1.0f;
    };
    for (const std::array<float, 4>& t : channels.texels) {
        if (layout == Layout::rgb && channels.background && t == *channels.background) {
            field.normals.push_back({0, 0, 1});
            continue;
        }
        if (layout == Layout::rgb) {
            field.normals.push_back({number(t[0]), number(t[1]), number(t[2])});
        } else {
            const float x = 2.0f * t[3] - 1.0f, y = number(t[1]);  // alpha is never sRGB
            field.normals.push_back({x, y, std::sqrt(std::max(0.0f, 1.0f - x * x - y * y))});
        }
    }
    return field;
}

float lengthOf(const Vector& v)
{
    return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

Image8 pictureOf(const NormalField& field)
{
    Image8 picture{field.width, field.height, {}};
    picture.pixels.resize(field.normals.size() * 4);
    const auto row = static_cast<std::size_t>(field.width);
    for (std::size_t i = 0; i < field.normals.size(); ++i) {
        const std::size_t to = (static_cast<std::size_t>(field.height) - 1 - i / row) * row + i % row;
        for (std::size_t c = 0; c < 3; ++c) {
            const float code = std::clamp(field.normals[i][c] * 0.5f + 0.5f, 0.0f, 1.0f) * 255.0f;
            picture.pixels[to * 4 + c] = static_cast<std::uint8_t>(std::floor(code + 0.5f));
        }
        picture.pixels[to * 4 + 3] = 255;
    }
    return picture;
}

}  // namespace relief::samples::doctor
