// What a normal loses on its way through codes and blocks, in degrees.
#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include "import_fixture.h"

using namespace import_fixture;

namespace {

struct Vector
{
    double x, y, z;
};

// As shaders read them: three channels, or two and the third from unit length.
Vector readNormal(const std::uint8_t* code, Storage storage)
{
    const auto toSigned = [](int c) { return c / 255.0 * 2.0 - 1.0; };
    if (storage == Storage::rgb) return {toSigned(code[0]), toSigned(code[1]), toSigned(code[2])};
    const double x = toSigned(code[3]), y = toSigned(code[1]);
    return {x, y, std::sqrt(1.0 - std::fmin(x * x + y * y, 1.0))};
}

double length(const Vector& v)
{
    return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

// In degrees; exact for small angles, where the arc cosine of a product is not (W. Kahan).
double angle(const Vector& a, const Vector& b)
{
    const double la = length(a), lb = length(b);
    const Vector difference{a.x / la - b.x / lb, a.y / la - b.y / lb, a.z / la - b.z / lb};
    const Vector sum{a.x / la + b.x / lb, a.y / la + b.y / lb, a.z / la + b.z / lb};
    return 2.0 * std::atan2(length(difference), length(sum)) * 57.29577951308232;
}

struct StorageError
{
    double largest, rootMeanSquare;
};

StorageError storageError(const MipLevel& exact, const MipLevel& codes, Storage storage)
{
    double largest = 0.0, squares = 0.0;
    for (int y = 0; y < exact.height(); ++y) {
        for (int x = 0; x < exact.width(); ++x) {
            const float* n = exact.texel<float>(x, y);
            const double error = angle({n[0], n[1], n[2]}, readNormal(codes.texel<std::uint8_t>(x, y), storage));
            largest = std::fmax(largest, error);
            squares += error * error;
        }
    }
    return {largest, std::sqrt(squares / exact.width() / exact.height())};
}

}  // namespace

TEST_CASE("import: a flat normal in 8 bits is tilted by 0.318 degrees, in every storage")
{
    const double tilt = angle({1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}) / 90.0 * std::asin(std::sqrt(2.0) / 255.0);
    for (const Storage storage : {Storage::rgb, Storage::dxt5nm, Storage::dxt5}) {
        const Texture texture = *importTexture(onlyColour(8, 8, 90, 90, 90, 255), normalMap(storage));
        for (int k = 0; k < texture.levelCount(); ++k) {
            const std::uint8_t* code = texture.level(k).texel<std::uint8_t>(0, 0);
            CHECK(isFlat(code, storage));
            const double measured = angle({0.0, 0.0, 1.0}, readNormal(code, storage));
            CHECK(std::abs(measured - tilt * 57.29577951308232) < 1e-5);
            CHECK(std::abs(measured - 0.317760) < 5e-6);
        }
    }
}

// In degrees: rgb is bounded by half a code in each of three channels, asin(sqrt(3) / 255) = 0.389. What derives z has
// little left of it where z is small, and blocks of steep, rough heights lie between few values. The bounds of these
// two are what was measured, rounded up.
TEST_CASE("import: what each storage costs on the marble's heights")
{
    struct Row
    {
        float bumpiness;
        Storage storage;
        std::string name;
        double largest, rootMeanSquare;
    };
    const Row rows[] = {{0.01f, Storage::rgb, "rgb", 0.39, 0.3},       {0.01f, Storage::dxt5nm, "dxt5nm", 0.8, 0.21},
                        {0.01f, Storage::dxt5, "dxt5", 34.0, 2.1},     {0.05f, Storage::rgb, "rgb", 0.39, 0.3},
                        {0.05f, Storage::dxt5nm, "dxt5nm", 5.6, 0.33}, {0.05f, Storage::dxt5, "dxt5", 46.0, 4.2}};
    const auto picture = pictureOf(kHeights);
    for (const Row& row : rows) {
        const MipLevel exact = normalsFromHeights(heightsOf(*picture), row.bumpiness, NormalFilter::smooth);
        const Texture texture = *importTexture(picture, normalMap(row.storage, row.bumpiness));
        const StorageError error = storageError(exact, texture.level(0), row.storage);
        MESSAGE("bumpiness " << row.bumpiness << " as " << row.name << ": largest " << error.largest
                             << " degrees, root mean square " << error.rootMeanSquare);
        CHECK(error.largest <= row.largest);
        CHECK(error.rootMeanSquare <= row.rootMeanSquare);
    }
}

TEST_CASE("import: levels of normals are averages of level 0's normals, unit length within their codes")
{
    const auto picture = pictureOf(kHeights);
    const Texture texture = *importTexture(picture, normalMap(Storage::rgb, 0.2f));
    MipLevel means = normalsFromHeights(heightsOf(*picture), 0.2f, NormalFilter::smooth);
    for (int k = 0; k < texture.levelCount(); ++k) {
        if (k > 0) means = coarserLevel(TexelFormat::rgba32Float, means);
        const MipLevel& level = texture.level(k);
        for (int y = 0; y < level.height(); ++y) {
            for (int x = 0; x < level.width(); ++x) {
                const Vector n = readNormal(level.texel<std::uint8_t>(x, y), Storage::rgb);
                const float* mean = means.texel<float>(x, y);
                REQUIRE(std::abs(length(n) - 1.0) <= std::sqrt(3.0) / 255.0);
                REQUIRE(angle(n, {mean[0], mean[1], mean[2]}) <= 0.4);  // asin(sqrt(3) / 255) is 0.389
            }
        }
    }
}
