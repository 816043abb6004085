#include "common/tangent_space_visualizer.h"

#include <glm/geometric.hpp>

#include "relief/mesh/tangents.h"

namespace relief::samples {

namespace {

struct VertexData
{
    POSITION position;
};

struct Interpolators
{
    SV_POSITION position;
};

struct LineVertexProgram
{
    ObjectTransform world;  // not `object`: lines have no tangent space of their own to show

    Interpolators operator()(VertexData v) const { return {UnityObjectToClipPos(world, v.position)}; }
};

struct LineFragmentProgram
{
    float3 color;

    float4 operator()(Interpolators) const { return float4(color, 1); }
};

// What Gizmos.DrawLine collects, in one colour.
struct Lines
{
    Mesh mesh;

    void DrawLine(const glm::vec3& from, const glm::vec3& to)
    {
        for (const glm::vec3& end : {from, to}) {
            mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
            mesh.positions.push_back(end);
        }
    }
};

}  // namespace

void TangentSpaceVisualizer::ShowTangentSpace(const Scene& s, const Mesh& shown, const glm::mat4& worldFromObject) const
{
    const Mesh& mesh = s.withTangents(shown);
    const glm::mat3 directions(worldFromObject);
    const glm::mat3 normalFromObject = normalMatrix(directions);
    const float mirrored = mirrorSign(worldFromObject);
    Lines normals, tangents, binormals;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3 normal = normalizedOrZero(normalFromObject * mesh.normals[i]);
        const glm::vec3 tangent = normalizedOrZero(directions * glm::vec3(mesh.tangents[i]));
        const glm::vec3 binormal = glm::cross(normal, tangent) * (mesh.tangents[i].w * mirrored);
        const glm::vec3 vertex = glm::vec3(worldFromObject * glm::vec4(mesh.positions[i], 1.0f)) + normal * offset;
        normals.DrawLine(vertex, vertex + normal * scale);
        tangents.DrawLine(vertex, vertex + tangent * scale);
        binormals.DrawLine(vertex, vertex + binormal * scale);
    }

    constexpr RenderState kLines = {.primitive = Primitive::lines};
    const LineVertexProgram program{s.uniforms().object};
    s.draw(s.keep(std::move(normals.mesh)), program, LineFragmentProgram{{0, 1, 0}}, kLines);
    s.draw(s.keep(std::move(tangents.mesh)), program, LineFragmentProgram{{1, 0, 0}}, kLines);
    s.draw(s.keep(std::move(binormals.mesh)), program, LineFragmentProgram{{0, 0, 1}}, kLines);
}

}  // namespace relief::samples
