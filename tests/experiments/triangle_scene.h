// Triangles at random places of a square target, with corners on whole 1/256 of a pixel: what tile sizes, lanes and
// threads are tried on. And which pixels they cover, by exact integers, pixel by pixel.
#pragma once

#include <algorithm>
#include <array>
#include <random>

#include "relief/hlsl/derivatives.h"
#include "relief/hlsl/intrinsics.h"
#include "small_frame.h"

namespace relief::experiments {

inline constexpr int kSceneSize = 512;  // pixels, a power of two: positions stay exact

struct TriangleScene
{
    using Corners = std::array<std::array<std::int64_t, 2>, 3>;  // 24.8 fixed point
    std::vector<Corners> triangles;
    Mesh mesh;  // in clip space; w = 1

    // So many triangles in boxes of `size` pixels, over the upper left `part` of the target.
    TriangleScene(int count, int size, double part = 1.0)
    {
        std::mt19937 random(27);
        const auto below = [&random](int limit) { return static_cast<int>(random() % static_cast<unsigned>(limit)); };
        const int room = static_cast<int>(part * (kSceneSize - size));
        mesh.name = "triangles";
        for (int i = 0; i < count; ++i) {
            Corners& corners = triangles.emplace_back();
            const int left = below(room * 256 + 1), top = below(room * 256 + 1);
            const float z = static_cast<float>(below(4096)) / 4096.0f;
            for (auto& corner : corners) {
                corner = {left + below(size * 256 + 1), top + below(size * 256 + 1)};
                const float scale = 2.0f / (256.0f * kSceneSize);
                mesh.positions.push_back(
                    {static_cast<float>(corner[0]) * scale - 1.0f, 1.0f - static_cast<float>(corner[1]) * scale, z});
                mesh.normals.push_back({0.0f, 0.0f, -1.0f});
                mesh.uvs.push_back({static_cast<float>(below(256)) / 16.0f, static_cast<float>(below(256)) / 16.0f});
                mesh.indices.push_back(static_cast<std::uint32_t>(mesh.indices.size()));
            }
        }
    }

    // How many triangles cover each pixel: its centre is inside, or on a top or left edge. Worked out when first asked.
    const std::vector<int>& coverage() const
    {
        if (counts.empty()) count();
        return counts;
    }

private:
    void count() const
    {
        counts.assign(static_cast<std::size_t>(kSceneSize) * kSceneSize, 0);
        for (Corners c : triangles) {
            const auto edge = [](const auto& p, const auto& q, std::int64_t x, std::int64_t y) {
                return (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]);
            };
            const std::int64_t area = edge(c[0], c[1], c[2][0], c[2][1]);
            if (area == 0) continue;
            if (area < 0) std::swap(c[1], c[2]);
            for (std::int64_t y = std::min({c[0][1], c[1][1], c[2][1]}) / 256; y < kSceneSize; ++y) {
                if (y * 256 > std::max({c[0][1], c[1][1], c[2][1]})) break;
                for (std::int64_t x = std::min({c[0][0], c[1][0], c[2][0]}) / 256; x < kSceneSize; ++x) {
                    if (x * 256 > std::max({c[0][0], c[1][0], c[2][0]})) break;
                    bool inside = true;
                    for (std::size_t k = 0; k < 3; ++k) {
                        const auto &p = c[k], &q = c[(k + 1) % 3];
                        const std::int64_t e = edge(p, q, x * 256 + 128, y * 256 + 128), dx = q[0] - p[0],
                                           dy = q[1] - p[1];
                        inside = inside && (e > 0 || (e == 0 && (dy < 0 || (dy == 0 && dx > 0))));
                    }
                    counts[static_cast<std::size_t>(y * kSceneSize + x)] += inside;
                }
            }
        }
    }

    mutable std::vector<int> counts;
};

namespace scene {

struct VertexData
{
    POSITION position;
    TEXCOORD<0, float2> uv;
};
struct Interpolators
{
    SV_POSITION position;
    TEXCOORD<0, float2> uv;
};

struct Place
{
    Interpolators operator()(VertexData v) const { return {.position = float4(v.position.xyz(), 1.0f), .uv = v.uv}; }
};

// Stripes that are as wide on screen wherever they are: they need their neighbours.
struct Stripes
{
    float4 operator()(Interpolators i) const
    {
        const Float change = abs(ddx(i.uv.x)) + abs(ddy(i.uv.x)) + 1e-6f;
        const Float stripe = saturate(abs(frac(i.uv.x) - 0.5f) / change);
        const float3 normal = normalize(float3(i.uv.x, i.uv.y, 4.0f));
        return float4(normal * (0.25f + 0.75f * stripe), 0.5f);
    }
};
struct One
{
    float4 operator()(Interpolators) const { return float4(1.0f); }
};

inline constexpr RenderState kSolid = {.cull = Cull::none};
inline constexpr RenderState kCounted = {
    .depthTest = Compare::always, .depthWrite = false, .cull = Cull::none, .blend = Blend::additive};

}  // namespace scene

// A frame of striped triangles, or one that counts how many cover each pixel.
inline std::shared_ptr<SmallFrame> framed(const TriangleScene& triangles, const FrameOptions& options, bool counts)
{
    const auto f = smallFrame(kSceneSize, kSceneSize, Format::rgba32f, options);
    f->frame.clear({0, 0, 0, 0});
    if (counts)
        f->frame.draw(triangles.mesh, scene::Place{}, scene::One{}, scene::kCounted);
    else
        f->frame.draw(triangles.mesh, scene::Place{}, scene::Stripes{}, scene::kSolid);
    return f;
}

// By how many triangles the pixels of a frame that counts differ from exact coverage.
inline Error coverageError(const TriangleScene& triangles, const FrameOptions& options)
{
    const auto f = framed(triangles, options, true);
    f->frame.run();
    const std::vector<int>& exact = triangles.coverage();
    ErrorSum sum;
    for (std::size_t i = 0; i < exact.size(); ++i) sum.add(static_cast<double>(f->target.color32f()[i].x) - exact[i]);
    return sum.result();
}

}  // namespace relief::experiments
