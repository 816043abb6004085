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
    program.set("clipFromObject", firstLane(scene.object(object.worldFromObject).clipFromObject));
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

}  // namespace

// --- 2.06 Two lights ---

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
    for (const char* name : {"bumpMap_ST", "color", "specColor"}) program->set(name, scene.vector(name));
    for (const char* name : {"shininess", "tutorialForm"}) program->set(name, scene.number(name));
    program->set("cameraPos", scene.worldSpaceCameraPos);
    const float3 lampColor = float3(0.25f, 0.5f, 1.0f) * scene.number("lamp");
    return [&mesa, &scene, lampColor, program = *program, objects = objectsOf(mesa, scene),
            bumpMap = mesa.makeTexture(scene.normalMap)] {
        for (const MesaObject& o : objects) {
            setObject(program, scene, o.object);
            program.set("ambient", scene.vector("ambient").xyz());
            program.set("lightPosition", float4(scene.light.dir, Float(0.0f)));
            program.set("lightColor", scene.light.color * scene.number("sun"));
            mesa.draw(program, o.mesh, {}, {bumpMap});
            program.set("ambient", float3(Float(0.0f)));
            program.set("lightPosition", float4(scene.vector("lampPosition").xyz(), Float(1.0f)));
            program.set("lightColor", lampColor);
            mesa.draw(program, o.mesh, kAdditivePass, {bumpMap});
        }
    };
}

}  // namespace relief::benchmarks
