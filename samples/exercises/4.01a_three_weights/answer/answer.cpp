// 4.01a How much of each side: the answer of an exercise. The lines between the marks are what the learner writes.
#include "common/stage.h"
#include "relief/shading/triplanar.h"

namespace relief::samples {
namespace {

struct VertexData {
    POSITION position;
    NORMAL normal;
};

struct Interpolators {
    SV_POSITION position;
    TEXCOORD<0, float3> worldPos;
    TEXCOORD<1, float3> worldNormal;
};

struct MyVertexProgram : Uniforms {
    Interpolators operator()(VertexData v) const {
        Interpolators i;
        i.position = UnityObjectToClipPos(object, v.position);
        i.worldPos = mul(object.worldFromObject, v.position).xyz();
        i.worldNormal = UnityObjectToWorldNormal(object, v.normal);
        return i;
    }
};

template <bool TRIPLANAR>
struct MyFragmentProgram : TriplanarMaterial {
    float4 operator()(Interpolators i) const {
        i.worldNormal = normalize(i.worldNormal);
        float3 albedo;
        if constexpr (TRIPLANAR) {
            const Triplanar<float2> uv = TriplanarUV(i.worldPos * tiling);
            // your turn: the weights of the three projections
            float3 blend = saturate(abs(i.worldNormal) - 0.2f);
            blend /= blend.x + blend.y + blend.z;
            // end of your turn
            const Triplanar<float4> color = tex2DTriplanar(mainTex, uv, blend);
            albedo = (color.x * blend.x + color.y * blend.y + color.z * blend.z).rgb();
        } else {
            albedo = tex2D(mainTex, i.worldPos.xz() * tiling).rgb();
        }
        return float4(albedo * (light.color * saturate(dot(i.worldNormal, light.dir)) + ambient), 1);
    }
};

struct Mountains : Uniforms {
    float height = number("height", 3.0f, {0, 16}, "of the mountains");
};

// The hills are made into mountains; a mesh of the user's stands as it is.
template <bool TRIPLANAR>
void drawTerrain(const Scene& s) {
    for (const Object& o : s.objects) {
        const float height = o.mesh->name == "terrain" ? Mountains(s.uniforms()).height : 1.0f;
        const glm::mat4 stretched = o.worldFromObject * scaling({1.0f, height, 1.0f});
        s.draw<MyVertexProgram, MyFragmentProgram<TRIPLANAR>>({o.mesh, stretched});
    }
}

}  // namespace

Stage exercise_4_01a() {
    return {.title = "How much of each side",
            .section = "",
            .news = "An exercise of stage 4.01.",
            .uniforms = declared<MyFragmentProgram<true>, Mountains>(),
            .mesh = "terrain",
            .camera = {.position = {0.0f, 1.0f, -1.6f}},
            .draw = [](const Scene& s) {
                s.cutCell(0, 2);
                drawTerrain<false>(s);
                s.cutCell(1, 2);
                drawTerrain<true>(s);
                s.labelColumns({"from above", "from three sides"});
            }};
}

}  // namespace relief::samples
