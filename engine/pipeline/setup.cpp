#include "pipeline/setup.h"

#include <bit>

#include "lanes/double.h"
#include "pipeline/clip.h"
#include "pipeline/viewport_transform.h"

namespace relief {

namespace {

// Up to kLanes triangles, corner by corner.
struct TriangleLanes
{
    std::uint32_t vertex[3][kLanes];
    Int x[3], y[3];
    Float z[3], invW[3];
};

struct Batch
{
    TriangleLanes lanes;
    unsigned unclipped = 0;  // bit per lane: set up from the vertices as they are
    unsigned clipped = 0;    // bit per lane: has to go through the clipper
};

// Sorts out by codes, and loads the screen positions of the rest. Lanes that are not used hold triangle `first` again.
Batch gather(const DrawGeometry& draw, std::uint32_t first, std::uint32_t count, Statistics& statistics)
{
    Batch batch;
    const std::byte* address[3][kLanes];
    for (std::uint32_t i = 0; i < kLanes; ++i) {
        const std::uint32_t* index = draw.indices + 3 * static_cast<std::size_t>(first + (i < count ? i : 0));
        const bool inRange = index[0] < draw.vertexCount && index[1] < draw.vertexCount && index[2] < draw.vertexCount;
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t vertex = inRange ? index[k] : 0;
            batch.lanes.vertex[k][i] = vertex;
            address[k][i] = reinterpret_cast<const std::byte*>(draw.screen + vertex);
        }
        if (i >= count) continue;
        if (!inRange) {
            ++statistics.droppedIndex;
            continue;
        }
        const unsigned c0 = draw.codes[index[0]], c1 = draw.codes[index[1]], c2 = draw.codes[index[2]];
        const unsigned some = c0 | c1 | c2;
        if ((some & (vertex_code::nan | vertex_code::infinite)) != 0) {
            ++((some & vertex_code::nan) != 0 ? statistics.droppedNan : statistics.droppedInfinite);
        } else if ((c0 & c1 & c2 & vertex_code::anyOutside) != 0) {
            ++statistics.outside;
        } else {
            ((some & vertex_code::mustClip) != 0 ? batch.clipped : batch.unclipped) |= 1u << i;
        }
    }
    for (int k = 0; k < 3; ++k) {
        native::IntVector word[4];
        native::loadTransposed<native::FourWords>([&](int i) { return address[k][i]; }, word);
        batch.lanes.x[k] = Int(word[0]);
        batch.lanes.y[k] = Int(word[1]);
        batch.lanes.z[k] = asFloat(Int(word[2]));
        batch.lanes.invW[k] = asFloat(Int(word[3]));
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

// The lanes with a pixel centre in the triangle's bounds and within the draw's: centres lie at 128 mod 256.
unsigned coversSample(const TriangleLanes& t, const Rectangle& bounds)
{
    const Int minX = min(min(t.x[0], t.x[1]), t.x[2]), maxX = max(max(t.x[0], t.x[1]), t.x[2]);
    const Int minY = min(min(t.y[0], t.y[1]), t.y[2]), maxY = max(max(t.y[0], t.y[1]), t.y[2]);
    const int half = kSubpixels / 2;
    const Int firstX = max((minX + (half - 1)) >> kSubpixelBits, Int(bounds.x0));
    const Int firstY = max((minY + (half - 1)) >> kSubpixelBits, Int(bounds.y0));
    const Int lastX = min((maxX - half) >> kSubpixelBits, Int(bounds.x1 - 1));
    const Int lastY = min((maxY - half) >> kSubpixelBits, Int(bounds.y1 - 1));
    return ((firstX <= lastX) & (firstY <= lastY)).bits();
}

// Appends the lanes in `candidates` that survive culling.
struct Survivors
{
    unsigned facing;  // not culled by orientation
    unsigned kept;    // and with a sample
};

Survivors emit(const DrawGeometry& draw, const TriangleLanes& t, unsigned candidates, TriangleChunk& chunk)
{
    const Orientation orientation = orient(t, draw.cull);
    const unsigned facing = candidates & orientation.kept;
    const unsigned kept = facing & coversSample(t, draw.bounds);
    if (kept == 0) return {facing, kept};

    std::int32_t x[3][kLanes], y[3][kLanes];
    float z[3][kLanes], invW[3][kLanes];
    for (int k = 0; k < 3; ++k) {
        t.x[k].store(x[k]);
        t.y[k].store(y[k]);
        t.z[k].store(z[k]);
        t.invW[k].store(invW[k]);
    }
    for (unsigned rest = kept; rest != 0; rest &= rest - 1) {
        const int lane = std::countr_zero(rest);
        const bool swap = (orientation.swapped >> lane & 1u) != 0;
        Triangle& triangle = chunk.triangles.emplace_back();
        for (int k = 0; k < 3; ++k) {
            const int from = swap && k != 0 ? 3 - k : k;
            triangle.x[k] = x[from][lane];
            triangle.y[k] = y[from][lane];
            triangle.z[k] = z[from][lane];
            triangle.invW[k] = invW[from][lane];
            triangle.vertex[k] = t.vertex[from][lane];
        }
        triangle.drawIndex = draw.drawIndex;
    }
    return {facing, kept};
}

// Clips one triangle and sets up the fan of what is left. It counts as one triangle, whatever it is cut into.
void clipAndSetUp(const DrawGeometry& draw, const TriangleLanes& t, int lane, TriangleChunk& chunk,
                  Statistics& statistics)
{
    const ViewportTransform transform(draw.viewport);
    const glm::vec4 corners[3] = {draw.clip[t.vertex[0][lane]], draw.clip[t.vertex[1][lane]],
                                  draw.clip[t.vertex[2][lane]]};
    ClipVertex polygon[kMaxClippedVertices];
    const int count =
        clipTriangle(corners, {transform.inverseGuardX, transform.inverseGuardY, draw.depthClip}, polygon);
    ++statistics.trianglesClipped;
    if (count == 0) {
        ++statistics.outside;
        return;
    }

    // New vertices get interpolated components; the triangle's own corners keep theirs.
    std::uint32_t vertex[kMaxClippedVertices];
    const float* corner[3];
    for (int k = 0; k < 3; ++k) corner[k] = componentsOf(draw, chunk, t.vertex[k][lane]);
    for (int i = 0; i < count; ++i) {
        const float(&w)[3] = polygon[i].weight;
        vertex[i] = w[0] == 1.0f ? t.vertex[0][lane] : w[1] == 1.0f ? t.vertex[1][lane] : t.vertex[2][lane];
        if (w[0] == 1.0f || w[1] == 1.0f || w[2] == 1.0f) continue;
        vertex[i] = kClippedVertex | static_cast<std::uint32_t>(chunk.clippedComponents.size());
        for (std::uint32_t c = 0; c < draw.componentCount; ++c) {
            chunk.clippedComponents.push_back(w[0] * corner[0][c] + w[1] * corner[1][c] + w[2] * corner[2][c]);
        }
    }

    // The fan (0, i + 1, i + 2): one triangle a lane, and at most eight of them.
    Survivors all{};
    for (int begin = 0; begin < count - 2; begin += kLanes) {
        TriangleLanes fan;
        // With values, because g++ 12 takes lanes that are set one by one for uninitialised.
        float4 position[3] = {float4(0.0f), float4(0.0f), float4(0.0f)};
        unsigned used = 0;
        for (int i = 0; i < kLanes; ++i) {
            const int step = begin + i < count - 2 ? begin + i : begin;
            if (step == begin + i) used |= 1u << i;
            for (int k = 0; k < 3; ++k) {
                const int p = k == 0 ? 0 : step + k;
                fan.vertex[k][i] = vertex[p];
                for (int c = 0; c < 4; ++c) position[k][c].set(i, polygon[p].position[c]);
            }
        }
        for (int k = 0; k < 3; ++k) {
            const ScreenLanes screen = transform.project(position[k]);
            fan.x[k] = screen.x;
            fan.y[k] = screen.y;
            fan.z[k] = screen.z;
            fan.invW[k] = screen.invW;
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

}  // namespace relief
