// Decoding and blending of tangent-space normals, ordinary and extreme (stability cases S-601 to S-620).
#include "relief/shading/normals.h"

#include <bit>
#include <limits>

#include "numbers.h"
#include "shading_fixture.h"

using namespace fixture;

namespace {

const float3 kFlat = {0.0f, 0.0f, 1.0f};

}  // namespace

TEST_CASE("normals: S-601 every pair of codes decodes to a finite unit vector, z 0 where x and y are too long")
{
    int tooLong = 0;
    double worst = 0.0;
    for (int x = 0; x < 256; ++x) {
        for (int y = 0; y < 256; ++y) {
            const float3 n = UnpackScaleNormal(codes(x, y), 1.0f);
            const double dx = 2.0 * x / 255.0 - 1.0, dy = 2.0 * y / 255.0 - 1.0;
            if (dx * dx + dy * dy > 1.0) {
                ++tooLong;
                CHECK(n.z[0] == 0.0f);
            }
            const Vector u = lane(normalize(n));
            REQUIRE(isFinite(u));
            worst = std::max(worst, std::abs(length(u) - 1.0));
        }
    }
    CHECK(tooLong == 14496);  // 22.1191 %: what a root without saturate() would make NaN
    measured("length off 1", worst, 2e-7);
}

TEST_CASE("normals: S-602 the flat codes are tilted by 0.31776 degrees")
{
    const double tilt = angle(lane(UnpackScaleNormal(codes(128, 128), 1.0f)), {0, 0, 1});
    measured("degrees off 0.317760", std::abs(tilt - 0.317760), 1e-5);
    const float4 rgb = {128.0f / 255.0f, 128.0f / 255.0f, 1.0f, 1.0f};
    CHECK(angle(lane(UnpackScaleNormalRGB(rgb, 1.0f)), {0, 0, 1}) == doctest::Approx(0.317755).epsilon(1e-5));
}

TEST_CASE("normals: S-603 bump scale 0 is exactly flat")
{
    for (int x = 0; x < 256; x += 5) {
        for (int y = 0; y < 256; y += 5) {
            const float3 n = UnpackScaleNormal(codes(x, y), 0.0f);
            CHECK(std::abs(n.x[0]) == 0.0f);
            CHECK(std::abs(n.y[0]) == 0.0f);
            CHECK(n.z[0] == 1.0f);
        }
    }
}

TEST_CASE("normals: S-604 extreme bump scales keep the direction of x and y, and z is 0")
{
    for (const float scale : {1e6f, 1e30f, kInfinity, std::numeric_limits<float>::max()}) {
        for (int x = 0; x < 256; x += 17) {
            for (int y = 0; y < 256; y += 17) {
                const float3 n = normalize(UnpackScaleNormal(codes(x, y), scale));
                REQUIRE(isFinite(lane(n)));
                CHECK(n.z[0] == 0.0f);
                measured("degrees off", angle(lane(n), {2.0 * x / 255.0 - 1.0, 2.0 * y / 255.0 - 1.0, 0}), 1e-4);
            }
        }
    }
    const float3 n = UnpackScaleNormal(codes(200, 40), 1.0f), flipped = UnpackScaleNormal(codes(200, 40), -1.0f);
    CHECK(sameBits(flipped, float3(-n.x, -n.y, n.z)));
    CHECK(sameBits(UnpackScaleNormal(codes(200, 40), kNan), UnpackScaleNormal(codes(200, 40), 0.0f)));
}

TEST_CASE("normals: S-605 S-617 RGB normals are made unit length, and never point down")
{
    for (int code = 0; code < 256; code += 3) {
        for (const float scale : {0.0f, 0.5f, 1.0f, 8.0f, 1e30f}) {
            const float4 texel = {static_cast<float>(code) / 255.0f, 0.9f, static_cast<float>(255 - code) / 255.0f,
                                  1.0f};
            const float3 n = UnpackScaleNormalRGB(texel, scale);
            measured("length off 1", std::abs(length(lane(n)) - 1.0), 2e-7);
            CHECK(n.z[0] >= 0.0f);
        }
    }
    CHECK(sameBits(UnpackScaleNormalRGB({0.5f, 0.5f, 0.0f, 1.0f}, 1.0f), kFlat));
}

