// Phong's highlight, the rim and the 1 / distance lamp of chapters 2 and 3 at their limits (stability cases S-801 and
// S-803 to S-806, S-813, S-814): the stages themselves, drawn on a square or on their own shapes.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "common/render.h"
#include "lane_check.h"
#include "numbers.h"
#include "relief/hlsl/intrinsics.h"
#include "relief/mesh/primitives.h"
#include "stability.h"

namespace {

using namespace relief;
using namespace relief::samples;
using stability::measured;

// What a drawing gives, as floats.
struct Picture
{
    std::vector<glm::vec4> pixels;  // those that something was drawn to
    glm::vec4 centre{0.0f};         // of the whole picture
    std::uint64_t invalid = 0;
};

// A stage without its pictures and, unless told otherwise, without its bumps.
struct Drawing
{
    explicit Drawing(const std::string& stage, const std::vector<std::string>& settings, bool bumps = false)
    {
        const Inputs inputs = (*findStage(stage))->inputs();
        InputFiles files;
        if (!bumps) files.textures[TextureSlot::normal] = kNone;
        if (!inputs.textures[TextureSlot::albedo].file.empty()) files.textures[TextureSlot::albedo] = kNone;
        Expected<PreparedStage> made = PreparedStage::prepare(**findStage(stage), settings, files);
        REQUIRE(made.has_value());
        prepared = std::move(*made);
        camera = prepared.camera();
    }

    // In place of the stage's shapes. The mesh must live as long as this.
    Drawing& on(const Mesh& mesh)
    {
        prepared.inputs->objects = {{&mesh, glm::mat4(1.0f)}};
        return *this;
    }
    // Beyond the range that --set allows.
    Drawing& beyond(const std::string& property, float value)
    {
        for (Property& p : prepared.properties) {
            if (p.name == property) p.value = glm::vec4(value);
        }
        return *this;
    }
    Drawing& from(const glm::vec3& position)
    {
        camera = {.position = position};
        return *this;
    }

    Picture operator()(int width = 33, int height = 33) const
    {
        Expected<Framebuffer> target = Framebuffer::create(width, height, Format::rgba32f, Store::keep);
        REQUIRE(target.has_value());
        Frame frame(*target, {.threads = 1});
        prepared.record(frame, width, height, camera);
        Picture picture;
        picture.invalid = frame.run().invalidColors;
        picture.centre = target->color32f()[target->color32f().size() / 2];
        for (std::size_t i = 0; i < target->color32f().size(); ++i) {
            if (target->depth()[i] < 1.0f) picture.pixels.push_back(target->color32f()[i]);
        }
        REQUIRE(picture.pixels.size() > 100);
        return picture;
    }

    PreparedStage prepared;
    Camera camera;
};

std::string setting(const std::string& name, float value)
{
    char text[64];
    std::snprintf(text, sizeof text, "%s=%.9g", name.c_str(), static_cast<double>(value));
    return text;
}

// The smallest and the largest red of a picture; no pixel may be anything but a number.
struct Interval
{
    float low = kInfinity, high = -kInfinity;
};
Interval reds(const Picture& picture)
{
    CHECK(picture.invalid == 0);
    Interval range;
    for (const glm::vec4& p : picture.pixels) {
        CHECK(std::isfinite(p.x));
        range = {std::min(range.low, p.x), std::max(range.high, p.x)};
    }
    return range;
}

// Only the highlight: black material, white specular colour, a light of strength 1 whose red is 1.
std::vector<std::string> highlightOnly(const std::string& stage)
{
    if (stage == "2.06") return {"color=0,0,0,1", "ambient=0,0,0", "sun=1", "lamp=0"};
    return {"color=0,0,0,1", "ambient=0,0,0", "sun=1"};
}

std::vector<std::string> with(std::vector<std::string> settings, const std::vector<std::string>& more)
{
    settings.insert(settings.end(), more.begin(), more.end());
    return settings;
}

const char* const kWithTutorialForm[] = {"2.05", "2.06"};

}  // namespace

