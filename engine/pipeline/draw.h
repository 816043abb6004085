// One draw, and the whole pipeline on one screen: start here.
//
//     vertices     shadeVertices   the vertex program, kLanes vertices at a time      -> clip space, screen
//     triangles    setUpTriangles  clip, cull, snap to the pixel grid (setUpLines: lines become thin triangles)
//                  binTriangles    to the tiles that each one touches
//     tile by tile rasterise       which pixels of which blocks are covered, a TriangleBatch at a time
//                  shadeBlocks     depth test, interpolate, the fragment program, merge
//
// Programs are functors on lanes; a Draw holds them by value and refers to the mesh. frame.h runs it all.
#pragma once

#include <span>

#include "hlsl/signature.h"
#include "lanes/active.h"
#include "leave_out.h"
#include "pipeline/interpolate.h"
#include "pipeline/output_merger.h"
#include "pipeline/raster.h"
#include "pipeline/statistics.h"
#include "pipeline/vertex.h"

namespace relief {

// A fragment program that takes this as its second parameter may throw pixels away: discard(alpha < 0.5f).
class Discard
{
public:
    void operator()(Mask where) { discarded |= where; }
    Mask discarded = false;
};

// --- what a program must look like; a failure names the sentence that is not met ---

template <class Program, class VertexData>
concept AVertexProgramIsCalledWithItsVertexData = requires(const Program& p, VertexData v)
{
    p(v);
};

template <class Program, class Interpolators>
concept AFragmentProgramTakesTheInterpolatorsAndReturnsFloat4 =
    std::is_invocable_r_v<float4, const Program&, Interpolators> ||
    std::is_invocable_r_v<float4, const Program&, Interpolators, Discard&>;

template <class Program, class Interpolators>
inline constexpr bool kDiscards = std::is_invocable_r_v<float4, const Program&, Interpolators, Discard&>;

// --- a draw whose types are forgotten: what the frame works with ---

class Draw
{
public:
    virtual ~Draw() = default;

    // Vertices first ... first + count - 1, into geometry's arrays.
    virtual void shadeVertices(std::uint32_t first, std::uint32_t count) const = 0;

    // Covered blocks of one tile, in order; all triangles belong to this draw, this chunk and this batch.
    virtual void shadeBlocks(std::span<const CoveredBlock> blocks, const TriangleBatch& batch,
                             const TriangleChunk& chunk, Tile& tile, Statistics& statistics) const = 0;

    // Runs the fragment program alone `times` times on the input of one block: without raster, depth test, blending and
    // memory, the program's own cost. Returns a sum of the results.
    virtual float shadeAlone(const CoveredBlock& block, const TriangleBatch& batch, const TriangleChunk& chunk,
                             std::uint64_t times) const = 0;

    // The vertex program's output, as hlsl/signature.h prints it.
    virtual std::string outputSignature() const = 0;

    DrawGeometry geometry;
};

template <RenderState state, class VertexData, class VertexProgram, class FragmentProgram>
class TypedDraw final : public Draw
{
    using Interpolators = std::remove_cvref_t<std::invoke_result_t<const VertexProgram&, VertexData>>;
    static constexpr int kCount = interpolatedComponents(FieldsOf<Interpolators>{});
    static constexpr bool kTestsDepth = state.depthTest != Compare::always;
    static constexpr bool kUsesDepth = kTestsDepth || state.depthWrite;
    static constexpr bool kMayDiscard = kDiscards<FragmentProgram, Interpolators>;

public:
    TypedDraw(const Mesh& source, const VertexProgram& vertex, const FragmentProgram& fragment)
        : mesh(source), vertexProgram(vertex), fragmentProgram(fragment)
    {
        geometry.componentCount = kCount;
        static_assert(state.lineWidth == 1 || state.lineWidth == 2, "lines are 1 or 2 pixels wide");
        geometry.primitive = state.primitive;
        geometry.lineWidth = state.lineWidth;
        geometry.cull = state.cull;
        geometry.depthClip = state.depthClip;
    }

    void shadeVertices(std::uint32_t first, std::uint32_t count) const override
    {
        relief::shadeVertices<VertexData>(vertexProgram, mesh, geometry, first, count);
    }

    [[gnu::flatten]] void shadeBlocks(std::span<const CoveredBlock> blocks, const TriangleBatch& batch,
                                      const TriangleChunk& chunk, Tile& tile, Statistics& statistics) const override
    {
        Counts counts;
        for (auto block = blocks.begin(); block != blocks.end();) {
            const int current = block->triangle;
            TriangleWeights triangle;
            triangle.set(batch, current);
            CornerComponents<kCount> corners;
            setCorners(corners, *batch.triangle[current], chunk);
            do {
                shadeBlock(*block, triangle, corners, tile, counts);
            } while (++block != blocks.end() && block->triangle == current);
        }
        activeLanes = kAllLanes;
        statistics.blocksShaded += counts.blocks;
        statistics.quadsShaded += counts.quads;
        statistics.pixelsShaded += counts.pixels;
        statistics.pixelsHidden += counts.hidden;
        statistics.invalidColors += counts.invalid;
    }

