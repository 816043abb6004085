// One pixel's sample of a texture, taken apart: the level of detail, the texels, their weights. Put together again by
// recombined() it is the sample's result, bit for bit.
#pragma once

#include <array>
#include <vector>

#include "relief/trace/events.h"

namespace relief::inline RELIEF_WIDTH::trace {

// One texel: where it lies (row 0 is the lowest), and what is stored there. On a cube map's face -1 and the face's side
// are in the frame, which holds the texels of the faces around it (cube_map.h).
struct TexelTrace
{
    int x, y;
    bool isBorder;                       // outside, in border mode: the border's colour
    std::array<std::uint32_t, 4> codes;  // as they are stored: 8 or 16 bits, or a float's bits
    std::array<float, 4> value;          // 0 ... 1, or the float
};

// A filter's work on one mip level.
struct LevelTrace
{
    int level, width, height;
    bool isNearest;                    // one texel, the first
    std::array<TexelTrace, 4> texels;  // lower left, lower right, upper left, upper right
    int weightX, weightY;              // of the right and of the upper ones, in 1/4096
};

// One tap: on one level or between two. Anisotropic filters have up to 16.
struct TapTrace
{
    float u, v;
    std::vector<LevelTrace> levels;
    int between;  // how much of the second level, in 1/256
};

struct SampleTrace
{
    Site site;
    TextureFunction function;
    bool isAsked = true;      // tex2DWhere gives 0 where it is not
    int face = -1;            // of a cube map (kCubeFaceNames); other textures have none
    bool isConstant = false;  // a texture of one texel: no coordinate is looked at
    TexelFormat format = TexelFormat::rgba8;
    int width = 0, height = 0, levelCount = 0;
    Filter filter = Filter::nearest;
    AddressMode addressU = AddressMode::wrap, addressV = AddressMode::wrap;
    std::array<float, 3> coordinate{}, dx{}, dy{};  // of a cube map the direction
    float extra = 0.0f;                             // level, bias, or what is compared
    bool choosesLevel = false;                      // the two below mean something
    float levelOfDetail = 0.0f;                     // before limits
    int fixedLevel = 0;                             // within limits, in 1/256
    float anisotropy = 1.0f;                        // of the footprint
    Compare comparison = Compare::always;
    std::vector<TapTrace> taps;
    std::array<float, 4> result{};
};

// What a call was for one lane.
SampleTrace traceSample(const Site& site, const TextureCall& call, int lane);

// The taps put together again, by the sampler's arithmetic, for one texel at a time.
std::array<float, 4> recombined(const SampleTrace& sample);

}  // namespace relief::inline RELIEF_WIDTH::trace
