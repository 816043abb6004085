#include "common/triplanar_methods.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "common/camera.h"

namespace relief::samples::triplanar {

namespace {

constexpr int kDirections = 64;

// Of vectors of any length, in one lane, in degrees; by a form that sees small angles.
double angle(const float3& a, const float3& b, int lane)
{
    const auto unit = [lane](const float3& v) {
        const glm::dvec3 d(static_cast<double>(v.x[lane]), static_cast<double>(v.y[lane]),
                           static_cast<double>(v.z[lane]));
        return d / std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
    };
    const glm::dvec3 p = unit(a), q = unit(b), difference = p - q, sum = p + q;
    const auto length = [](const glm::dvec3& v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); };
    return 2.0 * std::atan2(length(difference), length(sum)) * 57.295779513082321;
}

template <class Method>
MethodError errorOf(Method method, float tilt, float slope)
{
    MethodError error = {Method::kName, {0, 0, 0}, {0, 0, 0}};
    const float step = 6.2831853f / kDirections;
    for (int a = 0; a < kDirections; ++a) {
        const Float around = static_cast<float>(a) * step, t = tilt * kDegree;
        const float3 surface = {sin(t) * cos(around), sin(t) * sin(around), cos(t)};
        for (int b = 0; b < kDirections; b += kLanes) {
            Float direction;
            for (int lane = 0; lane < kLanes; ++lane) direction.set(lane, static_cast<float>(b + lane) * step);
            const float3 bump = normalize(float3(-slope * cos(direction), -slope * sin(direction), 1.0f));
            const float3 result = method(surface, bump);
            const float3 truths[3] = {AlongProjection()(surface, bump), AlongNormal()(surface, bump),
                                      Rotated()(surface, bump)};
            for (int lane = 0; lane < kLanes; ++lane) {
                for (int i = 0; i < 3; ++i) {
                    const double degrees = angle(result, truths[i], lane);
                    error.maximum[i] = std::max(error.maximum[i], degrees);
                    error.rms[i] += degrees * degrees / (kDirections * kDirections);
                }
            }
        }
    }
    for (double& r : error.rms) r = std::sqrt(r);
    return error;
}

}  // namespace

std::vector<MethodError> triplanarErrors(float tilt, float slope)
{
    return {errorOf(Swizzle(), tilt, slope),           errorOf(Udn(), tilt, slope),
            errorOf(GpuGems3(), tilt, slope),          errorOf(Whiteout(), tilt, slope),
            errorOf(Reoriented(), tilt, slope),        errorOf(CotangentFrame(), tilt, slope),
            errorOf(CrossProducts(), tilt, slope),     errorOf(Derivatives(), tilt, slope),
            errorOf(CotangentGradients(), tilt, slope)};
}

std::string formatted(const MethodError& e)
{
    char line[160];
    std::snprintf(line, sizeof line, "%-20s projection %8.4f %8.4f   normal %8.4f %8.4f   rotation %8.4f %8.4f",
                  e.method.c_str(), e.maximum[0], e.rms[0], e.maximum[1], e.rms[1], e.maximum[2], e.rms[2]);
    return line;
}

}  // namespace relief::samples::triplanar
