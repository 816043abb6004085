// Quad, cube, spheres and terrain. Every surface is a grid of cells whose corners are counted along u, then along v, so
// that one function, appendCell, decides the winding of all of them.
#include "relief/mesh/primitives.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include <glm/geometric.hpp>

#include "relief/lanes/environment.h"
#include "relief/lanes/math.h"

namespace relief {
namespace {

// Left-handed coordinates with u to the right and v up on the front: the binormal is -cross(normal, tangent).
constexpr float kHandedness = -1.0f;

glm::vec4 tangentAlong(glm::vec3 direction)
{
    return {direction, kHandedness};
}

void appendVertex(Mesh& mesh, glm::vec3 position, glm::vec3 normal, glm::vec2 uv, glm::vec3 tangent)
{
    mesh.positions.push_back(position);
    mesh.normals.push_back(normal);
    mesh.uvs.push_back(uv);
    mesh.tangents.push_back(tangentAlong(tangent));
}

void reserve(Mesh& mesh, std::size_t vertices, std::size_t triangles)
{
    mesh.positions.reserve(vertices);
    mesh.normals.reserve(vertices);
    mesh.uvs.reserve(vertices);
    mesh.tangents.reserve(vertices);
    mesh.indices.reserve(3 * triangles);
}

// The corners of a cell, seen from the front with u to the right and v up. Clockwise, split from lower left to upper
// right: the triangles of Unity's quad.
struct Cell
{
    std::uint32_t lowerLeft, lowerRight, upperLeft, upperRight;
};

void appendCell(Mesh& mesh, Cell cell)
{
    mesh.indices.insert(mesh.indices.end(), {cell.lowerLeft, cell.upperRight, cell.lowerRight,  //
                                             cell.upperRight, cell.lowerLeft, cell.upperLeft});
}

// Cells between (cellsU + 1) * (cellsV + 1) vertices that start at `first`, row by row along u.
void appendGridCells(Mesh& mesh, std::size_t first, int cellsU, int cellsV)
{
    const auto stride = static_cast<std::uint32_t>(cellsU) + 1;
    for (int v = 0; v < cellsV; ++v) {
        for (int u = 0; u < cellsU; ++u) {
            const std::uint32_t corner = static_cast<std::uint32_t>(first) + static_cast<std::uint32_t>(v) * stride +
                                         static_cast<std::uint32_t>(u);
            appendCell(mesh, {corner, corner + 1, corner + stride, corner + stride + 1});
        }
    }
}

void clampCells(int& cellsAcross, int& cellsAlong)
{
    constexpr int kMaxCells = 1 << 23;
    cellsAcross = std::clamp(cellsAcross, 1, 4096);
    cellsAlong = std::clamp(cellsAlong, 1, std::min(4096, kMaxCells / cellsAcross));
}

// A side of the cube: where it looks, and where the picture's +u and +v point; tangent = cross(normal, binormal).
struct Side
{
    glm::vec3 normal, tangent, binormal;
};

constexpr std::array<Side, 6> kSides = {{
    {{0, 0, -1}, {1, 0, 0}, {0, 1, 0}},   // front, the face of the quad
    {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}},    // right
    {{0, 0, 1}, {-1, 0, 0}, {0, 1, 0}},   // back
    {{-1, 0, 0}, {0, 0, -1}, {0, 1, 0}},  // left
    {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},    // top
    {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},  // bottom
}};

// The value of a smooth random function, with its slopes along x and z.
struct Height
{
    float value, slopeX, slopeZ;
};

// A number in -1..1 for every lattice point: multiply and shift-xor rounds, each of which can be undone, so that
// neighbours share no pattern.
float latticeValue(std::uint32_t x, std::uint32_t z, std::uint32_t octave)
{
    std::uint32_t h = x * 0x9e3779b1u ^ z * 0x85ebca77u ^ octave * 0xc2b2ae3du;
    h = (h ^ (h >> 16)) * 0x7feb352du;
    h = (h ^ (h >> 15)) * 0x846ca68bu;
    h ^= h >> 16;
    return static_cast<float>(h >> 8) * (1.0f / 8388608.0f) - 1.0f;  // 24 bits: exact
}

// Value noise: the lattice's values, blended by the quintic 6t^5 - 15t^4 + 10t^3, whose first and second derivatives
// are zero at both ends, so that the shading shows no lattice lines.
Height valueNoise(float x, float z, std::uint32_t octave)
{
    const auto cellX = static_cast<std::uint32_t>(x);  // x and z are not negative here
    const auto cellZ = static_cast<std::uint32_t>(z);
    const float tx = x - static_cast<float>(cellX);
    const float tz = z - static_cast<float>(cellZ);
    const auto blend = [](float t) { return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f); };
    const auto blendSlope = [](float t) { return 30.0f * t * t * (t * (t - 2.0f) + 1.0f); };

