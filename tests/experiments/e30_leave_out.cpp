// E-30: a feature that a material does not use: removed at compile time, skipped by a branch, or fed a neutral input.
#include <bit>

#include "experiments.h"
#include "lane_kernel.h"
#include "relief/shading/normals.h"
#include "relief/texture/sampler.h"

namespace relief::experiments {

namespace {

// What the material may have. A bit each.
enum Feature : unsigned
{
    normalMap = 1,
    detailMap = 2,
    highlight = 4,
    rim = 8,
    everything = 15
};

std::shared_ptr<const Texture> noise(unsigned seed)
{
    std::mt19937 random(seed);
    std::vector<std::uint8_t> pixels(128 * 128 * 4);
    for (std::uint8_t& p : pixels) p = static_cast<std::uint8_t>(96 + random() % 64);
    return std::make_shared<const Texture>(*Texture::fromRgba8(128, 128, pixels, ColorSpace::linear));
}

std::shared_ptr<const Texture> constant(const std::array<std::uint8_t, 4>& texel)
{
    std::vector<std::uint8_t> pixels;
    for (int i = 0; i < 128 * 128; ++i) pixels.insert(pixels.end(), texel.begin(), texel.end());
    return std::make_shared<const Texture>(*Texture::fromRgba8(128, 128, pixels, ColorSpace::linear));
}

struct Material
{
    std::shared_ptr<const Texture> albedo = noise(1), bumps = noise(2), grain = noise(3);
    Float shininess = 40.0f, highlightColor = 0.5f, rimColor = 0.25f;

