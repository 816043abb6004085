#include "stage_twins.h"

namespace relief::benchmarks {

namespace {

using samples::Object;
using samples::Scene;

// Light that a further pass adds where the depth of the first one is seen.
constexpr RenderState kAdditivePass = {.depthTest = Compare::equal, .depthWrite = false, .blend = Blend::additive};

// Of all vertex programs: the fields of ObjectTransform. Passes of several programs meet at the same depth.
const std::string kObjectTransform = R"glsl(
uniform mat4 clipFromObject, worldFromObject;
uniform mat3 normalFromObject;
invariant gl_Position;
)glsl";

void setObject(const MesaProgram& program, const Scene& scene, const Object& object)
{
    program.set("clipFromObject", firstLane(scene.uniforms(object.worldFromObject).object.clipFromObject));
    program.set("worldFromObject", object.worldFromObject);
    program.set("normalFromObject", normalMatrix(glm::mat3(object.worldFromObject)));
}

// The scene's objects, as Mesa's.
struct MesaObject
{
    Object object;
    MesaMesh mesh;
};

std::vector<MesaObject> objectsOf(Mesa& mesa, const Scene& scene)
{
    std::vector<MesaObject> objects;
    for (const Object& object : scene.objects) objects.push_back({object, mesa.makeMesh(*object.mesh)});
    return objects;
}

// UnpackScaleNormal of DXT5nm.
const std::string kUnpackScaleNormal = R"glsl(
vec3 unpackScaleNormal(vec4 texel, float scale)
{
    vec2 slope = (texel.wy * 2.0 - 1.0) * scale;
    return vec3(slope, sqrt(1.0 - clamp(dot(slope, slope), 0.0, 1.0)));
}
)glsl";

}  // namespace

// --- 1.25 Lit scene ---

namespace {

const char* const kLitVertexProgram = R"glsl(
uniform vec4 mainTex_ST, detailTex_ST;
out vec3 worldNormal, worldTangent, worldBinormal, worldPos;
out vec4 bothUv;  // main in xy, detail in zw
void main()
{
    worldPos = (worldFromObject * vec4(position, 1.0)).xyz;
    worldNormal = normalize(normalFromObject * normal);
    worldTangent = normalize(mat3(worldFromObject) * tangent.xyz);
    worldBinormal = cross(worldNormal, worldTangent) * (tangent.w < 0.0 ? -1.0 : 1.0);
    bothUv = vec4(uv * mainTex_ST.xy + mainTex_ST.zw, uv * detailTex_ST.xy + detailTex_ST.zw);
    gl_Position = flipped(clipFromObject * vec4(position, 1.0));
}
)glsl";

// What arrives of a light, and from where: one function for each kind.
const char* const kDirectionalLight = R"glsl(
uniform vec3 lightColor, lightDir;
void createLight(vec3 worldPos, out vec3 color, out vec3 dir)
{
    color = lightColor;
    dir = lightDir;
}
)glsl";

const std::string kPointLight = R"glsl(
uniform vec3 lightColor, lightPosition;
uniform float range;
float rangeAttenuation(vec3 toLight)
{
    float part = max(dot(toLight, toLight), 1e-6) / (range * range);
    float fade = clamp((1.0 - sqrt(part)) * 5.0, 0.0, 1.0);
    return fade > 0.0 ? fade / (1.0 + 25.0 * part) : 0.0;
}
void pointLight(vec3 worldPos, out vec3 color, out vec3 dir)
{
    vec3 toLight = lightPosition - worldPos;
    color = lightColor * rangeAttenuation(toLight);
    dir = normalize(toLight);
}
#define createLight pointLight
)glsl";

const std::string kSpotLight = kPointLight + R"glsl(
uniform vec3 axis;
uniform float cosOuter, cosInner;
void spotLight(vec3 worldPos, out vec3 color, out vec3 dir)
{
    pointLight(worldPos, color, dir);
    float cosine = -dot(dir, axis);
    color *= cosine > 0.0 ? smoothstep(cosOuter, cosInner, cosine) : 0.0;
}
#undef createLight
#define createLight spotLight
)glsl";

const char* const kLitFragmentProgram = R"glsl(
layout(binding = 0) uniform sampler2D mainTex;
layout(binding = 1) uniform sampler2D detailTex;
layout(binding = 2) uniform sampler2D normalMap;
layout(binding = 3) uniform sampler2D detailNormalMap;
uniform vec4 tint;
uniform float metallic, smoothness, bumpScale, detailBumpScale;
uniform vec3 cameraPos;
in vec3 worldNormal, worldTangent, worldBinormal, worldPos;
in vec4 bothUv;

float pow5(float x)
{
    float square = x * x;
    return square * square * x;
}

