#include "common/overlay.h"

#include <algorithm>
#include <cstdio>
#include <sstream>

namespace relief::samples {

namespace {

struct VertexData
{
    POSITION position;
    COLOR<0, float4> color;
};

struct Interpolators
{
    SV_POSITION position;
    nointerpolation<COLOR<0, float4>> color;
};

// From pixels to clip space. What is rounded here is less than the 1/256 of a pixel that positions are snapped to.
struct PixelVertexProgram
{
    Float width, height;

    Interpolators operator()(VertexData v) const
    {
        return {float4(v.position.x * 2.0f / width - 1.0f, 1.0f - v.position.y * 2.0f / height, 0.0f, 1.0f), v.color};
    }
};

struct ColorFragmentProgram
{
    float4 operator()(Interpolators i) const { return i.color; }
};

}  // namespace

int textScale(int width, int height)
{
    return std::max(1, std::min(width / 320, height / 270));
}

std::string shortNumber(float number)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", static_cast<double>(number));
    return text;
}

void Overlay::rectangle(const Rectangle& r, const SrgbCode& color, float opacity)
{
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const glm::vec4 linear = {srgbToLinear(color[0]), srgbToLinear(color[1]), srgbToLinear(color[2]), opacity};
    for (const auto& [x, y] : {std::pair{r.x0, r.y0}, {r.x1, r.y0}, {r.x1, r.y1}, {r.x0, r.y1}}) {
        mesh.positions.push_back({static_cast<float>(x), static_cast<float>(y), 0.0f});
        mesh.colors.push_back(linear);
    }
    for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + corner);
}

void Overlay::text(int x, int y, int scale, std::string_view text, const SrgbCode& color)
{
    for (const LetterPart& part : letterParts(text)) {
        rectangle({x + part.x0 * scale, y + part.y0 * scale, x + part.x1 * scale, y + part.y1 * scale}, color);
    }
}

namespace {

// Words, with newlines where a line would be wider than `width` pixels of the font.
std::string wrapped(const std::string& words, int width)
{
    std::string result, line;
    std::stringstream rest(words);
    for (std::string word; rest >> word;) {
        const bool fits = line.empty() || textWidth(line + " " + word) <= width;
        if (!fits) line.clear();
        result += (result.empty() ? "" : fits ? " " : "\n") + word;
        line += (line.empty() ? "" : " ") + word;
    }
    return result;
}

}  // namespace

void Overlay::label(const Label& label, int scale)
{
    const Rectangle& cell = label.cell;
    const std::string words = wrapped(label.text, (cell.x1 - cell.x0) / scale - 2 * kPadding);
    const auto lines = static_cast<int>(std::count(words.begin(), words.end(), '\n'));
    const int width = (textWidth(words) + 2 * kPadding) * scale;
    const int height = (lines * kLineHeight + kLetterHeight + 2 * kPadding) * scale;
    // The scale's upper edge is at 0.93 of the height.
    const int x = label.isScale ? (cell.x0 + cell.x1 - width) / 2 : cell.x0;
    const int y = label.isScale ? cell.y0 + (cell.y1 - cell.y0) * 92 / 100 - height : cell.y0;
    rectangle({x, y, x + width, y + height}, {0, 0, 0}, 0.9f);
    text(x + kPadding * scale, y + kPadding * scale, scale, words);
}

void Overlay::draw(Framebuffer& target) const
{
    if (mesh.indices.empty()) return;
    Frame frame(target, {.threads = 1});
    const PixelVertexProgram vertex = {static_cast<float>(target.width()), static_cast<float>(target.height())};
    frame.draw(mesh, vertex, ColorFragmentProgram{},
               {.depthTest = Compare::always, .depthWrite = false, .cull = Cull::none, .blend = Blend::alpha});
    frame.run();
}

}  // namespace relief::samples