    // Every feature off that is not in `features`, by an input that should change nothing: a flat 8-bit map, a middle
    // grey of 8 bits, black.
    static Material neutral(unsigned features)
    {
        Material m;
        if ((features & normalMap) == 0) m.bumps = constant({128, 128, 255, 128});
        if ((features & detailMap) == 0) m.grain = constant({128, 128, 128, 255});
        if ((features & highlight) == 0) m.highlightColor = 0.0f;
        if ((features & rim) == 0) m.rimColor = 0.0f;
        return m;
    }
};

// The colour, in which has(feature) says what is computed.
template <class Has>
float3 shade(const Material& m, const Has& has, Float u, Float v, Float x, Float y)
{
    const auto sampler = [](const Texture& t) { return sampler2D{.texture = &t, .mipmaps = false}; };
    const float2 uv = {u, v};
    float3 n = {x, y, sqrt(1.0f - saturate(x * x + y * y))};
    if (has(normalMap)) {
        const float3 bump = UnpackScaleNormal(tex2D(sampler(*m.bumps), uv), 1.0f);
        n = normalize(float3(n.x + bump.x, n.y + bump.y, n.z * bump.z));
    }
    float3 albedo = tex2D(sampler(*m.albedo), uv).xyz();
    if (has(detailMap)) albedo *= tex2D(sampler(*m.grain), uv * 4.0f).xyz() * (255.0f / 128.0f);
    float3 color = albedo * saturate(n.x * 0.48f + n.y * 0.36f + n.z * 0.8f);
    if (has(highlight)) {
        const Float NdotH = saturate(n.x * 0.25f + n.y * 0.2f + n.z * 0.947f);
        color += float3(pow(NdotH, m.shininess) * m.highlightColor);
    }
    if (has(rim)) {
        const Float edge = 1.0f - saturate(n.z);
        color += float3(edge * edge * m.rimColor);
    }
    return color;
}

template <unsigned features>
struct Removed
{
    Material material;
    float3 operator()(Float u, Float v, Float x, Float y) const
    {
        return shade(
            material, [](Feature f) { return (features & f) != 0; }, u, v, x, y);
    }
};

struct Branching
{
    Material material;
    unsigned features;
    float3 operator()(Float u, Float v, Float x, Float y) const
    {
        return shade(
            material, [this](Feature f) { return (features & f) != 0; }, u, v, x, y);
    }
};

using Neutral = Removed<everything>;

std::shared_ptr<const Columns> pixels()
{
    return randomColumns({{0.0, 1.0}, {0.0, 1.0}, {-0.5, 0.5}, {-0.5, 0.5}}, kStreamedItems, 30);
}

template <class Kernel, class Reference>
Error difference(const Kernel& kernel, const Reference& reference)
{
    const auto in = pixels();
    const Columns a = evaluate<4>(*in, kernel), b = evaluate<4>(*in, reference);
    ErrorSum sum;
    for (std::size_t c = 0; c < a.size(); ++c) {
        for (std::size_t i = 0; i < a[c].size(); ++i)
            sum.add(std::bit_cast<std::uint32_t>(a[c][i]) == std::bit_cast<std::uint32_t>(b[c][i])
                        ? 0.0
                        : 255.0 * (static_cast<double>(a[c][i]) - static_cast<double>(b[c][i])));
    }
    return sum.result();
}

template <unsigned features>
void add(Experiment& e, const std::string& without)
{
    const auto in = pixels();
    const Material material;
    const auto fetches = [](unsigned f) {
        return std::vector<Fact>{{"fetches", 1.0 + ((f & normalMap) != 0) + ((f & detailMap) != 0)}};
    };
    const Branching branching{material, features};
    e.variants.push_back(laneVariant<4>("removed", without, in, Removed<features>{material}, [=] {
        return Outcome(difference(Removed<features>{material}, branching), fetches(features));
    }));
    e.variants.push_back(laneVariant<4>("branch", without, in, branching,
                                        [=] { return Outcome(difference(branching, branching), fetches(features)); }));
    const Neutral neutral{Material::neutral(features)};
    e.variants.push_back(laneVariant<4>("neutral input", without, in, neutral,
                                        [=] { return Outcome(difference(neutral, branching), fetches(everything)); }));
}

// All sixteen sets of features, compiled in and by branches.
template <unsigned... features>
double differing(std::integer_sequence<unsigned, features...>)
{
    const Material material;
    return ((difference(Removed<features>{material}, Branching{material, features}).max > 0.0 ? 1.0 : 0.0) + ...);
}

}  // namespace

Experiment leaveOut(Effort)
{
    Experiment e;
    e.id = "E-30";
    e.title = "A feature that is not used";
    e.question =
        "A material has a normal map, a detail texture, a highlight and a rim; a scene does without some of them. One "
        "can remove their code when compiling, branch around it by a uniform, or leave it in and feed it what should "
        "change nothing: a flat map, a middle grey, black. What does each cost, and is the picture the same? The "
        "errors are those against the branch.";
    e.item = "fragment";
    e.unit = "codes of 255";
    e.rivals = Rivals::ofOneParameter;
    add<everything ^ normalMap>(e, "no normal map");
    add<everything ^ detailMap>(e, "no detail");
    add<everything ^ highlight>(e, "no highlight");
    add<everything ^ rim>(e, "no rim");
    add<0>(e, "none of them");
    e.checks.push_back({"sets of features, of 16, in which removing differs from branching", 0.0,
                        [] { return differing(std::make_integer_sequence<unsigned, 16>()); }, 0.0});
    e.finding = [](const Rows& rows) {
        const Row &removed = rows("removed", "none of them"), &branch = rows("branch", "none of them"),
                  &neutral = rows("neutral input", "none of them"), &flat = rows("neutral input", "no normal map");
        return "With none of the features a fragment takes " + number(removed.fastest, 2) +
               " ns when they are removed, " + number(branch.fastest, 2) + " with branches around them, " +
               number(neutral.fastest, 2) +
               " with neutral inputs. A branch on a uniform is taken once per block of lanes, so it "
               "costs next to nothing. Neutral inputs are not neutral either: 8 bits have no code for a flat normal, "
               "and "
               "the colours change by up to " +
               number(flat.outcome.error.max, 2) + " codes.";
    };
    return e;
}

}  // namespace relief::experiments
