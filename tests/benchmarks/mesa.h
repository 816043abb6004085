// Mesa's llvmpipe, the strongest other rasterizer on a CPU, as far as the comparison needs it: OpenGL 4.5 core without
// a window (EGL, surfaceless), drawing into one target of 8-bit colour and 32-bit float depth.
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

#include "hlsl/types.h"
#include "mesh/mesh.h"
#include "pipeline/render_state.h"
#include "texture/sampler.h"

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

// How tex2D in fragment programs finds the level of detail. Mesa's own takes a straight line between powers of two for
// the logarithm, and is off by up to 0.043 levels; `exact` spells the formula out.
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
    // at 3, and give flipped(clip position) to gl_Position. Fragment programs have tex2D(sampler, uv), and give
    // `result`.
    Expected<MesaProgram> makeProgram(const std::string& vertexProgram, const std::string& fragmentProgram);
    MesaMesh makeMesh(const Mesh& mesh);
    // The texture's own levels, as the sampler reads them but for its limits and bias. Mesa's anisotropic filter is
    // another one, and off.
    MesaTexture makeTexture(const sampler2D& sampler);

    // Depth to 1.
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
