// 2.04 Non-uniform scale: GLSL Programming/Unity "Lighting of Bumpy Surfaces", Normal Mapping in Unity
// New: a sphere pressed flat: its normals by the inverse transpose (left) and, wrong, by the matrix itself (right).
// Was: a round sphere (2.01 to 2.03), for which the two are the same.
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
    bool wrong = false;  // new

    Interpolators operator()(VertexData v) const {
        Interpolators i;
        i.tangentWorld = UnityObjectToWorldDir(object, v.tangent.xyz());
        i.normalWorld = wrong ? UnityObjectToWorldDir(object, v.normal) : UnityObjectToWorldNormal(object, v.normal);
        i.binormalWorld = normalize(cross(i.normalWorld, i.tangentWorld) * v.tangent.w);

        i.textureCoordinates = v.uv;
        i.clipPosition = UnityObjectToClipPos(object, v.position);
        return i;
    }
};

struct MyFragmentProgram : DiffuseMaterial {
    float3 NormalDirection(const Interpolators& i) const {
        const float4 encodedNormal = tex2D(bumpMap, TRANSFORM_TEX(i.textureCoordinates, bumpMap_ST));
        float3 localCoords = float3(encodedNormal.wy() * 2.0f - 1.0f, Float(0.0f));  // new
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

struct Sphere : Uniforms {                                                                      // new
    glm::vec3 scale = vector("scale", glm::vec3(1.3f, 0.45f, 1.3f), {-4, 4}, "of the sphere");  // new
};

}  // namespace

Stage bumpy_surfaces_04_non_uniform_scale() {
    return {.title = "Non-uniform scale",
            .section = "Normal Mapping in Unity",
            .news = "Normals of a flattened sphere by the inverse transpose, and, wrong, by the matrix itself.",
            .uniforms = declared<MyFragmentProgram, Sphere>(),
            .mesh = "sphere",
            .camera = {.position = {0.0f, 0.35f, -2.4f}},
            .draw = [](const Scene& s) {
                const glm::mat4 squeezed = s.objects[0].worldFromObject * scaling(Sphere(s.uniforms()).scale);
                MyVertexProgram vertex = s.uniforms(squeezed);
                const MyFragmentProgram fragment = s.uniforms(squeezed);
                s.cutCell(0, 2);
                s.draw(s.mesh, vertex, fragment);
                vertex.wrong = true;
                s.cutCell(1, 2);
                s.draw(s.mesh, vertex, fragment);
            }};
}

}  // namespace relief::samples
