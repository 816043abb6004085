// Comparing pictures: counts every differing pixel, names the first ten, enlarges differences eight times.
#include "relief/check/compare.h"

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
    CHECK(result.amplified.empty());
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

TEST_CASE("compare: pixels that a picture is too short for differ")
{
    const std::vector<std::uint8_t> expected(3 * 2 * 4, 9);
    const std::vector<std::uint8_t> actual(4 * 4 + 1, 9);  // four pixels and a byte, and nothing to read behind it
    const Comparison result = compare(3, 2, actual, expected);
    CHECK(result.differing == 2);
    REQUIRE(result.first.size() == 2);
    CHECK(result.first[0].x == 1);
    CHECK(result.first[0].y == 1);
    CHECK(result.first[0].actual[0] == 9);
    CHECK(result.first[0].actual[1] == 0);
    CHECK(result.first[1].actual[0] == 0);
    CHECK(result.amplified.size() == expected.size());
    CHECK(result.amplified[5 * 4] == 72);
    CHECK(compare(3, 2, expected, {}).differing == 6);
    CHECK(compare(3, 2, {}, {}).differing == 6);
    CHECK(compare(0, -1, {}, {}).same());
}
