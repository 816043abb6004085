// 3.05 Final code: UnityCookie, part 7, "Final code"
// New: colours and gloss from textures, and one program for directional and point lights, in two passes.
// Was: one directional light on white (3.04).
#include "common/stage.h"

namespace relief::samples {

namespace {

struct vertexInput
{
    POSITION vertex;
    NORMAL normal;
    TEXCOORD<0, float4> texcoord;
    TANGENT tangent;
};

struct vertexOutput
{
    SV_POSITION pos;
    TEXCOORD<0, float4> tex;
    TEXCOORD<1, float4> posWorld;
    TEXCOORD<2, float3> tangentWorld;
    TEXCOORD<3, float3> normalWorld;
    TEXCOORD<4, float3> binormalWorld;
};

struct vert
{
    ObjectTransform object;

    vertexOutput operator()(vertexInput v) const
    {
        vertexOutput o;
        o.tangentWorld = UnityObjectToWorldDir(object, v.tangent.xyz());
        o.normalWorld = UnityObjectToWorldNormal(object, v.normal);
        o.binormalWorld = normalize(cross(o.normalWorld, o.tangentWorld) * v.tangent.w);
        o.posWorld = mul(object.worldFromObject, v.vertex);
        o.pos = UnityObjectToClipPos(object, v.vertex);
        o.tex = v.texcoord;
        return o;
    }
};

struct frag
{
    float3 worldSpaceCameraPos, ambient, lightColor0;
    float4 worldSpaceLightPos0;  // w = 0: towards a directional light; w = 1: where a point light is
    sampler2D mainTex, bumpMap;
    float4 mainTex_ST, bumpMap_ST, color, specColor, rimColor;
    Float shininess, rimPower, glossFromRed;

    float4 operator()(vertexOutput i) const
    {
        const float3 viewDirection = normalize(worldSpaceCameraPos - i.posWorld.xyz());
        const Float isPoint = worldSpaceLightPos0.w;
        const float3 vertexToLightSource = worldSpaceLightPos0.xyz() - i.posWorld.xyz() * isPoint;
        const float3 lightDirection = normalize(vertexToLightSource);
        const Float atten = select(isPoint == 0.0f, Float(1.0f), 1.0f / max(length(vertexToLightSource), Float(1e-3f)));

        const float4 tex = tex2D(mainTex, mainTex_ST.xy() * i.tex.xy() + mainTex_ST.zw());
        const Float gloss = lerp(tex.a, tex.r, glossFromRed);
        const float4 texN = tex2D(bumpMap, bumpMap_ST.xy() * i.tex.xy() + bumpMap_ST.zw());
        float3 localCoords = float3(2.0f * texN.ag() - 1.0f, 0.0f);
        localCoords.z = 1.0f - 0.5f * dot(localCoords, localCoords);
        const float3x3 local2WorldTranspose = transpose(float3x3(i.tangentWorld, i.binormalWorld, i.normalWorld));
        const float3 normalDirection = normalize(mul(localCoords, local2WorldTranspose));

        const float3 diffuseReflection = atten * lightColor0 * saturate(dot(normalDirection, lightDirection));
        const Float highlight = saturate(dot(reflect(-lightDirection, normalDirection), viewDirection));
        const float3 specularReflection = diffuseReflection * gloss * specColor.rgb() * pow(highlight, shininess);
        const Float rim = 1.0f - saturate(dot(viewDirection, normalDirection));
        const float3 rimLighting = saturate(dot(normalDirection, lightDirection)) * rimColor.rgb() * pow(rim, rimPower);
        const float3 lightFinal = ambient + diffuseReflection + specularReflection + rimLighting;
        return float4(tex.rgb() * lightFinal * color.rgb(), 1.0f);
    }
};

// The base pass fills the depth buffer; an additive pass adds its light where that very depth is seen.
constexpr RenderState kAdditivePass = {.depthTest = Compare::equal, .depthWrite = false, .blend = Blend::additive};

void drawPass(const Scene& s, const float3& ambient, const float3& lightColor0, const float4& worldSpaceLightPos0,
              const RenderState& pass)
{
    s.draw(s.mesh, vert{s.object(s.objects[0].worldFromObject)},
           frag{s.worldSpaceCameraPos, ambient, lightColor0, worldSpaceLightPos0, s.mainTex, s.normalMap,
                s.vector("mainTex_ST"), s.vector("bumpMap_ST"), s.vector("color"), s.vector("specColor"),
                s.vector("rimColor"), s.number("shininess"), s.number("rimPower"), s.number("glossFromRed")},
           pass);
}

}  // namespace

Stage normal_maps_05_final_code()
{
    return {.title = "Final code",
            .section = "7, final code",
            .news = "Colours, gloss, bumps and rim, under a directional and a point light.",
            .properties = cgProperties(
                {{"rimColor", glm::vec4(1.0f), 0.0f, 1.0f, 4, "Rim Color"},
                 {"rimPower", glm::vec4(3.0f), 0.1f, 10.0f, 1, "Rim Power: larger is narrower"},
                 {"mainTex_ST", {1, 1, 0, 0}, -16.0f, 16.0f, 4, "tiling in x and y, offset in z and w"},
                 {"glossFromRed", glm::vec4(1.0f), 0.0f, 1.0f, 1, "gloss is the texture's alpha (0) or its red (1)"},
                 {"lampStrength", glm::vec4(1.0f), 0.0f, 64.0f, 1, "of the point light"},
                 {"lampPosition", {-0.9f, 0.1f, -0.6f, 0}, -16.0f, 16.0f, 3, "of the point light"}}),
            .inputs = {.mesh = "sphere", .albedo = "marble-albedo.png", .normal = "marble-heights.png"},
            .camera = {.position = {0.0f, 0.3f, -1.8f}},
            .draw = [](const Scene& s) {
                const float3 sun = s.light.color * s.number("lightStrength");
                const float3 lamp = float3(0.3f, 0.55f, 1.0f) * s.number("lampStrength");
                drawPass(s, s.vector("ambient").rgb(), sun, float4(s.light.dir, 0.0f), {});
                drawPass(s, float3(0.0f), lamp, float4(s.vector("lampPosition").xyz(), 1.0f), kAdditivePass);
            }};
}

}  // namespace relief::samples
