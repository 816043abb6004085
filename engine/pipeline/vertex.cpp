#include "pipeline/vertex.h"

#include "pipeline/viewport_transform.h"

namespace relief {

namespace {

// Four words per lane to the first `count` of an array's elements.
template <class FourWords>
void storeWords(FourWords* out, std::uint32_t count, const Int (&words)[4])
{
    static_assert(sizeof(FourWords) == 16);
    const native::IntVector in[4] = {words[0].value, words[1].value, words[2].value, words[3].value};
    FourWords nowhere;
    std::byte* address[kLanes];
    for (std::uint32_t i = 0; i < kLanes; ++i)
        address[i] = reinterpret_cast<std::byte*>(i < count ? out + i : &nowhere);
    native::storeTransposed(in, address);
}

}  // namespace

void projectVertices(const DrawGeometry& draw, std::uint32_t first, std::uint32_t count, const float4& clip)
{
    const ViewportTransform transform(draw.viewport);
    const Float largest = max(max(abs(clip.x), abs(clip.y)), max(abs(clip.z), abs(clip.w)));
    const Mask isNan = isnan(clip.x) | isnan(clip.y) | isnan(clip.z) | isnan(clip.w);
    const Mask isInfinite = largest > std::numeric_limits<float>::max();

    // 0 <= z <= w and -w <= x, y <= w are inside, limits included.
    const Mask smallW = !(clip.w >= kSmallestW);
    const Mask outsideNear = draw.depthClip ? clip.z < 0.0f : Mask(false);
    const Mask outsideFar = draw.depthClip ? clip.z > clip.w : Mask(false);
    const Mask beyond =
        (abs(clip.x) * transform.inverseGuardX > clip.w) | (abs(clip.y) * transform.inverseGuardY > clip.w);

    Int codes = 0;
    const auto flag = [&codes](Mask m, int bit) { codes = codes | select(m, Int(bit), Int(0)); };
    flag(clip.x < -clip.w, vertex_code::outsideLeft);
    flag(clip.x > clip.w, vertex_code::outsideRight);
    flag(clip.y < -clip.w, vertex_code::outsideBottom);
    flag(clip.y > clip.w, vertex_code::outsideTop);
    flag(outsideNear, vertex_code::outsideNear);
    flag(outsideFar, vertex_code::outsideFar);
    flag(beyond, vertex_code::beyondGuardBand);
    flag(smallW, vertex_code::smallW);
    flag(isInfinite, vertex_code::infinite);
    flag(isNan, vertex_code::nan);

    const ScreenLanes screen = transform.project(clip);
    const Int screenWords[4] = {screen.x, screen.y, asInt(screen.z), asInt(screen.invW)};
    const Int clipWords[4] = {asInt(clip.x), asInt(clip.y), asInt(clip.z), asInt(clip.w)};
    storeWords(draw.screen + first, count, screenWords);
    storeWords(draw.clip + first, count, clipWords);
    std::int32_t code[kLanes];
    codes.store(code);
    for (std::uint32_t i = 0; i < count; ++i) draw.codes[first + i] = static_cast<std::uint16_t>(code[i]);
}

}  // namespace relief
