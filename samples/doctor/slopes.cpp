#include "doctor/slopes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace relief::samples::doctor {

namespace {

using Plane = std::vector<float>;

double dot(const Plane& a, const Plane& b)
{
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

void removeMean(Plane& plane)
{
    const auto mean =
        static_cast<float>(std::accumulate(plane.begin(), plane.end(), 0.0) / static_cast<double>(plane.size()));
    for (float& value : plane) value -= mean;
}

// Minus the divergence of the gradient, both by forward and backward differences: symmetric, positive but for the mean.
void laplacian(const Plane& h, int width, int height, Plane& to)
{
    for (int y = 0; y < height; ++y) {
        const float* row = &h[static_cast<std::size_t>(y) * static_cast<std::size_t>(width)];
        const float* below = &h[static_cast<std::size_t>((y + height - 1) % height) * static_cast<std::size_t>(width)];
        const float* above = &h[static_cast<std::size_t>((y + 1) % height) * static_cast<std::size_t>(width)];
        float* out = &to[static_cast<std::size_t>(y) * static_cast<std::size_t>(width)];
        const auto at = [&](int x, int left, int right) {
            return 4.0f * row[x] - row[left] - row[right] - below[x] - above[x];
        };
        const int last = width - 1;
        out[0] = at(0, last, std::min(1, last));
        for (int x = 1; x < last; ++x) out[x] = at(x, x - 1, x + 1);
        out[last] = at(last, std::max(last - 1, 0), 0);
    }
}

// Slopes at a texel stand for the differences on both sides of it.
Plane minusDivergence(const Slopes& s)
{
    Plane result(s.u.size());
    for (int y = 0; y < s.height; ++y) {
        for (int x = 0; x < s.width; ++x) {
            result[s.at(x, y)] =
                -0.5f * (s.u[s.at(x + 1, y)] - s.u[s.at(x - 1, y)] + s.v[s.at(x, y + 1)] - s.v[s.at(x, y - 1)]);
        }
    }
    removeMean(result);
    return result;
}

// Makes h better: at most `steps` of conjugate gradients towards laplacian(h) = wanted.
void improve(Plane& h, const Plane& wanted, int width, int height, int steps)
{
    Plane residual(h.size()), along(h.size()), applied(h.size());
    laplacian(h, width, height, applied);
    for (std::size_t i = 0; i < h.size(); ++i) residual[i] = wanted[i] - applied[i];
    removeMean(residual);
    along = residual;
    double square = dot(residual, residual);
    const double enough = 1e-10 * std::max(dot(wanted, wanted), 1e-30);
    for (int step = 0; step < steps && square > enough; ++step) {
        laplacian(along, width, height, applied);
        const double curvature = dot(along, applied);
        if (!(curvature > 0.0)) break;
        const auto far = static_cast<float>(square / curvature);
        for (std::size_t i = 0; i < h.size(); ++i) {
            h[i] += far * along[i];
            residual[i] -= far * applied[i];
        }
        const double next = dot(residual, residual);
        const auto keep = static_cast<float>(next / square);
        for (std::size_t i = 0; i < h.size(); ++i) along[i] = residual[i] + keep * along[i];
        square = next;
    }
    removeMean(h);
}

// Means of 2x2 texels: slopes stay what they are, in coarser texels a coarser texel.
Slopes coarser(const Slopes& s)
{
    Slopes half{s.width / 2, s.height / 2, {}, {}};
    half.u.resize(static_cast<std::size_t>(half.width) * static_cast<std::size_t>(half.height));
    half.v.resize(half.u.size());
    for (int y = 0; y < half.height; ++y) {
        for (int x = 0; x < half.width; ++x) {
            const std::size_t i[4] = {s.at(2 * x, 2 * y), s.at(2 * x + 1, 2 * y), s.at(2 * x, 2 * y + 1),
                                      s.at(2 * x + 1, 2 * y + 1)};
            half.u[half.at(x, y)] = 0.25f * (s.u[i[0]] + s.u[i[1]] + s.u[i[2]] + s.u[i[3]]);
            half.v[half.at(x, y)] = 0.25f * (s.v[i[0]] + s.v[i[1]] + s.v[i[2]] + s.v[i[3]]);
        }
    }
    return half;
}

Plane heightsFrom(const Slopes& s)
{
    Plane h(s.u.size(), 0.0f);
    const bool isCoarsest = s.width % 2 != 0 || s.height % 2 != 0 || std::min(s.width, s.height) <= 8;
    if (!isCoarsest) {
        const Slopes half = coarser(s);
        const Plane of = heightsFrom(half);
        for (int y = 0; y < s.height; ++y) {
            for (int x = 0; x < s.width; ++x) {
                // Bilinear, a coarse texel's centre between its four; twice as high in finer texels.
                const int x0 = (x + 1) / 2 - 1, y0 = (y + 1) / 2 - 1;
                const float fx = x % 2 == 0 ? 0.75f : 0.25f, fy = y % 2 == 0 ? 0.75f : 0.25f;
                const float lower = of[half.at(x0, y0)] * (1 - fx) + of[half.at(x0 + 1, y0)] * fx;
                const float upper = of[half.at(x0, y0 + 1)] * (1 - fx) + of[half.at(x0 + 1, y0 + 1)] * fx;
                h[s.at(x, y)] = 2.0f * (lower * (1 - fy) + upper * fy);
            }
        }
    }
    improve(h, minusDivergence(s), s.width, s.height, isCoarsest ? 400 : 60);
    return h;
}

}  // namespace

Slopes slopesOf(const NormalField& field)
{
    Slopes slopes{field.width, field.height, {}, {}};
    slopes.u.reserve(field.normals.size());
    slopes.v.reserve(field.normals.size());
    for (const Vector& n : field.normals) {
        const float z = std::max(n[2], 1e-3f);
        slopes.u.push_back(std::clamp(-n[0] / z, -kSteepest, kSteepest));
        slopes.v.push_back(std::clamp(-n[1] / z, -kSteepest, kSteepest));
    }
    return slopes;
}

Slopes slopesOfHeights(const Channels& heights, float scale)
{
    Slopes slopes{heights.width, heights.height, {}, {}};
    for (int y = 0; y < heights.height; ++y) {
        for (int x = 0; x < heights.width; ++x) {
            const auto h = [&](int i, int j) { return heights.texels[heights.at(i, j)][0]; };
            slopes.u.push_back((h(x + 1, y) - h(x - 1, y)) * 0.5f * scale);
            slopes.v.push_back((h(x, y + 1) - h(x, y - 1)) * 0.5f * scale);
        }
    }
    return slopes;
}

double curlCorrelation(const Slopes& s)
{
    Plane across(s.u.size()), along(s.u.size());
    // Not at the sides: whether the picture goes on there is another question.
    for (int y = 1; y + 1 < s.height; ++y) {
        for (int x = 1; x + 1 < s.width; ++x) {
            across[s.at(x, y)] = s.u[s.at(x, y + 1)] - s.u[s.at(x, y - 1)];
            along[s.at(x, y)] = s.v[s.at(x + 1, y)] - s.v[s.at(x - 1, y)];
        }
    }
    return fit(across, along).correlation;
}

Fit fit(std::span<const float> of, std::span<const float> to)
{
    double ab = 0.0, aa = 0.0, bb = 0.0;
    for (std::size_t i = 0; i < of.size(); ++i) {
        const double a = of[i], b = to[i];
        ab += a * b;
        aa += a * a;
        bb += b * b;
    }
    if (aa < 1e-12 || bb < 1e-12) return {};
    return {ab / aa, ab / std::sqrt(aa * bb)};
}

Heights integrate(const Slopes& slopes)
{
    Heights heights{slopes.width, slopes.height, heightsFrom(slopes), 0.0, 0.0};
    const Plane& h = heights.values;
    double missed = 0.0, all = 0.0;
    // What a slope on average says of the difference to the next texel.
    for (int y = 0; y < slopes.height; ++y) {
        for (int x = 0; x < slopes.width; ++x) {
            const std::size_t i = slopes.at(x, y), right = slopes.at(x + 1, y), above = slopes.at(x, y + 1);
            const double u = 0.5 * (slopes.u[i] + slopes.u[right]), v = 0.5 * (slopes.v[i] + slopes.v[above]);
            const double du = u - (h[right] - h[i]), dv = v - (h[above] - h[i]);
            missed += du * du + dv * dv;
            all += u * u + v * v;
        }
    }
    heights.residual = all > 0.0 ? std::min(1.0, missed / all) : 0.0;
    const auto [low, high] = std::minmax_element(h.begin(), h.end());
    heights.range = static_cast<double>(*high) - static_cast<double>(*low);
    return heights;
}

Strength strengthOf(const Slopes& slopes)
{
    Strength strength;
    std::vector<float> squares(slopes.u.size());
    for (std::size_t i = 0; i < squares.size(); ++i) {
        squares[i] = slopes.u[i] * slopes.u[i] + slopes.v[i] * slopes.v[i];
        strength.rootMeanSquare += squares[i];
        strength.meanDegrees += std::atan(std::sqrt(squares[i]));
    }
    const auto count = static_cast<double>(squares.size());
    constexpr double degree = std::numbers::pi / 180.0;
    strength.rootMeanSquare = std::sqrt(strength.rootMeanSquare / count / 2.0);
    strength.meanDegrees /= count * degree;
    const auto most = squares.begin() + static_cast<std::ptrdiff_t>(count * 0.999);
    std::nth_element(squares.begin(), most, squares.end());
    strength.mostDegrees = std::atan(std::sqrt(*most)) / degree;
    return strength;
}

}  // namespace relief::samples::doctor
