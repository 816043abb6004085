#include "relief/pipeline/setup.h"

#include <algorithm>
#include <bit>
#include <cstddef>

#include "relief/lanes/double.h"
#include "relief/leave_out.h"
#include "relief/pipeline/clip.h"
#include "relief/pipeline/edge_function.h"
#include "relief/pipeline/viewport_transform.h"

namespace relief::inline RELIEF_WIDTH {

namespace {

// Up to kLanes triangles, corner by corner.
struct TriangleLanes
{
    Int x[3], y[3];
    Float z[3], invW[3];
    Int vertex[3];
};

struct Batch
{
    TriangleLanes lanes;
    unsigned unclipped = 0;  // bit per lane: set up from the vertices as they are
    unsigned clipped = 0;    // bit per lane: has to go through the clipper
};

// As std::max_element, but compilers make vector code of it.
std::uint32_t largestOf(const std::uint32_t* numbers, std::uint32_t count)
{
    std::uint32_t largest = 0;
    for (std::uint32_t i = 0; i < count; ++i) largest = std::max(largest, numbers[i]);
    return largest;
}

// Sorts one triangle, a lane of the batch, by its vertices' codes.
void sortOut(const DrawGeometry& draw, const std::uint32_t* index, unsigned lane, Batch& batch, Statistics& statistics)
{
    if (index[0] >= draw.vertexCount || index[1] >= draw.vertexCount || index[2] >= draw.vertexCount) {
        ++statistics.droppedIndex;
        return;
    }
    const unsigned c0 = draw.codes[index[0]], c1 = draw.codes[index[1]], c2 = draw.codes[index[2]];
    const unsigned some = c0 | c1 | c2;
    if ((some & (vertex_code::nan | vertex_code::infinite)) != 0) {
        ++((some & vertex_code::nan) != 0 ? statistics.droppedNan : statistics.droppedInfinite);
    } else if ((c0 & c1 & c2 & vertex_code::anyOutside) != 0) {
        ++statistics.outside;
    } else {
        const bool clips = !leavesOut::clipping || (some & vertex_code::mustClip) != 0;
        (clips ? batch.clipped : batch.unclipped) |= 1u << lane;
    }
}

// Loads the corners of up to kLanes triangles. Lanes that are not used hold triangle `first` again, and vertex 0 stands
// for those that do not exist.
Batch gather(const DrawGeometry& draw, std::uint32_t first, std::uint32_t count, Statistics& statistics)
{
    constexpr std::uint32_t corners = 3 * kLanes;
    std::uint32_t room[corners];
    const std::uint32_t* const indices = cornersOf(draw, first, count, 3, room);
    const bool inRange = largestOf(indices, 3 * count) < draw.vertexCount;
    const std::uint32_t* index = indices;
    std::uint32_t replaced[corners];
    if (count < kLanes || !inRange) {
        for (std::uint32_t i = 0; i < corners; ++i) {
            replaced[i] = indices[i < 3 * count ? i : i % 3];
            if (replaced[i] >= draw.vertexCount) replaced[i] = 0;
        }
        index = replaced;
    }

    Batch batch;
    unsigned some = 0;
    for (std::uint32_t i = 0; i < corners; ++i) some |= draw.codes[index[i]];
    if (leavesOut::clipping && inRange && some == 0) {
        batch.unclipped = count < kLanes ? (1u << count) - 1 : kAllLanes;
    } else {
        for (std::uint32_t i = 0; i < count; ++i) sortOut(draw, indices + 3 * i, i, batch, statistics);
    }
    for (int k = 0; k < 3; ++k) {
        std::int32_t vertex[kLanes];
        for (int i = 0; i < kLanes; ++i) vertex[i] = static_cast<std::int32_t>(index[3 * i + k]);
        native::IntVector word[4];
        native::loadTransposed<native::FourWords>(
            [&](int lane) {
                return reinterpret_cast<const std::byte*>(draw.screen + static_cast<std::uint32_t>(vertex[lane]));
            },
            word);
        batch.lanes.x[k] = Int(word[0]);
        batch.lanes.y[k] = Int(word[1]);
        batch.lanes.z[k] = asFloat(Int(word[2]));
        batch.lanes.invW[k] = asFloat(Int(word[3]));
        batch.lanes.vertex[k] = Int::load(vertex);
    }
    return batch;
}

// Which lanes face the viewer, and which have to swap two corners to be clockwise.
struct Orientation
{
    unsigned kept;
    unsigned swapped;
};

Orientation orient(const TriangleLanes& t, Cull cull)
{
    // Twice the signed area in 1/65536 px^2: an integer below 2^49, exact in double. Clockwise with y down is positive.
    const Double x0(t.x[0]), y0(t.y[0]);
    const Double area = (Double(t.x[1]) - x0) * (Double(t.y[2]) - y0) - (Double(t.x[2]) - x0) * (Double(t.y[1]) - y0);
    const unsigned back = negativeBits(area);
    const unsigned front = negativeBits(Double(0.0) - area);
    switch (cull) {
        case Cull::back:
            return {front, 0};
        case Cull::front:
            return {back, back};
        case Cull::none:
            break;
    }
    return {front | back, back};
}

// The lanes with a pixel centre, or what could be another sample, in the triangle's bounds and within the draw's.
unsigned coversSample(const TriangleLanes& t, const DrawGeometry& draw)
{
    const RectangleLanes pixels = sampleBounds(t.x, t.y, draw.bounds, draw.sampleReach);
    return ((pixels.x0 < pixels.x1) & (pixels.y0 < pixels.y1)).bits();
}

struct Survivors
{
    unsigned facing;  // not culled by orientation
    unsigned kept;    // and with a sample
};

// Swaps corners 1 and 2 where the mask says so.
void swapCorners(TriangleLanes& t, Mask where)
{
    const auto swap = [where](auto& one, auto& two) {
        const auto old = one;
        one = select(where, two, one);
        two = select(where, old, two);
    };
    swap(t.x[1], t.x[2]);
    swap(t.y[1], t.y[2]);
    swap(t.z[1], t.z[2]);
    swap(t.invW[1], t.invW[2]);
    swap(t.vertex[1], t.vertex[2]);
}

// Appends the lanes in `kept`. A Triangle is these sixteen words; lanes that are not kept go where nobody reads.
void append(const TriangleLanes& t, Int drawWord, unsigned kept, TriangleChunk& chunk)
{
    const std::size_t size = chunk.triangles.size();
    chunk.triangles.resize(size + static_cast<std::size_t>(std::popcount(kept)));
    auto* out = reinterpret_cast<std::byte*>(chunk.triangles.data() + size);
    alignas(64) std::byte nowhere[sizeof(Triangle)];
    std::byte* place[kLanes];
    for (int lane = 0; lane < kLanes; ++lane) {
        const bool keep = (kept >> lane & 1u) != 0;
        place[lane] = keep ? out : nowhere;
        out += keep ? sizeof(Triangle) : 0;
    }
    static_assert(offsetof(Triangle, y) == 12 && offsetof(Triangle, z) == 24 && offsetof(Triangle, invW) == 36 &&
                  offsetof(Triangle, vertex) == 48 && offsetof(Triangle, drawWord) == 60);
    const auto bits = [](Float f) { return asInt(f).value; };
    const native::IntVector word[16] = {t.x[0].value,      t.x[1].value,      t.x[2].value,      t.y[0].value,
                                        t.y[1].value,      t.y[2].value,      bits(t.z[0]),      bits(t.z[1]),
                                        bits(t.z[2]),      bits(t.invW[0]),   bits(t.invW[1]),   bits(t.invW[2]),
                                        t.vertex[0].value, t.vertex[1].value, t.vertex[2].value, drawWord.value};
    for (int part = 0; part < 4; ++part)
        native::storeTransposed(word + 4 * part, [&](int lane) { return place[lane] + 16 * part; });
}

// Appends the lanes in `candidates` that survive culling.
Survivors emit(const DrawGeometry& draw, const TriangleLanes& t, unsigned candidates, TriangleChunk& chunk)
{
    const Orientation orientation = orient(t, draw.cull);
    const unsigned facing = candidates & orientation.kept;
    const unsigned kept = facing & coversSample(t, draw);
    if (kept == 0) return {facing, kept};
    const Int drawIndex = static_cast<std::int32_t>(draw.drawIndex);
    if ((kept & orientation.swapped) != 0) {
        TriangleLanes clockwise = t;
        const Mask swapped = Mask::fromBits(orientation.swapped);
        swapCorners(clockwise, swapped);
        append(clockwise, select(swapped, drawIndex | static_cast<std::int32_t>(kWasCounterClockwise), drawIndex), kept,
               chunk);
    } else {
        append(t, drawIndex, kept, chunk);
    }
    return {facing, kept};
}

// Clips one triangle and sets up the fan of what is left. It counts as one triangle, whatever it is cut into.
void clipAndSetUp(const DrawGeometry& draw, const TriangleLanes& t, int lane, TriangleChunk& chunk,
                  Statistics& statistics)
{
    const ViewportTransform transform(draw.viewport);
    const auto vertexOf = [&](int k) { return static_cast<std::uint32_t>(t.vertex[k][lane]); };
    const glm::vec4 corners[3] = {draw.clip[vertexOf(0)], draw.clip[vertexOf(1)], draw.clip[vertexOf(2)]};
    ClipVertex polygon[kMaxClippedVertices];
    const int count = clipTriangle(corners, clipLimits(draw, {vertexOf(0), vertexOf(1), vertexOf(2)}), polygon);
    ++statistics.trianglesClipped;
    if (count == 0) {
        ++statistics.outside;
        return;
    }

    // The triangle's own corners keep their components; new vertices get some. A fan begins with its first vertex, and
    // a value that is not interpolated is that of the triangle's: where the two are not the same, it is copied.
    std::uint32_t vertex[kMaxClippedVertices];
    for (int i = 0; i < count; ++i) {
        const float(&w)[3] = polygon[i].weight;
        const int corner = w[0] == 1.0f ? 0 : w[1] == 1.0f ? 1 : w[2] == 1.0f ? 2 : -1;
        const bool kept = corner >= 0 && (corner == 0 || i > 0 || !draw.hasFlat);
        vertex[i] =
            kept ? vertexOf(corner) : clippedVertex(draw, {vertexOf(0), vertexOf(1), vertexOf(2)}, polygon[i], chunk);
    }

    // The fan (0, i + 1, i + 2): one triangle a lane.
    Survivors all{};
    for (int begin = 0; begin < count - 2; begin += kLanes) {
        std::int32_t corner[3][kLanes];
        float position[3][4][kLanes];
        unsigned used = 0;
        for (int i = 0; i < kLanes; ++i) {
            const int step = begin + i < count - 2 ? begin + i : begin;
            if (step == begin + i) used |= 1u << i;
            for (int k = 0; k < 3; ++k) {
                const int p = k == 0 ? 0 : step + k;
                corner[k][i] = static_cast<std::int32_t>(vertex[p]);
                for (int c = 0; c < 4; ++c) position[k][c][i] = polygon[p].position[c];
            }
        }
        TriangleLanes fan;
        for (int k = 0; k < 3; ++k) {
            const auto lanes = [&](int c) { return Float::load(position[k][c]); };
            const ScreenLanes screen = transform.project({lanes(0), lanes(1), lanes(2), lanes(3)});
            fan.x[k] = screen.x;
            fan.y[k] = screen.y;
            fan.z[k] = screen.z;
            fan.invW[k] = screen.invW;
            fan.vertex[k] = Int::load(corner[k]);
        }
        const Survivors some = emit(draw, fan, used, chunk);
        all.facing |= some.facing;
        all.kept |= some.kept;
    }
    ++(all.kept != 0 ? statistics.rasterised : all.facing != 0 ? statistics.culledNoSample : statistics.culledFacing);
}

}  // namespace

void setUpTriangles(const DrawGeometry& draw, std::uint32_t first, std::uint32_t count, TriangleChunk& chunk,
                    Statistics& statistics)
{
    statistics.trianglesSubmitted += count;
    for (std::uint32_t begin = 0; begin < count; begin += kLanes) {
        const std::uint32_t n = count - begin < kLanes ? count - begin : kLanes;
        const Batch batch = gather(draw, first + begin, n, statistics);

        // Submission order is the order of lanes; a batch with a triangle to clip goes lane by lane.
        if (batch.clipped == 0) {
            const Survivors some = emit(draw, batch.lanes, batch.unclipped, chunk);
            statistics.culledFacing += static_cast<unsigned>(std::popcount(batch.unclipped & ~some.facing));
            statistics.culledNoSample += static_cast<unsigned>(std::popcount(some.facing & ~some.kept));
            statistics.rasterised += static_cast<unsigned>(std::popcount(some.kept));
            continue;
        }
        for (int lane = 0; lane < kLanes; ++lane) {
            const unsigned bit = 1u << lane;
            if ((batch.clipped & bit) != 0) clipAndSetUp(draw, batch.lanes, lane, chunk, statistics);
            if ((batch.unclipped & bit) == 0) continue;
            const Survivors some = emit(draw, batch.lanes, bit, chunk);
            ++(some.kept != 0     ? statistics.rasterised
               : some.facing != 0 ? statistics.culledNoSample
                                  : statistics.culledFacing);
        }
    }
}

}  // namespace relief::inline RELIEF_WIDTH
