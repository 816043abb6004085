// 2.03 RGB normal map: GLSL Programming/Unity "Lighting of Bumpy Surfaces", Normal Mapping in Unity
// New: the map as OpenGL ES has it, x, y and z in red, green and blue: nothing to compute.
// Was: z computed from x and y (2.02), here in the left column.
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
    sampler2D bumpMap = normals("marble-heights.png", {.kind = ImportSettings::Kind::normalMap, .bumpiness = 0.02f});
    sampler2D swizzled = detailNormals("marble-heights.png", normalMapSettings(0.02f));  // new
    bool rgb = true;                                                                     // new

    float3 NormalDirection(const Interpolators& i) const {
        const float4 encodedNormal = tex2D(bumpMap, TRANSFORM_TEX(i.textureCoordinates, bumpMap_ST));
        float3 localCoords = encodedNormal.xyz() * 2.0f - 1.0f;                    // new
        if (!rgb) {                                                                // new
            localCoords = float3(encodedNormal.wy() * 2.0f - 1.0f, Float(0.0f));   // new
            localCoords.z = sqrt(1.0f - saturate(dot(localCoords, localCoords)));  // new
        }

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

struct Scale : Uniforms {
    Float maximumAngle = number("maximumAngle", 4.0f, {0.01f, 90}, "degrees that are red");  // new
};

}  // namespace

Stage bumpy_surfaces_03_rgb_normal_map() {
    return {
        .title = "RGB normal map",
        .section = "Normal Mapping in Unity",
        .news = "z computed from alpha and green (left), stored in blue (middle), and the angle between them (right).",
        .uniforms = declared<MyFragmentProgram, Scale>(),
        .mesh = "sphere",
        .camera = {.position = {0.0f, 0.35f, -2.6f}},
        .draw = [](const Scene& s) {
            const Uniforms uniforms = s.uniforms(s.objects[0].worldFromObject);
            const MyVertexProgram vertex = uniforms;
            const MyFragmentProgram stored = uniforms;
            MyFragmentProgram computed = uniforms;
            computed.bumpMap = computed.swizzled;
            computed.rgb = false;

            const Float red = Scale(uniforms).maximumAngle;
            drawBesideAngle<Interpolators>(s, vertex, computed, stored, red);
            s.labelColumns({"z computed", "z stored", "angle"});
        }};
}

}  // namespace relief::samples
