// Comparing pictures: counts every differing pixel, names the first ten, enlarges differences eight times.
#include "check/compare.h"

#include <algorithm>
#include <string>
#include <vector>

#include <doctest/doctest.h>

using relief::compare;
using relief::Comparison;

TEST_CASE("compare: equal pictures are the same")
{
    const std::vector<std::uint8_t> picture(5 * 3 * 4, 77);
    const Comparison result = compare(5, 3, picture, picture);
    CHECK(result.same());
    CHECK(result.first.empty());
    for (std::size_t i = 0; i < result.amplified.size(); ++i) CHECK(result.amplified[i] == (i % 4 == 3 ? 255 : 0));
}

TEST_CASE("compare: every differing pixel counts once, the first ten are named row by row")
{
    const std::vector<std::uint8_t> expected(20 * 2 * 4, 100);
    std::vector<std::uint8_t> actual = expected;
    for (std::size_t pixel = 7; pixel < 31; ++pixel) actual[pixel * 4 + pixel % 4] = 101;  // alpha counts too
    const Comparison result = compare(20, 2, actual, expected);
    CHECK(result.differing == 24);
    REQUIRE(result.first.size() == 10);
    CHECK(result.first.front().x == 7);
    CHECK(result.first.front().y == 0);
    CHECK(result.first.back().x == 16);
    const std::string report = result.report();
    CHECK(report.starts_with("24 pixels differ"));
    CHECK(std::count(report.begin(), report.end(), '\n') == 11);
}

TEST_CASE("compare: differences are enlarged eight times and stop at 255")
{
    const std::vector<std::uint8_t> expected = {10, 200, 0, 255};
    const std::vector<std::uint8_t> actual = {13, 100, 255, 255};
    const Comparison result = compare(1, 1, actual, expected);
    CHECK(result.amplified == std::vector<std::uint8_t>{24, 255, 255, 255});
}
