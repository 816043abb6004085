// Loops that each pixel leaves for itself.
#include "relief/shading/loop.h"

#include <doctest/doctest.h>

using namespace relief;

TEST_CASE("whileAny: each pixel goes on for itself, and only those that count keep it going")
{
    Int steps = 0;
    Mask running = true;
    int rounds = 0;
    whileAny(running, [&] {
        steps = select(running, steps + 1, steps);
        running &= steps < laneXs() + laneYs() * 2 + 1;
        ++rounds;
    });
    const Int expected = laneXs() + laneYs() * 2 + 1;
    CHECK(all(steps == expected));
    int most = 0;
    for (int lane = 0; lane < kLanes; ++lane) most = std::max(most, expected[lane]);
    CHECK(rounds == most);

    const ShadingScope scope;
    shading.activeLanes = 1;
    running = true;
    rounds = 0;
    whileAny(running, [&] {
        ++rounds;
        running &= Mask::fromBits(rounds < 3 ? kAllLanes : kAllLanes & ~1u);
    });
    CHECK(rounds == 3);
    running = false;
    whileAny(running, [&] { ++rounds; });
    CHECK(rounds == 3);
}
