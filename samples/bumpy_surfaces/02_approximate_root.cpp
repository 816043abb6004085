// 2.02 Approximate root: GLSL Programming/Unity "Lighting of Bumpy Surfaces", Normal Mapping in Unity
// New: z without a square root, 1 - (x^2 + y^2) / 2, and by how many degrees the normal is off.
// Was: the exact root (2.01), here in the left column.
#include "common/false_color.h"
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
    sampler2D bumpMap = normals("marble-heights.png", normalMapSettings(0.05f));  // new
    bool exact = true;                                                            // new

    float3 NormalDirection(const Interpolators& i) const {
        const float4 encodedNormal = tex2D(bumpMap, TRANSFORM_TEX(i.textureCoordinates, bumpMap_ST));
        float3 localCoords = float3(encodedNormal.wy() * 2.0f - 1.0f, Float(0.0f));
        const Float square = dot(localCoords, localCoords);                            // new
        localCoords.z = exact ? sqrt(1.0f - saturate(square)) : 1.0f - 0.5f * square;  // new

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

struct Scale : Uniforms {                                                                     // new
    Float maximumAngle = number("maximumAngle", 10.0f, {0.01f, 90}, "degrees that are red");  // new
};

}  // namespace

Stage bumpy_surfaces_02_approximate_root() {
    return {.title = "Approximate root",
            .section = "Normal Mapping in Unity",
            .news = "z by the root (left), without one (middle), and the angle between the two normals (right).",
            .uniforms = declared<MyFragmentProgram, Scale>(),
            .mesh = "sphere",
            .camera = {.position = {0.0f, 0.35f, -2.6f}},
            .draw = [](const Scene& s) {
                const Uniforms uniforms = s.uniforms(s.objects[0].worldFromObject);
                const MyVertexProgram vertex = uniforms;
                const MyFragmentProgram exact = uniforms;
                MyFragmentProgram approximate = uniforms;
                approximate.exact = false;

                const Float red = Scale(uniforms).maximumAngle;
                drawBesideAngle<Interpolators>(s, vertex, exact, approximate, red);
                s.labelColumns({"by the root", "without a root", "angle"});
            }};
}

}  // namespace relief::samples
