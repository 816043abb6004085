// 5.19 Mirror: Kilgard 1999; D3D 11.3 17.13
// New: stencil. A bumpy floor marks its pixels; the mirrored scene is drawn there alone, cut off at the floor.
// Was: light, shadows, and nothing that shows anything else (5.18).
#include "common/screen_quad.h"
#include "common/stage.h"

namespace relief::samples {
namespace {

struct VertexData {
    POSITION position;
    NORMAL normal;
    TANGENT tangent;
    TEXCOORD<0, float2> uv;
};

struct Interpolators {
    SV_POSITION position;
    SV_ClipDistance<0, Float> aboveFloor;
    TEXCOORD<0, float2> uv;
    TEXCOORD<1, float3> normal;
    TEXCOORD<2, float4> tangent;
    TEXCOORD<3, float3> worldPos;
};

constexpr float kFloor = -0.5f;

struct MyVertexProgram : Uniforms {
    Float side = 1.0f;  // of the floor that is kept: 1 above, -1 below, 0 both

    Interpolators operator()(VertexData v) const {
        Interpolators i;
        i.position = UnityObjectToClipPos(object, v.position);
        i.worldPos = mul(object.worldFromObject, v.position).xyz();
        i.aboveFloor = (i.worldPos.y - kFloor) * side;
        i.uv = v.uv;
        i.normal = UnityObjectToWorldNormal(object, v.normal);
        i.tangent = float4(UnityObjectToWorldDir(object, v.tangent.xyz()), v.tangent.w);
        return i;
    }
};

struct MyFragmentProgram : StoneMaterial {
    Float reflectivity = number("reflectivity", 0.9f, {0, 1}, "of the floor, at a grazing angle");
    Float mirrored = 1.0f;  // -1: what stands in the mirror has the light from below
    bool isFloor = false;

    float4 operator()(Interpolators i) const {
        const float3 binormal =
            CreateBinormal(i.normal, i.tangent.xyz(), i.tangent.w, object.unity_WorldTransformParams.w);
        const float3 bump = UnpackScaleNormal(tex2D(normalMap, i.uv), bumpScale);
        const float3 normal = TangentSpaceToWorld(bump, i.tangent.xyz(), binormal, i.normal);
        const float3 lightDir = light.dir * float3(Float(1.0f), mirrored, Float(1.0f));
        const float3 color = tint.rgb() * (light.color * saturate(dot(normal, lightDir)) + ambient);
        if (!isFloor) return float4(color, 1);
        // The floor covers its mirror the better, the more it is looked at from above.
        const float3 viewDir = normalize(worldSpaceCameraPos - i.worldPos);
        return float4(color, 1.0f - reflectivity * Pow5(1.0f - saturate(dot(normal, viewDir) * 0.5f)));
    }
};

constexpr StencilFace kMark = {.pass = StencilOp::replace};
constexpr StencilFace kWhereMarked = {.test = Compare::equal};

void DrawObject(const Scene& s, const Object& o, float side, bool isFloor, const RenderState& state) {
    MyVertexProgram vertex = s.uniforms(o.worldFromObject);
    MyFragmentProgram fragment = s.uniforms(o.worldFromObject);
    vertex.side = side;
    fragment.mirrored = side < 0.0f ? -1.0f : 1.0f;
    fragment.isFloor = isFloor;
    s.draw(*o.mesh, vertex, fragment, state);
}

}  // namespace

Stage beyond_19_mirror() {
    return {
        .title = "Mirror",
        .section = "Kilgard 1999",
        .news = "A floor marks its pixels in the stencil; the mirrored scene is drawn there, then the floor over it.",
        .uniforms = declared<MyFragmentProgram>(),
        .mesh = "cube+sphere+quad",
        .camera = {.position = {0.0f, 0.45f, -3.1f}, .target = {0.0f, -0.2f, 0.0f}},
        .draw = [](const Scene& s) {
            const Attachment color = {Format::rgba32f}, depth = {Format::depth32f, Store::discard};
            const Framebuffer& drawn =
                s.pass(*Framebuffer::create(s.width, s.height, {color, depth, {Format::stencil8, Store::discard}}),
                       [](const Scene& p) {
                           const Object& floor = p.objects.back();
                           const auto solids = [&p](float side, const glm::mat4& moved, const RenderState& state) {
                               for (std::size_t k = 0; k + 1 < p.objects.size(); ++k) {
                                   const Object& o = p.objects[k];
                                   DrawObject(p, {o.mesh, moved * o.worldFromObject}, side, false, state);
                               }
                           };
                           const glm::mat4 mirror = translation({0, 2 * kFloor, 0}) * scaling({1, -1, 1});
                           DrawObject(p, floor, 0.0f, true,
                                      {.depthWrite = false, .colorWrite = false, .stencil = bothSides(1, kMark)});
                           solids(-1.0f, mirror, {.stencil = bothSides(1, kWhereMarked)});
                           DrawObject(p, floor, 0.0f, true, {.depthTest = Compare::always, .blend = Blend::alpha});
                           solids(1.0f, glm::mat4(1.0f), {});
                       });
            s.draw(primitive("quad"), ScreenVertexProgram{}, ShowPicture{s.sampled(drawn, drawn.colorIndex()), true});
        }};
}

}  // namespace relief::samples
