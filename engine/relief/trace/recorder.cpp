#include "relief/trace/recorder.h"

#include <cmath>

#include "relief/bits.h"

namespace relief::inline RELIEF_WIDTH::trace {

QuadValue quadOf(const LaneValue& value, int quad)
{
    QuadValue its{value.kind, value.rows, value.columns, {}};
    for (int c = 0; c < value.rows * value.columns; ++c) {
        alignas(Float) float lanes[kLanes];
        value.components[c].store(lanes);
        for (int pixel = 0; pixel < 4; ++pixel)
            its.words[static_cast<std::size_t>(pixel)][static_cast<std::size_t>(c)] =
                bitCast<std::uint32_t>(lanes[quad + pixel]);
    }
    return its;
}

void Recorder::sample(const Site& site, const TextureCall& call)
{
    const SampleTrace trace = traceSample(site, call, lane);
    const std::array<float, 4> again = recombined(trace);
    for (std::size_t c = 0; c < 4; ++c) {
        // A NaN is a NaN: its bits are the processor's.
        const bool bothNan = std::isnan(again[c]) && std::isnan(trace.result[c]);
        agrees = agrees && (bothNan || bitCast<std::uint32_t>(again[c]) == bitCast<std::uint32_t>(trace.result[c]));
    }
    const Float result[4] = {call.result.x, call.result.y, call.result.z, call.result.w};
    const int count = call.function == TextureFunction::SampleCmp ? 1 : 4;
    events.push_back(
        {Event::Kind::sample, site, "", quadOf({ValueKind::number, count, 1, result}, lane & ~3), textures.size()});
    textures.push_back(trace);
}

}  // namespace relief::inline RELIEF_WIDTH::trace
