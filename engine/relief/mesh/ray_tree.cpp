// A tree of boxes: split at the median along the longest side, walked without recursion, the nearer child first.
#include "relief/mesh/ray_tree.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include <glm/common.hpp>

#include "relief/lanes/environment.h"

namespace relief {
namespace {

constexpr std::uint32_t kLeafSize = 3;
constexpr std::size_t kLargestDepth = 64;  // halving 2^32 triangles takes 32 levels

// A ray as the two tests want it.
struct PreparedRay
{
    explicit PreparedRay(const Ray& ray) : origin(ray.origin), inverse(1.0 / ray.direction), begin(ray.begin)
    {
        // z becomes the longest axis of the direction; x and y are swapped where it is negative, so that triangles
        // keep the way that they turn.
        const glm::dvec3 size(std::fabs(ray.direction.x), std::fabs(ray.direction.y), std::fabs(ray.direction.z));
        z = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
        x = (z + 1) % 3;
        y = (z + 2) % 3;
        if (ray.direction[z] < 0) std::swap(x, y);
        shearX = ray.direction[x] / ray.direction[z];
        shearY = ray.direction[y] / ray.direction[z];
        scaleZ = 1.0 / ray.direction[z];
    }

    // To the space in which the ray starts at 0 and runs along z, one unit per unit of t.
    glm::dvec3 fromObject(const glm::vec3& position) const
    {
        const glm::dvec3 p = glm::dvec3(position) - origin;
        return {p[x] - shearX * p[z], p[y] - shearY * p[z], scaleZ * p[z]};
    }

    glm::dvec3 origin, inverse;
    double begin;
    int x = 0, y = 0, z = 0;
    double shearX = 0, shearY = 0, scaleZ = 0;
};

// Where the ray enters the box, or infinity if it does not before `end`. A side that the ray runs along and that it
// touches gives a NaN, which no comparison prefers.
double entry(const PreparedRay& ray, double end, const glm::vec3& low, const glm::vec3& high)
{
    double enter = ray.begin, leave = end;
    for (int axis = 0; axis < 3; ++axis) {
        const double toLow = (static_cast<double>(low[axis]) - ray.origin[axis]) * ray.inverse[axis];
        const double toHigh = (static_cast<double>(high[axis]) - ray.origin[axis]) * ray.inverse[axis];
        const bool isForward = ray.inverse[axis] >= 0;
        const double in = isForward ? toLow : toHigh, out = isForward ? toHigh : toLow;
        enter = in > enter ? in : enter;
        leave = out < leave ? out : leave;
    }
    return enter <= leave ? enter : std::numeric_limits<double>::infinity();
}

// Replaces `hit` if the triangle is hit earlier, or as early and has a lower number.
void intersect(const PreparedRay& ray, double end, const std::array<glm::vec3, 3>& corners, std::uint32_t number,
               std::optional<RayHit>& hit)
{
    const glm::dvec3 a = ray.fromObject(corners[0]);
    const glm::dvec3 b = ray.fromObject(corners[1]);
    const glm::dvec3 c = ray.fromObject(corners[2]);
    // Edge functions: positive for fronts. The other triangle of an edge computes the same two products.
    const double u = c.x * b.y - c.y * b.x;
    const double v = a.x * c.y - a.y * c.x;
    const double w = b.x * a.y - b.y * a.x;
    const double sum = u + v + w;
    if (!(u >= 0 && v >= 0 && w >= 0 && sum > 0)) return;
    const std::array<double, 3> weights = {u / sum, v / sum, w / sum};
    const double t = weights[0] * a.z + weights[1] * b.z + weights[2] * c.z;
    if (!(t >= ray.begin && t <= end)) return;
    if (hit && (t > hit->t || (t == hit->t && number > hit->triangle))) return;
    hit = RayHit{number, t, weights};
}

}  // namespace

struct RayTree::Builder
{
    struct Item
    {
        glm::vec3 low, high, centre;
        std::uint32_t number;
    };

    RayTree& tree;
    const Mesh& mesh;
    float margin;  // makes up for rounding in both tests
    std::vector<Item> items;

