// 2.04 Non-uniform scale: GLSL Programming/Unity "Lighting of Bumpy Surfaces", Normal Mapping in Unity
// New: a sphere pressed flat: its normals by the inverse transpose (left) and, wrong, by the matrix itself (right).
// Was: a round sphere (2.01 to 2.03), for which the two are the same.
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
    bool wrong;

    Interpolators operator()(VertexData v) const
    {
        Interpolators i;
        i.tangentWorld = UnityObjectToWorldDir(object, v.tangent.xyz());
        i.normalWorld = wrong ? UnityObjectToWorldDir(object, v.normal) : UnityObjectToWorldNormal(object, v.normal);
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

    float3 NormalDirection(const Interpolators& i) const
    {
        const float4 encodedNormal = tex2D(bumpMap, TRANSFORM_TEX(i.textureCoordinates, bumpMap_ST));
        float3 localCoords = float3(encodedNormal.wy() * 2.0f - 1.0f, Float(0.0f));
        localCoords.z = sqrt(1.0f - saturate(dot(localCoords, localCoords)));

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

Stage bumpy_surfaces_04_non_uniform_scale()
{
    return {.title = "Non-uniform scale",
            .section = "Normal Mapping in Unity",
            .news = "Normals of a flattened sphere by the inverse transpose, and, wrong, by the matrix itself.",
            .properties = diffuseProperties({{"scale", {1.3f, 0.45f, 1.3f, 0.0f}, -4.0f, 4.0f, 3, "of the sphere"}}),
            .inputs = {.mesh = "sphere", .normal = "marble-heights.png", .normalImport = normalMapSettings(0.02f)},
            .camera = {.position = {0.0f, 0.35f, -2.4f}},
            .draw = [](const Scene& s) {
                const float4 scale = s.vector("scale");
                const glm::mat4 squeezed = scaling({scale.x[0], scale.y[0], scale.z[0]});
                for (int column = 0; column < 2; ++column) {
                    s.cutCell(column, 2);
                    s.draw(s.mesh, MyVertexProgram{s.object(s.objects[0].worldFromObject * squeezed), column == 1},
                           MyFragmentProgram{s.normalMap, s.vector("bumpMap_ST"), s.vector("color"),
                                             float4(s.light.dir, Float(0.0f)), s.light.color});
                }
            }};
}

}  // namespace relief::samples
