// 2.04a The normals of a flattened sphere: the answer of an exercise. The lines between the marks are what the learner
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
    float3 scale = vector("scale", glm::vec3(1.3f, 0.45f, 1.3f), {-4, 4}, "of the sphere");

    Interpolators operator()(VertexData v) const {
        Interpolators i;
        i.tangentWorld = UnityObjectToWorldDir(object, v.tangent.xyz());
        // your turn: the normal of the scaled sphere
        i.normalWorld = normalize(v.normal / scale);
        // end of your turn
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

        float3x3 localSurface2World = {i.tangentWorld, i.binormalWorld, i.normalWorld};
        return normalize(mul(localSurface2World, localCoords));
    }

    float4 operator()(Interpolators i) const {
        const float3 normalDirection = NormalDirection(i);
        const float3 lightDirection = normalize(worldSpaceLightPos0.xyz());
        const float3 diffuseReflection =
            lightColor0 * color.xyz() * max(Float(0.0f), dot(normalDirection, lightDirection));
        return float4(diffuseReflection, 1);
    }
};

struct Sphere : Uniforms {
    glm::vec3 scale = vector("scale", glm::vec3(1.3f, 0.45f, 1.3f), {-4, 4}, "of the sphere");
};

}  // namespace

Stage exercise_2_04a() {
    return {.title = "The normals of a flattened sphere",
            .section = "",
            .news = "An exercise of stage 2.04.",
            .uniforms = declared<MyFragmentProgram, MyVertexProgram, Sphere>(),
            .mesh = "sphere",
            .camera = {.position = {0.0f, 0.5f, -2.0f}},
            .draw = [](const Scene& s) {
                const glm::mat4 squeezed = s.objects[0].worldFromObject * scaling(Sphere(s.uniforms()).scale);
                const MyVertexProgram vertex = s.uniforms(squeezed);
                const MyFragmentProgram fragment = s.uniforms(squeezed);
                s.draw(s.mesh, vertex, fragment);
            }};
}

}  // namespace relief::samples