    // The bilinear form a + b * bx + c * bz + d * bx * bz of the four corners.
    const float a = latticeValue(cellX, cellZ, octave);
    const float b = latticeValue(cellX + 1, cellZ, octave) - a;
    const float c = latticeValue(cellX, cellZ + 1, octave) - a;
    const float d = latticeValue(cellX + 1, cellZ + 1, octave) - a - b - c;
    const float bx = blend(tx);
    const float bz = blend(tz);
    return {a + b * bx + c * bz + d * bx * bz, (b + d * bz) * blendSlope(tx), (c + d * bx) * blendSlope(tz)};
}

// Hills at x, z in 0..1: octaves of half the size and 0.4 times the height each. The heights' sum stays below 0.1.
Height terrainHeight(float x, float z)
{
    constexpr std::uint32_t kOctaves = 4;
    Height sum{};
    float frequency = 4.0f;
    float amplitude = 0.06f;
    for (std::uint32_t octave = 0; octave < kOctaves; ++octave) {
        const Height noise = valueNoise(x * frequency, z * frequency, octave);
        sum.value += amplitude * noise.value;
        sum.slopeX += amplitude * frequency * noise.slopeX;
        sum.slopeZ += amplitude * frequency * noise.slopeZ;
        frequency *= 2.0f;
        amplitude *= 0.4f;
    }
    return sum;
}

}  // namespace

Mesh makeQuad()
{
    const DefaultFloatingPoint environment;
    Mesh mesh;
    mesh.name = "quad";
    const Side& front = kSides[0];
    for (int corner = 0; corner < 4; ++corner) {
        const glm::vec2 uv(static_cast<float>(corner % 2), static_cast<float>(corner / 2));
        appendVertex(mesh, {uv.x - 0.5f, uv.y - 0.5f, 0.0f}, front.normal, uv, front.tangent);
    }
    appendGridCells(mesh, 0, 1, 1);
    return mesh;
}

Mesh makeGrid(int cellsX, int cellsY)
{
    const DefaultFloatingPoint environment;
    clampCells(cellsX, cellsY);
    Mesh mesh;
    mesh.name = "grid";
    const auto columns = static_cast<std::size_t>(cellsX), rows = static_cast<std::size_t>(cellsY);
    reserve(mesh, (columns + 1) * (rows + 1), 2 * columns * rows);
    const Side& front = kSides[0];
    for (int y = 0; y <= cellsY; ++y) {
        for (int x = 0; x <= cellsX; ++x) {
            const glm::vec2 uv(static_cast<float>(x) / static_cast<float>(cellsX),
                               static_cast<float>(y) / static_cast<float>(cellsY));
            appendVertex(mesh, {uv.x - 0.5f, uv.y - 0.5f, 0.0f}, front.normal, uv, front.tangent);
        }
    }
    appendGridCells(mesh, 0, cellsX, cellsY);
    return mesh;
}

Mesh makeCube()
{
    const DefaultFloatingPoint environment;
    Mesh mesh;
    mesh.name = "cube";
    for (const Side& side : kSides) {
        const std::size_t first = mesh.positions.size();
        for (int corner = 0; corner < 4; ++corner) {
            const glm::vec2 uv(static_cast<float>(corner % 2), static_cast<float>(corner / 2));
            const glm::vec3 position =
                side.normal * 0.5f + side.tangent * (uv.x - 0.5f) + side.binormal * (uv.y - 0.5f);
            appendVertex(mesh, position, side.normal, uv, side.tangent);
        }
        appendGridCells(mesh, first, 1, 1);
    }
    return mesh;
}

