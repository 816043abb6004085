#include "relief/check/tell_pixel.h"

#include <algorithm>
#include <cstdio>
#include <vector>

#include "relief/trace/pixel_trace.h"

namespace relief::inline RELIEF_WIDTH {

namespace {

using trace::SampleOutcome;

// What became of the triangle in the first of the pixel's samples that it covers.
const char* verdictOf(const trace::FragmentTrace& fragment)
{
    static constexpr const char* kVerdicts[] = {"misses it", "fails the stencil test", "fails the depth test",
                                                "is discarded", "is drawn"};
    const auto covers = [](const SampleOutcome& sample) { return sample.verdict != SampleOutcome::Verdict::missed; };
    const auto sample = std::find_if(fragment.samples.begin(), fragment.samples.end(), covers);
    return kVerdicts[sample == fragment.samples.end() ? 0 : static_cast<std::size_t>(sample->verdict)];
}

std::string numbers(const std::array<float, 4>& values)
{
    char text[96];
    std::snprintf(text, sizeof text, "(%.9g, %.9g, %.9g, %.9g)", static_cast<double>(values[0]),
                  static_cast<double>(values[1]), static_cast<double>(values[2]), static_cast<double>(values[3]));
    return text;
}

}  // namespace

std::string tellPixel(Frame& frame, int x, int y)
{
    const std::string pixel = "pixel (" + std::to_string(x) + ", " + std::to_string(y) + ")";
    const Expected<trace::PixelTrace> traced = trace::tracePixel(frame, x, y);
    if (!traced) return pixel + ": no trace: " + traced.error().message;
    std::vector<std::string> lines;
    for (const trace::DrawTrace& draw : traced->draws) {
        for (const trace::PrimitiveTrace& primitive : draw.primitives) {
            for (const trace::PieceTrace& piece : primitive.pieces) {
                if (!piece.fragment) continue;
                std::string line = "  draw " + std::to_string(draw.number) + " (" + draw.mesh + "), triangle " +
                                   std::to_string(primitive.number) + ": " + verdictOf(*piece.fragment);
                for (const trace::TargetOutcome& target : piece.fragment->targets) {
                    if (piece.fragment->ran && target.target == 0)
                        line += ", its program gave " + numbers(target.returned);
                }
                lines.push_back(line);
            }
        }
    }
    if (lines.empty()) return pixel + ": no triangle covers it";
    constexpr std::size_t kTold = 5;
    const std::size_t from = lines.size() - std::min(lines.size(), kTold);
    std::string text = pixel + ", " + std::to_string(lines.size()) + (lines.size() == 1 ? " triangle:" : " triangles:");
    if (from > 0) text += "\n  ...";
    for (std::size_t i = from; i < lines.size(); ++i) text += "\n" + lines[i];
    return text;
}

}  // namespace relief::inline RELIEF_WIDTH