// Unity's BRDF1 without its 1 / pi: Disney's diffuse, GGX, Schlick's Fresnel.
vec3 brdf(vec3 diffuseColor, vec3 specularColor, vec3 n, vec3 v, vec3 l)
{
    float perceptualRoughness = 1.0 - clamp(smoothness, 0.0, 1.0);
    vec3 sum = l + v;
    vec3 h = sum * (1.0 / sqrt(max(0.001, dot(sum, sum))));
    float nl = clamp(dot(n, l), 0.0, 1.0), nv = abs(dot(n, v));
    float nh = clamp(dot(n, h), 0.0, 1.0), lh = clamp(dot(l, h), 0.0, 1.0);

    float roughness = max(perceptualRoughness * perceptualRoughness, 0.002);
    float lambdaV = nl * (nv * (1.0 - roughness) + roughness);
    float lambdaL = nv * (nl * (1.0 - roughness) + roughness);
    float visible = 0.5 / (lambdaV + lambdaL + 1e-5);
    float a2 = roughness * roughness;
    float d = (nh * a2 - nh) * nh + 1.0;
    float facing = a2 / (3.14159265 * (d * d + 1e-7));
    float specular = max(0.0, visible * facing * 3.14159265 * nl);

    float fd90 = 0.5 + 2.0 * lh * lh * perceptualRoughness;
    float diffuse = (1.0 + (fd90 - 1.0) * pow5(1.0 - nl)) * (1.0 + (fd90 - 1.0) * pow5(1.0 - nv)) * nl;
    vec3 fresnel = specularColor + (1.0 - specularColor) * pow5(1.0 - lh);
    return diffuseColor * diffuse + fresnel * specular;
}

void main()
{
    vec3 bump = unpackScaleNormal(tex2D(normalMap, bothUv.xy), bumpScale);
    vec3 detail = unpackScaleNormal(tex2D(detailNormalMap, bothUv.zw), detailBumpScale);
    vec3 both = normalize(vec3(bump.xy + detail.xy, bump.z * detail.z));
    vec3 n = normalize(worldTangent * both.x + worldBinormal * both.y + worldNormal * both.z);
    vec3 v = normalize(cameraPos - worldPos);

    vec3 albedo = tex2D(mainTex, bothUv.xy).rgb * tint.rgb;
    albedo *= tex2D(detailTex, bothUv.zw).rgb * 4.59479380;
    float metal = clamp(metallic, 0.0, 1.0);
    vec3 specularColor = mix(vec3(0.04), albedo, metal);
    vec3 diffuseColor = albedo * ((1.0 - 0.04) * (1.0 - metal));

    vec3 color, l;
    createLight(worldPos, color, l);
    result = vec4(brdf(diffuseColor, specularColor, n, v, l) * color, 1.0);
}
)glsl";

// The stage's, number by number.
struct Lights
{
    DirectionalLight sun;
    PointLight lamp;
    SpotLight spot;
};

struct LitScene : samples::DetailedMarble
{
    Float sunStrength = number("sunStrength", 0.0f, {}, "");
    Float lightStrength = number("lightStrength", 0.0f, {}, "");
};

Lights lightsOf(const LitScene& s)
{
    const Float strength = s.lightStrength;
    return {{s.light.color * s.sunStrength, s.light.dir},
            {float3(0.25f, 0.5f, 1.0f) * strength, {-0.7f, 0.9f, -0.9f}, 1.6f},
            {float3(1.0f, 0.5f, 0.15f) * strength,
             {1.7f, 1.7f, -0.9f},
             4.0f,
             normalize(float3(-0.47f, -0.75f, 0.43f)),
             0.9f,
             0.97f}};
}

Expected<MesaProgram> litProgram(Mesa& mesa, const LitScene& s, const std::string& light)
{
    const Expected<MesaProgram> program =
        mesa.makeProgram(kObjectTransform + kLitVertexProgram, kUnpackScaleNormal + light + kLitFragmentProgram);
    if (!program) return program;
    program->set("mainTex_ST", s.mainTex_ST);
    program->set("detailTex_ST", s.detailTex_ST);
    program->set("tint", s.tint);
    program->set("metallic", s.metallic);
    program->set("smoothness", s.smoothness);
    program->set("bumpScale", s.bumpScale);
    program->set("detailBumpScale", s.detailBumpScale);
    program->set("cameraPos", s.worldSpaceCameraPos);
    return program;
}

}  // namespace

