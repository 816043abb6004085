// The lighting model in both forms: known values, energy, and extreme inputs (stability cases S-802 to S-812).
#include "relief/shading/lighting.h"

#include "numbers.h"
#include "shading_fixture.h"

using namespace fixture;

namespace {

const float3 kUp = {0.0f, 0.0f, 1.0f}, kWhite = {1.0f, 1.0f, 1.0f}, kNothing = {0.0f, 0.0f, 0.0f};

enum class Form
{
    compat,
    exact
};

float3 lit(Form form, const float3& diffuse, const float3& specular, Float smoothness, const float3& viewDir,
           const float3& lightDir, const float3& color = kWhite)
{
    const UnityLight light = {color, lightDir};
    return (form == Form::exact ? UNITY_BRDF_PBS_Exact(diffuse, specular, smoothness, kUp, viewDir, light)
                                : UNITY_BRDF_PBS(diffuse, specular, smoothness, kUp, viewDir, light))
        .xyz();
}

float3 direction(double cosine, double azimuth)
{
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    return {static_cast<float>(sine * std::cos(azimuth)), static_cast<float>(sine * std::sin(azimuth)),
            static_cast<float>(cosine)};
}

// The model's D where viewer, light and normal are one direction: the result is V D pi F, and V is known there.
double peakOfD(Form form, float smoothness)
{
    const double value = static_cast<double>(lit(form, kNothing, kWhite, smoothness, kUp, kUp).x[0]);
    return value / (kPi * 0.5 / (form == Form::exact ? 2.0 : 2.0 + 1e-5));
}

// The exact form's specular light at F = 1, in double.
double specularInDouble(double a2, const Vector& v, const Vector& l)
{
    const Vector h = unit({v.x + l.x, v.y + l.y, v.z + l.z});
    const double sine2 = h.x * h.x + h.y * h.y, d = a2 + (1.0 - a2) * sine2, NdotL = l.z, NdotV = v.z;
    const double V =
        0.5 / (NdotL * std::sqrt(NdotV * NdotV * (1 - a2) + a2) + NdotV * std::sqrt(NdotL * NdotL * (1 - a2) + a2));
    return V * a2 / (d * d) * NdotL;
}

// The share of light from all around that leaves towards the viewer, at F = 1. Light directions are taken where the
// highlight is (GGX half vectors, a stratified grid), so that a narrow one is not missed.
double specularAlbedo(Form form, double smoothness, double NdotV)
{
    const double a = std::max((1.0 - smoothness) * (1.0 - smoothness), 0.002);
    const float3 view = direction(NdotV, 0.0);
    const Vector v = lane(view);
    constexpr int steps = 192;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        for (int j = 0; j < steps; ++j) {
            const double u = (i + 0.5) / steps, azimuth = 2.0 * kPi * (j + 0.5) / steps;
            const double cosine = std::sqrt((1.0 - u) / (1.0 + (a * a - 1.0) * u)),
                         sine = std::sqrt(1.0 - cosine * cosine);
            const Vector h = {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
            const double VdotH = v.x * h.x + v.y * h.y + v.z * h.z;
            const Vector l = {2.0 * VdotH * h.x - v.x, 2.0 * VdotH * h.y - v.y, 2.0 * VdotH * h.z - v.z};
            if (VdotH <= 0.0 || l.z <= 0.0) continue;
            const double d = cosine * cosine * (a * a - 1.0) + 1.0;
            const double density = a * a / (kPi * d * d) * cosine / (4.0 * VdotH);
            const float3 light = {static_cast<float>(l.x), static_cast<float>(l.y), static_cast<float>(l.z)};
            const double value =
                static_cast<double>(lit(form, kNothing, kWhite, static_cast<float>(smoothness), view, light).x[0]);
            sum += value / kPi / density;
        }
    }
    return sum / (steps * steps);
}

double diffuseAlbedo(double smoothness, double NdotV)
{
    const float3 view = direction(NdotV, 0.0);
    constexpr int steps = 96;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        for (int j = 0; j < steps; ++j) {
            const float3 light = direction((i + 0.5) / steps, 2.0 * kPi * (j + 0.5) / steps);
            const auto s = static_cast<float>(smoothness);
            // With and without a diffuse colour: the difference is the diffuse part.
            sum += static_cast<double>(lit(Form::compat, kWhite, kNothing, s, view, light).x[0] -
                                       lit(Form::compat, kNothing, kNothing, s, view, light).x[0]);
        }
    }
    return sum * 2.0 * kPi / (steps * steps) / kPi;
}

}  // namespace

