// Octahedral normals and packed numbers, against double and by their codes.
#include "relief/shading/normal_encoding.h"

#include <limits>
#include <random>

#include "shading_fixture.h"

using namespace fixture;

namespace {

float3 lanes(double x, double y, double z)
{
    return {Float(static_cast<float>(x)), Float(static_cast<float>(y)), Float(static_cast<float>(z))};
}

}  // namespace

TEST_CASE("normal encoding: a direction comes back from its square, at seams and corners too")
{
    std::mt19937 random(37);
    const auto number = [&] { return static_cast<double>(random()) / 2147483648.0 - 1.0; };
    double worst = 0.0, least = 1.0, most = 0.0;
    const auto check = [&](const Vector& v) {
        const float2 square = octahedralOf(lanes(v.x, v.y, v.z));
        for (const float c : {square.x[0], square.y[0]}) {
            least = std::fmin(least, static_cast<double>(c));
            most = std::fmax(most, static_cast<double>(c));
        }
        worst = std::fmax(worst, angle(lane(fromOctahedral(square)), lane(lanes(v.x, v.y, v.z))));
    };
    for (int i = 0; i < trials(20000); ++i) {
        const Vector v = {number(), number(), number()};
        if (length(v) > 1e-3) check(v);
    }
    for (int i = 0; i < 27; ++i) {
        const Vector v = {i % 3 - 1.0, i / 3 % 3 - 1.0, i / 9 - 1.0};
        if (i != 13) check(v);
        if (i != 13) check({v.x * 1e-20, v.y * 1e-20, v.z * 1e-20});
        check({v.x + 1e-7, v.y - 1e-7, v.z + 1e-7});
    }
    CHECK(worst <= 5e-5);  // some ulps of the square
    CHECK(least >= 0.0);
    CHECK(most <= 1.0);
    const float2 none = octahedralOf(float3(0.0f));
    CHECK(lane(fromOctahedral(none)).z == 1.0);
}

TEST_CASE("normal encoding: in codes of 8, 12 and 16 bits the largest error is the known one")
{
    // Largest of 300000 directions, by a script without the engine.
    double worst[3] = {};
    std::mt19937 random(38);
    const auto number = [&] { return static_cast<double>(random()) / 2147483648.0 - 1.0; };
    for (int i = 0; i < trials(20000); ++i) {
        const Vector v = {number(), number(), number()};
        if (length(v) < 1e-3) continue;
        const float2 square = octahedralOf(lanes(v.x, v.y, v.z));
        const auto bytes = [](const auto& c) { return floor(saturate(c) * 255.0f + 0.5f) / 255.0f; };
        const float3 decoded[] = {fromOctahedral(bytes(square)),
                                  fromOctahedral(unpackedTwelve(bytes(packedTwelve(square)))),
                                  fromOctahedral(unpackedSixteen(bytes(packedSixteen(square))))};
        for (int k = 0; k < 3; ++k) worst[k] = std::fmax(worst[k], angle(lane(decoded[k]), v));
    }
    CHECK(worst[0] == doctest::Approx(0.93337).epsilon(0.05));
    CHECK(worst[1] == doctest::Approx(0.058435).epsilon(0.05));
    CHECK(worst[2] == doctest::Approx(0.003655).epsilon(0.05));
}

TEST_CASE("normal encoding: every code of 12 and 16 bits comes back from its bytes, and NaN is one of them")
{
    int wrong = 0;
    const auto whole = [](float v) { return v == std::floor(v) && v >= 0.0f && v <= 255.0f; };
    for (int code = 0; code < 4096; ++code) {
        const Float v = static_cast<float>(code) / 4095.0f, other = static_cast<float>(4095 - code) / 4095.0f;
        const float3 bytes = packedTwelve({v, other});
        wrong += !whole(std::round(bytes.x[0] * 255.0f)) ||
                 std::abs(bytes.y[0] * 255.0f - std::round(bytes.y[0] * 255.0f)) > 1e-4f;
        const float2 back = unpackedTwelve(bytes);
        wrong += back.x[0] != v[0] || back.y[0] != other[0];
    }
    for (int code = 0; code < 65536; ++code) {
        const Float v = static_cast<float>(code) / 65535.0f, other = static_cast<float>(65535 - code) / 65535.0f;
        const float2 back = unpackedSixteen(packedSixteen({v, other}));
        wrong += back.x[0] != v[0] || back.y[0] != other[0];
    }
    CHECK(wrong == 0);
    const Float nan = std::numeric_limits<float>::quiet_NaN();
    CHECK(unpackedTwelve(packedTwelve({nan, Float(1.0f)})).x[0] == 0.0f);
    CHECK(unpackedSixteen(packedSixteen({nan, Float(1.0f)})).y[0] == 1.0f);
}
