#include "twins.h"

#include "shading/object_transform.h"

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
            mesa.draw(program, mesh, MesaCull::none);
        }
    };
}

Expected<MesaDrawing> plane(Mesa& mesa, const SceneData& data)
{
    const Expected<MesaProgram> program = mesa.makeProgram(R"glsl(
uniform mat4 clipFromObject;
uniform float tiling;
out vec2 planeUv;
void main()
{
    planeUv = uv * tiling;
    gl_Position = flipped(clipFromObject * vec4(position, 1.0));
}
)glsl",
                                                           R"glsl(
layout(binding = 0) uniform sampler2D mainTex;
in vec2 planeUv;
void main() { result = texture(mainTex, planeUv); }
)glsl");
    if (!program) return tl::unexpected(program.error());
    program->set("clipFromObject", data.clipFromWorld * data.worldFromObject);
    program->set("tiling", data.tiling);
    return [&mesa, program = *program, mesh = mesa.makeMesh(data.mesh),
            texture = mesa.makeTexture(*data.texture, data.maxAnisotropy)] {
        mesa.draw(program, mesh, MesaCull::back, texture);
    };
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
    return [&mesa, program = *program, mesh = mesa.makeMesh(data.mesh)] { mesa.draw(program, mesh, MesaCull::back); };
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
    return [&mesa, program = *program, mesh = mesa.makeMesh(data.mesh)] { mesa.draw(program, mesh, MesaCull::none); };
}

}  // namespace

const std::vector<Twin>& twins()
{
    static const std::vector<Twin> all = {
        {"clear", clearOnly},
        {"flat_quad", layers},
        {"trilinear_plane", plane},
        {"anisotropic_plane", plane},
        {"million_triangles", terrain},
        {"layers_32", layers},
        {"small_triangles", smallTriangles},
    };
    return all;
}

}  // namespace relief::benchmarks
