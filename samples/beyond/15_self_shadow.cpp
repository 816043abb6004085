// 5.15 Self shadow: Policarpo et al. 2005; Tatarchuk 2006
// New: a second march, towards the light: bumps cast shadows on their own surface.
// Was: light that shines through bricks (5.14).
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
    Float steps = number("steps", 10.0f, {1, 128}, "layers that the ray goes down through");
    int bisections = choice("bisections", 5, {"0", "1", "2", "3", "4", "5", "6", "7", "8"}, "halvings after the march");
    Float shadowBias = number("shadowBias", 0.02f, {0, 0.2f}, "how far above the surface the second march begins");

    Float HeightAt(const float2& uv, const float2& dx, const float2& dy) const {
        return tex2Dgrad(heightMap, uv, dx, dy).x;
    }

    // Down along the ray of sight, layer by layer, until the surface is above it; then half a step back or forth, a
    // quarter, an eighth: each bisection is worth a doubling of the layers.
    float2 ParallaxOffset(const Interpolators& i, const float2& dx, const float2& dy) const {
        Float step = 1.0f / steps;
        float2 delta = i.viewDir.xy() / i.viewDir.z * (step * parallaxStrength);
        float2 offset(0.0f);
        Float ray = 1.0f;
        Mask above = HeightAt(i.uv, dx, dy) < ray;
        whileAny(above, [&] {
            offset = select(above, offset - delta, offset);
            ray = select(above, ray - step, ray);
            above &= HeightAt(i.uv + offset, dx, dy) < ray;
        });
        for (int k = 0; k < bisections; ++k) {
            step *= 0.5f;
            delta *= 0.5f;
            above = HeightAt(i.uv + offset, dx, dy) < ray;
            const Float sign = select(above, Float(-1.0f), Float(1.0f));
            offset += delta * sign;
            ray += step * sign;
        }
        return offset;
    }

    // What of the light arrives where the ray of sight ended: a second march, from there up towards the light.
    Float Shadow(const Interpolators& i, const float2& uv, const float2& dx, const float2& dy) const {  // new
        const Float step = 1.0f / steps, start = HeightAt(uv, dx, dy);                                  // new
        const float2 delta = i.lightDir.xy() / i.lightDir.z * (step * parallaxStrength);                // new
        float2 offset(0.0f);                                                                            // new
        Float ray = start + shadowBias;                                                                 // new
        Mask free = (ray < 1.0f) & (i.lightDir.z > 0.0f), climbing = free;                              // new
        whileAny(climbing, [&] {                                                                        // new
            offset = select(climbing, offset + delta, offset);                                          // new
            ray = select(climbing, ray + step, ray);                                                    // new
            free &= !(climbing & (HeightAt(uv + offset, dx, dy) > ray));                                // new
            climbing &= free & (ray < 1.0f);                                                            // new
        });
        return select(free | (ray >= 1.0f), Float(1.0f), Float(0.0f));  // new
    }

    float4 operator()(Interpolators i) const {
        const float2 dx = ddx(i.uv), dy = ddy(i.uv);
        i.uv += ParallaxOffset(i, dx, dy);
        const float3 albedo = tex2Dgrad(mainTex, i.uv, dx, dy).rgb();
        const float3 normal = normalize(UnpackScaleNormal(tex2Dgrad(normalMap, i.uv, dx, dy), bumpScale));
        const Float diffuse = saturate(dot(normal, normalize(i.lightDir))) * Shadow(i, i.uv, dx, dy);  // new
        return float4(albedo * (light.color * diffuse + ambient), 1);
    }
};

}  // namespace

Stage beyond_15_self_shadow() {
    return {.title = "Self shadow",
            .section = "Policarpo et al. 2005; Tatarchuk 2006",
            .news = "Relief mapping, and a march from each point towards the light.",
            .uniforms = declared<MyFragmentProgram>(),
            .mesh = "quad",
            .camera = {.position = {-0.35f, 0.42f, -0.85f}, .target = {0.0f, -0.03f, -0.04f}, .fieldOfView = 46.0f},
            .draw = [](const Scene& s) { s.draw<MyVertexProgram, MyFragmentProgram>(s.lying()); }};
}

}  // namespace relief::samples
