// The level of detail and the texels are found by the sampler's own functions (texture/), on lanes; the arithmetic of
// recombined() is written once more, for single numbers, after fetch.h.
#include "relief/trace/sample_trace.h"

#include <algorithm>

#include "relief/bits.h"
#include "relief/hlsl/derivatives.h"
#include "relief/texture/cube_place.h"

namespace relief::inline RELIEF_WIDTH::trace {

const char* nameOf(TextureFunction function)
{
    static constexpr const char* kNames[] = {"tex2D",     "tex2DWhere", "tex2Dgrad",   "tex2Dlod",   "tex2Dbias",
                                             "SampleCmp", "texCUBE",    "texCUBEgrad", "texCUBElod", "texCUBEbias"};
    return kNames[static_cast<std::size_t>(function)];
}

namespace {

std::array<float, 3> laneOf(const Float (&v)[3], int lane)
{
    return {v[0][lane], v[1][lane], v[2][lane]};
}

// What a level has there.
void readTexel(TexelFormat format, const MipLevel& level, int x, int y, TexelTrace& texel)
{
    const auto set = [&](std::size_t c, std::uint32_t code, float value) {
        texel.codes[c] = code;
        texel.value[c] = value;
    };
    for (std::size_t c = 0; c < 4; ++c) {
        if (format == TexelFormat::rgba8) {
            const std::uint8_t code = level.texel<std::uint8_t>(x, y)[c];
            set(c, code, static_cast<float>(code) / 255.0f);
        } else if (format == TexelFormat::rgba16) {
            const std::uint16_t code = level.texel<std::uint16_t>(x, y)[c];
            set(c, code, static_cast<float>(code) / 65535.0f);
        } else {
            const bool isThere = format == TexelFormat::rgba32Float || c == 0;
            const float value = isThere ? level.texel<float>(x, y)[c] : c == 3 ? 1.0f : 0.0f;
            set(c, bitCast<std::uint32_t>(value), value);
        }
    }
}

TexelTrace texelAt(const sampler2D& s, const Texture& texture, const MipLevel& level, int x, int y)
{
    TexelTrace texel{};
    texel.x = x;
    texel.y = y;
    const bool outX = s.u == AddressMode::border && (x < 0 || x >= level.width());
    const bool outY = s.v == AddressMode::border && (y < 0 || y >= level.height());
    if (outX || outY) {
        texel.isBorder = true;
        for (std::size_t c = 0; c < 4; ++c) texel.value[c] = s.borderColor[static_cast<int>(c)];
        return texel;
    }
    // The frame around a level repeats the other side.
    texel.x = (x + level.width()) % level.width();
    texel.y = (y + level.height()) % level.height();
    readTexel(texture.format(), level, x, y, texel);
    return texel;
}

// Positions on a level count its frame (address.h).
LevelTrace levelAt(const sampler2D& s, const Texture& texture, int number, float u, float v)
{
    const MipLevel& level = texture.level(number);
    const Place<AnyModes> place = placeOn<AnyModes>(s, texture, Float(u), Float(v));
    LevelTrace trace{};
    trace.level = number;
    trace.width = level.width();
    trace.height = level.height();
    trace.isNearest = s.filter == Filter::nearest;
    if (trace.isNearest) {
        const int x = nearestPosition(place.modes.u, place.u, level.sideU())[0] - 1;
        const int y = nearestPosition(place.modes.v, place.v, level.sideV())[0] - 1;
        trace.texels[0] = texelAt(s, texture, level, x, y);
        return trace;
    }
    const Pairs at = pairsOn(place, level);
    for (int i = 0; i < 4; ++i)
        trace.texels[static_cast<std::size_t>(i)] =
            texelAt(s, texture, level, at.x[0] - 1 + i % 2, at.y[0] - 1 + i / 2);
    trace.weightX = at.fx[0];
    trace.weightY = at.fy[0];
    return trace;
}

LevelTrace levelAt(const CubePlace& place, int number, int lane)
{
    const CubeMap& texture = place.texture;
    const MipLevel& level = texture.level(number);
    const int side = level.width(), face = place.face[lane];
    LevelTrace trace{};
    trace.level = number;
    trace.width = trace.height = side;
    trace.isNearest = place.sampler.filter == Filter::nearest;
    Pairs at = pairsOn(place, level);
    if (trace.isNearest) {
        at = {nearestPosition(AddressMode::clamp, place.u, level.sideU()),
              nearestPosition(AddressMode::clamp, place.v, level.sideU()), Int(0), Int(0)};
    }
    for (int i = 0; i < (trace.isNearest ? 1 : 4); ++i) {
        TexelTrace& texel = trace.texels[static_cast<std::size_t>(i)];
        texel.x = at.x[lane] - 1 + i % 2;
        texel.y = at.y[lane] - 1 + i / 2;
        readTexel(texture.format(), level, texel.x, CubeMap::rowOf(face, texel.y, side), texel);
    }
    trace.weightX = at.fx[lane];
    trace.weightY = at.fy[lane];
    return trace;
}

// On the levels that sampleMipLevels (filter.h) takes; levelOf(number) tells of one.
template <class LevelAt>
TapTrace tapOn(Filter filter, float u, float v, int lod, const LevelAt& levelOf)
{
    TapTrace tap{u, v, {}, 0};
    if (filter != Filter::trilinear) {
        tap.levels.push_back(levelOf((lod + kLodOne / 2) >> kLodBits));
        return tap;
    }
    const int level = lod >> kLodBits;
    tap.between = lod & (kLodOne - 1);
    tap.levels.push_back(levelOf(level));
    if (tap.between != 0) tap.levels.push_back(levelOf(level + 1));
    return tap;
}

TapTrace tapAt(const sampler2D& s, const Texture& texture, float u, float v, int lod)
{
    return tapOn(s.filter, u, v, lod, [&](int number) { return levelAt(s, texture, number, u, v); });
}

float2 texelsOf(const Texture& texture, const Float (&change)[3])
{
    const glm::vec4& size = texture.texelSize();
    return {change[0] * size.z, change[1] * size.w};
}

void trace2D(const sampler2D& s, const TextureCall& call, int lane, SampleTrace& trace)
{
    const Texture& texture = s.texture != nullptr ? *s.texture : Texture::white();
    const float u = trace.coordinate[0], v = trace.coordinate[1];
    trace.format = texture.format();
    trace.width = texture.width();
    trace.height = texture.height();
    trace.levelCount = texture.levelCount();
    trace.filter = s.filter;
    trace.addressU = s.u;
    trace.addressV = s.v;
    trace.isConstant = texture.isConstant() && !hasBorder(s);
    if (!trace.isAsked) return;
    if (trace.isConstant || !s.mipmaps || texture.levelCount() == 1) {
        trace.taps.push_back(tapAt(s, texture, u, v, 0));
        return;
    }
    trace.choosesLevel = true;
    const bool isGiven = call.function == TextureFunction::tex2Dlod;
    const Float bias = call.function == TextureFunction::tex2Dbias ? call.extra : Float(0.0f);
    const float2 dX = texelsOf(texture, call.dx), dY = texelsOf(texture, call.dy);
    const Float lod = isGiven ? call.extra : limitedIsotropicLevel(longestSquare(dX, dY));
    if (isAnisotropic(s) && !isGiven) {
        const AnisotropicFootprint footprint =
            anisotropicFootprint(dX, dY, static_cast<float>(std::min(s.maxAnisotropy, 16)));
        trace.levelOfDetail = (footprint.lod + limitBias(s, bias))[lane];
        trace.fixedLevel = fixedLevel(s, texture.levelCount(), footprint.lod + limitBias(s, bias))[lane];
        trace.anisotropy = footprint.ratio[lane];
        const int taps = static_cast<int>(footprint.taps[lane]);
        const glm::vec4& size = texture.texelSize();
        const float2 axis = {footprint.axis.x * size.x, footprint.axis.y * size.y};
        const Float perTap = 0.5f / footprint.taps;
        for (int i = 0; i < taps; ++i) {
            const Float along = (static_cast<float>(2 * i + 1) - footprint.taps) * perTap;
            const Float tapU = call.coordinate[0] + axis.x * along, tapV = call.coordinate[1] + axis.y * along;
            trace.taps.push_back(tapAt(s, texture, tapU[lane], tapV[lane], trace.fixedLevel));
        }
        return;
    }
    trace.levelOfDetail = (lod + limitBias(s, bias))[lane];
    trace.fixedLevel = fixedLevel(s, texture.levelCount(), lod + limitBias(s, bias))[lane];
    trace.taps.push_back(tapAt(s, texture, u, v, trace.fixedLevel));
}

float3 vectorOf(const Float (&v)[3])
{
    return {v[0], v[1], v[2]};
}

void traceCube(const samplerCUBE& s, const TextureCall& call, int lane, SampleTrace& trace)
{
    const CubeMap& texture = textureOf(s);
    const float3 direction = finiteDirection(vectorOf(call.coordinate));
    const Meeting at(direction);
    const CubePlace place = placeOn(s, texture, at);
    trace.face = place.face[lane];
    trace.format = texture.format();
    trace.width = trace.height = texture.side();
    trace.levelCount = texture.levelCount();
    trace.filter = s.filter;
    if (usesMipLevels(s, texture)) {
        const bool isGiven = call.function == TextureFunction::texCUBElod;
        const bool hasChange = call.function == TextureFunction::texCUBEgrad;
        const float3 dx = hasChange ? vectorOf(call.dx) : ddx(direction);
        const float3 dy = hasChange ? vectorOf(call.dy) : ddy(direction);
        const Float bias = call.function == TextureFunction::texCUBEbias ? call.extra : Float(0.0f);
        const Float lod = isGiven ? call.extra + limitBias(s, 0.0f)
                                  : limitedIsotropicLevel(squareOfChange(texture, at, dx, dy)) + limitBias(s, bias);
        trace.choosesLevel = true;
        trace.levelOfDetail = lod[lane];
        trace.fixedLevel = fixedLevel(s, texture.levelCount(), lod)[lane];
    }
    trace.taps.push_back(tapOn(s.filter, place.u[lane], place.v[lane], trace.fixedLevel,
                               [&](int number) { return levelAt(place, number, lane); }));
}

// What SampleCmp compares: one texture, or one for each face of a cube.
void traceComparison(const SamplerComparisonState& s, const TextureCall& call, int lane, SampleTrace& trace)
{
    sampler2D plain = {.texture = s.texture, .filter = Filter::bilinear, .u = s.u, .v = s.v, .mipmaps = false};
    plain.borderColor = glm::vec4(s.border);
    trace.comparison = s.comparison;
    trace2D(plain, call, lane, trace);
}

void traceComparison(const SamplerCubeComparisonState& s, const TextureCall& call, int lane, SampleTrace& trace)
{
    const CubeFaceOf at(vectorOf(call.coordinate));
    const float3 along = at.components(vectorOf(call.coordinate));
    TextureCall onFace = call;
    onFace.coordinate[0] = along.x / along.z * 0.5f + 0.5f;
    onFace.coordinate[1] = along.y / along.z * 0.5f + 0.5f;
    trace.face = at.face()[lane];
    const std::array<float, 3> direction = trace.coordinate;
    trace.coordinate = laneOf(onFace.coordinate, lane);
    traceComparison(
        {s.faces[static_cast<std::size_t>(trace.face)], s.comparison, AddressMode::clamp, AddressMode::clamp}, onFace,
        lane, trace);
    trace.coordinate = direction;
}

// --- the arithmetic of fetch.h, for one channel of one pixel ---

float mixed(float a, float b, float t, TexelFormat format)
{
    const bool isFloat = format == TexelFormat::rgba32Float || format == TexelFormat::r32Float;
    return isFloat && t == 0.0f ? a : a + (b - a) * t;
}

// In the units that the filters mix in (Fetch::kOne).
float rawOf(const TexelTrace& texel, std::size_t c, TexelFormat format)
{
    if (format == TexelFormat::rgba8)
        return texel.isBorder ? texel.value[c] * (255.0f * kSubtexels)
                              : static_cast<float>(texel.codes[c] * kSubtexels);
    if (format == TexelFormat::rgba16)
        return texel.isBorder ? texel.value[c] * 65535.0f : static_cast<float>(texel.codes[c]);
    return texel.value[c];
}

float levelValue(const SampleTrace& sample, const LevelTrace& level, std::size_t c)
{
    const TexelFormat format = sample.format;
    const auto raw = [&](std::size_t i) { return rawOf(level.texels[i], c, format); };
    if (level.isNearest) return raw(0);
    const float tx = static_cast<float>(level.weightX) * (1.0f / kSubtexels);
    const float ty = static_cast<float>(level.weightY) * (1.0f / kSubtexels);
    const bool mayBeBorder = sample.addressU == AddressMode::border || sample.addressV == AddressMode::border;
    if (format == TexelFormat::rgba8 && !mayBeBorder) {
        // Along the rows in integers.
        const auto along = [&](std::size_t left) {
            return static_cast<int>(level.texels[left].codes[c]) * (kSubtexels - level.weightX) +
                   static_cast<int>(level.texels[left + 1].codes[c]) * level.weightX;
        };
        return static_cast<float>(along(0)) + static_cast<float>(along(2) - along(0)) * ty;
    }
    return mixed(mixed(raw(0), raw(1), tx, format), mixed(raw(2), raw(3), tx, format), ty, format);
}

float toUnit(float raw, TexelFormat format)
{
    if (format == TexelFormat::rgba8)
        return raw * (1.0f / (256.0f * kSubtexels)) + raw * (1.0f / (65280.0f * kSubtexels));
    if (format == TexelFormat::rgba16) return raw * (1.0f / 65536.0f) + raw * (1.0f / (65536.0f * 65535.0f));
    return raw;
}

float tapValue(const SampleTrace& sample, const TapTrace& tap, std::size_t c)
{
    float value = levelValue(sample, tap.levels[0], c);
    if (tap.levels.size() > 1)
        value = mixed(value, levelValue(sample, tap.levels[1], c), static_cast<float>(tap.between) * (1.0f / kLodOne),
                      sample.format);
    return toUnit(value, sample.format);
}

float comparedValue(const SampleTrace& sample)
{
    const LevelTrace& level = sample.taps[0].levels[0];
    const auto passes = [&](std::size_t i) {
        const float texel = toUnit(rawOf(level.texels[i], 0, sample.format), sample.format);
        return any(compareBy(sample.comparison, Float(sample.extra), Float(texel))) ? 1.0f : 0.0f;
    };
    const auto between = [](float a, float b, int weight) {
        return a + (b - a) * (static_cast<float>(weight) * (1.0f / kSubtexels));
    };
    return between(between(passes(0), passes(1), level.weightX), between(passes(2), passes(3), level.weightX),
                   level.weightY);
}

}  // namespace

SampleTrace traceSample(const Site& site, const TextureCall& call, int lane)
{
    const ShadingScope aside;  // levels that are made here are nobody's
    SampleTrace trace;
    trace.site = site;
    trace.function = call.function;
    trace.isAsked = (call.lanes >> lane & 1u) != 0;
    trace.coordinate = laneOf(call.coordinate, lane);
    trace.dx = laneOf(call.dx, lane);
    trace.dy = laneOf(call.dy, lane);
    trace.extra = call.extra[lane];
    for (int c = 0; c < 4; ++c) trace.result[static_cast<std::size_t>(c)] = call.result[c][lane];
    if (call.texture != nullptr)
        trace2D(*call.texture, call, lane, trace);
    else if (call.comparison != nullptr)
        traceComparison(*call.comparison, call, lane, trace);
    else if (call.cubeComparison != nullptr)
        traceComparison(*call.cubeComparison, call, lane, trace);
    else
        traceCube(*call.cube, call, lane, trace);
    return trace;
}

std::array<float, 4> recombined(const SampleTrace& sample)
{
    std::array<float, 4> result{};
    if (!sample.isAsked) return result;
    if (sample.function == TextureFunction::SampleCmp) {
        result[0] = comparedValue(sample);
        return result;
    }
    for (std::size_t c = 0; c < 4; ++c) {
        for (std::size_t i = 0; i < sample.taps.size(); ++i) {
            const float tap = tapValue(sample, sample.taps[i], c);
            result[c] = i == 0 ? tap : result[c] + (tap - result[c]) * (1.0f / static_cast<float>(i + 1));
        }
    }
    return result;
}

}  // namespace relief::inline RELIEF_WIDTH::trace
