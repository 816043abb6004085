// Light from all around, made ready for shaders: what a rough surface reflects of it, as the levels of a cube map, and
// what a matte one does, as spherical harmonics. In goes a cube map of radiance (linear), texture/cube_map.h.
//
// A level holds, for every direction n, the mean of the radiance over the directions l that GGX spreads around n, with
// the weights D(h) n.l, h half-way between n and l: reflection seen from straight above, n = v = r (Karis 2013). Seen
// at a grazing angle a highlight is longer than that, which no cube map of one direction can hold.
//
//   const Expected<ImageFloat> picture = prefilteredEnvironment(radiance, {.side = 128});
//   const CubeMap map = *CubeMap::fromPicture(*picture, ColorSpace::linear);
//   texCUBElod(s, float4(reflected, levelOfRoughness(perceptualRoughness, map.levelCount())))
#pragma once

#include <functional>

#include "relief/shading/lights.h"
#include "relief/texture/cube_sampler.h"

namespace relief {

inline constexpr int kLeastPrefilteredSide = 8;   // two levels
inline constexpr int kMaxPrefilteredSide = 2048;  // six of them beside each other are an image file
inline constexpr int kLeastPrefilterSamples = 2, kMaxPrefilterSamples = 65536;

struct PrefilterSettings
{
    int side = 128;      // of level 0, kLeastPrefilteredSide..kMaxPrefilteredSide
    int samples = 1024;  // directions for each texel, kLeastPrefilterSamples..kMaxPrefilterSamples
};

// The levels of such a chain: from `side` down to the last of at least 4 texels. The roughest one is smooth, and 4
// texels hold it; fewer could not.
int prefilteredLevelCount(int side);

// The perceptual roughness (1 - smoothness; the roughness of GGX is its square) that level k of so many is for, by
// Unity's curve: level = roughness (1.7 - 0.7 roughness) (levels - 1). Level 0 is 0, a mirror; the last one is 1.
float roughnessOfLevel(int k, int levels);

// Its inverse: the level for a roughness, which is taken into 0..1.
inline namespace RELIEF_WIDTH {
inline Float levelOfRoughness(Float perceptualRoughness, int levels)
{
    const Float r = saturate(perceptualRoughness);
    return r * (1.7f - 0.7f * r) * static_cast<float>(levels - 1);
}
}  // namespace RELIEF_WIDTH

// Runs function(task) for task = 0..tasks - 1, in any order and by any number of threads: results do not depend on it.
using RunTasks = std::function<void(int tasks, const std::function<void(int task)>& function)>;
void runInTurn(int tasks, const std::function<void(int task)>& function);

// The levels as one picture that CubeMap::fromPicture takes: strips of six faces, below each other. `radiance` should
// have all its levels: a sample looks at the one whose texels cover as much as the sample stands for, so that a small
// bright light becomes a highlight and not a few specks (Krivanek and Colbert 2008). Equal radiance everywhere gives
// exactly itself. An error when a setting is out of its range or the picture does not fit into memory.
Expected<ImageFloat> prefilteredEnvironment(const CubeMap& radiance, const PrefilterSettings& settings,
                                            const RunTasks& run = runInTurn);

// Whether a cube map is such a chain: its levels end where these do, and every other cube map's go down to one texel.
bool isPrefiltered(const CubeMap& map);

// The light that arrives at a matte surface, for ShadeSH9: irradiance / pi, so that equal radiance everywhere gives
// itself. From the texels of level 0, each weighted by its solid angle. Nine coefficients hold it to about 1 % for
// natural light (Ramamoorthi and Hanrahan 2001); a single bright light is too broad, and rings.
SphericalHarmonics irradianceOf(const CubeMap& radiance);

}  // namespace relief