TEST_CASE("normals: bump scale scales the sine of the tilt, which is the slope for small ones only")
{
    // Scale 2 makes 30 degrees an upright wall, where twice the slope would be 49.1066 degrees.
    const float half = 0.5f;  // sin(30 degrees)
    const float4 texel = {1.0f, 0.5f, 1.0f, half * 0.5f + 0.5f};
    CHECK(angle(lane(UnpackScaleNormal(texel, 1.0f)), {0, 0, 1}) == doctest::Approx(30.0).epsilon(1e-6));
    CHECK(angle(lane(UnpackScaleNormal(texel, 2.0f)), {0, 0, 1}) == doctest::Approx(90.0).epsilon(1e-6));
    CHECK(angle(lane(UnpackScaleNormal(texel, 0.5f)), {0, 0, 1}) ==
          doctest::Approx(std::asin(0.25) * 180.0 / 3.14159265358979).epsilon(1e-6));
}

TEST_CASE("normals: S-615 where one map is flat, whiteout, derivatives and RNM keep the other")
{
    for (int i = 0; i < 40; ++i) {
        const float3 n = sloped(static_cast<float>(i) * 0.1f - 2.0f, static_cast<float>(i % 7) * 0.3f - 1.0f);
        measured("degrees off", angle(lane(BlendNormals(n, kFlat)), lane(n)), 1e-4);
        CHECK(angle(lane(BlendNormals(kFlat, n)), lane(n)) <= 1e-4);
        measured("degrees off", angle(lane(BlendNormalsDerivative(n, kFlat)), lane(n)), 1e-4);
        CHECK(angle(lane(BlendNormalsDerivative(kFlat, n)), lane(n)) <= 1e-4);
        measured("degrees off", angle(lane(BlendNormalsRNM(n, kFlat)), lane(n)), 1e-4);
        CHECK(angle(lane(BlendNormalsRNM(kFlat, n)), lane(n)) <= 1e-4);
        CHECK(angle(lane(BlendNormalsUDN(n, kFlat)), lane(n)) <= 1e-4);
    }
    // The average halves both, and UDN with a flat base keeps z at 1: T-03 expects these to differ.
    CHECK(angle(lane(BlendNormalsAverage(sloped(1, 0), kFlat)), lane(sloped(1, 0))) ==
          doctest::Approx(22.5).epsilon(1e-5));
    CHECK(angle(lane(BlendNormalsUDN(kFlat, sloped(1, 0))), lane(sloped(1, 0))) > 5.0);
}

TEST_CASE("normals: derivatives of two height fields add up exactly, whiteout's do not")
{
    const float3 sum = sloped(0.7f, -0.2f);
    CHECK(angle(lane(BlendNormalsDerivative(sloped(0.4f, 0.3f), sloped(0.3f, -0.5f))), lane(sum)) <= 1e-5);
    CHECK(angle(lane(BlendNormals(sloped(0.4f, 0.3f), sloped(0.3f, -0.5f))), lane(sum)) > 0.5);
}

TEST_CASE("normals: S-616 average, derivatives and whiteout do not depend on the order")
{
    for (int i = 0; i < 40; ++i) {
        const float3 a = sloped(static_cast<float>(i) * 0.1f - 2.0f, 0.4f),
                     b = sloped(0.3f, static_cast<float>(i) * 0.05f);
        CHECK(sameBits(BlendNormals(a, b), BlendNormals(b, a)));
        CHECK(sameBits(BlendNormalsAverage(a, b), BlendNormalsAverage(b, a)));
        CHECK(sameBits(BlendNormalsDerivative(a, b), BlendNormalsDerivative(b, a)));
    }
}

