// The mix of texels and grey, in integers where texels are codes.
#include "relief/texture/mip_fade.h"

#include <algorithm>
#include <cstdint>

#include "relief/lanes/environment.h"
#include "relief/texture/pixels.h"

namespace relief {
namespace {

// To nearest, halves up.
int mixCodes(int code, int grey, Fade fade)
{
    return (2 * (code * (fade.span - fade.step) + grey * fade.step) + fade.span) / (2 * fade.span);
}

template <class Channel, int channels = 4, class Mix>
void mixEach(MipLevel& level, Mix mix)
{
    for (int y = 0; y < level.height(); ++y) {
        Channel* texel = level.texel<Channel>(0, y);
        for (int x = 0; x < level.width(); ++x, texel += channels) {
            for (int c = 0; c < std::min(channels, 3); ++c) texel[c] = mix(texel[c]);
        }
    }
    level.fillFrame();
}

}  // namespace

Fade fadeOfLevel(int level, int first, int last)
{
    if (first >= last) return {level >= last ? 1 : 0, 1};
    return {std::clamp(level - first, 0, last - first), last - first};
}

void fadeToGrey(TexelFormat format, ColorSpace meaning, MipLevel& level, Fade fade)
{
    const DefaultFloatingPoint environment;
    if (fade.step == 0) return;
    const auto mix8 = [fade](std::uint8_t code) { return static_cast<std::uint8_t>(mixCodes(code, kGreyCode, fade)); };
    const auto mix16 = [fade](std::uint16_t code) {
        return static_cast<std::uint16_t>(mixCodes(code, kGreyCode * 257, fade));
    };
    const auto mixLight = [mix16](std::uint16_t light) { return decodeSrgb16(mix16(encodeSrgb16(light))); };
    const auto mixFloat = [fade](float value) {
        const double share = static_cast<double>(fade.step) / fade.span;
        return static_cast<float>(static_cast<double>(value) * (1.0 - share) + 0.5 * share);
    };
    switch (format) {
        case TexelFormat::rgba8:
            return mixEach<std::uint8_t>(level, mix8);
        case TexelFormat::rgba16:
            if (meaning == ColorSpace::srgb) return mixEach<std::uint16_t>(level, mixLight);
            return mixEach<std::uint16_t>(level, mix16);
        case TexelFormat::rgba32Float:
            return mixEach<float>(level, mixFloat);
        case TexelFormat::r32Float:
            return mixEach<float, 1>(level, mixFloat);
    }
}

}  // namespace relief
