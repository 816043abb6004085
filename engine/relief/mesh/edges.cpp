// Edges by their ends: sorted, those between the same vertices are neighbours.
#include "relief/mesh/edges.h"

#include <algorithm>
#include <cstddef>

namespace relief {

std::vector<std::uint32_t> pairEdges(const std::vector<std::uint32_t>& vertices)
{
    struct Edge
    {
        std::uint64_t ends;  // smaller vertex, larger vertex
        std::uint32_t corner;
    };
    std::vector<Edge> edges;
    edges.reserve(vertices.size());
    for (std::uint32_t corner = 0; corner < vertices.size(); ++corner) {
        const std::uint64_t from = vertices[corner];
        const std::uint64_t to = vertices[nextCorner(corner)];
        const std::uint64_t apex = vertices[previousCorner(corner)];
        if (from == to || from == apex || to == apex) continue;
        edges.push_back({std::min(from, to) << 32 | std::max(from, to), corner});
    }
    std::sort(edges.begin(), edges.end(),
              [](Edge a, Edge b) { return a.ends != b.ends ? a.ends < b.ends : a.corner < b.corner; });

    // Those that wait for a partner all run in the same direction, or they would have found one another. The partner of
    // the next one is the one that waits longest.
    std::vector<std::uint32_t> partners(vertices.size(), kNoEdge);
    std::size_t waiting = 0;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const std::uint32_t corner = edges[i].corner;
        while (edges[waiting].ends != edges[i].ends || partners[edges[waiting].corner] != kNoEdge) ++waiting;
        const std::uint32_t partner = edges[waiting].corner;
        if (vertices[partner] == vertices[corner]) continue;  // itself, or one that runs in its direction
        partners[corner] = partner;
        partners[partner] = corner;
    }
    return partners;
}

}  // namespace relief