TEST_CASE("phong: S-801 a lamp of 1 / distance ends at 1000 times its strength, and at the surface itself is dark")
{
    const Mesh quad = makeQuad();
    struct Lamp
    {
        std::string stage;
        std::vector<std::string> settings;
    };
    const Lamp lamps[] = {
        {"2.06", {"sun=0", "ambient=0,0,0", "specColor=0,0,0,1", "lamp=1"}},
        {"3.05", {"lightStrength=0", "ambient=0,0,0", "specColor=0,0,0,1", "rimColor=0,0,0,1", "lampStrength=1"}}};
    for (const Lamp& lamp : lamps) {
        CAPTURE(lamp.stage);
        for (const float distance : {0.0f, 1e-30f, 1e-20f, 1e-6f, 1e-4f, 5e-4f, 1e-3f, 1e-2f, 0.1f, 1.0f}) {
            CAPTURE(distance);
            Drawing drawing(lamp.stage, lamp.settings);
            for (Property& p : drawing.prepared.properties) {
                if (p.name == "lampPosition") p.value = {0, 0, -distance, 0};
            }
            const Picture picture = drawing.on(quad).from({0, 0, -1.5f})();
            CHECK(picture.invalid == 0);
            for (const glm::vec4& p : picture.pixels) {
                CHECK(std::isfinite(p.z));
                CHECK(p.z >= 0.0f);
                CHECK(p.z <= 1000.0f * 1.000001f);  // of a lamp whose blue is 1
            }
            // Straight above the middle N.L is 1. The square's middle is a pixel's centre.
            const float expected = distance == 0.0f ? 0.0f : 1.0f / std::max(distance, 1e-3f);
            CHECK(picture.centre.z == doctest::Approx(expected).epsilon(1e-4));
        }
    }
}

TEST_CASE("phong: S-803 the tutorial's highlight jumps where N.L is 0, and with N.L it fades out")
{
    // A light from behind, 150 degrees from the viewer: at N.L = 0 the highlight is cos(30 degrees)^10.
    const Mesh quad = makeQuad();
    for (const char* stage : kWithTutorialForm) {
        CAPTURE(stage);
        const auto highlight = [&](float degrees, const char* form) {
            const std::vector<std::string> settings = with(
                highlightOnly(stage), {setting("lightYaw", 90.0f - degrees), "lightPitch=0", form, "shininess=10"});
            return Drawing(stage, settings).on(quad).from({1.7320508f, 0, -1})().centre.x;
        };
        const double jump = std::pow(0.75, 5.0);
        for (const float degrees : {8.0f, 4.0f, 2.0f, 1.0f, 0.5f, 0.1f, 0.01f}) {
            CAPTURE(degrees);
            const double sine = std::sin(static_cast<double>(degrees) * 3.14159265358979 / 180.0);
            const float above = highlight(degrees, "tutorialForm=0"), below = highlight(-degrees, "tutorialForm=0");
            CHECK(below == 0.0f);
            CHECK(above > 0.0f);
            CHECK(static_cast<double>(above) <= sine);  // 255 sin(e) of 255 codes
            CHECK(highlight(-degrees, "tutorialForm=1") == 0.0f);
            // R leaves the surface at the same angle e as L, and the viewer stands at 30 degrees: R.V = cos(30 - e).
            const double expected =
                std::pow(std::cos((30.0 - static_cast<double>(degrees)) * 3.14159265358979 / 180.0), 10.0);
            CHECK(static_cast<double>(highlight(degrees, "tutorialForm=1")) == doctest::Approx(expected).epsilon(1e-4));
        }
        CHECK(static_cast<double>(highlight(0.01f, "tutorialForm=1")) == doctest::Approx(jump).epsilon(2e-3));
    }
}

