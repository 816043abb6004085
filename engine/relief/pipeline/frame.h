// A frame: records draws, then runs them. The order of draws is the order of blending; which thread does what never
// shows in the result.
#pragma once

#include <memory>
#include <string>

#include "relief/pipeline/draw.h"

namespace relief::inline RELIEF_WIDTH {

struct FrameOptions
{
    int threads = 0;                       // 0: one per processor; at most 256
    int tileSize = kDefaultTileSize;       // 16, 32, 64 or 128 pixels
    std::uint32_t maxBinned = kMaxBinned;  // pairs of a triangle and a tile kept at a time (limits.h)
};

class Frame
{
public:
    // The target must outlive the frame. A frame object can be used again and again, and keeps its memory.
    explicit Frame(Framebuffer& target, const FrameOptions& options = {});
    ~Frame();
    Frame(const Frame&) = delete;
    Frame& operator=(const Frame&) = delete;

    // The target's content before the first draw: all of it, with a stencil of 0; or the colours, all or the one of
    // SV_Target<target>, the depth, the stencil alone. What is not cleared is drawn onto as it is; what the target does
    // not keep is 0 then, and its depth 1. Colour is linear; depth is limited to 0 ... 1, and NaN to 0.
    void clear(const glm::vec4& color, float depth = 1.0f);
    void clearColor(const glm::vec4& color);
    void clearColor(int target, const glm::vec4& color);
    void clearDepth(float depth = 1.0f);
    void clearStencil(std::uint8_t stencil = 0);

    // Where the next draws go: the whole target by default. The viewport may lie partly outside of the target; width
    // and height are limited to 16384. The scissor cuts off pixels and moves nothing.
    void setViewport(const Viewport& viewport);
    void setScissor(const Rectangle& scissor);

    // Whether the next draws' front faces are counter-clockwise on screen: right for an object whose matrix mirrors it.
    // false by default.
    void setFrontCounterClockwise(bool counterClockwise);

    // Records a draw of a mesh, or of a part of it, or of several instances. The programs are copied; the mesh and the
    // textures must live until run() returns. VertexData is found from the vertex program's parameter; where the mesh
    // does not have what it asks for, the draw is left out, and the error says why (problem() too).
    template <class VertexProgram, class FragmentProgram>
    Expected<void> draw(const Mesh& mesh, const VertexProgram& vertexProgram, const FragmentProgram& fragmentProgram,
                        const RenderState& state = {}, const MeshPart& part = {})
    {
        if constexpr (detail::checkPrograms<VertexProgram, FragmentProgram>()) {
            return record(detail::programsOf<VertexProgram, FragmentProgram>(), &vertexProgram, &fragmentProgram, mesh,
                          state, part, detail::contractsProducts());
        }
    }

    template <class VertexProgram, class FragmentProgram>
    Expected<void> draw(Mesh&&, const VertexProgram&, const FragmentProgram&, const RenderState& = {},
                        const MeshPart& = {})
    {
        constexpr bool lives = sizeof(VertexProgram) == 0;
        static_assert(lives, "a mesh that ends with the call is not there when the frame runs: keep it in a variable");
        return {};
    }

    // Why the first draw that is left out is left out; empty where all of them are recorded.
    const std::string& problem() const;

    // Runs what was recorded, on the target as it is then, and says what happened. A frame that clears is the same
    // every time; another one draws onto what the last run left.
    Statistics run();

    int drawCount() const;

    // What it runs with: as many threads as there are, and the tiles' side that was chosen.
    FrameOptions options() const;

    // Forgets the recorded draws and the clear, for the next frame.
    void reset();

    // What instruments, views and traces look into (frame_storage.h).
    struct Storage;
    Storage& internals() const { return *storage; }

private:
    Expected<void> record(const Programs& programs, const void* vertexProgram, const void* fragmentProgram,
                          const Mesh& mesh, const RenderState& state, const MeshPart& part, bool contractsProducts);

    std::unique_ptr<Storage> storage;
};

}  // namespace relief::inline RELIEF_WIDTH
