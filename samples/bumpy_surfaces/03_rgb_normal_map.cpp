// 2.03 RGB normal map: GLSL Programming/Unity "Lighting of Bumpy Surfaces", Normal Mapping in Unity
// New: the map as OpenGL ES has it, x, y and z in red, green and blue: nothing to compute.
// Was: z computed from x and y (2.02), here in the left column.
#include "common/false_color.h"
#include "common/stage.h"

namespace relief::samples {

namespace {

struct VertexData
{
    POSITION position;
    NORMAL normal;
    TANGENT tangent;
    TEXCOORD<0, float2> uv;
};

struct Interpolators
{
    SV_POSITION clipPosition;
    TEXCOORD<0, float2> textureCoordinates;
    TEXCOORD<1, float3> tangentWorld;
    TEXCOORD<2, float3> binormalWorld;
    TEXCOORD<3, float3> normalWorld;
};

struct MyVertexProgram
{
    ObjectTransform object;

    Interpolators operator()(VertexData v) const
    {
        Interpolators i;
        i.tangentWorld = UnityObjectToWorldDir(object, v.tangent.xyz());
        i.normalWorld = UnityObjectToWorldNormal(object, v.normal);
        i.binormalWorld = normalize(cross(i.normalWorld, i.tangentWorld) * v.tangent.w);

        i.textureCoordinates = v.uv;
        i.clipPosition = UnityObjectToClipPos(object, v.position);
        return i;
    }
};

struct MyFragmentProgram
{
    sampler2D bumpMap;
    float4 bumpMap_ST, color;
    float4 worldSpaceLightPos0;  // w: 0 for a direction
    float3 lightColor0;
    bool rgb;

    float3 NormalDirection(const Interpolators& i) const
    {
        const float4 encodedNormal = tex2D(bumpMap, TRANSFORM_TEX(i.textureCoordinates, bumpMap_ST));
        float3 localCoords = encodedNormal.xyz() * 2.0f - 1.0f;
        if (!rgb) {
            localCoords = float3(encodedNormal.wy() * 2.0f - 1.0f, Float(0.0f));
            localCoords.z = sqrt(1.0f - saturate(dot(localCoords, localCoords)));
        }

        float3x3 localSurface2World = {i.tangentWorld, i.binormalWorld, i.normalWorld};
        return normalize(mul(localSurface2World, localCoords));
    }

    float4 operator()(Interpolators i) const
    {
        const float3 normalDirection = NormalDirection(i);
        const float3 lightDirection = normalize(worldSpaceLightPos0.xyz());
        const float3 diffuseReflection =
            lightColor0 * color.xyz() * max(Float(0.0f), dot(normalDirection, lightDirection));
        return float4(diffuseReflection, 1);
    }
};

}  // namespace

Stage bumpy_surfaces_03_rgb_normal_map()
{
    return {
        .title = "RGB normal map",
        .section = "Normal Mapping in Unity",
        .news = "z computed from alpha and green (left), stored in blue (middle), and the angle between them (right).",
        .properties = diffuseProperties({{"maximumAngle", glm::vec4(4.0f), 0.01f, 90.0f, 1, "degrees that are red"}}),
        .inputs = {.mesh = "sphere",
                   .normal = "marble-heights.png",
                   .detailNormal = "marble-heights.png",
                   .normalImport = {.kind = ImportSettings::Kind::normalMap, .bumpiness = 0.02f},
                   .detailNormalImport = normalMapSettings(0.02f)},
        .camera = {.position = {0.0f, 0.35f, -2.6f}},
        .draw = [](const Scene& s) {
            const MyVertexProgram vertex = {s.object(s.objects[0].worldFromObject)};
            const MyFragmentProgram stored = {s.normalMap,       s.vector("bumpMap_ST"),
                                              s.vector("color"), float4(s.light.dir, Float(0.0f)),
                                              s.light.color,     true};
            MyFragmentProgram computed = stored;
            computed.bumpMap = s.detailNormalMap;
            computed.rgb = false;

            s.cutCell(0, 3);
            s.draw(s.mesh, vertex, computed);
            s.cutCell(1, 3);
            s.draw(s.mesh, vertex, stored);
            s.cutCell(2, 3);
            s.draw(s.mesh, vertex,
                   ShowAngle<Interpolators, MyFragmentProgram>{computed, stored, s.number("maximumAngle")});
            drawScale(s, 3);
        }};
}

}  // namespace relief::samples