Expected<MesaDrawing> litScene(Mesa& mesa, const SceneData& data)
{
    const Scene& scene = *data.stageScene;
    const LitScene uniforms = scene.uniforms();
    const Lights lights = lightsOf(uniforms);
    const Expected<MesaProgram> sun = litProgram(mesa, uniforms, kDirectionalLight);
    const Expected<MesaProgram> lamp = litProgram(mesa, uniforms, kPointLight);
    const Expected<MesaProgram> spot = litProgram(mesa, uniforms, kSpotLight);
    for (const auto* program : {&sun, &lamp, &spot}) {
        if (!*program) return tl::unexpected(program->error());
    }
    sun->set("lightColor", lights.sun.color);
    sun->set("lightDir", lights.sun.dir);
    lamp->set("lightColor", lights.lamp.color);
    lamp->set("lightPosition", lights.lamp.position);
    lamp->set("range", lights.lamp.range);
    spot->set("lightColor", lights.spot.color);
    spot->set("lightPosition", lights.spot.position);
    spot->set("range", lights.spot.range);
    spot->set("axis", lights.spot.axis);
    spot->set("cosOuter", lights.spot.cosOuter);
    spot->set("cosInner", lights.spot.cosInner);
    const std::vector<MesaTexture> textures = {mesa.makeTexture(uniforms.mainTex), mesa.makeTexture(uniforms.detailTex),
                                               mesa.makeTexture(uniforms.normalMap),
                                               mesa.makeTexture(uniforms.detailNormalMap)};
    struct Pass
    {
        MesaProgram program;
        RenderState state;
        MesaObject object;
    };
    std::vector<Pass> passes;
    for (const MesaObject& o : objectsOf(mesa, scene)) {
        passes.push_back({*sun, {}, o});
        if (scene.reaches("the lamp", lights.lamp, o.object)) passes.push_back({*lamp, kAdditivePass, o});
        if (scene.reaches("the spot", lights.spot, o.object)) passes.push_back({*spot, kAdditivePass, o});
    }
    return [&mesa, &scene, passes, textures] {
        for (const Pass& pass : passes) {
            setObject(pass.program, scene, pass.object.object);
            mesa.draw(pass.program, pass.object.mesh, pass.state, textures);
        }
    };
}

// --- 2.06 Two lights ---

namespace {

struct Lamp : samples::PhongMaterial
{
    Float lamp = number("lamp", 0.0f, {}, "");
    float3 lampPosition = vector("lampPosition", glm::vec3(0.0f), {}, "");
};

}  // namespace

Expected<MesaDrawing> twoLights(Mesa& mesa, const SceneData& data)
{
    const Scene& scene = *data.stageScene;
    const Expected<MesaProgram> program = mesa.makeProgram(kObjectTransform + R"glsl(
out vec3 worldTangent, worldBinormal, worldNormal, worldPos;
out vec2 mapUv;
void main()
{
    worldTangent = normalize(mat3(worldFromObject) * tangent.xyz);
    worldNormal = normalize(normalFromObject * normal);
    worldBinormal = normalize(cross(worldNormal, worldTangent) * tangent.w);
    worldPos = (worldFromObject * vec4(position, 1.0)).xyz;
    mapUv = uv;
    gl_Position = flipped(clipFromObject * vec4(position, 1.0));
}
)glsl",
                                                           R"glsl(
layout(binding = 0) uniform sampler2D bumpMap;
uniform vec4 bumpMap_ST, color, specColor, lightPosition;
uniform float shininess, tutorialForm;
uniform vec3 cameraPos, ambient, lightColor;
in vec3 worldTangent, worldBinormal, worldNormal, worldPos;
in vec2 mapUv;
void main()
{
    vec2 slope = tex2D(bumpMap, mapUv * bumpMap_ST.xy + bumpMap_ST.zw).wy * 2.0 - 1.0;
    float up = sqrt(1.0 - clamp(dot(slope, slope), 0.0, 1.0));
    vec3 n = normalize(worldTangent * slope.x + worldBinormal * slope.y + worldNormal * up);
    vec3 v = normalize(cameraPos - worldPos);
    vec3 toLight = lightPosition.xyz - worldPos * lightPosition.w;
    vec3 l = normalize(toLight);
    float attenuation = lightPosition.w == 0.0 ? 1.0 : 1.0 / max(length(toLight), 1e-3);

    float nl = dot(n, l);
    vec3 diffuse = lightColor * color.rgb * (attenuation * max(0.0, nl));
    float rv = clamp(dot(reflect(-l, n), v), 0.0, 1.0);
    float cut = nl < 0.0 ? 0.0 : tutorialForm > 0.0 ? 1.0 : nl;
    vec3 specular = lightColor * specColor.rgb * (attenuation * pow(rv, shininess) * cut);
    result = vec4(ambient * color.rgb + diffuse + specular, 1.0);
}
)glsl");
    if (!program) return tl::unexpected(program.error());
    const Lamp uniforms = scene.uniforms();
    program->set("bumpMap_ST", uniforms.bumpMap_ST);
    program->set("color", uniforms.color);
    program->set("specColor", uniforms.specColor);
    program->set("shininess", uniforms.shininess);
    program->set("tutorialForm", uniforms.tutorialForm);
    program->set("cameraPos", uniforms.worldSpaceCameraPos);
    return [&mesa, &scene, uniforms, program = *program, objects = objectsOf(mesa, scene),
            bumpMap = mesa.makeTexture(uniforms.bumpMap)] {
        for (const MesaObject& o : objects) {
            setObject(program, scene, o.object);
            program.set("ambient", uniforms.ambient);
            program.set("lightPosition", uniforms.worldSpaceLightPos0);
            program.set("lightColor", uniforms.lightColor0);
            mesa.draw(program, o.mesh, {}, {bumpMap});
            program.set("ambient", float3(Float(0.0f)));
            program.set("lightPosition", float4(uniforms.lampPosition, 1.0f));
            program.set("lightColor", float3(0.25f, 0.5f, 1.0f) * uniforms.lamp);
            mesa.draw(program, o.mesh, kAdditivePass, {bumpMap});
        }
    };
}

