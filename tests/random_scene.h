// A scene of extreme numbers, made from a seed or from any bytes, and whether everything that must always hold does
// hold when it is drawn. Without doctest: the fuzzer of draws (fuzz/draw.cpp) uses it too.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace random_scene {

// Where a scene's numbers come from: the bytes first, SplitMix64 from the seed after them.
class Source
{
public:
    explicit Source(std::uint64_t seed) : state(seed) {}
    explicit Source(std::span<const std::uint8_t> given) : bytes(given), state(given.size()) {}

    std::uint64_t next();
    int between(int low, int high);  // low ... high
    bool chance(int of) { return between(1, of) == 1; }

private:
    std::span<const std::uint8_t> bytes;
    std::uint64_t state;
};

struct Result
{
    std::string broken;  // what does not hold; empty: everything does
    std::uint64_t trianglesSubmitted = 0, dropped = 0, pixelsShaded = 0, invalidColors = 0;
    double seconds = 0.0;
};

// Draws the scene three times: twice as it is, and with other threads and tiles. What must hold: no NaN and no infinity
// in colour or depth; nothing outside of the scissor changes; every triangle is counted once; the same bits and counts
// every time.
Result draw(Source source);

}  // namespace random_scene