    Builder(RayTree& t, const Mesh& m) : tree(t), mesh(m), margin(0)
    {
        float largest = 0;
        items.reserve(mesh.indices.size() / 3);
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            const glm::vec3 a = mesh.positions[mesh.indices[i]];
            const glm::vec3 b = mesh.positions[mesh.indices[i + 1]];
            const glm::vec3 c = mesh.positions[mesh.indices[i + 2]];
            const glm::vec3 low = glm::min(glm::min(a, b), c), high = glm::max(glm::max(a, b), c);
            for (int axis = 0; axis < 3; ++axis) {
                largest = std::max({largest, std::fabs(low[axis]), std::fabs(high[axis])});
            }
            items.push_back({low, high, low * 0.5f + high * 0.5f, static_cast<std::uint32_t>(i / 3)});
        }
        margin = largest * std::numeric_limits<float>::epsilon();
    }

    void leaf(std::size_t node, std::size_t begin, std::size_t end)
    {
        tree.nodes[node].next = static_cast<std::uint32_t>(tree.triangles.size());
        tree.nodes[node].count = static_cast<std::uint32_t>(end - begin);
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint32_t* const of = &mesh.indices[3 * std::size_t{items[i].number}];
            tree.triangles.push_back(
                {{mesh.positions[of[0]], mesh.positions[of[1]], mesh.positions[of[2]]}, items[i].number});
        }
    }

    void build(std::size_t begin, std::size_t end)
    {
        glm::vec3 low = items[begin].low, high = items[begin].high;
        glm::vec3 lowCentre = items[begin].centre, highCentre = lowCentre;
        for (std::size_t i = begin + 1; i < end; ++i) {
            low = glm::min(low, items[i].low);
            high = glm::max(high, items[i].high);
            lowCentre = glm::min(lowCentre, items[i].centre);
            highCentre = glm::max(highCentre, items[i].centre);
        }
        const std::size_t node = tree.nodes.size();
        tree.nodes.push_back({low - margin, high + margin, 0, 0});
        if (end - begin <= kLeafSize) return leaf(node, begin, end);

        const glm::dvec3 size = glm::dvec3(highCentre) - glm::dvec3(lowCentre);
        const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
        const std::size_t middle = begin + (end - begin) / 2;
        const auto at = [&](std::size_t i) { return items.begin() + static_cast<std::ptrdiff_t>(i); };
        std::nth_element(at(begin), at(middle), at(end), [axis](const Item& a, const Item& b) {
            return a.centre[axis] != b.centre[axis] ? a.centre[axis] < b.centre[axis] : a.number < b.number;
        });
        build(begin, middle);
        tree.nodes[node].next = static_cast<std::uint32_t>(tree.nodes.size());
        build(middle, end);
    }
};

RayTree::RayTree(const Mesh& mesh)
{
    const DefaultFloatingPoint environment;
    Builder builder(*this, mesh);
    if (builder.items.empty()) return;
    triangles.reserve(builder.items.size());
    nodes.reserve(builder.items.size());
    builder.build(0, builder.items.size());
}

std::optional<RayHit> RayTree::firstHit(const Ray& ray) const
{
    const DefaultFloatingPoint environment;
    std::optional<RayHit> hit;
    if (nodes.empty()) return hit;
    const PreparedRay prepared(ray);
    constexpr double kNever = std::numeric_limits<double>::infinity();
    struct Waiting
    {
        std::uint32_t node;
        double enter;
    };
    std::array<Waiting, kLargestDepth> stack;
    std::size_t waiting = 0;
    const double rootEntry = entry(prepared, ray.end, nodes[0].low, nodes[0].high);
    if (rootEntry < kNever) stack[waiting++] = {0, rootEntry};
    while (waiting > 0) {
        const Waiting current = stack[--waiting];
        const double end = hit ? hit->t : ray.end;
        if (current.enter > end) continue;
        const Node& node = nodes[current.node];
        for (std::uint32_t i = 0; i < node.count; ++i) {
            const Triangle& triangle = triangles[node.next + i];
            intersect(prepared, ray.end, triangle.corners, triangle.number, hit);
        }
        if (node.count > 0) continue;

        Waiting near = {current.node + 1, 0}, far = {node.next, 0};
        near.enter = entry(prepared, end, nodes[near.node].low, nodes[near.node].high);
        far.enter = entry(prepared, end, nodes[far.node].low, nodes[far.node].high);
        if (far.enter < near.enter) std::swap(near, far);
        if (far.enter < kNever) stack[waiting++] = far;
        if (near.enter < kNever) stack[waiting++] = near;
    }
    return hit;
}

}  // namespace relief