TEST_CASE("lighting: the metallic workflow splits a colour and gains no energy")
{
    for (const float metallic : {0.0f, 0.25f, 0.5f, 1.0f}) {
        const float3 albedo = {1.0f, 0.5f, 0.0f};
        float3 specular;
        Float oneMinusReflectivity;
        const float3 diffuse = DiffuseAndSpecularFromMetallic(albedo, metallic, specular, oneMinusReflectivity);
        for (int c = 0; c < 3; ++c) {
            CHECK(specular[c][0] == doctest::Approx(0.04f + (albedo[c][0] - 0.04f) * metallic));
            CHECK(diffuse[c][0] == doctest::Approx(albedo[c][0] * 0.96f * (1.0f - metallic)));
            CHECK(diffuse[c][0] + specular[c][0] <= 1.0f + 1e-6f);
        }
    }
}

TEST_CASE("lighting: S-807 the highlight's peak, exact and as Unity's epsilon leaves it")
{
    // smoothness, 1 / (pi a^2), and what a^2 / (pi (a^4 + 1e-7)) leaves of it.
    const double rows[][3] = {{0.5, 5.09296, 5.09283},  {0.7, 39.2975, 39.2377}, {0.8, 198.944, 191.465},
                              {0.85, 628.760, 452.286}, {0.9, 3183.10, 289.373}, {0.95, 50929.6, 19.8866},
                              {1.0, 79577.5, 12.7304}};
    for (const auto& row : rows) {
        const double smoothness = row[0], exact = row[1], compat = row[2];
        CAPTURE(smoothness);
        measured("the exact form's peak, relative error",
                 std::abs(peakOfD(Form::exact, static_cast<float>(smoothness)) / exact - 1.0), 4e-6);
        CHECK(peakOfD(Form::compat, static_cast<float>(smoothness)) == doctest::Approx(compat).epsilon(2e-3));
    }
}

TEST_CASE("lighting: S-807 around the peak of a mirror, the exact form agrees with double")
{
    const double a2 = 0.002 * 0.002;
    for (const double tilt : {0.0, 1e-5, 1e-4, 1e-3, 3e-3, 1e-2}) {
        // Viewer and light on both sides of the half vector, which leans by `tilt` away from the normal.
        const float3 view = direction(std::cos(0.5), 0.0);
        const Vector v = lane(view);
        const Vector h = {std::sin(tilt), 0.0, std::cos(tilt)};
        const double VdotH = v.x * h.x + v.z * h.z;
        const float3 light = {static_cast<float>(2.0 * VdotH * h.x - v.x), static_cast<float>(-v.y),
                              static_cast<float>(2.0 * VdotH * h.z - v.z)};
        const double expected = specularInDouble(a2, v, lane(light));
        CAPTURE(tilt);
        const auto value = static_cast<double>(lit(Form::exact, kNothing, kWhite, 1.0f, view, light).x[0]);
        measured("around the peak, relative error", std::abs(value / expected - 1.0), 1e-5);
    }
}

TEST_CASE("lighting: the exact form agrees with double at all angles, grazing ones too")
{
    for (const double smoothness : {0.3, 0.6, 0.9}) {
        for (const double NdotV : {1.0, 0.5, 0.1, 0.02, 0.004}) {
            for (const double NdotL : {1.0, 0.5, 0.1, 0.02, 0.004}) {
                const float3 view = direction(NdotV, 0.0), light = direction(NdotL, 2.0);
                const double expected = specularInDouble(std::pow(1.0 - smoothness, 4.0), lane(view), lane(light));
                CAPTURE(smoothness);
                CAPTURE(NdotV);
                CAPTURE(NdotL);
                const float3 value = lit(Form::exact, kNothing, kWhite, static_cast<float>(smoothness), view, light);
                measured("relative error", std::abs(static_cast<double>(value.x[0]) / expected - 1.0), 1e-5);
            }
        }
    }
}

TEST_CASE("lighting: S-810 white furnace: the exact form loses a little, and never gains")
{
    const double rows[][3] = {{0.5, 1.0, 0.9158},  {0.5, 0.5, 0.8573},  {0.5, 0.1, 0.8941},
                              {0.75, 1.0, 0.9955}, {0.75, 0.5, 0.9888}, {0.75, 0.1, 0.8948},
                              {0.9, 1.0, 1.0},     {0.9, 0.5, 0.9997},  {0.9, 0.1, 0.9935}};
    for (const auto& row : rows) {
        const double smoothness = row[0], NdotV = row[1], expected = row[2];
        CAPTURE(smoothness);
        CAPTURE(NdotV);
        const double albedo = specularAlbedo(Form::exact, smoothness, NdotV);
        measured("albedo", albedo, 1.001);
        CHECK(albedo == doctest::Approx(expected).epsilon(0.01));
    }
    CHECK(specularAlbedo(Form::compat, 0.9, 0.5) == doctest::Approx(0.3957).epsilon(0.01));
}

