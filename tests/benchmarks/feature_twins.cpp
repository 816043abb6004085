#include "feature_twins.h"

#include <glm/matrix.hpp>

#include "feature_scenes.h"
#include "relief/shading/object_transform.h"

namespace relief::benchmarks {

namespace {

const std::string kBumpyVertexProgram = R"glsl(
uniform mat4 clipFromObject, worldFromObject;
uniform mat3 normalFromObject;
uniform float tiling;
out vec3 worldNormal, worldPos;
out vec4 worldTangent;
out vec2 mapUv;
void main()
{
    mapUv = uv * tiling;
    worldNormal = normalize(normalFromObject * normal);
    worldTangent = vec4(normalize(mat3(worldFromObject) * tangent.xyz), tangent.w);
    worldPos = (worldFromObject * vec4(position, 1.0)).xyz;
    gl_Position = flipped(clipFromObject * vec4(position, 1.0));
}
)glsl";

const std::string kBumps = R"glsl(
layout(binding = 0) uniform sampler2D normalMap;
uniform float bumpScale;
in vec3 worldNormal, worldPos;
in vec4 worldTangent;
in vec2 mapUv;
vec3 bumpyNormal()
{
    vec2 slope = (tex2D(normalMap, mapUv).wy * 2.0 - 1.0) * bumpScale;
    float up = sqrt(1.0 - clamp(dot(slope, slope), 0.0, 1.0));
    vec3 binormal = cross(worldNormal, worldTangent.xyz) * (worldTangent.w < 0.0 ? -1.0 : 1.0);
    return normalize(worldTangent.xyz * slope.x + binormal * slope.y + worldNormal * up);
}
)glsl";

const std::string kSun = R"glsl(
uniform vec3 color, lightDir, cameraPos;
uniform float ambient, shininess, specularStrength;
vec3 lit(vec3 place, vec3 n, float share)
{
    vec3 halfway = normalize(lightDir + normalize(cameraPos - place));
    float specular = pow(clamp(dot(n, halfway), 0.0, 1.0), shininess) * specularStrength;
    return color * (clamp(dot(n, lightDir), 0.0, 1.0) * share + ambient) + specular * share;
}
)glsl";

// Those uniforms that a program does not have are left out by OpenGL.
Expected<MesaProgram> makeProgram(Mesa& mesa, const SceneData& data, const std::string& vertexProgram,
                                  const std::string& fragmentProgram)
{
    const Expected<MesaProgram> program = mesa.makeProgram(vertexProgram, fragmentProgram);
    if (!program) return program;
    program->set("bumpScale", kBumpScale);
    program->set("color", data.color);
    program->set("lightDir", data.lightDir);
    program->set("cameraPos", data.cameraPos);
    program->set("ambient", kAmbient);
    program->set("shininess", kShininess);
    program->set("specularStrength", kSpecular);
    return program;
}

struct MesaPiece
{
    MesaMesh mesh;
    glm::mat4 worldFromObject;
    float tiling;
};

std::vector<MesaPiece> piecesOf(Mesa& mesa, const SceneData& data)
{
    std::vector<MesaPiece> pieces;
    for (const Piece& p : data.pieces) pieces.push_back({mesa.makeMesh(p.mesh), p.worldFromObject, p.tiling});
    return pieces;
}

void drawPieces(Mesa& mesa, const std::vector<MesaPiece>& pieces, const glm::mat4& clipFromWorld,
                const MesaProgram& program, const std::vector<MesaTexture>& textures)
{
    for (const MesaPiece& piece : pieces) {
        program.set("clipFromObject", clipFromWorld * piece.worldFromObject);
        program.set("worldFromObject", piece.worldFromObject);
        program.set("normalFromObject", normalMatrix(glm::mat3(piece.worldFromObject)));
        program.set("tiling", piece.tiling);
        mesa.draw(program, piece.mesh, {}, textures);
    }
}

}  // namespace

Expected<MesaDrawing> sunlit(Mesa& mesa, const SceneData& data)
{
    const Expected<MesaProgram> program = makeProgram(mesa, data, kBumpyVertexProgram, kBumps + kSun + R"glsl(
void main() { result = vec4(lit(worldPos, bumpyNormal(), 1.0), 1.0); }
)glsl");
    if (!program) return tl::unexpected(program.error());
    return [&mesa, &data, program = *program, pieces = piecesOf(mesa, data),
            normalMap = mesa.makeTexture({.texture = &*data.texture})] {
        drawPieces(mesa, pieces, data.clipFromWorld, program, {normalMap});
    };
}

