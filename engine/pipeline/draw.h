// One draw, and the whole pipeline on one screen: start here.
//
//     vertices     shadeVertices   the vertex program, kLanes vertices at a time      -> clip space, screen
//     triangles    setUpTriangles  clip, cull, snap to the pixel grid
//                  binTriangles    to the tiles that each one touches
//     tile by tile rasterise       which pixels of which blocks are covered
//                  shadeBlocks     depth test, interpolate, the fragment program, merge
//
// Programs are functors on lanes; a Draw holds them by value and refers to the mesh. frame.h runs it all.
#pragma once

#include <span>

#include "lanes/active.h"
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
concept AVertexProgramIsCalledWithItsVertexData = requires(const Program& p, VertexData v) { p(v); };

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

    // Covered blocks of one tile, in order; all triangles belong to this draw and this chunk.
    virtual void shadeBlocks(std::span<const CoveredBlock> blocks, const TriangleChunk& chunk, Tile& tile,
                             Statistics& statistics) const = 0;

    // Runs the fragment program alone, `blocks` times, without raster, depth, blending or memory: the shader's own cost.
    virtual float shadeAlone(std::uint64_t blocks) const = 0;

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
        geometry.cull = state.cull;
        geometry.depthClip = state.depthClip;
    }

    void shadeVertices(std::uint32_t first, std::uint32_t count) const override
    {
        relief::shadeVertices<VertexData>(vertexProgram, mesh, geometry, first, count);
    }

    [[gnu::flatten]] void shadeBlocks(std::span<const CoveredBlock> blocks, const TriangleChunk& chunk, Tile& tile,
                                      Statistics& statistics) const override
    {
        const Triangle* current = nullptr;
        TriangleWeights triangle;
        CornerComponents<kCount> corners;
        for (const CoveredBlock& block : blocks) {
            if (block.triangle != current) {
                current = block.triangle;
                triangle = TriangleWeights(*current);
                corners.set(componentsOf(geometry, chunk, current->vertex[0]),
                            componentsOf(geometry, chunk, current->vertex[1]),
                            componentsOf(geometry, chunk, current->vertex[2]));
            }
            shadeBlock(block, triangle, corners, tile, statistics);
        }
    }

    float shadeAlone(std::uint64_t blocks) const override;

private:
    void shadeBlock(const CoveredBlock& block, const TriangleWeights& triangle, const CornerComponents<kCount>& corners,
                    Tile& tile, Statistics& statistics) const
    {
        const int index = tile.blockAt(block.x, block.y);
        DepthBounds& bounds = tile.bounds(index);
        if (isHidden<state.depthTest>(triangle.nearest, triangle.farthest, bounds)) {
            statistics.pixelsHidden += static_cast<unsigned>(std::popcount(block.coverage));
            return;
        }
        const BlockWeights weights = triangle.at(block.x, block.y, block.coverage);
        const Float depth = kUsesDepth ? triangle.depth(weights) : Float(0.0f);

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
            const auto hidden = std::popcount(block.coverage) - count(live);
            statistics.pixelsHidden += static_cast<unsigned>(hidden);
            if (none(live)) return;
        }

        const unsigned quads = wholeQuads(live.bits());
        activeLanes = quads;
        statistics.blocksShaded += 1;
        statistics.quadsShaded += static_cast<unsigned>(std::popcount(quads)) / 4;
        statistics.pixelsShaded += static_cast<unsigned>(count(live));

        const Interpolators input = interpolate<Interpolators>(triangle, corners, weights, block.x, block.y, depth);
        float4 color;
        if constexpr (kMayDiscard) {
            Discard discard;
            color = fragmentProgram(input, discard);
            live &= !discard.discarded;
            if constexpr (kUsesDepth) testAndWriteDepth();
        } else {
            color = fragmentProgram(input);
        }
        statistics.invalidColors += static_cast<unsigned>(sanitizeColor(color, live));
        mergeColor<state.blend>(tile, index, color, live);
    }

    const Mesh& mesh;
    VertexProgram vertexProgram;
    FragmentProgram fragmentProgram;
};

template <RenderState state, class VertexData, class VertexProgram, class FragmentProgram>
[[gnu::flatten]] float TypedDraw<state, VertexData, VertexProgram, FragmentProgram>::shadeAlone(
    std::uint64_t blocks) const
{
    // Interpolators as a triangle of 64 x 64 pixels would give them, its corners the mesh's first three vertices.
    Triangle shape{{0, 0, 64 * kSubpixels}, {64 * kSubpixels, 0, 0}, {0, 0, 0}, {1, 1, 1}, {0, 0, 0}, 0};
    const TriangleWeights triangle(shape);
    CornerComponents<kCount> corners;
    const float* components = geometry.components;
    const std::uint32_t* corner = geometry.indices;
    const auto at = [&](int k) { return components + static_cast<std::size_t>(corner[k]) * kCount; };
    corners.set(at(0), at(1), at(2));

    activeLanes = kAllLanes;
    float4 sum(Float(0.0f));
    const BlockWeights weights = triangle.at(16, 16, kAllLanes);
    Interpolators input = interpolate<Interpolators>(triangle, corners, weights, 16, 16, 0.5f);
    for (std::uint64_t i = 0; i < blocks; ++i) {
        // The compiler must take the input for new each time, and keep the result.
        asm volatile("" : : "r"(&input) : "memory");
        if constexpr (kMayDiscard) {
            Discard discard;
            sum += fragmentProgram(input, discard);
        } else {
            sum += fragmentProgram(input);
        }
    }
    return sum.x[0] + sum.y[0] + sum.z[0] + sum.w[0];
}

}  // namespace relief
