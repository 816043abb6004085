// The words that all tellings of a trace share. Numbers are as short as gives the same number back, so that a trace
// reads the same on every machine.
#pragma once

#include <array>
#include <string>

#include "relief/trace/pixel_trace.h"

namespace relief::samples::trace {

namespace t = relief::trace;

std::string number(float value);
std::string number(double value);

// "0.5 0.25 1", of one of the quad's pixels.
std::string valueOf(const t::QuadValue& value, int pixel);
std::string listOf(std::span<const float> values);

// Whether one of them is NaN or infinite.
bool isInvalid(const t::QuadValue& value, int pixel);
bool isEverywhereSame(const t::QuadValue& value);

// The difference to the right or below, in the pixel's row or column: ddx, ddy.
std::string differenceOf(const t::QuadValue& value, int pixel, bool down);

std::string wordsOf(t::PrimitiveTrace::Verdict verdict);
std::string wordsOf(t::SampleOutcome::Verdict verdict);
std::string wordsOf(Compare compare);
std::string wordsOf(Blend blend);
std::string wordsOf(Format format);
std::string wordsOf(Filter filter);
std::string wordsOf(AddressMode mode);
std::string wordsOf(TexelFormat format);
std::string wordsOf(Interpolation how);
std::string wordsOf(const RenderState& state);

// "#8c7a5b ff", or the words of a float format.
std::string storedText(Format format, std::span<const std::uint32_t> words);

// Sub-pixels as pixels: 24.8 fixed point is exact in decimal.
std::string pixels(std::int32_t fixed);

}  // namespace relief::samples::trace
