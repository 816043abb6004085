// What texture filters are tried on: a zone plate face on and a checkered plane that is tilted away, and what their
// pixels show exactly, by supersampling and by an elliptically weighted average.
#pragma once

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "relief/texture/sampler.h"

namespace relief::experiments {

inline constexpr int kSide = 256;
inline constexpr double kPi = std::numbers::pi;

// Red is a zone plate, rings up to half a cycle per texel at the edge; green a checkerboard of 8x8 texels.
struct Patterns
{
    Texture texture;
    std::vector<double> values[2];

    Patterns() : texture(*Texture::fromRgba8(kSide, kSide, pixels(), ColorSpace::linear))
    {
        for (int y = 0; y < kSide; ++y) {
            for (int x = 0; x < kSide; ++x) {
                for (int c = 0; c < 2; ++c) values[c].push_back(static_cast<double>(texture.texel(x, y)[c]));
            }
        }
    }
    static std::vector<std::uint8_t> pixels()
    {
        std::vector<std::uint8_t> all;
        for (int y = 0; y < kSide; ++y) {
            for (int x = 0; x < kSide; ++x) {
                const double dx = x - 127.5, dy = y - 127.5,
                             rings = 0.5 + 0.5 * std::cos(kPi * (dx * dx + dy * dy) / 256);
                all.insert(all.end(), {static_cast<std::uint8_t>(rings * 255.0 + 0.5),
                                       static_cast<std::uint8_t>(((x ^ y) & 8) != 0 ? 255 : 0), 0, 255});
            }
        }
        return all;
    }
    double texel(int channel, int x, int y) const
    {
        return values[channel][static_cast<std::size_t>((y & (kSide - 1)) * kSide + (x & (kSide - 1)))];
    }
    double bilinear(int channel, double u, double v) const
    {
        const double x = std::floor(u - 0.5), y = std::floor(v - 0.5), fx = u - 0.5 - x, fy = v - 0.5 - y;
        const int i = static_cast<int>(x), j = static_cast<int>(y);
        return (texel(channel, i, j) * (1 - fx) + texel(channel, i + 1, j) * fx) * (1 - fy) +
               (texel(channel, i, j + 1) * (1 - fx) + texel(channel, i + 1, j + 1) * fx) * fy;
    }
};

inline const Patterns& patterns()
{
    static const Patterns all;
    return all;
}

// What a pixel sees: the zone plate face on, or the plane under a tilt, each at several minifications.
struct View
{
    int channel = 0;
    double texels = 1.0;  // per pixel, across
    double tilt = 0.0;    // radians
    double x = 0.0, y = 0.0, u = 0.0, v = 0.0;

    struct Point
    {
        double u, v;
    };
    Point operator()(double dx, double dy) const  // from the pixel's centre
    {
        constexpr double focalLength = 2000.0;  // pixels
        const double px = (x + dx) / focalLength, py = (y + dy) / focalLength, c = std::cos(tilt), s = std::sin(tilt);
        const double t = c / (py * s + c), across = t * px, along = t * py * c - (t - 1.0) * s;
        return {u + across * focalLength * texels, v + along * focalLength * texels};
    }
};

inline constexpr const char* kScenes[] = {"zone plate", "60 degrees", "80 degrees", "88 degrees", "89.5 degrees"};
inline constexpr double kTilts[] = {0.0, 60.0, 80.0, 88.0, 89.5};

// Pixels in blocks of 4x4, quad by quad; every scene in turn.
inline std::vector<View> views(std::size_t count)
{
    constexpr double zoneTexels[] = {1.0, 2.5, 6.0, 15.0, 32.0, 64.0}, planeTexels[] = {2.0, 3.0, 4.0};
    std::vector<View> all;
    std::mt19937 random(3);
    const auto between = [&random](double low, double high) { return low + (high - low) * uniform(random); };
    for (std::size_t block = 0; all.size() < count; ++block) {
        View corner;
        const std::size_t scene = block % 5, turn = block / 5;
        corner.channel = scene == 0 ? 0 : 1;
        corner.texels = scene == 0 ? zoneTexels[turn % 6] : planeTexels[turn % 3];
        corner.tilt = kTilts[scene] * kPi / 180.0;
        corner.x = between(-100.0, 100.0);
        corner.y = between(-8.0, 8.0);
        corner.u = between(0.0, kSide);
        corner.v = between(0.0, kSide);
        for (int i = 0; i < 16; ++i) {
            View pixel = corner;
            pixel.x += i % 2 + i / 4 % 2 * 2;
            pixel.y += i / 2 % 2 + i / 8 * 2;
            all.push_back(pixel);
        }
    }
    return all;
}

// The mean of level 0 over the square of the pixel: n x n samples, each somewhere in its own cell.
inline double supersampled(const View& view, int n, std::mt19937& random)
{
    double sum = 0.0;
    for (int i = 0; i < n * n; ++i) {
        const double jx = uniform(random), jy = uniform(random);
        const View::Point p = view((i % n + jx) / n - 0.5, (i / n + jy) / n - 0.5);
        sum += patterns().bilinear(view.channel, p.u, p.v);
    }
    return sum / (n * n);
}

// Elliptically weighted average (Heckbert 1989): a Gaussian over the ellipse of texels that a round pixel covers.
inline double ellipticallyWeighted(const View& view)
{
    const View::Point p = view(0, 0), r = view(0.5, 0), l = view(-0.5, 0), d = view(0, 0.5), t = view(0, -0.5);
    const double ux = r.u - l.u, vx = r.v - l.v, uy = d.u - t.u, vy = d.v - t.v;
    const double a = vx * vx + vy * vy + 1.0, b = -2.0 * (ux * vx + uy * vy), c = ux * ux + uy * uy + 1.0;
    const double f = a * c - b * b / 4.0, reachU = std::sqrt(c), reachV = std::sqrt(a);
    double sum = 0.0, weights = 0.0;
    for (int y = static_cast<int>(std::ceil(p.v - 0.5 - reachV)); y <= p.v - 0.5 + reachV; ++y) {
        for (int x = static_cast<int>(std::ceil(p.u - 0.5 - reachU)); x <= p.u - 0.5 + reachU; ++x) {
            const double du = x + 0.5 - p.u, dv = y + 0.5 - p.v, q = (a * du * du + b * du * dv + c * dv * dv) / f;
            if (q > 1.0) continue;
            const double weight = std::exp(-2.0 * q);
            sum += weight * patterns().texel(view.channel, x, y);
            weights += weight;
        }
    }
    return sum / weights;
}

}  // namespace relief::experiments