// --- 4.07 Reoriented normal mapping ---

Expected<MesaDrawing> reorientedNormals(Mesa& mesa, const SceneData& data)
{
    const Scene& scene = *data.stageScene;
    const Expected<MesaProgram> program = mesa.makeProgram(kObjectTransform + R"glsl(
out vec3 worldPos, worldNormal;
void main()
{
    worldPos = (worldFromObject * vec4(position, 1.0)).xyz;
    worldNormal = normalize(normalFromObject * normal);
    gl_Position = flipped(clipFromObject * vec4(position, 1.0));
}
)glsl",
                                                           kUnpackScaleNormal + R"glsl(
layout(binding = 0) uniform sampler2D mainTex;
layout(binding = 1) uniform sampler2D normalMap;
uniform float tiling, bumpScale;
uniform vec3 ambient, lightColor, lightDir;
in vec3 worldPos, worldNormal;

// Turns `bump` as (0, 0, 1) is turned to `surface`, whose z is not negative.
vec3 reoriented(vec3 surface, vec3 bump)
{
    vec3 t = surface + vec3(0.0, 0.0, 1.0);
    vec3 u = bump * vec3(-1.0, -1.0, 1.0);
    return normalize(t * (dot(t, u) / t.z) - u);
}

void main()
{
    vec3 n = normalize(worldNormal);
    vec3 place = worldPos * tiling;
    vec2 uvX = place.zy, uvY = place.xz, uvZ = place.xy;
    vec3 weights = max(abs(n) - 0.2, 0.0);
    weights /= weights.x + weights.y + weights.z;

    // All planes are fetched: in Mesa branches around the fetches cost more than they save.
    vec3 albedo = tex2D(mainTex, uvX).rgb * weights.x + tex2D(mainTex, uvY).rgb * weights.y +
                  tex2D(mainTex, uvZ).rgb * weights.z;
    vec3 bumpX = unpackScaleNormal(tex2D(normalMap, uvX), bumpScale);
    vec3 bumpY = unpackScaleNormal(tex2D(normalMap, uvY), bumpScale);
    vec3 bumpZ = unpackScaleNormal(tex2D(normalMap, uvZ), bumpScale);

    vec3 facing = abs(n), side = mix(vec3(1.0), vec3(-1.0), lessThan(n, vec3(0.0)));
    bumpX = reoriented(vec3(n.zy, facing.x), bumpX);
    bumpY = reoriented(vec3(n.xz, facing.y), bumpY);
    bumpZ = reoriented(vec3(n.xy, facing.z), bumpZ);
    bumpX.z *= side.x;
    bumpY.z *= side.y;
    bumpZ.z *= side.z;
    vec3 bumped = normalize(bumpX.zyx * weights.x + bumpY.xzy * weights.y + bumpZ * weights.z);
    result = vec4(albedo * (lightColor * clamp(dot(bumped, lightDir), 0.0, 1.0) + ambient), 1.0);
}
)glsl");
    if (!program) return tl::unexpected(program.error());
    const samples::TriplanarMaterial uniforms = scene.uniforms();
    program->set("tiling", uniforms.tiling);
    program->set("bumpScale", uniforms.bumpScale);
    program->set("ambient", uniforms.ambient);
    program->set("lightColor", uniforms.light.color);
    program->set("lightDir", uniforms.light.dir);
    const std::vector<MesaTexture> textures = {mesa.makeTexture(uniforms.mainTex),
                                               mesa.makeTexture(uniforms.normalMap)};
    return [&mesa, &scene, textures, program = *program, objects = objectsOf(mesa, scene)] {
        for (const MesaObject& o : objects) {
            setObject(program, scene, o.object);
            mesa.draw(program, o.mesh, {}, textures);
        }
    };
}

}  // namespace relief::benchmarks