    [[gnu::flatten]] float shadeAlone(const CoveredBlock& block, const TriangleBatch& batch, const TriangleChunk& chunk,
                                      std::uint64_t times) const override
    {
        TriangleWeights triangle;
        triangle.set(batch, block.triangle);
        CornerComponents<kCount> corners;
        setCorners(corners, *batch.triangle[block.triangle], chunk);
        const BlockWeights weights = triangle.at(block.x, block.y, block.coverage);
        const Interpolators input =
            interpolate<Interpolators>(triangle, corners, weights, block.x, block.y, triangle.depth(weights));
        activeLanes = wholeQuads(block.coverage);
        float4 sum(Float(0.0f));
        for (std::uint64_t i = 0; i < times; ++i) {
            Interpolators again = input;
            asm volatile("" : "+m"(again));  // new to the compiler every time, or it would run the program once
            Discard discard;
            sum += runProgram([&] { return again; }, discard);
        }
        activeLanes = kAllLanes;
        return sum.x[0] + sum.y[0] + sum.z[0] + sum.w[0];
    }

    std::string outputSignature() const override { return signature<Interpolators>(); }

private:
    void setCorners(CornerComponents<kCount>& corners, const Triangle& triangle, const TriangleChunk& chunk) const
    {
        corners.set(componentsOf(geometry, chunk, triangle.vertex[0]),
                    componentsOf(geometry, chunk, triangle.vertex[1]),
                    componentsOf(geometry, chunk, triangle.vertex[2]));
    }

    // `input` is a function: what it returns becomes the program's parameter without a copy, in registers.
    template <class Input>
    float4 runProgram(const Input& input, [[maybe_unused]] Discard& discard) const
    {
        if constexpr (kMayDiscard) {
            return fragmentProgram(input(), discard);
        } else {
            return fragmentProgram(input());
        }
    }

    // Of one batch of blocks; in registers while it runs.
    struct Counts
    {
        unsigned blocks = 0, quads = 0, pixels = 0, hidden = 0, invalid = 0;
    };

    void shadeBlock(const CoveredBlock& block, const TriangleWeights& triangle, const CornerComponents<kCount>& corners,
                    Tile& tile, Counts& counts) const
    {
        const int index = tile.blockAt(block.x, block.y);
        DepthBounds& bounds = tile.bounds(index);
        if (leavesOut::hidden && isHidden<state.depthTest>(triangle.nearest, triangle.farthest, bounds)) {
            counts.hidden += static_cast<unsigned>(countBits(block.coverage));
            return;
        }
        const BlockWeights weights = triangle.at(block.x, block.y, block.coverage);
        const Float depth = triangle.depth(weights);

        // Early depth test: before the program runs, unless the program may throw the pixel away afterwards.
        Mask live = Mask::fromBits(block.coverage);
        const auto testAndWriteDepth = [&] {
            float* stored = tile.depth(index);
            const Float old = kUsesDepth ? Float::load(stored) : Float(0.0f);
            live &= compareDepth<state.depthTest>(depth, old);
            if (state.depthWrite && any(live)) {
                select(live, depth, old).store(stored);
                updateBounds<state.depthTest>(triangle.nearest, triangle.farthest,
                                              !kMayDiscard && block.coverage == kAllLanes, bounds);
            }
        };
        if constexpr (kUsesDepth && !kMayDiscard) {
            testAndWriteDepth();
            counts.hidden += static_cast<unsigned>(countBits(block.coverage) - count(live));
            if (leavesOut::hidden && none(live)) return;
        }

        const unsigned quads = wholeQuads(leavesOut::hidden ? live.bits() : block.coverage);
        activeLanes = quads;
        counts.blocks += 1;
        counts.quads += static_cast<unsigned>(countBits(quads)) / 4;
        counts.pixels += static_cast<unsigned>(count(live));

        Discard discard;
        float4 color = runProgram(
            [&] { return interpolate<Interpolators>(triangle, corners, weights, block.x, block.y, depth); }, discard);
        if constexpr (kMayDiscard) {
            live &= !discard.discarded;
            if constexpr (kUsesDepth) testAndWriteDepth();
        }
        counts.invalid += static_cast<unsigned>(sanitizeColor(color, live));
        mergeColor<state.blend>(tile, index, color, live);
    }

    const Mesh& mesh;
    VertexProgram vertexProgram;
    FragmentProgram fragmentProgram;
};

}  // namespace relief
