#include "common/triplanar_methods.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "common/false_color.h"

namespace relief::samples::triplanar {

namespace {

constexpr int kDirections = 64;

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
            for (int i = 0; i < 3; ++i) {
                const Float degrees = degreesBetween(result, truths[i]);
                for (int lane = 0; lane < kLanes; ++lane) {
                    const double d = static_cast<double>(degrees[lane]);
                    error.maximum[i] = std::max(error.maximum[i], d);
                    error.rms[i] += d * d / (kDirections * kDirections);
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
