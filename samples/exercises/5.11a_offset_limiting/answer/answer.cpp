// 5.11a Parallax with a limit: the answer of an exercise. The lines between the marks are what the learner writes.
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
    TEXCOORD<0, float2> uv;
    TEXCOORD<1, float3> viewDir;   // tangent space, not of unit length
    TEXCOORD<2, float3> lightDir;  // tangent space
};

struct MyVertexProgram : ParallaxMaterial {
    Interpolators operator()(VertexData v) const {
        Interpolators i;
        i.position = UnityObjectToClipPos(object, v.position);
        i.uv = v.uv;
        const float3 normal = UnityObjectToWorldNormal(object, v.normal);
        const float3 tangent = UnityObjectToWorldDir(object, v.tangent.xyz());
        const float3 binormal = CreateBinormal(normal, tangent, v.tangent.w, object.unity_WorldTransformParams.w);
        const float3 view = worldSpaceCameraPos - mul(object.worldFromObject, v.position).xyz();
        i.viewDir = float3(dot(view, tangent), dot(view, binormal), dot(view, normal));
        i.lightDir = float3(dot(light.dir, tangent), dot(light.dir, binormal), dot(light.dir, normal));
        return i;
    }
};

struct MyFragmentProgram : ParallaxMaterial {
    Float parallaxBias = number("parallaxBias", 0.42f, {0, 1}, "added to z: 0.42 is Unity's; 1 leaves almost no depth");

    Float HeightAt(const float2& uv, const float2& dx, const float2& dy) const {
        return tex2Dgrad(heightMap, uv, dx, dy).x;
    }

    // How far the picture is moved. The direction is of unit length, and its z never below the bias: at a grazing view
    // the offset stays small, instead of going to infinity.
    float2 ParallaxOffset(const Interpolators& i, const float2& dx, const float2& dy) const {
        // your turn: the offset, limited
        const Float height = (HeightAt(i.uv, dx, dy) - 0.5f) * parallaxStrength;
        const float3 viewDir = normalize(i.viewDir);
        return viewDir.xy() / (viewDir.z + parallaxBias) * height;
        // end of your turn
    }

    float4 operator()(Interpolators i) const {
        const float2 dx = ddx(i.uv), dy = ddy(i.uv);
        i.uv += ParallaxOffset(i, dx, dy);
        const float3 albedo = tex2Dgrad(mainTex, i.uv, dx, dy).rgb();
        const float3 normal = normalize(UnpackScaleNormal(tex2Dgrad(normalMap, i.uv, dx, dy), bumpScale));
        const Float diffuse = saturate(dot(normal, normalize(i.lightDir)));
        return float4(albedo * (light.color * diffuse + ambient), 1);
    }
};

}  // namespace

Stage exercise_5_11a() {
    return {.title = "Parallax with a limit",
            .section = "",
            .news = "An exercise of stage 5.11.",
            .uniforms = declared<MyFragmentProgram>(),
            .mesh = "quad",
            .camera = {.position = {-0.35f, 0.42f, -0.85f}, .target = {0.0f, -0.03f, -0.04f}, .fieldOfView = 46.0f},
            .draw = [](const Scene& s) { s.draw<MyVertexProgram, MyFragmentProgram>(s.lying()); }};
}

}  // namespace relief::samples