TEST_CASE("phong: S-803 the Cg stages fade to 0 with N.L, highlight and rim included")
{
    const Mesh quad = makeQuad();
    for (const char* stage : {"3.01", "3.03", "3.04", "3.05"}) {
        CAPTURE(stage);
        for (const float degrees : {8.0f, 1.0f, 0.1f, 0.01f}) {
            CAPTURE(degrees);
            const double sine = std::sin(static_cast<double>(degrees) * 3.14159265358979 / 180.0);
            for (const float side : {1.0f, -1.0f}) {
                std::vector<std::string> settings = {setting("lightYaw", 90.0f - side * degrees), "lightPitch=0",
                                                     "ambient=0,0,0", "lightStrength=1"};
                if (std::string(stage) == "3.05")
                    settings = with(settings, {"lampStrength=0", "rimColor=0,0,0,1"});  // the lamp has a rim too
                const float red = Drawing(stage, settings).on(quad).from({1.7320508f, 0, -1})().centre.x;
                // Diffuse light, highlight and rim: each at most N.L.
                CHECK(static_cast<double>(red) <= (side > 0.0f ? 3.0 * sine * 1.00001 : 0.0));
                if (side > 0.0f) CHECK(red > 0.0f);
            }
        }
    }
}

TEST_CASE("phong: S-804 a base that rounding left above 1, to large exponents")
{
    // 1e4: the exponent multiplies the error of log2. 3.4e-3 is the bound of the stability list.
    double worst = 0.0;
    for (int i = 0; i < 4000; ++i) {
        const float base = 1.0f - static_cast<float>(i) * 0x1p-22f;
        const double exact = std::pow(static_cast<double>(base), 1e4);
        worst = std::max(worst, std::abs(static_cast<double>(pow(base, 1e4f)) - exact) / exact);
    }
    measured("relative error at exponent 1e4", worst, 3.4e-3);
    for (const float exponent : {1e4f, 1e6f, 1e30f}) {
        CAPTURE(exponent);
        for (const float base :
             {0.0f, 1e-30f, 0.5f, 0.99f, 1.0f - 0x1p-24f, 1.0f, 1.0f + 0x1p-23f, 1.0f + 0x1p-20f, 2.0f}) {
            CAPTURE(base);
            const float value = pow(saturate(Float(base)), Float(exponent))[0];
            CHECK(value >= 0.0f);
            CHECK(value <= 1.0f);
        }
        CHECK(pow(saturate(Float(1.0f + 0x1p-23f)), Float(exponent))[0] == 1.0f);
    }
}

TEST_CASE("phong: S-804 no stage's highlight is brighter than the light, whatever the exponent")
{
    const Mesh sphere = makeCubeSphere(24);
    for (const char* stage : {"2.05", "2.06", "3.03", "3.04", "3.05"}) {
        CAPTURE(stage);
        const bool cg = stage[0] == '3';
        const std::vector<std::string> settings = cg ? std::vector<std::string>{"ambient=0,0,0", "lightStrength=1"}
                                                     : with(highlightOnly(stage), {"tutorialForm=1"});
        for (const float exponent : {1.0f, 1000.0f, 1e4f, 1e6f, 1e30f}) {
            CAPTURE(exponent);
            // From the front: the highlight's middle is on the surface, where R.V is 1 but for its rounding.
            Drawing drawing(stage, with(settings, {"lightYaw=0", "lightPitch=0"}), false);
            drawing.on(sphere).from({0, 0, -1.4f}).beyond("shininess", exponent);
            if (cg) {
                drawing.beyond("rimPower", 1e30f).beyond("lampStrength", 0.0f);
                Drawing without = Drawing(stage, with(settings, {"lightYaw=0", "lightPitch=0", "specColor=0,0,0,1"}));
                without.on(sphere).from({0, 0, -1.4f}).beyond("rimPower", 1e30f).beyond("lampStrength", 0.0f);
                const Picture lit = drawing(257, 257), matte = without(257, 257);
                REQUIRE(lit.pixels.size() == matte.pixels.size());
                CHECK(lit.invalid == 0);
                for (std::size_t i = 0; i < lit.pixels.size(); ++i)
                    CHECK(lit.pixels[i].x - matte.pixels[i].x <= matte.pixels[i].x);  // N.L times at most 1
            } else {
                const Interval range = reds(drawing(257, 257));
                CHECK(range.low >= 0.0f);
                CHECK(range.high <= 1.0f);
                if (exponent <= 1000.0f) CHECK(range.high > 0.9f);
            }
        }
    }
    for (const char* stage : {"2.05", "2.06", "3.01", "3.05"}) {
        CHECK_FALSE(PreparedStage::prepare(**findStage(stage), {"shininess=1000.1"}).has_value());
        CHECK_FALSE(PreparedStage::prepare(**findStage(stage), {"shininess=-0.1"}).has_value());
    }
}

