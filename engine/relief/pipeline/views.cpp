#include "relief/pipeline/views.h"

#include <algorithm>
#include <string_view>

#include "relief/lanes/environment.h"
#include "relief/pipeline/frame_storage.h"

namespace relief::inline RELIEF_WIDTH {

namespace {

// Any numbers, other ones in every field, component and lane. Integers and ids stay 0, as a program may count with
// them.
VertexLanes someVertices(Fields vertexData, std::size_t changed)
{
    VertexLanes vertices;
    for (std::size_t f = 0; f < vertexData.size(); ++f) {
        for (int c = 0; c < 4; ++c) {
            const float base = 0.3f + 0.11f * static_cast<float>(f) + 0.07f * static_cast<float>(c);
            const bool isNumber = vertexData[f].systemValue != SystemValue::id && !vertexData[f].isInteger;
            vertices.in[f][c] = isNumber ? Float(laneXs()) * 0.013f + (f == changed ? base + 0.27f : base) : 0.0f;
        }
    }
    return vertices;
}

// The fields of VertexData that an interpolator is made from, by name: those that change it when they change.
std::vector<std::string> sourcesOf(const Draw& draw, const Slots& slots)
{
    const DefaultFloatingPoint environment;
    const ShadingScope aside;
    const Programs& programs = *draw.programs;
    VertexLanes plain = someVertices(programs.vertexData, programs.vertexData.size());
    programs.shadeVertices(draw.vertexProgram.get(), plain);
    std::vector<std::string> sources;
    for (std::size_t f = 0; f < programs.vertexData.size(); ++f) {
        VertexLanes other = someVertices(programs.vertexData, f);
        programs.shadeVertices(draw.vertexProgram.get(), other);
        bool depends = false;
        for (int i = slots.first; i < slots.first + slots.count; ++i)
            depends = depends || any(asInt(plain.components[i]) != asInt(other.components[i]));
        if (depends) sources.push_back(semanticOf(programs.vertexData[f]));
    }
    return sources;
}

// Calls function(field, slots) for every interpolator until it returns true.
template <class Function>
void forEachInterpolator(const Draw& draw, const Function& function)
{
    int first = 0;
    for (const Field& field : draw.programs->interpolators) {
        if (!isInterpolated(field.systemValue)) continue;
        if (function(field, Slots{first, field.components, field.interpolation, field.isInteger})) return;
        first += field.components;
    }
}

std::string meaningOf(const Draw& draw, const Field& field, const Slots& slots)
{
    std::string meaning = field.isInteger ? "int" : "float";
    if (slots.count > 1) meaning += std::to_string(slots.count);
    const std::vector<std::string> sources = sourcesOf(draw, slots);
    for (std::size_t i = 0; i < sources.size(); ++i) {
        meaning += (i == 0 ? ", from " : i + 1 == sources.size() ? " and " : ", ") + sources[i];
    }
    if (slots.interpolation == Interpolation::affine) meaning += ", linear on the screen";
    if (slots.interpolation == Interpolation::flat) meaning += ", the first vertex's";
    if (slots.interpolation == Interpolation::centroid) meaning += ", at the centroid";
    return meaning;
}

bool isThere(const std::vector<Draw>& draws, const char* name)
{
    return std::any_of(draws.begin(), draws.end(), [&](const Draw& d) { return slotsOf(d, name).has_value(); });
}

}  // namespace

std::optional<Slots> slotsOf(const Draw& draw, const std::string& name)
{
    const std::size_t dot = name.find('.');
    const std::string whole = name.substr(0, dot);
    std::optional<Slots> found;
    forEachInterpolator(draw, [&](const Field& field, const Slots& slots) {
        const auto isFrom = [&](const char* source) {
            return sourcesOf(draw, slots) == std::vector<std::string>{source};
        };
        if (field.isInteger     ? semanticOf(field) == whole
            : whole == "normal" ? slots.count == 3 && isFrom("NORMAL")
            : whole == "uv"     ? slots.count >= 2 && isFrom("TEXCOORD0")
                                : semanticOf(field) == whole)
            found = slots;
        return found.has_value();
    });
    if (!found) return found;
    if (whole == "uv") found->count = 2;
    if (dot == std::string::npos) return found;
    const std::size_t component = name.size() == dot + 2 ? std::string_view("xyzw").find(name[dot + 1]) : 4;
    if (component >= static_cast<std::size_t>(found->count)) return {};
    return Slots{found->first + static_cast<int>(component), 1, found->interpolation, found->isInteger};
}

std::vector<View> viewsOf(const Frame& frame)
{
    const std::vector<Draw>& draws = frame.internals().draws;
    std::vector<View> views = {{"color", "the picture", "", Sight::color},
                               {"depth", "0 near, 1 far", "", Sight::depth}};
    if (isThere(draws, "normal")) views.push_back({"normal", "as interpolated", "", Sight::interpolator});
    if (isThere(draws, "uv")) views.push_back({"uv", "the fraction of each", "", Sight::interpolator});
    for (const Draw& draw : draws) {
        forEachInterpolator(draw, [&](const Field& field, const Slots& slots) {
            const auto same = [&](const View& view) { return view.name == semanticOf(field); };
            if (std::none_of(views.begin(), views.end(), same))
                views.push_back({semanticOf(field), meaningOf(draw, field, slots), "", Sight::interpolator});
            return false;
        });
    }
    const std::string lanes = std::to_string(kLanes);
    const std::string tile = std::to_string(frame.internals().tileSize);
    const std::vector<View> costs = {
        {"mip", "coarsest level that is sampled", "level", Sight::mipLevel},
        {"triangles", "a colour for each", "", Sight::triangles},
        {"blocks", "of " + lanes + " pixels; tiles of " + tile + " x " + tile, "", Sight::blocks},
        {"overdraw", "runs of a fragment program", "runs", Sight::overdraw},
        {"lanes", "in use, of the " + lanes + " of a block", "lanes", Sight::lanes},
        {"samples", "of textures, by all runs", "samples", Sight::samples},
        {"time", "of the pixel's blocks, measured", "ns", Sight::time},
    };
    views.insert(views.end(), costs.begin(), costs.end());
    return views;
}

Expected<View> findView(const Frame& frame, const std::string& name)
{
    const std::string whole = name.substr(0, name.find('.'));
    std::string names;
    for (View& view : viewsOf(frame)) {
        names += (names.empty() ? "" : ", ") + view.name;
        if (view.name == name) return view;
        if (view.name != whole || view.sight != Sight::interpolator) continue;
        if (isThere(frame.internals().draws, name.c_str())) {
            view.name = name;
            return view;
        }
    }
    return fail("there is no view '" + name + "' of this frame; it has " + names);
}

}  // namespace relief::inline RELIEF_WIDTH
