// 5.08 Environment: Blinn and Newell 1976; Greene 1986; D3D 11.3 7.18
// New: a cube map in place of a lamp: what is around, in the direction that a mirror looks.
// Was: a cube of depths (5.07).
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
    TEXCOORD<0, float3> normal;    // new
    TEXCOORD<1, float3> worldPos;  // new
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

struct Surrounded : Uniforms {                                                                        // new
    samplerCUBE environment = radiance();                                                             // new
    Float level = number("level", 5.0f, {0, 8}, "of the cube map, in the second and third picture");  // new
    Float exposure = number("exposure", 0.8f, {0, 8}, "what all light is multiplied by");             // new

    float4 ColorIn(const float3& direction) const {                                            // new
        return float4(texCUBElod(environment, float4(direction, level)).rgb() * exposure, 1);  // new
    }
};

// Where the ray of sight goes on from a mirror.
struct MirrorProgram : Surrounded {  // new
    float4 operator()(Interpolators i) const {
        const float3 viewDir = normalize(worldSpaceCameraPos - i.worldPos);  // new
        return ColorIn(reflect(-viewDir, normalize(i.normal)));              // new
    }
};

// Where it goes if nothing is in its way.
struct SkyProgram : Surrounded {                                                                    // new
    float4 operator()(Interpolators i) const { return ColorIn(i.worldPos - worldSpaceCameraPos); }  // new
};

template <class FragmentProgram>  // new
void DrawSurrounded(const Scene& s, const Object& o, bool isSharp, bool seamless, const RenderState& state = {}) {
    FragmentProgram fragment = s.uniforms(o.worldFromObject);                          // new
    fragment.environment.seamless = seamless;                                          // new
    if (isSharp) fragment.level = 0.0f;                                                // new
    s.draw(*o.mesh, MyVertexProgram(s.uniforms(o.worldFromObject)), fragment, state);  // new
}

void DrawColumn(const Scene& s, int column, bool isSharp, bool seamless) {  // new
    s.cutCell(column, 3);                                                   // new
    // A box so large that the camera is in its middle, seen from inside.
    const glm::mat4 around = translation(firstLane(s.uniforms().worldSpaceCameraPos)) * scaling(glm::vec3(50.0f));
    DrawSurrounded<SkyProgram>(s, {&primitive("cube"), around}, isSharp, seamless, {.cull = Cull::front});  // new
    for (const Object& o : s.objects) DrawSurrounded<MirrorProgram>(s, o, isSharp, seamless);               // new
}

}  // namespace

Stage beyond_08_environment() {
    return {
        .title = "Environment",
        .section = "Blinn and Newell 1976; Greene 1986; D3D 11.3 7.18",
        .news = "A mirror in a cube map; a coarse level of it, with filters that end at a face's edge, and without.",
        .uniforms = declared<MirrorProgram>(),
        .mesh = "sphere",
        .camera = {.position = {-1.1f, 0.6f, -1.75f}, .fieldOfView = 46.0f},
        .draw = [](const Scene& s) {
            DrawColumn(s, 0, true, true);
            DrawColumn(s, 1, false, false);
            DrawColumn(s, 2, false, true);
            s.labelColumns({"a mirror", "wrong: seams", "seamless"});
        }};
}

}  // namespace relief::samples