TEST_CASE("phong: S-805 to the power of 0 everything is 1, also a highlight that is 0")
{
    CHECK(pow(0.0f, 0.0f) == 1.0f);
    CHECK(pow(Float(0.0f), Float(0.0f))[0] == 1.0f);
    // The highlight is then N.L everywhere, the diffuse light of a white material, to the bit.
    for (const char* stage : kWithTutorialForm) {
        CAPTURE(stage);
        const std::vector<std::string> side = {"lightYaw=60", "lightPitch=20"};
        const Picture highlight =
            Drawing(stage, with(highlightOnly(stage), with(side, {"shininess=0"})), true)(160, 90);
        std::vector<std::string> settings = highlightOnly(stage);
        settings[0] = "specColor=0,0,0,1";
        const Picture diffuse = Drawing(stage, with(settings, side), true)(160, 90);
        CHECK(highlight.invalid == 0);
        REQUIRE(highlight.pixels.size() == diffuse.pixels.size());
        for (std::size_t i = 0; i < diffuse.pixels.size(); ++i) CHECK(highlight.pixels[i].x == diffuse.pixels[i].x);
    }
}

TEST_CASE("phong: S-806 where the reflection points away from the viewer there is no highlight")
{
    CHECK(std::isnan(pow(-0.5f, 10.0f)));
    CHECK(pow(saturate(Float(-0.5f)), Float(10.0f))[0] == 0.0f);
    // Light and viewer on the same side, 60 and 80 degrees from the normal: R.V = cos(140 degrees).
    const Mesh quad = makeQuad();
    for (const char* stage : {"2.05", "2.06", "3.03", "3.05"}) {
        CAPTURE(stage);
        std::vector<std::string> matte = {"lightYaw=-60", "lightPitch=0", "ambient=0,0,0", "specColor=0,0,0,1"};
        std::vector<std::string> shiny = matte;
        shiny.back() = "specColor=1,1,1,1";
        for (const char* exponent : {"shininess=1", "shininess=10", "shininess=3.5"}) {
            const auto draw = [&](const std::vector<std::string>& settings) {
                Drawing drawing(stage, with(settings, {exponent}));
                drawing.beyond("lamp", 0.0f).beyond("lampStrength", 0.0f).on(quad).from({1.4772f, 0, -0.26047f});
                return drawing();
            };
            const Picture plain = draw(matte), highlit = draw(shiny);
            CHECK(highlit.invalid == 0);
            CHECK(highlit.centre.x == plain.centre.x);
            CHECK(highlit.centre.x > 0.0f);
        }
    }
}

