// Mesa's llvmpipe, the strongest other rasterizer on a CPU, as far as the comparison needs it: OpenGL 4.5 core without
// a window (EGL, surfaceless), drawing into one target of 8-bit colour and 32-bit float depth, the picture, and into
// textures before it.
//
// Programs draw the picture with row 0 on top, as the engine's framebuffer has it: OpenGL's row 0 is the lowest, so it
// is the geometry that is flipped, by flipped() in every vertex program. Then Mesa's top-left rule, which speaks of
// memory, is Direct3D's.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>

#include "relief/hlsl/types.h"
#include "relief/mesh/mesh.h"
#include "relief/pipeline/render_state.h"
#include "relief/texture/cube_map.h"
#include "relief/texture/sampler.h"

namespace relief::benchmarks {

// Names of OpenGL objects; they live as long as the context.
struct MesaProgram
{
    unsigned name;

    void set(const char* uniform, float value) const;
    void set(const char* uniform, const glm::vec3& value) const;
    void set(const char* uniform, const glm::vec4& value) const;
    void set(const char* uniform, const glm::mat3& value) const;
    void set(const char* uniform, const glm::mat4& value) const;

    // The first lane.
    void set(const char* uniform, Float value) const { set(uniform, value[0]); }
    void set(const char* uniform, const float3& value) const;
    void set(const char* uniform, const float4& value) const;
};

struct MesaMesh
{
    unsigned vertexArray;
    int indexCount;
};

struct MesaTexture
{
    unsigned name;
};

// A target for a pass before the picture, 8-bit colours and a 32-bit float depth, which are textures: by the nearest
// texel, and clamped. As in the picture, row 0 is on top: v goes down.
struct MesaTarget
{
    unsigned framebuffer;
    int width, height;
    std::vector<MesaTexture> colors;
    MesaTexture depth;
};

// How tex2D and texCUBE in fragment programs find the level of detail. Mesa's own takes a straight line between powers
// of two for the logarithm, and is off by up to 0.043 levels; `exact` spells the formula out.
enum class LevelOfDetail
{
    mesas,
    exact
};

class Mesa
{
public:
    // Current on the calling thread as long as it lives; one at a time. Mesa reads its environment variables here.
    static Expected<Mesa> create(int width, int height, LevelOfDetail levelOfDetail);

    // What Mesa calls itself: renderer and version.
    std::string description() const;

    // From GLSL without #version. Vertex programs find `position` at location 0, `normal` at 1, `uv` at 2 and `tangent`
    // at 3, and give flipped(clip position) to gl_Position. Fragment programs have tex2D(sampler, uv) and
    // texCUBE(sampler, direction), and give `result`.
    Expected<MesaProgram> makeProgram(const std::string& vertexProgram, const std::string& fragmentProgram);
    MesaMesh makeMesh(const Mesh& mesh);
    // The texture's own levels, as the sampler reads them but for its limits and bias. Mesa's anisotropic filter is
    // another one, and off.
    MesaTexture makeTexture(const sampler2D& sampler);
    // RGBA8, trilinear, seamless.
    MesaTexture makeCubeMap(const CubeMap& cubeMap);
    // With 0 to 4 colours.
    Expected<MesaTarget> makeTarget(int width, int height, int colors);
    // For a sampler2DShadow: 2x2 comparisons, `reference <= depth`, and 1 outside.
    void compareDepths(const MesaTexture& depth);

    // Of a pixel of the picture; finish() writes their mean.
    Expected<void> setSamples(int samples);

    // Makes it the target of the next draws, cleared to 0 and depth 1.
    void drawInto(const MesaTarget& target);
    // Makes the picture the target, and its depth 1.
    void clear(const glm::vec4& color);
    // Triangles. The textures are those of bindings 0, 1, ...
    void draw(const MesaProgram& program, const MesaMesh& mesh, const RenderState& state,
              const std::vector<MesaTexture>& textures = {});
    void finish();

    // Waits for the picture: R, G, B, A from the lowest byte up, row 0 on top. An error if OpenGL reported one.
    Expected<std::vector<std::uint32_t>> pixels();

private:
    struct Context;
    explicit Mesa(std::shared_ptr<Context> opened) : context(std::move(opened)) {}

    std::shared_ptr<Context> context;
};

}  // namespace relief::benchmarks
