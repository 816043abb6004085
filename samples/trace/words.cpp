#include "trace/words.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "relief/bits.h"

namespace relief::samples::trace {

namespace {

#if !defined(__cpp_lib_to_chars)
// With the fewest digits behind the point that give the value again; empty where twenty are not enough.
template <class Number>
std::string fewestDigits(const char* format, Number value)
{
    char digits[64];
    for (int precision = 0; precision < 20; ++precision) {
        std::snprintf(digits, sizeof digits, format, precision, static_cast<double>(value));
        if (static_cast<Number>(std::strtod(digits, nullptr)) == value) return digits;
    }
    return {};
}
#endif

template <class Number>
std::string shortest(Number value)
{
    if (std::isnan(value)) return "NaN";
#if defined(__cpp_lib_to_chars)
    char digits[64];
    return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
#else
    // emscripten's C++ library has to_chars of integers only. What to_chars does: the shorter one.
    const std::string fixed = fewestDigits("%.*f", value), scientific = fewestDigits("%.*e", value);
    return fixed.empty() || scientific.size() < fixed.size() ? scientific : fixed;
#endif
}

template <class Value>
std::string nameOf(Value value, std::initializer_list<const char*> names)
{
    return names.begin()[static_cast<std::size_t>(value)];
}

}  // namespace

std::string number(float value)
{
    return shortest(value);
}
std::string number(double value)
{
    return shortest(value);
}

std::string listOf(std::span<const float> values)
{
    std::string all;
    for (const float value : values) all += (all.empty() ? "" : " ") + number(value);
    return all;
}

std::string valueOf(const t::QuadValue& value, int pixel)
{
    std::string all;
    const int count = value.rows * value.columns;
    for (int c = 0; c < count; ++c) {
        const std::uint32_t word = value.words[static_cast<std::size_t>(pixel)][static_cast<std::size_t>(c)];
        if (c > 0) all += value.columns > 1 && c % value.rows == 0 ? " | " : " ";
        if (value.kind == t::ValueKind::truth) {
            all += word != 0 ? "true" : "false";
        } else if (value.kind == t::ValueKind::integer) {
            all += std::to_string(static_cast<std::int32_t>(word));
        } else {
            all += number(bitCast<float>(word));
        }
    }
    return all;
}

bool isInvalid(const t::QuadValue& value, int pixel)
{
    if (value.kind != t::ValueKind::number) return false;
    for (int c = 0; c < value.rows * value.columns; ++c) {
        if (!std::isfinite(value.number(pixel, c))) return true;
    }
    return false;
}

bool isEverywhereSame(const t::QuadValue& value)
{
    return value.words[1] == value.words[0] && value.words[2] == value.words[0] && value.words[3] == value.words[0];
}

std::string differenceOf(const t::QuadValue& value, int pixel, bool down)
{
    const int first = down ? pixel & 1 : pixel & 2, second = down ? first | 2 : first | 1;
    std::string all;
    for (int c = 0; c < value.rows * value.columns; ++c)
        all += (c > 0 ? " " : "") + number(value.number(second, c) - value.number(first, c));
    return all;
}

std::string wordsOf(t::PrimitiveTrace::Verdict verdict)
{
    return nameOf(verdict, {"covers the pixel", "misses it", "faces away: culled",
                            "has no pixel's centre within its bounds: culled", "clipped to nothing"});
}
std::string wordsOf(t::SampleOutcome::Verdict verdict)
{
    return nameOf(verdict, {"not covered", "fails the stencil test", "fails the depth test", "thrown away", "drawn"});
}
std::string wordsOf(Compare compare)
{
    return nameOf(compare,
                  {"never", "less", "equal", "less or equal", "greater", "not equal", "greater or equal", "always"});
}
std::string wordsOf(Blend blend)
{
    return nameOf(blend, {"replaces", "is added to", "is blended by its alpha with"});
}
std::string wordsOf(Format format)
{
    return nameOf(format, {"rgba8", "rgba8 sRGB", "rgba16f", "r32f", "rgba32f", "depth32f", "stencil8"});
}
std::string wordsOf(Filter filter)
{
    return nameOf(filter, {"nearest", "bilinear", "trilinear"});
}
std::string wordsOf(AddressMode mode)
{
    return nameOf(mode, {"wrap", "mirror", "clamp", "border"});
}
std::string wordsOf(TexelFormat format)
{
    return nameOf(format, {"rgba8", "rgba16", "rgba32f", "r32f"});
}
std::string wordsOf(Interpolation how)
{
    switch (how) {
        case Interpolation::affine:
            return "linear on the screen";
        case Interpolation::flat:
            return "the first vertex's";
        case Interpolation::centroid:
            return "at the centroid";
        default:
            return "in perspective";
    }
}

std::string wordsOf(const RenderState& state)
{
    std::string all = state.cull == Cull::none   ? "culls nothing"
                      : state.cull == Cull::back ? "culls back faces"
                                                 : "culls front faces";
    all += "; depth " + wordsOf(state.depthTest) + (state.depthWrite ? ", written" : ", not written");
    if (state.blend == Blend::additive) all += "; its light is added";
    if (state.blend == Blend::alpha) all += "; blended by alpha";
    if (state.stencil.isUsed()) all += "; tests the stencil";
    if (state.alphaToCoverage) all += "; alpha to coverage";
    if (!state.colorWrite) all += "; no colour";
    return all;
}

std::string storedText(Format format, std::span<const std::uint32_t> words)
{
    char text[32];
    if (format == Format::rgba8 || format == Format::rgba8Srgb) {
        const std::uint32_t w = words[0];
        std::snprintf(text, sizeof text, "#%02x%02x%02x, alpha %02x", w & 255u, w >> 8 & 255u, w >> 16 & 255u, w >> 24);
        return text;
    }
    std::string all;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (format == Format::rgba16f) {
            std::snprintf(text, sizeof text, "0x%04x 0x%04x", words[i] & 0xffffu, words[i] >> 16);
            all += (i > 0 ? " " : "") + std::string(text);
        } else {
            all += (i > 0 ? " " : "") + number(bitCast<float>(words[i]));
        }
    }
    return all;
}

std::string pixels(std::int32_t fixed)
{
    return number(static_cast<double>(fixed) / 256.0);
}

}  // namespace relief::samples::trace