Mesh makeSphere(int segments, int rings)
{
    const DefaultFloatingPoint environment;
    segments = std::clamp(segments, 3, 1024);
    rings = std::clamp(rings, 2, 1024);
    const auto segmentCount = static_cast<std::size_t>(segments);
    const auto ringCount = static_cast<std::size_t>(rings);
    Mesh mesh;
    mesh.name = "sphere";
    reserve(mesh, 2 * segmentCount + (ringCount - 1) * (segmentCount + 1), 2 * segmentCount * (ringCount - 1));

    // The outward direction at longitude u and the given height: u grows to the right of who looks at it, and the
    // middle of the picture faces the viewer at -Z. The seam takes the sine and cosine of 0, so that it closes exactly.
    constexpr float kTwoPi = 6.283185307f;
    const auto appendRing = [&](float v, float y, float radius, float firstStep, int count) {
        for (int i = 0; i < count; ++i) {
            const float u = (static_cast<float>(i) + firstStep) / static_cast<float>(segments);
            const float longitude = i == segments ? 0.0f : kTwoPi * u;
            const float sine = relief::sin(longitude);
            const float cosine = relief::cos(longitude);
            const glm::vec3 normal = glm::normalize(glm::vec3(-sine * radius, y, cosine * radius));
            appendVertex(mesh, normal * 0.5f, normal, {u, v}, glm::normalize(glm::vec3(-cosine, 0.0f, -sine)));
        }
    };

    // South pole, rings from south to north, north pole.
    appendRing(0.0f, -1.0f, 0.0f, 0.5f, segments);
    for (int ring = 1; ring < rings; ++ring) {
        const float v = static_cast<float>(ring) / static_cast<float>(rings);
        const float latitude = 0.5f * kTwoPi * v;  // from the south pole
        appendRing(v, -relief::cos(latitude), relief::sin(latitude), 0.0f, segments + 1);
    }
    appendRing(1.0f, 1.0f, 0.0f, 0.5f, segments);

    // At a pole a cell is one triangle: two of its corners are the pole's vertex.
    const auto segmentsU = static_cast<std::uint32_t>(segments);
    const auto lastRing = static_cast<std::uint32_t>(mesh.positions.size()) - segmentsU - (segmentsU + 1);
    for (std::uint32_t i = 0; i < segmentsU; ++i) {
        const std::uint32_t firstRing = segmentsU;
        mesh.indices.insert(mesh.indices.end(), {i, firstRing + i, firstRing + i + 1});
    }
    appendGridCells(mesh, segmentCount, segments, rings - 2);
    for (std::uint32_t i = 0; i < segmentsU; ++i) {
        mesh.indices.insert(mesh.indices.end(), {lastRing + i, lastRing + segmentsU + 1 + i, lastRing + i + 1});
    }
    return mesh;
}

Mesh makeCubeSphere(int subdivisions)
{
    const DefaultFloatingPoint environment;
    subdivisions = std::clamp(subdivisions, 1, 1024);
    const auto cells = static_cast<std::size_t>(subdivisions);
    Mesh mesh;
    mesh.name = "cube sphere";
    reserve(mesh, 6 * (cells + 1) * (cells + 1), 12 * cells * cells);
    // From -1 to 1, and exactly symmetric: points on the cube's edges come out the same from both sides.
    const auto along = [&](int i) {
        return static_cast<float>(2 * i - subdivisions) / static_cast<float>(subdivisions);
    };
    for (const Side& side : kSides) {
        const std::size_t first = mesh.positions.size();
        for (int v = 0; v <= subdivisions; ++v) {
            for (int u = 0; u <= subdivisions; ++u) {
                const glm::vec3 onCube = side.normal + side.tangent * along(u) + side.binormal * along(v);
                const glm::vec3 normal = glm::normalize(onCube);
                // The derivative of normalize(onCube) along u is the side's tangent without its part along the normal.
                const glm::vec3 tangent = glm::normalize(side.tangent - normal * glm::dot(normal, side.tangent));
                const glm::vec2 uv(static_cast<float>(u) / static_cast<float>(subdivisions),
                                   static_cast<float>(v) / static_cast<float>(subdivisions));
                appendVertex(mesh, normal * 0.5f, normal, uv, tangent);
            }
        }
        appendGridCells(mesh, first, subdivisions, subdivisions);
    }
    return mesh;
}

Mesh makeTerrain(int cellsX, int cellsZ)
{
    const DefaultFloatingPoint environment;
    clampCells(cellsX, cellsZ);
    const auto columns = static_cast<std::size_t>(cellsX);
    const auto rows = static_cast<std::size_t>(cellsZ);
    Mesh mesh;
    mesh.name = "terrain";
    reserve(mesh, (columns + 1) * (rows + 1), 2 * columns * rows);
    for (int z = 0; z <= cellsZ; ++z) {
        for (int x = 0; x <= cellsX; ++x) {
            const glm::vec2 uv(static_cast<float>(x) / static_cast<float>(cellsX),
                               static_cast<float>(z) / static_cast<float>(cellsZ));
            const Height height = terrainHeight(uv.x, uv.y);
            // The surface (x, h(x, z), z) has the tangent (1, dh/dx, 0) and the normal (-dh/dx, 1, -dh/dz).
            const glm::vec3 normal = glm::normalize(glm::vec3(-height.slopeX, 1.0f, -height.slopeZ));
            const glm::vec3 tangent = glm::normalize(glm::vec3(1.0f, height.slopeX, 0.0f));
            appendVertex(mesh, {uv.x - 0.5f, height.value, uv.y - 0.5f}, normal, uv, tangent);
        }
    }
    appendGridCells(mesh, 0, cellsX, cellsZ);
    return mesh;
}

}  // namespace relief