TEST_CASE("lighting: S-811 Disney's diffuse sends out up to 1.56 of what arrives")
{
    CHECK(diffuseAlbedo(0.0, 1.0) == doctest::Approx(1.03571).epsilon(2e-3));
    CHECK(diffuseAlbedo(0.0, 0.1) == doctest::Approx(1.38011).epsilon(2e-3));
    CHECK(diffuseAlbedo(0.0, 0.0) == doctest::Approx(1.55754).epsilon(2e-3));
    measured("albedo", diffuseAlbedo(0.0, 0.0), 1.56);
    CHECK(diffuseAlbedo(1.0, 0.0) == doctest::Approx(0.490534).epsilon(5e-3));
}

TEST_CASE("lighting: S-812 smoothness and metallic beyond 0 to 1 are clamped, to the bit")
{
    const float3 view = direction(0.7, 1.0), light = direction(0.6, 3.0);
    for (const Form form : {Form::compat, Form::exact}) {
        const auto with = [&](float smoothness) { return lit(form, kWhite, kWhite, smoothness, view, light); };
        CHECK(sameBits(with(-1.0f), with(0.0f)));
        CHECK(sameBits(with(2.0f), with(1.0f)));
        CHECK(sameBits(with(kNan), with(0.0f)));
    }
    const auto metal = [](float metallic) {
        float3 specular;
        Float oneMinusReflectivity;
        const float3 diffuse =
            DiffuseAndSpecularFromMetallic({0.8f, 0.4f, 0.2f}, metallic, specular, oneMinusReflectivity);
        return specular * 2.0f + diffuse;
    };
    CHECK(sameBits(metal(-1.0f), metal(0.0f)));
    CHECK(sameBits(metal(2.0f), metal(1.0f)));
    CHECK(sameBits(metal(kNan), metal(0.0f)));
}

TEST_CASE("lighting: S-802 S-808 S-809 no light, no half vector, grazing: finite, not negative, dark where unlit")
{
    const float3 none = kNothing, broken = {kNan, 0.0f, 1.0f};
    for (const Form form : {Form::compat, Form::exact}) {
        for (const float smoothness : {0.0f, 0.5f, 0.9f, 1.0f}) {
            for (const double NdotV : {1.0, 0.5, 1e-4, 0.0, -0.5}) {
                const float3 view = direction(NdotV, 0.4);
                const float3 opposite = {-view.x, -view.y, -view.z};
                for (const float3& light : {none, broken, opposite, direction(0.0, 2.0), direction(-1e-7, 2.0),
                                            direction(1e-7, 2.0), direction(-0.3, 0.0), direction(1.0, 0.0)}) {
                    const Vector color = lane(lit(form, kWhite, kWhite, smoothness, view, light));
                    REQUIRE(isFinite(color));
                    CHECK(color.x >= 0.0);
                }
                CHECK(length(lane(lit(form, kWhite, kWhite, smoothness, view, none))) == 0.0);
                CHECK(length(lane(lit(form, kWhite, kWhite, smoothness, view, direction(-0.3, 0.0)))) == 0.0);
            }
        }
    }
    // S-809: specular * N.L <= 1 / (2 pi a^3), times the pi of the model.
    const double bound = 1.0 / (2.0 * 0.002 * 0.002 * 0.002);
    for (const double cosine : {1e-6, 1e-4, 1e-2, 0.3}) {
        const float3 view = direction(cosine, 0.0), light = direction(cosine, kPi);
        CHECK(static_cast<double>(lit(Form::exact, kNothing, kWhite, 1.0f, view, light).x[0]) <= bound);
    }
}

TEST_CASE("lighting: S-803 light that sinks below the surface fades out without a jump")
{
    for (const Form form : {Form::compat, Form::exact}) {
        for (const double e : {1e-2, 1e-3, 1e-4}) {
            const float3 above = direction(std::sin(e), 2.0), below = direction(-std::sin(e), 2.0);
            const float3 view = direction(0.8, 0.0);
            const double step = static_cast<double>(lit(form, kWhite, {0.04f, 0.04f, 0.04f}, 0.5f, view, above).x[0]) -
                                static_cast<double>(lit(form, kWhite, {0.04f, 0.04f, 0.04f}, 0.5f, view, below).x[0]);
            measured("step of intensity", step,
                     2.0 * std::sin(e));  // Disney's diffuse and Fresnel at the horizon: at most twice Lambert's
        }
    }
}