TEST_CASE("normals: S-611 derivatives where a z is 0 are the limit from above")
{
    const float3 upright = {0.6f, 0.8f, 0.0f}, gentle = sloped(0.5f, 0.25f), other = {-0.8f, 0.6f, 0.0f};
    const float3 nearly = normalize(float3(0.6f, 0.8f, 1e-6f));
    measured("degrees off the limit",
             angle(lane(BlendNormalsDerivative(upright, gentle)), lane(BlendNormalsDerivative(nearly, gentle))), 1e-3);
    measured("degrees off the limit",
             angle(lane(BlendNormalsDerivative(gentle, upright)), lane(BlendNormalsDerivative(gentle, nearly))), 1e-3);
    // Both: the two walls' slopes together.
    CHECK(angle(lane(BlendNormalsDerivative(upright, other)), {-0.2, 1.4, 0.0}) <= 1e-4);
    CHECK(isFinite(lane(BlendNormalsDerivative(upright, float3(-0.6f, -0.8f, 0.0f)))));
}

TEST_CASE("normals: S-612 S-613 RNM near its pole, and with lengths that are not 1")
{
    for (const float away : {0.0f, 0x1p-24f, 1e-6f, 1e-5f, 1e-4f, 2e-4f, 3e-4f, 1e-3f}) {
        const float z = -1.0f + away, across = std::sqrt(std::max(0.0f, 1.0f - z * z));
        for (const float3& n1 :
             {float3(across, 0, z), float3(0, across, z), float3(across * 0.6f, across * -0.8f, z)}) {
            const float3 r = BlendNormalsRNM(n1, sloped(0.3f, -0.4f));
            REQUIRE(isFinite(lane(r)));
            measured("length off 1 near the pole", std::abs(length(lane(r)) - 1.0), 1e-3);
        }
    }
    for (const float scale : {0.9f, 1.0f, 1.1f}) {
        const float3 r = BlendNormalsRNM(sloped(0.5f, 0.1f) * scale, sloped(-0.2f, 0.3f));
        measured("length off 1", std::abs(length(lane(r)) - 1.0), 1e-6);
        measured("degrees off", angle(lane(r), lane(BlendNormalsRNM(sloped(0.5f, 0.1f), sloped(-0.2f, 0.3f)))), 6.0);
    }
}

TEST_CASE("normals: RNM turns the detail by the rotation that takes up to the base")
{
    const float3 base = sloped(1.0f, 0.0f);  // leans by 45 degrees
    const float3 detail = sloped(std::tan(0.2f), 0.0f);
    // Rotations about the same axis add up: 45 degrees and 0.2 rad.
    const double sum = 45.0 + 0.2 * 180.0 / 3.14159265358979;
    CHECK(angle(lane(BlendNormalsRNM(base, detail)), {0, 0, 1}) == doctest::Approx(sum).epsilon(1e-6));
}

TEST_CASE("normals: S-614 the average of opposite normals is the first")
{
    const float3 n = sloped(0.5f, -0.5f);
    CHECK(sameBits(BlendNormalsAverage(n, float3(-n.x, -n.y, -n.z)), n));
}

TEST_CASE("normals: S-1105 no detail map and a flat one of 8 bits are not the same: 0.31776 degrees")
{
    const float3 flat8 = UnpackScaleNormal(codes(128, 128), 1.0f);
    double largest = 0.0, smallest = 1e30;
    for (float slope = 0.0f; slope < 2.0f; slope += 0.125f) {
        const float3 base = sloped(slope, -0.3f);
        const Vector without = lane(base), with = lane(BlendNormals(base, flat8));
        smallest = std::min(smallest, angle(without, with));
        // Of all lights the one that sees most of the difference: 255 times the chord between the two normals.
        const Vector d = {with.x - without.x, with.y - without.y, with.z - without.z};
        largest = std::max(largest, 255.0 * length(d));
    }
    CHECK(smallest > 0.05);
    measured("codes of Lambert's light between them", largest, 1.41439 * 1.0001);
}
