#include "relief/pipeline/vertex.h"

#include <algorithm>
#include <limits>
#include <string_view>

#include "relief/pipeline/draw.h"

namespace relief::inline RELIEF_WIDTH {

namespace {

// Four words per lane to the first `count` of places that lie `stride` bytes apart.
void storeWords(void* out, std::size_t stride, std::uint32_t count, const Int (&words)[4])
{
    const native::IntVector in[4] = {words[0].value, words[1].value, words[2].value, words[3].value};
    const auto placeOf = [&](int lane) {
        return static_cast<std::byte*>(out) + static_cast<std::size_t>(lane) * stride;
    };
    if (count == kLanes) return native::storeTransposed(in, placeOf);
    std::byte nowhere[16];
    native::storeTransposed(
        in, [&](int lane) { return static_cast<std::uint32_t>(lane) < count ? placeOf(lane) : nowhere; });
}

// Which vertex of the mesh each lane has, and of which instance: the draw's vertices from `first` on. Lanes from
// `count` on have the first one again.
void numberVertices(const DrawGeometry& draw, std::uint32_t first, std::uint32_t count, std::uint32_t (&vertex)[kLanes],
                    std::uint32_t (&instance)[kLanes])
{
    const bool isOneInstance = draw.verticesPerInstance == draw.vertexCount;
    if (isOneInstance && count == kLanes) {  // mostly
        for (std::uint32_t i = 0; i < kLanes; ++i) {
            vertex[i] = first + draw.firstVertex + i;
            instance[i] = 0;
        }
        return;
    }
    for (std::uint32_t i = 0; i < kLanes; ++i) {
        const std::uint32_t at = first + (i < count ? i : 0);
        instance[i] = isOneInstance ? 0 : at / draw.verticesPerInstance;
        vertex[i] = at - instance[i] * draw.verticesPerInstance + draw.firstVertex;
    }
}

// The fields that are counted instead of read.
Float idOf(const Field& field, const std::uint32_t* vertex, const std::uint32_t* instance)
{
    const bool isVertex = std::string_view(field.name) == semantic::SvVertexId::kName;
    std::int32_t lanes[kLanes];
    for (int i = 0; i < kLanes; ++i) lanes[i] = static_cast<std::int32_t>((isVertex ? vertex : instance)[i]);
    return asFloat(Int::load(lanes));
}

}  // namespace

void readStream(const StreamView& stream, const std::uint32_t* element, std::uint32_t count, Float (&lanes)[4])
{
    const auto components = static_cast<std::size_t>(stream.components);
    // Mostly one element after the other: numbers that begin again, with the next instance, do not reach so far.
    const bool isRun = element[count - 1] - element[0] == count - 1;
    const std::uint32_t last = isRun ? element[count - 1] : *std::max_element(element, element + count);
    // Four words are read of each, if the last one's lie within the stream.
    if (components >= 2 &&
        (last + std::size_t{1}) * components + (components == 3 ? 1 : 0) <= stream.count * components) {
        native::IntVector words[4];
        const auto load = [&](const auto& elementOf) {
            const auto addressOf = [&](int lane) {
                return reinterpret_cast<const std::byte*>(stream.words + elementOf(lane) * components);
            };
            if (components == 2) {
                native::loadTransposed<native::TwoWords>(addressOf, words);
            } else {
                native::loadTransposed<native::FourWords>(addressOf, words);
            }
        };
        if (isRun && count == kLanes) {
            load([&](int lane) { return std::size_t{element[0]} + static_cast<std::size_t>(lane); });
        } else {
            load([&](int lane) { return std::size_t{element[static_cast<std::uint32_t>(lane) < count ? lane : 0]}; });
        }
        for (std::size_t c = 0; c < components; ++c) lanes[c] = asFloat(Int(words[c]));
    } else {
        for (std::size_t c = 0; c < components; ++c) {
            std::int32_t lane[kLanes] = {};
            for (std::uint32_t i = 0; i < count; ++i)
                lane[i] = static_cast<std::int32_t>(stream.words[element[i] * components + c]);
            lanes[c] = asFloat(Int::load(lane));
        }
    }
    const Float one = stream.isInteger ? asFloat(Int(1)) : Float(1.0f);
    for (std::size_t c = components; c < 4; ++c) lanes[c] = c == 3 ? one : Float(0.0f);
}

void storeComponents(const DrawGeometry& draw, std::uint32_t first, std::uint32_t count, const Float* components)
{
    const std::size_t stride = draw.componentStride;
    for (std::size_t c = 0; c < draw.componentCount; c += 4) {
        Int words[4];
        for (std::size_t k = 0; k < 4; ++k)
            words[k] = asInt(components[std::min<std::size_t>(c + k, draw.componentCount - 1)]);
        storeWords(draw.components + first * stride + c, stride * sizeof(float), count, words);
    }
}

namespace {

// Vertices beyond a plane of the vertex program's own.
void noteClipDistances(const DrawGeometry& draw, std::uint32_t first, std::uint32_t count, const Float* components)
{
    Mask beyond = false;
    for (int i = 0; i < draw.clipDistanceCount; ++i)
        beyond |= !(components[draw.clipDistances[static_cast<std::size_t>(i)]] >= 0.0f);
    for (std::uint32_t i = 0; i < count && any(beyond); ++i) {
        if (!beyond[static_cast<int>(i)]) continue;
        draw.codes[first + i] = static_cast<std::uint16_t>(draw.codes[first + i] | vertex_code::beyondOwnPlane);
    }
}

}  // namespace

void shadeVertices(const Draw& draw, std::uint32_t first, std::uint32_t count)
{
    const DrawGeometry& g = draw.geometry;
    const ViewportTransform transform(g.viewport);
    VertexLanes lanes;
    for (std::uint32_t begin = first; begin < first + count; begin += kLanes) {
        const std::uint32_t n = std::min<std::uint32_t>(kLanes, first + count - begin);
        std::uint32_t vertex[kLanes], instance[kLanes];
        numberVertices(g, begin, n, vertex, instance);
        for (std::size_t f = 0; f < draw.streams.size(); ++f) {
            const StreamView& stream = draw.streams[f];
            if (stream.words != nullptr) {
                readStream(stream, stream.perInstance ? instance : vertex, n, lanes.in[f]);
            } else {
                lanes.in[f][0] = idOf(draw.programs->vertexData[f], vertex, instance);
            }
        }
        draw.programs->shadeVertices(draw.vertexProgram.get(), lanes);
        projectVertices(g, transform, begin, n, lanes.position);
        noteClipDistances(g, begin, n, lanes.components);
        storeComponents(g, begin, n, lanes.components);
    }
}

void projectVertices(const DrawGeometry& draw, const ViewportTransform& transform, std::uint32_t first,
                     std::uint32_t count, const float4& clip)
{
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
    static_assert(sizeof(ScreenVertex) == 16 && sizeof(glm::vec4) == 16);
    storeWords(draw.screen + first, sizeof(ScreenVertex), count, screenWords);
    storeWords(draw.clip + first, sizeof(glm::vec4), count, clipWords);
    std::int32_t code[kLanes];
    codes.store(code);
    for (std::uint32_t i = 0; i < count; ++i) draw.codes[first + i] = static_cast<std::uint16_t>(code[i]);
}

}  // namespace relief::inline RELIEF_WIDTH