TEST_CASE("phong: S-813 the rim is within 0 to 1 for any power, seen head on and along the edge")
{
    const Mesh quad = makeQuad();
    const std::vector<std::string> rimOnly = {"ambient=0,0,0", "lightStrength=0"};
    for (const char* stage : {"3.04", "3.05"}) {
        CAPTURE(stage);
        for (const float power : {0.1f, 10.0f, 0.0f, 1e6f, 1e30f}) {
            CAPTURE(power);
            // The sphere with its bumps; in 3.05 the lamp's pass adds a rim of its own.
            Drawing drawing(stage, rimOnly, true);
            const Interval range = reds(drawing.beyond("rimPower", power).beyond("lampStrength", 0.0f)(257, 257));
            CHECK(range.low >= 0.0f);
            CHECK(range.high <= (std::string(stage) == "3.05" ? 2.0f : 1.0f));
            if (power <= 10.0f) CHECK(range.high > 0.01f);
        }
    }
    // Head on V.N is 1, and the rim 0^power: 0, and 1 for the power of 0.
    for (const float power : {0.1f, 10.0f, 0.0f, 1e6f}) {
        CAPTURE(power);
        Drawing drawing("3.04", with(rimOnly, {"lightYaw=0", "lightPitch=0"}));
        const Picture picture = drawing.on(quad).from({0, 0, -1.5f}).beyond("rimPower", power)();
        CHECK(picture.invalid == 0);
        CHECK(picture.centre.x == (power == 0.0f ? 1.0f : 0.0f));
    }
    // V.N above 1 by rounding.
    for (const float cosine : {1.0f, 1.0f + 0x1p-23f, 1.0f + 0x1p-20f}) {
        for (const float power : {0.1f, 10.0f, 0.0f, 1e6f}) {
            const float value = pow(1.0f - saturate(Float(cosine)), Float(power))[0];
            CHECK(value == (power == 0.0f ? 1.0f : 0.0f));
        }
    }
}

TEST_CASE("phong: S-814 unit vectors alone leave R.V up to 2^-20 above 1, and so the stages clamp it")
{
    lane_check::RandomBits random;
    const auto number = [&random] { return static_cast<float>(random() >> 8) * 0x1p-23f - 1.0f; };
    float largest = 0.0f;
    for (int trial = 0; trial < 20000; ++trial) {
        float3 n;
        for (int c = 0; c < 3; ++c) n[c] = Float(number());
        n = normalize(n) * Float(1.0f + 0.1f * number());
        const float3 unit = normalize(n), light = normalize(unit * Float(1.03f));
        const Float RdotV = dot(reflect(-light, unit), light);
        largest = std::max(largest, RdotV[0]);
        CHECK(saturate(RdotV)[0] <= 1.0f);
    }
    CHECK(largest > 1.0f);
    measured("R.V of unit vectors above 1, unclamped", largest - 1.0f, 0x1p-20f);
}

TEST_CASE("phong: S-814 normals of length 0.9 to 1.1 reflect no more light than arrives")
{
    // Exponent 1: the highlight is R.V itself.
    Mesh mesh = makeCubeSphere(24);
    const Mesh plain = mesh;
    for (std::size_t i = 0; i < mesh.normals.size(); ++i)
        mesh.normals[i] *= 0.9f + 0.2f * static_cast<float>(i % 17) / 16.0f;
    for (const char* stage : kWithTutorialForm) {
        CAPTURE(stage);
        const std::vector<std::string> settings =
            with(highlightOnly(stage), {"tutorialForm=1", "shininess=1", "lightYaw=0", "lightPitch=0"});
        const Picture scaled = Drawing(stage, settings).on(mesh).from({0, 0, -1.4f})(257, 257);
        const Picture unscaled = Drawing(stage, settings).on(plain).from({0, 0, -1.4f})(257, 257);
        measured("brightest above a light of 1", reds(scaled).high - 1.0f, 0x1p-22f);
        CHECK(reds(scaled).high > 0.99f);
        // The same picture but for rounding: the length does not count.
        REQUIRE(scaled.pixels.size() == unscaled.pixels.size());
        for (std::size_t i = 0; i < scaled.pixels.size(); ++i)
            CHECK(std::abs(scaled.pixels[i].x - unscaled.pixels[i].x) <= 2e-6f);
    }
}
