// A frame: records draws, then runs them. The order of draws is the order of blending; which thread does what never
// shows in the result.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "mesh/mesh.h"
#include "pipeline/bin.h"
#include "pipeline/draw.h"
#include "pipeline/framebuffer.h"
#include "pipeline/workers.h"

namespace relief {

struct FrameOptions
{
    int threads = 0;                  // 0: one per processor
    int tileSize = kDefaultTileSize;  // 16, 32, 64 or 128 pixels
};

class Frame
{
public:
    // The target must outlive the frame. A frame object can be used again and again, and keeps its memory.
    explicit Frame(Framebuffer& target, const FrameOptions& options = {});
    ~Frame();
    Frame(const Frame&) = delete;
    Frame& operator=(const Frame&) = delete;

    // The target's content before the first draw; without it the frame draws onto what is there. Colour is linear.
    void clear(const glm::vec4& color, float depth = 1.0f);

    // Where the next draws go: the whole target by default. The viewport may lie partly outside of the target; width
    // and height are limited to 16384. The scissor cuts off pixels and moves nothing.
    void setViewport(const Viewport& viewport);
    void setScissor(const Rectangle& scissor);

    // Whether the next draws' front faces are counter-clockwise on screen: right for an object whose matrix mirrors it.
    // false by default.
    void setFrontCounterClockwise(bool counterClockwise);

    // Records a draw. The programs are copied; the mesh and the textures must live until run() returns.
    // VertexData is found from the vertex program's parameter.
    template <RenderState state = RenderState{}, class VertexProgram, class FragmentProgram>
    void draw(const Mesh& mesh, const VertexProgram& vertexProgram, const FragmentProgram& fragmentProgram);

    // Runs what was recorded and says what happened. Running again gives the same frame again.
    Statistics run();

    // The recorded draws, and how many components (floats) each of them interpolates.
    int drawCount() const;
    int componentCount(int draw) const;

    // What the draw's vertex program hands on, as the table that Direct3D's compiler prints (hlsl/signature.h).
    std::string outputSignature(int draw) const;

    // Whether any pixel depends on an interpolated component: runs the frame again with NaN in it at every vertex.
    // After run(); the target holds the same picture afterwards.
    bool dependsOn(int draw, int component);

    // Forgets the recorded draws and the clear, for the next frame.
    void reset();

    // What the frame's fragment programs cost by themselves: runs each of them `blocks` times in all, on the inputs of
    // one block in every tile, without raster, depth test, blending and memory. After run(). Returns a sum of the
    // results.
    float shadeAlone(std::uint64_t blocks) const;

private:
    void add(std::unique_ptr<Draw> draw, const Mesh& mesh);

    struct Storage;
    std::unique_ptr<Storage> storage;
};

namespace detail {

// The struct that a vertex program takes; void if it is no vertex program.
template <class Operator>
struct VertexDataOf
{
    using Type = void;
};
template <class Result, class Program, class VertexData>
struct VertexDataOf<Result (Program::*)(VertexData) const>
{
    using Type = std::remove_cvref_t<VertexData>;
};
template <class VertexProgram>
using VertexDataFor = typename VertexDataOf<decltype(&VertexProgram::operator())>::Type;

// Whether two programs and their structs belong together. A mistake is one sentence in the compiler's output: every
// check has a name, which clang prints, and what would fail for the same reason is not compiled after it.
template <class VertexProgram, class FragmentProgram>
constexpr bool checkPrograms()
{
    using VertexData = VertexDataFor<VertexProgram>;
    constexpr bool isVertexProgram = !std::is_void_v<VertexData>;
    static_assert(isVertexProgram, "a vertex program must have: Interpolators operator()(VertexData v) const");
    if constexpr (isVertexProgram) {
        using Interpolators = std::remove_cvref_t<std::invoke_result_t<const VertexProgram&, VertexData>>;
        constexpr bool vertexDataIsSemantics = fieldCount<VertexData>() >= 0;
        constexpr bool interpolatorsAreSemantics = fieldCount<Interpolators>() >= 0;
        static_assert(vertexDataIsSemantics,
                      "every field of VertexData must be a semantic: POSITION, NORMAL, TANGENT or TEXCOORD<0, float2>");
        static_assert(interpolatorsAreSemantics,
                      "every field of Interpolators (at most 12) must be a semantic: "
                      "SV_POSITION, TEXCOORD<n, float4>, COLOR<n, float4>");
        if constexpr (vertexDataIsSemantics && interpolatorsAreSemantics) {
            constexpr bool meshHasVertexData = meshHasAll(FieldsOf<VertexData>{});
            constexpr bool hasOnePosition = positionCount(FieldsOf<Interpolators>{}) == 1;
            constexpr bool isFewEnough = interpolatedComponents(FieldsOf<Interpolators>{}) <= kMaxComponents;
            constexpr bool takesInterpolators =
                AFragmentProgramTakesTheInterpolatorsAndReturnsFloat4<FragmentProgram, Interpolators>;
            static_assert(meshHasVertexData,
                          "VertexData can hold POSITION, NORMAL, TANGENT and TEXCOORD<0, float2>: "
                          "a mesh has nothing else");
            static_assert(hasOnePosition,
                          "Interpolators must have exactly one SV_POSITION: the vertex program's clip-space position");
            static_assert(isFewEnough, "Interpolators may have at most 128 components");
            static_assert(takesInterpolators,
                          "the fragment program must take the Interpolators that the vertex "
                          "program returns, and return float4");
            return meshHasVertexData && hasOnePosition && isFewEnough && takesInterpolators;
        }
    }
    return false;
}

}  // namespace detail

template <RenderState state, class VertexProgram, class FragmentProgram>
void Frame::draw(const Mesh& mesh, const VertexProgram& vertexProgram, const FragmentProgram& fragmentProgram)
{
    if constexpr (detail::checkPrograms<VertexProgram, FragmentProgram>()) {
        using VertexData = detail::VertexDataFor<VertexProgram>;
        add(std::make_unique<TypedDraw<state, VertexData, VertexProgram, FragmentProgram>>(mesh, vertexProgram,
                                                                                           fragmentProgram),
            mesh);
    }
}

}  // namespace relief
