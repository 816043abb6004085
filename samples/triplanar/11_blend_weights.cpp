// 4.11 Blend weights: Normal Mapping for a Triplanar Shader, "Triplanar Blending"
// New: seven ways to share a surface out among the three planes; the weights as colours (above), and bricks (below).
// Was: one of them, 0.2 subtracted (4.10).
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

// Properties count them from 1.
enum class Weights { linear = 1, offset, offsetTimes7, power4, power8, power, asymmetric, height, offsetTooLarge };

template <Weights kind>
struct MyFragmentProgram : TriplanarMaterial {
    sampler2D heightMap = heights("bricks-heights.png");
    Float sharpness = number("sharpness", 16.0f, {0, 128}, "the exponent of kind 6");
    Float heightRange = number("heightRange", 0.3f, {0.01f, 1}, "of kind 8: how much lower may still be seen");
    bool asColors = toggle("asColors", false, "of one kind: 1 shows the weights");

    float3 Blend(const float3& normal, const Triplanar<float2>& uv) const {
        if constexpr (kind == Weights::linear) return TriplanarBlendLinear(normal);
        if constexpr (kind == Weights::offset) return TriplanarBlendOffset(normal, 0.2f);
        if constexpr (kind == Weights::power4) return TriplanarBlendPower4(normal);
        if constexpr (kind == Weights::power) return TriplanarBlendPower(normal, sharpness);
        if constexpr (kind == Weights::asymmetric) return TriplanarBlendAsymmetric(normal);
        if constexpr (kind == Weights::height) {
            const float3 heights = {tex2D(heightMap, uv.x).r, tex2D(heightMap, uv.y).r, tex2D(heightMap, uv.z).r};
            return TriplanarBlendHeight(normal, heights, heightRange);
        }
        float3 blend = abs(normal);
        if constexpr (kind == Weights::offsetTimes7) blend = max((blend - 0.2f) * 7.0f, float3(0.0f));
        if constexpr (kind == Weights::power8) blend = pow(blend, 8.0f);
        if constexpr (kind == Weights::offsetTooLarge) blend = max(blend - 0.65f, float3(0.0f));
        return blend / (blend.x + blend.y + blend.z);
    }

    float4 operator()(Interpolators i) const {
        i.worldNormal = normalize(i.worldNormal);
        const Triplanar<float2> uv = TriplanarUV(i.worldPos * tiling);
        const float3 blend = Blend(i.worldNormal, uv);
        if (asColors) return float4(blend, 1);

        const Triplanar<float4> color = tex2DTriplanar(mainTex, uv, blend);
        const float3 albedo = (color.x * blend.x + color.y * blend.y + color.z * blend.z).rgb();
        return float4(albedo * (light.color * saturate(dot(i.worldNormal, light.dir)) + ambient), 1);
    }
};

struct Choice : Uniforms {
    int weights = choice("weights", 0,
                         {"side by side", "linear", "offset", "offset times 7", "4th power", "8th power", "power",
                          "asymmetric", "by height", "offset too large"},
                         "which kind");
};

template <Weights kind>
void drawShape(const Scene& s, std::optional<bool> asColors = {}) {
    for (const Object& o : s.objects) {
        MyFragmentProgram<kind> fragment = s.uniforms(o.worldFromObject);
        if (asColors) fragment.asColors = *asColors;
        s.draw(*o.mesh, MyVertexProgram(s.uniforms(o.worldFromObject)), fragment);
    }
}

// All side by side, or the one that the property asks for.
template <Weights... kind>
void drawAll(const Scene& s) {
    const auto only = static_cast<Weights>(Choice(s.uniforms()).weights);
    int column = 0;
    const auto drawOne = [&]<Weights one>() {
        if (only == one) drawShape<one>(s);
        if (only != Weights() || one == Weights::power8 || one == Weights::power) return;
        for (const int row : {0, 1}) {
            s.cutCell(column, 7, row, 2);
            drawShape<one>(s, row == 0);
        }
        ++column;
    };
    (drawOne.template operator()<kind>(), ...);
    if (only == Weights())
        s.labelColumns({"linear", "0.2 off", "0.2 off x 7", "power 4", "asymmetric", "by height", "wrong: 0.65 off"});
}

}  // namespace

Stage triplanar_11_blend_weights() {
    return {.title = "Blend weights",
            .section = "Triplanar Blending",
            .news = "Linear, 0.2 off, the same times 7, fourth power, asymmetric, by height; wrong: 0.65 off.",
            .uniforms = declared<Choice, MyFragmentProgram<Weights::linear>>(),
            .mesh = "sphere",
            .camera = {.position = {3.4f, 3.4f, -3.4f}},
            .draw = [](const Scene& s) {
                using enum Weights;
                drawAll<linear, offset, offsetTimes7, power4, power8, power, asymmetric, height, offsetTooLarge>(s);
            }};
}

}  // namespace relief::samples
