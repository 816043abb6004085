// What the tests of cube maps share: pictures of functions of a direction, and a reference in double that goes by
// Direct3D's table of faces (the same as OpenGL's), not by the engine's.
#pragma once

#include <array>
#include <cmath>
#include <functional>

#include "relief/texture/cube_sampler.h"
#include "sampler_fixture.h"

namespace cube_fixture {

using namespace sampler_fixture;

struct Direction
{
    double x = 0.0, y = 0.0, z = 0.0;

    double length() const { return std::sqrt(x * x + y * y + z * z); }
    Direction unit() const { return {x / length(), y / length(), z / length()}; }
};

inline double dot(const Direction& a, const Direction& b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

inline float3 toLanes(const Direction& d)
{
    return {Float(static_cast<float>(d.x)), Float(static_cast<float>(d.y)), Float(static_cast<float>(d.z))};
}

// A face and -1..1 to the right and down in its picture.
struct OnFace
{
    int face;
    double s, t;
};

// OpenGL 4.6, table 8.19: for each face sc, tc and ma.
inline OnFace onFace(const Direction& d)
{
    const double x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
    if (z >= x && z >= y) return d.z > 0 ? OnFace{4, d.x / z, -d.y / z} : OnFace{5, -d.x / z, -d.y / z};
    if (y >= x) return d.y > 0 ? OnFace{2, d.x / y, d.z / y} : OnFace{3, d.x / y, -d.z / y};
    return d.x > 0 ? OnFace{0, -d.z / x, -d.y / x} : OnFace{1, d.z / x, -d.y / x};
}

inline Direction directionOf(const OnFace& p)
{
    switch (p.face) {
        case 0:
            return {1, -p.t, -p.s};
        case 1:
            return {-1, -p.t, p.s};
        case 2:
            return {p.s, 1, p.t};
        case 3:
            return {p.s, -1, -p.t};
        case 4:
            return {p.s, -p.t, 1};
        default:
            return {-p.s, -p.t, -1};
    }
}

// The middle of a pixel, y counted from the top.
inline Direction pixelDirection(int face, int x, int y, int side)
{
    return directionOf({face, (2 * x + 1.0) / side - 1.0, (2 * y + 1.0) / side - 1.0});
}

inline std::size_t pixelIndex(int x, int y, int width)
{
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) * 4;
}

using Faces = std::array<ImageFile, kCubeFaces>;
using Radiance = std::function<double(const Direction& unit, int channel)>;

inline ImageFloat emptyPicture(int width, int height)
{
    return {width, height, std::vector<float>(pixelIndex(0, height, width))};
}

inline Faces facesOf(int side, const Radiance& radiance)
{
    Faces faces;
    for (int f = 0; f < kCubeFaces; ++f) {
        ImageFloat face = emptyPicture(side, side);
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                for (int c = 0; c < 4; ++c) {
                    face.pixels[pixelIndex(x, y, side) + static_cast<std::size_t>(c)] =
                        static_cast<float>(radiance(pixelDirection(f, x, y, side).unit(), c));
                }
            }
        }
        faces[static_cast<std::size_t>(f)] = std::move(face);
    }
    return faces;
}

inline CubeMap cubeOf(int side, const Radiance& radiance)
{
    return *CubeMap::fromFaces(facesOf(side, radiance), ColorSpace::linear);
}

// Without any pattern, in 0..1.
inline CubeMap noiseCube(TexelFormat format, int side, std::uint32_t seed = 1)
{
    Random random(seed);
    const auto fill = [&]<class Channel>(ImageOf<Channel>, auto number) {
        Faces faces;
        for (ImageFile& face : faces) {
            ImageOf<Channel> image{side, side, std::vector<Channel>(pixelIndex(0, side, side))};
            for (Channel& channel : image.pixels) channel = number();
            face = std::move(image);
        }
        return *CubeMap::fromFaces(faces, ColorSpace::linear);
    };
    if (format == TexelFormat::rgba8)
        return fill(Image8(), [&] { return static_cast<std::uint8_t>(random.bits() >> 8); });
    if (format == TexelFormat::rgba16)
        return fill(Image16(), [&] { return static_cast<std::uint16_t>(random.bits()); });
    return fill(ImageFloat(), [&] { return random(0.0f, 1.0f); });
}

// Level k is k everywhere: a sample gives its level of detail. Of 2^(levels - 1) texels a side.
inline CubeMap levelsCube(int levels)
{
    std::vector<ImageFile> strips;
    for (int k = 0; k < levels; ++k) {
        const int side = 1 << (levels - 1 - k);
        ImageFloat strip = emptyPicture(kCubeFaces * side, side);
        std::fill(strip.pixels.begin(), strip.pixels.end(), static_cast<float>(k));
        strips.push_back(std::move(strip));
    }
    return *CubeMap::fromLevels(strips, ColorSpace::linear);
}

// A smooth function of all directions, different in each channel, in about 0..1.
inline double smooth(const Direction& d, int channel)
{
    switch (channel) {
        case 0:
            return 0.5 + 0.25 * d.x - 0.2 * d.y * d.z;
        case 1:
            return 0.5 + 0.25 * d.y + 0.2 * d.x * d.z;
        case 2:
            return 0.5 + 0.25 * d.z + 0.2 * d.x * d.y * d.y;
        default:
            return 0.75 + 0.2 * (d.x * d.x - d.y * d.z);
    }
}

inline Direction randomDirection(Random& random)
{
    for (;;) {
        const Direction d = {random(-1.0f, 1.0f), random(-1.0f, 1.0f), random(-1.0f, 1.0f)};
        if (d.length() > 0.1 && d.length() < 1.0) return d;
    }
}

inline float4 lodSample(const samplerCUBE& s, const Direction& d, float lod = 0.0f)
{
    return texCUBElod(s, float4(toLanes(d), Float(lod)));
}

inline double maxDifference(const float4& a, const float4& b)
{
    double worst = 0.0;
    for (int c = 0; c < 4; ++c)
        worst = std::fmax(worst, std::abs(static_cast<double>(a[c][0]) - static_cast<double>(b[c][0])));
    return worst;
}

}  // namespace cube_fixture
