// What a program that is followed says about itself while it runs: the values that its lines give, and the textures
// that it samples. Instrumented sources say it (see.h); who listens decides what becomes of it (pixel_trace.h).
#pragma once

#include <cstdint>
#include <string>

#include "relief/texture/comparison_sampler.h"
#include "relief/texture/cube_sampler.h"
#include "relief/texture/sampler.h"

namespace relief::inline RELIEF_WIDTH::trace {

// A place in a source that gives a value. The texts are literals.
struct Site
{
    const char* file;
    int line;
    const char* function;
    const char* name;  // of what is assigned to; "return"; a parameter
};

enum class ValueKind : std::uint8_t
{
    number,
    integer,
    truth  // 0 or 1
};

// A value of every lane, component by component, a matrix column by column. Integers and truths are bits.
struct LaneValue
{
    ValueKind kind;
    int rows, columns;
    const Float* components;
};

enum class TextureFunction : std::uint8_t
{
    tex2D,
    tex2DWhere,
    tex2Dgrad,
    tex2Dlod,
    tex2Dbias,
    SampleCmp,
    texCUBE,
    texCUBEgrad,
    texCUBElod,
    texCUBEbias
};

// "tex2D", the name in the source.
const char* nameOf(TextureFunction function);

// One sample of a texture, as it was asked for and what it gave.
struct TextureCall
{
    TextureFunction function;
    const sampler2D* texture;                  // of the first five; else null
    const SamplerComparisonState* comparison;  // of SampleCmp, or the next
    const SamplerCubeComparisonState* cubeComparison;
    const samplerCUBE* cube;  // of the last four
    Float coordinate[3];
    Float dx[3], dy[3];  // its change to the next pixel: given, or the quad's differences
    Float extra;         // level, bias, or what is compared
    unsigned lanes;      // that it was asked for, a bit each
    float4 result;
};

class Listener
{
public:
    virtual void enter(const Site& function) = 0;
    virtual void leave() = 0;
    virtual void value(const Site& site, const std::string& field, const LaneValue& value) = 0;  // field: ".dir", or ""
    virtual void sample(const Site& site, const TextureCall& call) = 0;

protected:
    ~Listener() = default;
};

// Who listens to this thread; mostly nobody.
inline constinit thread_local Listener* listener = nullptr;

}  // namespace relief::inline RELIEF_WIDTH::trace
