// Edges: who is whose neighbour, where an edge belongs to one, two or more triangles.
#include "relief/mesh/edges.h"

#include <cstdint>
#include <vector>

#include <doctest/doctest.h>

using namespace relief;

namespace {

using Corners = std::vector<std::uint32_t>;

}  // namespace

TEST_CASE("edges: the next and the previous corner go around the triangle")
{
    CHECK(nextCorner(6) == 7);
    CHECK(nextCorner(8) == 6);
    CHECK(previousCorner(6) == 8);
    CHECK(previousCorner(8) == 7);
}

TEST_CASE("edges: two triangles that share an edge are neighbours if they run through it in opposite directions")
{
    CHECK(pairEdges({0, 1, 2, 2, 1, 3}) == Corners{kNoEdge, 3, kNoEdge, 1, kNoEdge, kNoEdge});
    CHECK(pairEdges({0, 1, 2, 1, 2, 3}) == Corners(6, kNoEdge));
    CHECK(pairEdges({}).empty());
}

TEST_CASE("edges: two triangles back to back share all three")
{
    CHECK(pairEdges({0, 1, 2, 0, 2, 1}) == Corners{5, 4, 3, 2, 1, 0});
}

TEST_CASE("edges: among several triangles the first free ones pair up")
{
    // The edge from 0 to 1 is run through forward, forward, back, back, back.
    const Corners partners = pairEdges({0, 1, 2, 0, 1, 3, 1, 0, 4, 1, 0, 5, 1, 0, 6});
    CHECK(partners[0] == 6);
    CHECK(partners[6] == 0);
    CHECK(partners[3] == 9);
    CHECK(partners[9] == 3);
    CHECK(partners[12] == kNoEdge);
    // Back, forward, back, forward: the first back takes the first forward.
    CHECK(pairEdges({1, 0, 2, 0, 1, 3, 1, 0, 4, 0, 1, 5})[0] == 3);
    CHECK(pairEdges({1, 0, 2, 0, 1, 3, 1, 0, 4, 0, 1, 5})[6] == 9);
}

TEST_CASE("edges: triangles with two equal vertices have no neighbours")
{
    CHECK(pairEdges({0, 1, 2, 1, 0, 0, 2, 1, 1}) == Corners(9, kNoEdge));
}
