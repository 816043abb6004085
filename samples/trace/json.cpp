#include <cmath>

#include <nlohmann/json.hpp>

#include "relief/bits.h"
#include "trace/tell.h"
#include "trace/words.h"

namespace relief::samples::trace {

namespace {

using Json = nlohmann::ordered_json;

// JSON has no NaN and no infinities: they are words.
Json numberOf(float value)
{
    if (std::isnan(value)) return "NaN";
    if (std::isinf(value)) return value < 0 ? "-Infinity" : "Infinity";
    return value;
}

template <class Numbers>
Json listOfNumbers(const Numbers& numbers)
{
    Json list = Json::array();
    for (const float value : numbers) list.push_back(numberOf(value));
    return list;
}

Json jsonOf(const t::QuadValue& value, int pixel)
{
    Json list = Json::array();
    for (int c = 0; c < value.rows * value.columns; ++c) {
        const std::uint32_t word = value.words[static_cast<std::size_t>(pixel)][static_cast<std::size_t>(c)];
        if (value.kind == t::ValueKind::truth) {
            list.push_back(word != 0);
        } else if (value.kind == t::ValueKind::integer) {
            list.push_back(static_cast<std::int32_t>(word));
        } else {
            list.push_back(numberOf(bitCast<float>(word)));
        }
    }
    return list;
}

Json quadOf(const t::QuadValue& value)
{
    return {jsonOf(value, 0), jsonOf(value, 1), jsonOf(value, 2), jsonOf(value, 3)};
}

const char* nameOf(t::SampleOutcome::Verdict verdict)
{
    static constexpr const char* kNames[] = {"missed", "failsStencil", "failsDepth", "discarded", "drawn"};
    return kNames[static_cast<std::size_t>(verdict)];
}

const char* nameOf(t::PrimitiveTrace::Verdict verdict)
{
    static constexpr const char* kNames[] = {"covers", "misses", "facesAway", "hasNoSample", "clippedAway"};
    return kNames[static_cast<std::size_t>(verdict)];
}

Json jsonOf(const t::TexelTrace& texel)
{
    return {{"x", texel.x},
            {"y", texel.y},
            {"border", texel.isBorder},
            {"codes", texel.codes},
            {"value", listOfNumbers(texel.value)}};
}

Json jsonOf(const t::SampleTrace& s)
{
    Json taps = Json::array();
    for (const t::TapTrace& tap : s.taps) {
        Json levels = Json::array();
        for (const t::LevelTrace& level : tap.levels) {
            Json texels = Json::array();
            for (std::size_t i = 0; i < (level.isNearest ? 1u : 4u); ++i) texels.push_back(jsonOf(level.texels[i]));
            levels.push_back({{"level", level.level},
                              {"size", {level.width, level.height}},
                              {"weightRight", level.weightX},
                              {"weightUp", level.weightY},
                              {"texels", texels}});
        }
        taps.push_back(
            {{"uv", listOfNumbers(std::array{tap.u, tap.v})}, {"secondLevel", tap.between}, {"levels", levels}});
    }
    Json all = {{"function", t::nameOf(s.function)},
                {"asked", s.isAsked},
                {"size", {s.width, s.height}},
                {"format", wordsOf(s.format)},
                {"levels", s.levelCount},
                {"filter", wordsOf(s.filter)},
                {"coordinate", listOfNumbers(s.coordinate)},
                {"ddx", listOfNumbers(s.dx)},
                {"ddy", listOfNumbers(s.dy)}};
    if (s.choosesLevel) {
        all["levelOfDetail"] = numberOf(s.levelOfDetail);
        all["level"] = static_cast<float>(s.fixedLevel) / 256.0f;
        all["anisotropy"] = numberOf(s.anisotropy);
    }
    if (s.face >= 0) all["face"] = kCubeFaceNames[static_cast<std::size_t>(s.face)];
    all["taps"] = taps;
    all["result"] = listOfNumbers(s.result);
    return all;
}

Json eventsOf(const t::FragmentTrace& f, const Subject& subject)
{
    Json list = Json::array();
    for (const t::Event& event : f.events) {
        if (event.kind == t::Event::Kind::leave) {
            list.push_back({{"event", "leave"}});
            continue;
        }
        const bool isEnter = event.kind == t::Event::Kind::enter;
        Json one = {{"event", isEnter                                ? "enter"
                              : event.kind == t::Event::Kind::sample ? "sample"
                                                                     : "value"},
                    {"file", event.site.file},
                    {"line", event.site.line},
                    {"function", event.site.function}};
        if (!isEnter) {
            one["name"] = event.site.name + event.field;
            one["quad"] = quadOf(event.value);
            if (const std::string code = subject.line(event.site); !code.empty()) one["code"] = code;
        }
        if (event.kind == t::Event::Kind::sample) one["texture"] = jsonOf(f.textures[event.sample]);
        list.push_back(std::move(one));
    }
    return list;
}

Json jsonOf(const t::FragmentTrace& f, const Subject& subject)
{
    Json samples = Json::array(), interpolators = Json::array(), targets = Json::array();
    for (const t::SampleOutcome& o : f.samples) {
        samples.push_back({{"verdict", nameOf(o.verdict)},
                           {"edges", o.edges},
                           {"depth", numberOf(o.depth)},
                           {"depthBefore", numberOf(o.depthBefore)},
                           {"depthAfter", numberOf(o.depthAfter)},
                           {"stencilBefore", o.stencilBefore},
                           {"stencilAfter", o.stencilAfter}});
    }
    for (const t::InterpolatorTrace& i : f.interpolators) {
        Json corners = Json::array();
        for (const auto& words : i.corners) {
            t::QuadValue corner = i.here;
            std::copy(words.begin(), words.end(), corner.words[0].begin());
            corners.push_back(jsonOf(corner, 0));
        }
        interpolators.push_back({{"semantic", i.semantic},
                                 {"interpolation", wordsOf(i.how)},
                                 {"corners", corners},
                                 {"quad", quadOf(i.here)}});
    }
    for (const t::TargetOutcome& o : f.targets) {
        Json merged = Json::array();
        for (const t::TargetOutcome::Sample& s : o.samples) {
            merged.push_back({{"before", listOfNumbers(s.before)}, {"after", listOfNumbers(s.after)}});
        }
        targets.push_back({{"target", o.target},
                           {"format", wordsOf(o.format)},
                           {"returned", listOfNumbers(o.returned)},
                           {"wasInvalid", o.wasInvalid},
                           {"samples", merged}});
    }
    Json all = {{"weightsOnScreen", listOfNumbers(f.linear)},
                {"weightsInSpace", listOfNumbers(f.perspective)},
                {"samples", samples},
                {"ran", f.ran}};
    if (!f.ran) return all;
    all["interpolators"] = interpolators;
    all["events"] = eventsOf(f, subject);
    all["discarded"] = f.discarded;
    if (f.depthOut) all["SV_Depth"] = numberOf(*f.depthOut);
    if (f.coverageOut) all["SV_Coverage"] = *f.coverageOut;
    all["targets"] = targets;
    return all;
}

Json jsonOf(const t::PieceTrace& p, const Subject& subject)
{
    Json edges = Json::array();
    for (const t::EdgeTrace& e : p.edges)
        edges.push_back({{"value", e.value}, {"topLeft", e.isTopLeft}, {"inside", e.isInside}});
    Json all = {{"x", p.x},
                {"y", p.y},
                {"depth", listOfNumbers(p.z)},
                {"inverseW", listOfNumbers(p.invW)},
                {"edges", edges},
                {"doubledArea", p.doubledArea}};
    if (p.fragment) all["fragment"] = jsonOf(*p.fragment, subject);
    return all;
}

}  // namespace

std::string toJson(const PixelTrace& trace, const Subject& subject, bool inOneLine)
{
    Json draws = Json::array();
    for (const t::DrawTrace& draw : trace.draws) {
        Json primitives = Json::array();
        for (const t::PrimitiveTrace& p : draw.primitives) {
            Json pieces = Json::array();
            for (const t::PieceTrace& piece : p.pieces) pieces.push_back(jsonOf(piece, subject));
            primitives.push_back({{"number", p.number},
                                  {"instance", p.instance},
                                  {"verdict", nameOf(p.verdict)},
                                  {"vertices", p.vertices},
                                  {"clippedBy", p.clippedBy},
                                  {"pieces", pieces}});
        }
        draws.push_back({{"number", draw.number},
                         {"mesh", draw.mesh},
                         {"state", wordsOf(draw.state)},
                         {"primitiveCount", draw.primitiveCount},
                         {"primitives", primitives}});
    }
    const Json all = {{"stage", subject.stage},
                      {"command", subject.command},
                      {"pixel", {trace.x, trace.y}},
                      {"size", {trace.width, trace.height}},
                      {"samples", trace.sampleCount},
                      {"stored", trace.stored},
                      {"draws", draws}};
    return all.dump(inOneLine ? -1 : 1) + "\n";
}

std::string errorToJson(const std::string& message)
{
    return Json({{"error", message}}).dump() + "\n";
}

}  // namespace relief::samples::trace
