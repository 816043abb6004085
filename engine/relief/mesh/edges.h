// Which triangles lie next to each other: edges that two triangles share.
#pragma once

#include <cstdint>
#include <vector>

namespace relief {

// A corner is a position in a list of three vertices per triangle, and an edge is named by the corner where it begins;
// it leads to the next corner of its triangle.
inline std::uint32_t nextCorner(std::uint32_t corner)
{
    return corner % 3 == 2 ? corner - 2 : corner + 1;
}
inline std::uint32_t previousCorner(std::uint32_t corner)
{
    return corner % 3 == 0 ? corner + 2 : corner - 1;
}

inline constexpr std::uint32_t kNoEdge = 0xffffffffu;

// For each edge the one that runs between the same vertices in the opposite direction, or kNoEdge. Where more than two
// run between them, each takes the first that is still free, in the order of the list. Edges of triangles with two
// equal vertices have no partner.
std::vector<std::uint32_t> pairEdges(const std::vector<std::uint32_t>& vertices);

}  // namespace relief
