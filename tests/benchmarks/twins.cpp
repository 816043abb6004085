#include "twins.h"

#include "feature_twins.h"
#include "relief/shading/object_transform.h"
#include "stage_twins.h"

namespace relief::benchmarks {

namespace {

Expected<MesaDrawing> clearOnly(Mesa&, const SceneData&)
{
    return [] {};
}

Expected<MesaDrawing> layers(Mesa& mesa, const SceneData& data)
{
    const Expected<MesaProgram> program = mesa.makeProgram(R"glsl(
uniform float depth;
void main() { gl_Position = flipped(vec4(position.xy * 2.0, depth, 1.0)); }
)glsl",
                                                           R"glsl(
uniform vec4 color;
void main() { result = color; }
)glsl");
    if (!program) return tl::unexpected(program.error());
    return [&mesa, &data, program = *program, mesh = mesa.makeMesh(data.mesh)] {
        for (const Layer& layer : data.layers) {
            program.set("depth", layer.depth);
            program.set("color", layer.color);
            mesa.draw(program, mesh, {.cull = Cull::none});
        }
    };
}

Expected<MesaDrawing> plane(Mesa& mesa, const SceneData& data, const char* fragmentProgram)
{
    const Expected<MesaProgram> program = mesa.makeProgram(R"glsl(
uniform mat4 clipFromObject;
uniform float tiling;
out vec2 planeUv;
void main()
{
    planeUv = (uv - 0.5) * tiling;
    gl_Position = flipped(clipFromObject * vec4(position, 1.0));
}
)glsl",
                                                           fragmentProgram);
    if (!program) return tl::unexpected(program.error());
    program->set("clipFromObject", data.clipFromWorld * data.worldFromObject);
    program->set("tiling", data.tiling);
    program->set("maxAnisotropy", static_cast<float>(data.maxAnisotropy));
    return [&mesa, program = *program, mesh = mesa.makeMesh(data.mesh),
            texture = mesa.makeTexture({.texture = &*data.texture})] { mesa.draw(program, mesh, {}, {texture}); };
}

Expected<MesaDrawing> trilinearPlane(Mesa& mesa, const SceneData& data)
{
    return plane(mesa, data, R"glsl(
layout(binding = 0) uniform sampler2D mainTex;
in vec2 planeUv;
void main() { result = tex2D(mainTex, planeUv); }
)glsl");
}

// Direct3D's anisotropic filter, as the engine has it (texture/sampler.cpp): up to 16 samples in a row. Mesa's own
// weighs all texels in an ellipse: another picture, for more than 20 times the time.
Expected<MesaDrawing> anisotropicPlane(Mesa& mesa, const SceneData& data)
{
    return plane(mesa, data, R"glsl(
layout(binding = 0) uniform sampler2D mainTex;
uniform float maxAnisotropy;
in vec2 planeUv;
void main()
{
    vec2 size = vec2(textureSize(mainTex, 0));
    vec2 dX = dFdxFine(planeUv) * size, dY = dFdyFine(planeUv) * size;
    float xx = dot(dX, dX), yy = dot(dY, dY);
    float square = max(xx, yy), side = sqrt(square), area = abs(dX.x * dY.y - dY.x * dX.y);
    float ratio = clamp(square / area, 1.0, maxAnisotropy);
    float minor = square > area * maxAnisotropy ? side / maxAnisotropy : area / side;
    if (minor < 1.0) ratio = max(ratio * minor, 1.0);
    float taps = ceil(ratio), lod = log2(minor);
    vec2 axis = (xx >= yy ? dX : dY) / size;
    vec4 sum = vec4(0.0);
    for (float i = 0.0; i < taps; i += 1.0) {
        sum += textureLod(mainTex, planeUv + axis * ((2.0 * i + 1.0 - taps) * 0.5 / taps), lod);
    }
    result = sum / taps;
}
)glsl");
}

Expected<MesaDrawing> terrain(Mesa& mesa, const SceneData& data)
{
    const Expected<MesaProgram> program = mesa.makeProgram(R"glsl(
uniform mat4 clipFromObject;
uniform mat3 normalFromObject;
out vec3 worldNormal;
void main()
{
    worldNormal = normalize(normalFromObject * normal);
    gl_Position = flipped(clipFromObject * vec4(position, 1.0));
}
)glsl",
                                                           R"glsl(
uniform vec3 lightDir, color;
in vec3 worldNormal;
void main() { result = vec4(color * clamp(dot(normalize(worldNormal), lightDir), 0.0, 1.0), 1.0); }
)glsl");
    if (!program) return tl::unexpected(program.error());
    program->set("clipFromObject", data.clipFromWorld * data.worldFromObject);
    program->set("normalFromObject", normalMatrix(glm::mat3(data.worldFromObject)));
    program->set("lightDir", data.lightDir);
    program->set("color", data.color);
    return [&mesa, program = *program, mesh = mesa.makeMesh(data.mesh)] { mesa.draw(program, mesh, {}); };
}

Expected<MesaDrawing> smallTriangles(Mesa& mesa, const SceneData& data)
{
    const Expected<MesaProgram> program = mesa.makeProgram(R"glsl(
out vec2 color;
void main()
{
    color = uv;
    gl_Position = flipped(vec4(position, 1.0));
}
)glsl",
                                                           R"glsl(
in vec2 color;
void main() { result = vec4(color, 0.5, 1.0); }
)glsl");
    if (!program) return tl::unexpected(program.error());
    return [&mesa, program = *program, mesh = mesa.makeMesh(data.mesh)] {
        mesa.draw(program, mesh, {.cull = Cull::none});
    };
}

}  // namespace

const std::vector<Twin>& twins()
{
    static const std::vector<Twin> all = {
        {"clear", clearOnly},
        {"flat_quad", layers},
        {"trilinear_plane", trilinearPlane},
        {"anisotropic_plane", anisotropicPlane},
        {"million_triangles", terrain},
        {"layers_32", layers},
        {"small_triangles", smallTriangles},
        {"stage_1.25", litScene},
        {"stage_2.06", twoLights},
        {"stage_4.07", reorientedNormals},
        {"multisampled", sunlit},
        {"shadowed", shadowed},
        {"reflecting", reflecting},
        {"deferred", deferred},
    };
    return all;
}

}  // namespace relief::benchmarks
