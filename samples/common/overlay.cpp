#include "common/overlay.h"

#include <algorithm>

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

void Overlay::label(int x, int y, int scale, std::string_view words)
{
    rectangle({x, y, x + labelWidth(words, scale), y + labelHeight(scale)}, {0, 0, 0}, kGround);
    text(x + kPadding * scale, y + kPadding * scale, scale, words);
}

void Overlay::draw(Frame& frame, int width, int height) const
{
    if (mesh.indices.empty()) return;
    frame.setViewport({0, 0, width, height});
    frame.setScissor({0, 0, width, height});
    frame.draw(mesh, PixelVertexProgram{static_cast<float>(width), static_cast<float>(height)}, ColorFragmentProgram{},
               {.depthTest = Compare::always, .depthWrite = false, .cull = Cull::none, .blend = Blend::alpha});
}

}  // namespace relief::samples