// What a pass draws has row 0 on top, as the picture: so 1 - v is where uv's v is.
Expected<MesaDrawing> shadowed(Mesa& mesa, const SceneData& data)
{
    const Expected<MesaProgram> depths = makeProgram(mesa, data, R"glsl(
uniform mat4 clipFromObject;
void main() { gl_Position = flipped(clipFromObject * vec4(position, 1.0)); }
)glsl",
                                                     "void main() {}");
    if (!depths) return tl::unexpected(depths.error());
    const Expected<MesaProgram> program = makeProgram(mesa, data, kBumpyVertexProgram, kBumps + kSun + R"glsl(
layout(binding = 1) uniform sampler2DShadow shadowMap;
uniform mat4 lightFromWorld;
uniform float normalOffset;
void main()
{
    vec3 p = (lightFromWorld * vec4(worldPos + normalize(worldNormal) * normalOffset, 1.0)).xyz;
    float share = texture(shadowMap, vec3(p.x * 0.5 + 0.5, 0.5 - p.y * 0.5, p.z));
    result = vec4(lit(worldPos, bumpyNormal(), share), 1.0);
}
)glsl");
    if (!program) return tl::unexpected(program.error());
    program->set("lightFromWorld", data.lightFromWorld);
    program->set("normalOffset", kNormalOffset);
    const Expected<MesaTarget> map = mesa.makeTarget(kShadowMapSide, kShadowMapSide, 0);
    if (!map) return tl::unexpected(map.error());
    mesa.compareDepths(map->depth);
    const std::vector<MesaTexture> textures = {mesa.makeTexture({.texture = &*data.texture}), map->depth};
    const std::vector<MesaPiece> pieces = piecesOf(mesa, data);
    return MesaDrawing([&mesa, &data, program = *program, pieces,
                        textures] { drawPieces(mesa, pieces, data.clipFromWorld, program, textures); },
                       [&mesa, &data, program = *depths, pieces, map = *map] {
                           mesa.drawInto(map);
                           drawPieces(mesa, pieces, data.lightFromWorld, program, {});
                       });
}

Expected<MesaDrawing> reflecting(Mesa& mesa, const SceneData& data)
{
    const Expected<MesaProgram> program = makeProgram(mesa, data, kBumpyVertexProgram, kBumps + R"glsl(
layout(binding = 1) uniform samplerCube environment;
uniform vec3 cameraPos;
void main()
{
    vec3 v = normalize(cameraPos - worldPos);
    result = vec4(texCUBE(environment, reflect(-v, bumpyNormal())).rgb, 1.0);
}
)glsl");
    if (!program) return tl::unexpected(program.error());
    const std::vector<MesaTexture> textures = {mesa.makeTexture({.texture = &*data.texture}),
                                               mesa.makeCubeMap(*data.cubeMap)};
    return [&mesa, &data, program = *program, pieces = piecesOf(mesa, data), textures] {
        drawPieces(mesa, pieces, data.clipFromWorld, program, textures);
    };
}

Expected<MesaDrawing> deferred(Mesa& mesa, const SceneData& data)
{
    const Expected<MesaProgram> write = makeProgram(mesa, data, kBumpyVertexProgram, kBumps + R"glsl(
layout(binding = 1) uniform sampler2D mainTex;
layout(location = 1) out vec4 codedNormal;
void main()
{
    result = tex2D(mainTex, mapUv);
    codedNormal = vec4(bumpyNormal() * 0.5 + 0.5, 1.0);
}
)glsl");
    if (!write) return tl::unexpected(write.error());
    const Expected<MesaProgram> light = makeProgram(mesa, data, R"glsl(
out vec2 screenUv;
void main()
{
    screenUv = uv;
    gl_Position = flipped(vec4(position.xy * 2.0, 0.5, 1.0));
}
)glsl",
                                                    kSun + R"glsl(
layout(binding = 0) uniform sampler2D albedos;
layout(binding = 1) uniform sampler2D normals;
layout(binding = 2) uniform sampler2D depths;
uniform mat4 worldFromClip;
uniform vec3 lampPosition, lampColor;
in vec2 screenUv;
void main()
{
    vec2 place = vec2(screenUv.x, 1.0 - screenUv.y);
    float depth = texture(depths, place).x;
    if (depth == 1.0) discard;
    vec4 p = worldFromClip * vec4(screenUv * 2.0 - 1.0, depth, 1.0);
    vec3 worldPos = p.xyz / p.w;
    vec3 n = normalize(texture(normals, place).xyz * 2.0 - 1.0);
    vec3 toLamp = lampPosition - worldPos;
    float square = dot(toLamp, toLamp);
    float lamp = clamp(dot(n, toLamp * inversesqrt(square)), 0.0, 1.0) / (1.0 + 4.0 * square);
    result = vec4(texture(albedos, place).rgb * (lit(worldPos, n, 1.0) + lampColor * lamp), 1.0);
}
)glsl");
    if (!light) return tl::unexpected(light.error());
    light->set("worldFromClip", glm::inverse(data.clipFromWorld));
    light->set("lampPosition", kLampPosition);
    light->set("lampColor", kLampColor);
    const Framebuffer& size = data.pass->target;
    const Expected<MesaTarget> target = mesa.makeTarget(size.width(), size.height(), 2);
    if (!target) return tl::unexpected(target.error());
    const std::vector<MesaTexture> textures = {mesa.makeTexture({.texture = &*data.texture}),
                                               mesa.makeTexture({.texture = &*data.albedo})};
    return MesaDrawing(
        [&mesa, program = *light, quad = mesa.makeMesh(data.mesh), target = *target] {
            mesa.draw(program, quad, {}, {target.colors[0], target.colors[1], target.depth});
        },
        [&mesa, &data, program = *write, pieces = piecesOf(mesa, data), textures, target = *target] {
            mesa.drawInto(target);
            drawPieces(mesa, pieces, data.clipFromWorld, program, textures);
        });
}

}  // namespace relief::benchmarks
