#include "common/inside.h"

#include <algorithm>
#include <cmath>

#include "common/overlay.h"
#include "relief/trace/variable.h"

namespace relief::samples {

namespace {

constexpr SrgbCode kNothing = {20, 20, 24};      // where there is no value
constexpr SrgbCode kNoNumber = {255, 0, 255};    // NaN or infinite
constexpr SrgbCode kTileBorder = {255, 140, 0};  // in the view of blocks

std::uint32_t packed(const SrgbCode& c)
{
    return 0xff000000u | static_cast<std::uint32_t>(c[2]) << 16 | static_cast<std::uint32_t>(c[1]) << 8 | c[0];
}

// How far a value is on the way from the lowest to the highest.
float partOf(const Inspection& seen, float value)
{
    const float lowest = seen.lowest * 0.5f, range = seen.highest * 0.5f - lowest;  // half, or it might be infinite
    return range > 0.0f ? std::clamp((value * 0.5f - lowest) / range, 0.0f, 1.0f) : 0.0f;
}

SrgbCode colorOf(const Inspection& seen, const glm::vec4& value, std::uint32_t picture)
{
    SrgbCode color = {};
    switch (seen.showAs) {
        case ShowAs::picture:
            break;
        case ShowAs::scale:
            return std::isfinite(value.x) ? ramp(partOf(seen, value.x)) : kNoNumber;
        case ShowAs::vector:
            for (int c = 0; c < std::min(seen.components, 3); ++c) {
                if (!std::isfinite(value[c])) return kNoNumber;
                color[static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(partOf(seen, value[c]) * 255.0f + 0.5f);
            }
            return color;
        case ShowAs::names: {
            const auto name = static_cast<std::uint32_t>(value.x);
            for (std::size_t c = 0; c < 3; ++c)
                color[c] = static_cast<std::uint8_t>(64 + (name >> 8 * c & 0xffu) * 3 / 4);
            return color;
        }
        case ShowAs::parity: {
            // The picture in grey, and every other block a little brighter.
            const std::uint32_t grey =
                ((picture & 0xffu) * 2 + (picture >> 8 & 0xffu) * 5 + (picture >> 16 & 0xffu)) / 8;
            color.fill(static_cast<std::uint8_t>(grey / 2 + (value.x > 0.0f ? 80 : 24)));
            return color;
        }
    }
    return color;
}

void paint(const Inspection& seen, std::span<std::uint32_t> pixels)
{
    for (int y = 0; y < seen.height; ++y) {
        for (int x = 0; x < seen.width; ++x) {
            const auto i =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(seen.width) + static_cast<std::size_t>(x);
            const bool isBorder =
                seen.showAs == ShowAs::parity && (x % seen.tileSize == 0 || y % seen.tileSize == 0) && x > 0 && y > 0;
            pixels[i] = packed(isBorder         ? kTileBorder
                               : !seen.drawn[i] ? kNothing
                                                : colorOf(seen, seen.values[i], pixels[i]));
        }
    }
}

// A row of the legend, written from left to right.
struct Row
{
    Overlay& overlay;
    int x, y, scale;

    void text(const std::string& words)
    {
        overlay.text(x, y, scale, words);
        x += (textWidth(words) + 4) * scale;
    }

    // A strip of colours: colorAt(0) at its left end, colorAt(1) at its right one.
    template <class ColorAt>
    void strip(int width, const ColorAt& colorAt)
    {
        for (int i = 0; i < width; ++i) {
            const float part = static_cast<float>(i) / static_cast<float>(width - 1);
            overlay.rectangle({x + i * scale, y, x + (i + 1) * scale, y + kCapitalHeight * scale}, colorAt(part));
        }
        x += (width + 4) * scale;
    }
};

// In the lower left corner: the view's name, and a scale with numbers.
void addLegend(const Inspection& seen, Overlay& overlay)
{
    constexpr int kStrip = 72, kVectorStrip = 24;  // pixels of the font
    const int scale = textScale(seen.width, seen.height), padding = Overlay::kPadding * scale;
    const bool isVector = seen.showAs == ShowAs::vector, hasScale = isVector || seen.showAs == ShowAs::scale;
    const std::string low = shortNumber(seen.lowest);
    const std::string high = shortNumber(seen.highest) + (seen.view.unit.empty() ? "" : " " + seen.view.unit);
    const int strips = isVector ? std::min(seen.components, 3) : 1;
    const char* const names = seen.view.name == "uv" ? "uv" : "xyz";
    int scaleWidth = textWidth(low) + textWidth(high) + 4 + strips * ((isVector ? kVectorStrip : kStrip) + 4);
    for (int c = 0; isVector && c < strips; ++c) scaleWidth += textWidth({names + c, 1}) + 4;

    std::string title = seen.view.name + ": " + seen.view.meaning;
    if (textWidth(title) * scale + 2 * padding > seen.width) title = seen.view.name;
    const int width = std::max(textWidth(title), hasScale ? scaleWidth : 0) * scale + 2 * padding;
    const int height = ((hasScale ? kLineHeight : 0) + kLetterHeight) * scale + 2 * padding, top = seen.height - height;
    overlay.rectangle({0, top, width, seen.height}, {0, 0, 0});
    overlay.text(padding, top + padding, scale, title);
    if (!hasScale) return;
    Row row = {overlay, padding, top + padding + kLineHeight * scale, scale};
    row.text(low);
    for (int c = 0; c < strips; ++c) {
        if (isVector) row.text({names[c]});
        row.strip(isVector ? kVectorStrip : kStrip, [&](float part) {
            if (!isVector) return ramp(part);
            SrgbCode color = {};
            color[static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(part * 255.0f + 0.5f);
            return color;
        });
    }
    row.text(high);
}

}  // namespace

Expected<Statistics> runInside(Frame& frame, Framebuffer& target, const std::string& show,
                               const std::vector<Label>& labels)
{
    Statistics statistics;
    Overlay overlay;
    for (const Label& label : labels) overlay.label(label, textScale(target.width(), target.height()));
    if (show.empty() || show == "color") {
        statistics = frame.run();
    } else {
        const Expected<Inspection> seen =
            trace::namesVariable(show) ? trace::inspectVariable(frame, show) : inspect(frame, show);
        if (!seen) return tl::unexpected(seen.error());
        statistics = seen->statistics;
        paint(*seen, target.color8());
        addLegend(*seen, overlay);
    }
    overlay.draw(target);
    return statistics;
}

}  // namespace relief::samples
