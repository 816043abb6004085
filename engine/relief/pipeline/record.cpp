// Recording a draw: what VertexData asks for is looked up among the mesh's streams, once.
#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "relief/pipeline/draw.h"

namespace relief::inline RELIEF_WIDTH {

namespace {

Expected<StreamView> findStream(const std::vector<StreamView>& streams, const Field& field, const Mesh& mesh,
                                std::size_t vertices, std::uint32_t instances)
{
    if (field.systemValue == SystemValue::id) return StreamView{field.name, 0, 1, true, false, nullptr, 0};
    const auto isWanted = [&field](const StreamView& s) {
        return std::string_view(s.semantic) == field.name && s.index == field.index;
    };
    const auto found = std::find_if(streams.begin(), streams.end(), isWanted);
    const std::string name = "draw of mesh '" + mesh.name + "': ";
    if (found == streams.end()) {
        return fail(name + "it has no " + semanticOf(field) +
                    ", which VertexData asks for; give the mesh that stream, or take the field out");
    }
    if (std::any_of(found + 1, streams.end(), isWanted))
        return fail(name + "it has two streams " + semanticOf(field) + "; take one of them out");
    if (found->isInteger != field.isInteger) {
        return fail(name + "its " + semanticOf(field) + " holds " + (found->isInteger ? "integers" : "floats") +
                    ", and VertexData asks for the other; make both the same");
    }
    const std::size_t wanted = found->perInstance ? instances : vertices;
    if (found->count < wanted) {
        return fail(name + "its " + semanticOf(field) + " holds " + std::to_string(found->count) + " elements for " +
                    std::to_string(wanted) + (found->perInstance ? " instances" : " vertices") +
                    "; give each of them one");
    }
    return *found;
}

// The vertices that a mesh has: one for each element of its streams.
std::size_t vertexCountOf(const std::vector<StreamView>& streams, const Mesh& mesh)
{
    for (const StreamView& stream : streams) {
        if (!stream.perInstance) return stream.count;
    }
    return mesh.indices.empty() ? 0 : std::size_t{*std::max_element(mesh.indices.begin(), mesh.indices.end())} + 1;
}

}  // namespace

Expected<Draw> makeDraw(const Programs& programs, const void* vertexProgram, const void* fragmentProgram,
                        const Mesh& mesh, const RenderState& state, const MeshPart& part)
{
    const std::string name = "draw of mesh '" + mesh.name + "': ";
    if (state.lineWidth != 1 && state.lineWidth != 2) {
        return fail(name + "lines are 1 or 2 pixels wide, not " + std::to_string(state.lineWidth) +
                    "; set RenderState::lineWidth to one of them");
    }
    const DepthBias& bias = state.depthBias;
    if (!std::isfinite(bias.constant) || !std::isfinite(bias.slope) || !std::isfinite(bias.limit)) {
        return fail(name +
                    "its depth bias holds a NaN or an infinity; set all of RenderState::depthBias to finite numbers");
    }
    for (const VertexStream& stream : mesh.streams) {
        if (stream.components < 1 || stream.components > 4) {
            return fail(name + "its stream " + stream.semantic + std::to_string(stream.index) + " has " +
                        std::to_string(stream.components) + " components; give it 1 to 4");
        }
    }
    const std::size_t indices = mesh.indices.size();
    const std::size_t rest = indices - std::min<std::size_t>(part.first, indices);
    if (part.first > indices || (part.count != MeshPart{}.count && part.count > rest)) {
        const std::string length = part.count != MeshPart{}.count ? ", " + std::to_string(part.count) + " long," : "";
        return fail(name + "the part from index " + std::to_string(part.first) + " on" + length +
                    " is not within its " + std::to_string(indices) + " indices; choose first and count within them");
    }

    const std::vector<StreamView> streams = streamsOf(mesh);
    const std::size_t meshVertices = vertexCountOf(streams, mesh);
    Draw draw = {mesh.name,
                 &programs,
                 programs.copyVertexProgram(vertexProgram),
                 programs.copyFragmentProgram(fragmentProgram),
                 state,
                 {},
                 {},
                 {}};
    if (state.primitive == Primitive::lines) draw.state.depthBias = {};
    const std::size_t used = std::min<std::size_t>(part.count, rest);
    if (used == 0 || part.instances == 0) return draw;
    for (const Field& field : programs.vertexData) {
        const Expected<StreamView> stream = findStream(streams, field, mesh, meshVertices, part.instances);
        if (!stream) return tl::unexpected(stream.error());
        draw.streams.push_back(*stream);
    }
    for (const Field& field : programs.interpolators) {
        for (int c = 0; c < field.components && field.systemValue == SystemValue::clipDistance; ++c) {
            draw.geometry.clipDistances[static_cast<std::size_t>(draw.geometry.clipDistanceCount++)] =
                static_cast<std::uint8_t>(draw.interpolations.size() + static_cast<std::size_t>(c));
        }
        if (isInterpolated(field.systemValue))
            draw.interpolations.insert(draw.interpolations.end(), static_cast<std::size_t>(field.components),
                                       field.interpolation);
    }

    DrawGeometry& g = draw.geometry;
    const std::uint32_t* const first = mesh.indices.data() + part.first;
    std::size_t firstVertex = 0, vertices = meshVertices;
    if (used < indices) {  // a part of the mesh: of the vertices, too
        const auto [low, high] = std::minmax_element(first, first + used);
        firstVertex = std::min<std::size_t>(*low, meshVertices);
        vertices = std::min<std::size_t>(std::size_t{*high} + 1, meshVertices) - firstVertex;
    }
    constexpr std::uint64_t most = kClippedVertex - 1;  // products of 64 bits wherever this runs
    if (std::uint64_t{vertices} * part.instances > most || std::uint64_t{used} * part.instances > most) {
        return fail(name + std::to_string(part.instances) + " instances of " + std::to_string(vertices) +
                    " vertices are more than 2^31; draw them in parts");
    }
    g.indices = first;
    g.primitivesPerInstance = static_cast<std::uint32_t>(used / (state.primitive == Primitive::lines ? 2 : 3));
    g.firstVertex = static_cast<std::uint32_t>(firstVertex);
    g.verticesPerInstance = static_cast<std::uint32_t>(vertices);
    draw.instances = part.instances;
    g.componentCount = static_cast<std::uint32_t>(programs.components);
    g.componentStride = (g.componentCount + 3) & ~3u;
    g.interpolations = draw.interpolations.data();
    const auto interpolates = [&draw](Interpolation how) {
        return std::find(draw.interpolations.begin(), draw.interpolations.end(), how) != draw.interpolations.end();
    };
    g.hasFlat = interpolates(Interpolation::flat);
    g.hasCentroid = interpolates(Interpolation::centroid);
    g.primitive = state.primitive;
    g.lineWidth = state.lineWidth;
    g.cull = state.cull;
    g.depthClip = state.depthClip;
    return draw;
}

void Draw::fitTo(const Framebuffer& target)
{
    DrawGeometry& g = geometry;
    g.bounds = intersect(window, {0, 0, target.width(), target.height()});
    g.sampleReach = target.samples().reach;
    const bool isSeen = g.bounds.x0 < g.bounds.x1 && g.bounds.y0 < g.bounds.y1 && g.verticesPerInstance > 0;
    g.primitiveCount = isSeen ? g.primitivesPerInstance * instances : 0;
    g.vertexCount = g.primitiveCount > 0 ? g.verticesPerInstance * instances : 0;
}

}  // namespace relief::inline RELIEF_WIDTH
