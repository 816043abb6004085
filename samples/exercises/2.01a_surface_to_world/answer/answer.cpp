// 2.01a From the surface to the world: the answer of an exercise. The lines between the marks are what the learner
// writes.
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
    SV_POSITION clipPosition;
    TEXCOORD<0, float2> textureCoordinates;
    TEXCOORD<1, float3> tangentWorld;
    TEXCOORD<2, float3> binormalWorld;
    TEXCOORD<3, float3> normalWorld;
};

struct MyVertexProgram : Uniforms {
    Interpolators operator()(VertexData v) const {
        Interpolators i;
        i.tangentWorld = UnityObjectToWorldDir(object, v.tangent.xyz());
        i.normalWorld = UnityObjectToWorldNormal(object, v.normal);
        i.binormalWorld = normalize(cross(i.normalWorld, i.tangentWorld) * v.tangent.w);

        i.textureCoordinates = v.uv;
        i.clipPosition = UnityObjectToClipPos(object, v.position);
        return i;
    }
};

struct MyFragmentProgram : DiffuseMaterial {
    float3 NormalDirection(const Interpolators& i) const {
        const float4 encodedNormal = tex2D(bumpMap, TRANSFORM_TEX(i.textureCoordinates, bumpMap_ST));
        float3 localCoords = float3(encodedNormal.wy() * 2.0f - 1.0f, Float(0.0f));
        localCoords.z = sqrt(1.0f - saturate(dot(localCoords, localCoords)));

        // your turn: the normal of the map, in the world
        float3x3 localSurface2World = {i.tangentWorld, i.binormalWorld, i.normalWorld};
        return normalize(mul(localSurface2World, localCoords));
        // end of your turn
    }

    float4 operator()(Interpolators i) const {
        const float3 normalDirection = NormalDirection(i);
        const float3 lightDirection = normalize(worldSpaceLightPos0.xyz());
        const float3 diffuseReflection =
            lightColor0 * color.xyz() * max(Float(0.0f), dot(normalDirection, lightDirection));
        return float4(diffuseReflection, 1);
    }
};

}  // namespace

Stage exercise_2_01a() {
    return {.title = "From the surface to the world",
            .section = "",
            .news = "An exercise of stage 2.01.",
            .uniforms = declared<MyFragmentProgram>(),
            .mesh = "sphere",
            .camera = {.position = {0.0f, 0.35f, -1.75f}},
            .draw = [](const Scene& s) {
                for (const Object& o : s.objects) s.draw<MyVertexProgram, MyFragmentProgram>(o);
            }};
}

}  // namespace relief::samples
