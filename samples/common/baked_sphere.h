// What stage 1.23 is about: a coarse sphere, a detailed one over it, and the normal map that is baked from the second
// for the first.
#pragma once

#include <string>
#include <vector>

#include "relief/mesh/mesh.h"
#include "relief/texture/texture.h"

namespace relief::samples {

struct BakedSphere
{
    Mesh high;           // with bumps, 256 x 128 segments
    Mesh low;            // 12 x 6 segments, with MikkTSpace's tangents: the map was baked with these
    Mesh otherTangents;  // the same with tangents along the circles of latitude, each right by itself
    Texture normalMap;   // DXT5nm, for binormals per fragment

    // The angle between what is decoded and the detailed sphere's normal, over all texels: one line per way to decode,
    // with mean and maximum in degrees.
    std::vector<std::string> measured;
};

// Made once per process, in about a fifth of a second.
const BakedSphere& bakedSphere();

}  // namespace relief::samples
