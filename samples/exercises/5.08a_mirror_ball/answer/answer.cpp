// 5.08a A mirror ball: the answer of an exercise. The lines between the marks are what the learner writes.
#include "common/assets.h"
#include "common/stage.h"

namespace relief::samples {
namespace {

struct VertexData {
    POSITION position;
    NORMAL normal;
};

struct Interpolators {
    SV_POSITION position;
    TEXCOORD<0, float3> normal;
    TEXCOORD<1, float3> worldPos;
};

struct MyVertexProgram : Uniforms {
    Interpolators operator()(VertexData v) const {
        Interpolators i;
        i.position = UnityObjectToClipPos(object, v.position);
        i.normal = UnityObjectToWorldNormal(object, v.normal);
        i.worldPos = mul(object.worldFromObject, v.position).xyz();
        return i;
    }
};

struct Surrounded : Uniforms {
    samplerCUBE environment = radiance();
    Float level = number("level", 5.0f, {0, 8}, "of the cube map, in the second and third picture");
    Float exposure = number("exposure", 0.8f, {0, 8}, "what all light is multiplied by");

    float4 ColorIn(const float3& direction) const {
        return float4(texCUBElod(environment, float4(direction, level)).rgb() * exposure, 1);
    }
};

// Where the ray of sight goes on from a mirror.
struct MirrorProgram : Surrounded {
    float4 operator()(Interpolators i) const {
        const float3 viewDir = normalize(worldSpaceCameraPos - i.worldPos);
        const float3 normal = normalize(i.normal);
        // your turn: where the ray of sight goes on from the mirror
        const float3 direction = 2.0f * dot(normal, viewDir) * normal - viewDir;
        // end of your turn
        return ColorIn(direction);
    }
};

// Where it goes if nothing is in its way.
struct SkyProgram : Surrounded {
    float4 operator()(Interpolators i) const { return ColorIn(i.worldPos - worldSpaceCameraPos); }
};

template <class FragmentProgram>
void DrawSurrounded(const Scene& s, const Object& o, bool isSharp, bool seamless, const RenderState& state = {}) {
    FragmentProgram fragment = s.uniforms(o.worldFromObject);
    fragment.environment.seamless = seamless;
    if (isSharp) fragment.level = 0.0f;
    s.draw(*o.mesh, MyVertexProgram(s.uniforms(o.worldFromObject)), fragment, state);
}

void DrawAll(const Scene& s) {
    // A box so large that the camera is in its middle, seen from inside.
    const glm::mat4 around = translation(firstLane(s.uniforms().worldSpaceCameraPos)) * scaling(glm::vec3(50.0f));
    DrawSurrounded<SkyProgram>(s, {&primitive("cube"), around}, true, true, {.cull = Cull::front});
    for (const Object& o : s.objects) DrawSurrounded<MirrorProgram>(s, o, true, true);
}

}  // namespace

Stage exercise_5_08a() {
    return {.title = "A mirror ball",
            .section = "",
            .news = "An exercise of stage 5.08.",
            .uniforms = declared<MirrorProgram>(),
            .mesh = "sphere",
            .camera = {.position = {-1.1f, 0.6f, -1.75f}, .fieldOfView = 46.0f},
            .draw = [](const Scene& s) { DrawAll(s); }};
}

}  // namespace relief::samples
