#include "common/baked_sphere.h"

#include <cstdio>

#include "relief/lanes/math.h"
#include "relief/mesh/bake_error.h"
#include "relief/mesh/displace.h"
#include "relief/mesh/primitives.h"
#include "relief/mesh/tangents.h"
#include "relief/texture/import.h"

namespace relief::samples {

namespace {

// Knobs in rows, 0 ... 1, and smooth where u begins again.
float knobs(float u, float v)
{
    constexpr float kTwoPi = 6.283185307f;
    return 0.5f + 0.5f * sin(kTwoPi * 12.0f * u) * sin(kTwoPi * 6.0f * v);
}

// The shapes are ours, and fit: what could go wrong with a user's meshes cannot go wrong here.
template <class Value>
Value sure(Expected<Value> value)
{
    return std::move(*value);
}

std::string measurement(const char* name, const BakedNormalMap& map, const Mesh& mesh, bool orthonormalise)
{
    const DecodeOptions options = {.binormal = BinormalAt::fragment, .orthonormalise = orthonormalise};
    const AngleError exact = sure(bakeError(map, mesh, options));
    const AngleError rounded = sure(bakeError(roundedTo8Bits(map), mesh, options));
    char line[160];
    std::snprintf(line, sizeof line, "%-17s mean %.4f, max %.4f degrees; in 8 bits mean %.4f, max %.4f (%zu texels)",
                  name, exact.mean, exact.max, rounded.mean, rounded.max, exact.texels);
    return line;
}

BakedSphere bake()
{
    const Mesh plain = makeSphere(12, 6);
    Mesh high = sure(withTangents(sure(displaced(makeSphere(256, 128), knobs, 0.02f))));
    Mesh low = sure(withTangents(plain));
    const BakeOptions options = {.width = 256, .height = 256, .binormal = BinormalAt::fragment};
    const BakedNormalMap map = sure(bakeNormalMap(low, high, options));
    std::vector<std::string> measured = {measurement("synched:", map, low, false),
                                         measurement("other tangents:", map, plain, false),
                                         measurement("renormalised:", map, low, true)};

    const ImportSettings settings = {.kind = ImportSettings::Kind::normalMap,
                                     .storage = ImportSettings::Storage::dxt5nm,
                                     .fromGreyscale = ImportSettings::FromGreyscale::no};
    Texture texture = sure(importTexture(ImageFile(ImageFloat{map.width, map.height, rgbaOf(map)}), settings));
    return {std::move(high), std::move(low), plain, std::move(texture), std::move(measured)};
}

}  // namespace

const BakedSphere& bakedSphere()
{
    static const BakedSphere sphere = bake();
    return sphere;
}

}  // namespace relief::samples
