#include "trace/tell.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <sstream>

#include "trace/words.h"

namespace relief::samples::trace {

namespace {

using t::Event;
using t::QuadValue;

Node leaf(std::string label, std::string value)
{
    Node node;
    node.label = std::move(label);
    node.value = std::move(value);
    return node;
}

std::string position(int x, int y)
{
    return std::to_string(x) + "," + std::to_string(y);
}

bool isEquality(Compare compare)
{
    return compare == Compare::equal || compare == Compare::notEqual;
}

bool endsWithAnyOf(const std::string& name, std::initializer_list<std::string_view> ends)
{
    std::string lower = name;
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](char c) { return static_cast<char>(std::tolower(c)); });
    return std::any_of(ends.begin(), ends.end(), [&](std::string_view end) { return lower.ends_with(end); });
}

// What a program says, of one of a quad's four pixels.
class ProgramTeller
{
public:
    ProgramTeller(const Subject& its, int ofQuad, bool tellsQuad = true)
        : subject(its), pixel(ofQuad), hasQuad(tellsQuad)
    {
    }

    Node program(const std::vector<Event>& events, const std::vector<t::SampleTrace>& textures)
    {
        Node node = leaf("program", events.empty() ? "its lines are not told" : "");
        std::size_t next = 0;
        addEvents(events, textures, next, node);
        return node;
    }

    // A value here, and in the quad where it is not the same there.
    Node valueNode(const std::string& label, const QuadValue& value) const
    {
        Node node = leaf(label, valueOf(value, pixel));
        node.isInvalid = isInvalid(value, pixel);
        if (value.kind == t::ValueKind::number && value.columns == 1 && value.rows >= 3) {
            const std::array<float, 3> xyz = {value.number(pixel, 0), value.number(pixel, 1), value.number(pixel, 2)};
            const float length = std::sqrt(xyz[0] * xyz[0] + xyz[1] * xyz[1] + xyz[2] * xyz[2]);
            if (endsWithAnyOf(label, {"normal", "dir", "tangent", "binormal", "direction"}) ||
                (std::abs(length - 1.0f) < 1e-3f && (xyz[0] < 0 || xyz[1] < 0 || xyz[2] < 0))) {
                node.direction = xyz;
            } else if (!endsWithAnyOf(label, {"pos", "position", "uv"}) && !label.starts_with("TEXCOORD")) {
                node.color = xyz;
            }
        }
        if (!hasQuad || isEverywhereSame(value)) return node;
        Quad& quad = node.quad.emplace();
        quad.pixel = pixel;
        for (int p = 0; p < 4; ++p) quad.values[static_cast<std::size_t>(p)] = valueOf(value, p);
        if (value.kind == t::ValueKind::number) {
            quad.ddx = differenceOf(value, pixel, false);
            quad.ddy = differenceOf(value, pixel, true);
        }
        return node;
    }

private:
    // What a function's run says, up to its end.
    void addEvents(const std::vector<Event>& events, const std::vector<t::SampleTrace>& textures, std::size_t& next,
                   Node& to) const
    {
        while (next < events.size()) {
            const Event& event = events[next++];
            if (event.kind == Event::Kind::leave) return;
            if (event.kind == Event::Kind::enter) {
                Node call = leaf(event.site.function, "");
                call.place = place(event.site);
                addEvents(events, textures, next, call);
                call.isFolded = std::string_view(event.site.file) != subject.file;
                call.isInvalid = std::any_of(call.children.begin(), call.children.end(),
                                             [](const Node& child) { return child.isInvalid; });
                if (!call.children.empty()) to.children.push_back(std::move(call));
                continue;
            }
            if (event.kind == Event::Kind::sample) {
                to.children.push_back(textureNode(textures[event.sample], event));
                continue;
            }
            Node node = valueNode(event.site.name + event.field, event.value);
            node.line = event.site.line;
            node.code = subject.line(event.site);
            to.children.push_back(std::move(node));
        }
    }

    static std::string place(const t::Site& site) { return std::string(site.file) + ":" + std::to_string(site.line); }

    Node textureNode(const t::SampleTrace& s, const Event& event) const
    {
        Node node = valueNode(t::nameOf(s.function), event.value);
        node.line = s.site.line;
        node.code = subject.line(s.site);
        if (!s.isAsked) {
            node.value = "not asked for";
            return node;
        }
        const bool isCube = s.face >= 0;
        const std::size_t dimensions = isCube ? 3 : 2;
        node.children.push_back(leaf(
            "texture", (isCube ? "cube map, " : "") + std::to_string(s.width) + "x" + std::to_string(s.height) + " " +
                           wordsOf(s.format) + ", " + std::to_string(s.levelCount) + " levels; " + wordsOf(s.filter) +
                           (isCube ? "" : ", " + wordsOf(s.addressU) + ", " + wordsOf(s.addressV))));
        node.children.push_back(leaf(isCube ? "direction" : "uv", listOf(std::span(s.coordinate).first(dimensions))));
        if (isCube && !s.taps.empty()) {
            node.children.push_back(leaf("face", std::string(kCubeFaceNames[static_cast<std::size_t>(s.face)]) +
                                                     ", at " + number(s.taps[0].u) + " " + number(s.taps[0].v)));
        }
        if (s.choosesLevel) {
            if (s.function != t::TextureFunction::tex2Dlod && s.function != t::TextureFunction::texCUBElod) {
                node.children.push_back(leaf("change", "to the right " + listOf(std::span(s.dx).first(dimensions)) +
                                                           "; down " + listOf(std::span(s.dy).first(dimensions))));
            }
            std::string level =
                number(s.levelOfDetail) + "; within limits " + number(static_cast<float>(s.fixedLevel) / 256.0f);
            if (s.anisotropy > 1.0f) level += "; the footprint is " + number(s.anisotropy) + " times as long as wide";
            node.children.push_back(leaf("level of detail", level));
        }
        if (s.function == t::TextureFunction::SampleCmp)
            node.children.push_back(leaf("compared", number(s.extra) + " " + wordsOf(s.comparison) + " the texel"));
        for (std::size_t i = 0; i < s.taps.size(); ++i) {
            if (s.taps.size() == 1) {
                addTap(s.taps[i], s, node);
            } else {
                Node tap = leaf("tap " + std::to_string(i), number(s.taps[i].u) + " " + number(s.taps[i].v));
                addTap(s.taps[i], s, tap);
                node.children.push_back(std::move(tap));
            }
        }
        return node;
    }

    static void addTap(const t::TapTrace& tap, const t::SampleTrace& s, Node& to)
    {
        for (std::size_t l = 0; l < tap.levels.size(); ++l) {
            const t::LevelTrace& level = tap.levels[l];
            std::string value = std::to_string(level.width) + "x" + std::to_string(level.height);
            if (tap.levels.size() > 1)
                value += ", weight " + std::to_string(l == 0 ? 256 - tap.between : tap.between) + "/256";
            if (!level.isNearest)
                value +=
                    ", " + std::to_string(level.weightX) + "/4096 right, " + std::to_string(level.weightY) + "/4096 up";
            Node node = leaf("level " + std::to_string(level.level), value);
            for (std::size_t i = 0; i < (level.isNearest ? 1u : 4u); ++i) {
                const t::TexelTrace& texel = level.texels[i];
                std::string words;
                const bool isFloat = s.format == TexelFormat::rgba32Float || s.format == TexelFormat::r32Float;
                for (std::size_t c = 0; c < 4 && !texel.isBorder && !isFloat; ++c)
                    words += std::to_string(texel.codes[c]) + " ";
                words += (texel.isBorder ? "the border: " : isFloat ? "" : "= ") + listOf(texel.value);
                const bool isNeighbours =
                    s.face >= 0 && (std::min(texel.x, texel.y) < 0 || std::max(texel.x, texel.y) >= level.width);
                if (isNeighbours) words += ", beyond the face's edge";
                node.children.push_back(leaf("texel " + position(texel.x, texel.y), words));
                node.children.back().color = {texel.value[0], texel.value[1], texel.value[2]};
            }
            to.children.push_back(std::move(node));
        }
    }

protected:
    const Subject& subject;
    const int pixel;  // of the quad
    const bool hasQuad;
};

class PixelTeller : private ProgramTeller
{
public:
    PixelTeller(const PixelTrace& itsTrace, const Subject& its)
        : ProgramTeller(its, (itsTrace.y & 1) * 2 + (itsTrace.x & 1)), trace(itsTrace)
    {
    }

    Node tell()
    {
        Node all =
            leaf(subject.stage, "pixel " + position(trace.x, trace.y) + " of " + std::to_string(trace.width) + "x" +
                                    std::to_string(trace.height) + ", " + std::to_string(trace.sampleCount) +
                                    (trace.sampleCount == 1 ? " sample" : " samples"));
        all.children.push_back(leaf("tile", "from " + position(trace.tileX, trace.tileY) + ", " +
                                                std::to_string(trace.tileSize) + "x" + std::to_string(trace.tileSize) +
                                                "; the pixel's centre is " + pixels(trace.x * 256 + 128) + "," +
                                                pixels(trace.y * 256 + 128)));
        if (trace.cleared[0]) {
            const glm::vec4& c = *trace.cleared[0];
            all.children.push_back(leaf("cleared to", listOf(std::array{c.x, c.y, c.z, c.w}) + ", linear"));
            all.children.back().color = {c.x, c.y, c.z};
        }
        int without = 0;
        bool isCovered = false;
        for (const t::DrawTrace& draw : trace.draws) {
            const bool isShown = !draw.primitives.empty();
            without += isShown ? 0 : 1;
            for (const t::PrimitiveTrace& p : draw.primitives)
                isCovered |= p.verdict == t::PrimitiveTrace::Verdict::covers;
            if (isShown) all.children.push_back(drawNode(draw));
        }
        if (without > 0)
            all.children.push_back(leaf("other draws", std::to_string(without) + ", with no triangle within a pixel"));
        if (!isCovered)
            all.children.push_back(leaf("background", "no triangle covers it: what it was cleared to stays"));
        all.children.push_back(storedNode());
        return all;
    }

private:
    Node storedNode() const
    {
        Node node = leaf("stored", storedText(trace.format, trace.storedWords) + " (" + wordsOf(trace.format) + ")");
        if (trace.sampleCount > 1) node.value += ", the mean of the samples in linear light";
        return node;
    }

    Node drawNode(const t::DrawTrace& draw)
    {
        Node node = leaf("draw " + std::to_string(draw.number), draw.mesh + ", " + std::to_string(draw.primitiveCount) +
                                                                    " primitives; " + wordsOf(draw.state));
        for (const t::PrimitiveTrace& p : draw.primitives) node.children.push_back(primitiveNode(draw, p));
        return node;
    }

    Node primitiveNode(const t::DrawTrace& draw, const t::PrimitiveTrace& p)
    {
        const bool isLine = draw.state.primitive == Primitive::lines;
        std::string label = (isLine ? "line " : "triangle ") + std::to_string(p.number);
        if (p.instance > 0) label += " of instance " + std::to_string(p.instance);
        std::string value = wordsOf(p.verdict) + "; vertices";
        for (std::size_t k = 0; k < (isLine ? 2u : 3u); ++k) value += " " + std::to_string(p.vertices[k]);
        if (p.verdict == t::PrimitiveTrace::Verdict::misses) {
            double nearest = 1e30;
            for (const t::PieceTrace& piece : p.pieces) nearest = std::min(nearest, piece.distance);
            if (nearest > 0) value += "; " + rounded(nearest) + " pixels away";
        }
        Node node = leaf(std::move(label), std::move(value));
        if (!p.clippedBy.empty()) {
            std::string planes;
            for (const std::string& plane : p.clippedBy) planes += (planes.empty() ? "" : ", ") + plane;
            node.children.push_back(leaf("clipped", "beyond " + planes + "; into " + std::to_string(p.pieces.size()) +
                                                        (p.pieces.size() == 1 ? " triangle" : " triangles")));
        }
        int number = 0;
        for (const t::PieceTrace& piece : p.pieces) {
            ++number;
            if (p.pieces.size() == 1) {
                addPiece(piece, draw, node);
                continue;
            }
            Node part =
                leaf("piece " + std::to_string(number), piece.fragment ? "covers the pixel" : "does not cover it");
            addPiece(piece, draw, part);
            part.isFolded = !piece.fragment;
            node.children.push_back(std::move(part));
        }
        node.isFolded = p.verdict != t::PrimitiveTrace::Verdict::covers;
        return node;
    }

    static std::string rounded(double value)
    {
        char text[32];
        std::snprintf(text, sizeof text, "%.3f", value);
        return text;
    }

    void addPiece(const t::PieceTrace& piece, const t::DrawTrace& draw, Node& to)
    {
        for (std::size_t k = 0; k < 3; ++k) {
            to.children.push_back(leaf("corner " + std::to_string(k), pixels(piece.x[k]) + "," + pixels(piece.y[k]) +
                                                                          ", depth " + number(piece.z[k]) + ", 1/w " +
                                                                          number(piece.invW[k])));
        }
        if (piece.wasTurned)
            to.children.push_back(leaf("turned", "counter-clockwise on screen; two corners changed places"));
        for (std::size_t k = 0; k < 3; ++k) {
            const t::EdgeTrace& edge = piece.edges[k];
            std::string value = std::to_string(edge.value);
            if (edge.value == 0) {
                value += edge.isTopLeft ? ": on it, and it is a top or left edge: inside"
                                        : ": on it, and it is no top or left edge: outside";
            } else {
                value += edge.isInside ? ": inside" : ": outside";
            }
            to.children.push_back(leaf("edge " + std::to_string(k), value));
        }
        to.children.push_back(
            leaf("area", std::to_string(piece.doubledArea) + ", the sum of the three, in 1/65536 px\u00b2, doubled"));
        if (piece.fragment) addFragment(*piece.fragment, draw, to);
    }

    void addFragment(const t::FragmentTrace& f, const t::DrawTrace& draw, Node& to)
    {
        to.children.push_back(
            leaf("weights", listOf(f.linear) + " on the screen; " + listOf(f.perspective) + " in space"));
        for (std::size_t s = 0; s < f.samples.size(); ++s) to.children.push_back(sampleNode(f, draw, s));
        if (!f.ran) {
            const bool hasColor = !f.targets.empty();
            to.children.push_back(leaf("program", hasColor ? "does not run: nothing of the pixel is left to draw"
                                                           : "does not run: no colour is asked for"));
            return;
        }
        for (const t::InterpolatorTrace& i : f.interpolators) to.children.push_back(interpolatorNode(i));
        to.children.push_back(program(f.events, f.textures));
        if (f.discarded) to.children.push_back(leaf("discarded", "by the program"));
        if (f.depthOut) to.children.push_back(leaf("SV_Depth", number(*f.depthOut)));
        if (f.coverageOut) to.children.push_back(leaf("SV_Coverage", std::to_string(*f.coverageOut)));
        for (const t::TargetOutcome& target : f.targets) {
            if (!f.discarded) to.children.push_back(targetNode(target, f, draw));
        }
    }

    Node sampleNode(const t::FragmentTrace& f, const t::DrawTrace& draw, std::size_t s) const
    {
        const t::SampleOutcome& o = f.samples[s];
        std::string value = wordsOf(o.verdict);
        if (f.samples.size() > 1) {
            value += "; edges";
            for (const std::int64_t edge : o.edges) value += " " + std::to_string(edge);
        }
        if (o.verdict != t::SampleOutcome::Verdict::missed) {
            value += "; depth " + number(o.depth) + ", " + wordsOf(draw.state.depthTest) +
                     (isEquality(draw.state.depthTest) ? " to " : " than ") + number(o.depthBefore) +
                     (o.depthAfter != o.depthBefore ? ", written" : "");
            if (draw.state.stencil.isUsed())
                value += "; stencil " + std::to_string(o.stencilBefore) + " becomes " + std::to_string(o.stencilAfter);
        }
        return leaf(f.samples.size() == 1 ? "tests" : "sample " + std::to_string(s), value);
    }

    Node interpolatorNode(const t::InterpolatorTrace& i) const
    {
        Node node = valueNode(i.semantic, i.here);
        node.value += " (" + wordsOf(i.how) + ")";
        for (std::size_t k = 0; k < 3; ++k) {
            QuadValue corner = i.here;
            for (std::size_t c = 0; c < 4; ++c) corner.words[0][c] = i.corners[k][c];
            node.children.push_back(leaf("corner " + std::to_string(k), valueOf(corner, 0)));
        }
        node.isFolded = true;
        return node;
    }

    Node targetNode(const t::TargetOutcome& o, const t::FragmentTrace& f, const t::DrawTrace& draw) const
    {
        Node node = leaf(f.targets.size() > 1 ? "target " + std::to_string(o.target) : "colour", listOf(o.returned));
        node.color = {o.returned[0], o.returned[1], o.returned[2]};
        if (o.wasInvalid) {
            node.value += ", after NaN and infinities were replaced";
            node.isInvalid = true;
        }
        for (std::size_t s = 0; s < o.samples.size(); ++s) {
            if (f.samples[s].verdict != t::SampleOutcome::Verdict::drawn) continue;
            const t::TargetOutcome::Sample& sample = o.samples[s];
            const auto count = static_cast<std::size_t>(wordsPerPixel(o.format));
            Node merged = leaf(o.samples.size() > 1 ? "sample " + std::to_string(s) : "merged",
                               wordsOf(draw.state.blend) + " " + listOf(sample.before) + "; stored as " +
                                   storedText(o.format, std::span(sample.wordsAfter).first(count)));
            merged.color = {sample.after[0], sample.after[1], sample.after[2]};
            node.children.push_back(std::move(merged));
        }
        return node;
    }

    const PixelTrace& trace;
};

void writeText(const Node& node, bool all, int depth, std::string& text, const std::string& lastCode)
{
    const std::string indent(static_cast<std::size_t>(depth) * 2, ' ');
    if (!node.code.empty() && node.code != lastCode) text += indent + "| " + node.code + "\n";
    const std::string& value = node.place.empty() ? node.value : node.place;
    text += indent + titleOf(node) + (value.empty() ? "" : ": " + value) + (node.isInvalid ? "   <- not finite" : "") +
            "\n";
    if (node.quad) {
        const Quad& q = *node.quad;
        text +=
            indent + "  quad [" + q.values[0] + "] [" + q.values[1] + "] [" + q.values[2] + "] [" + q.values[3] + "]";
        text += (q.ddx.empty() ? "" : "  ddx " + q.ddx + "  ddy " + q.ddy) + "\n";
    }
    if (node.isFolded && !all && !node.isInvalid) return;
    std::string code;
    for (const Node& child : node.children) {
        writeText(child, all, depth + 1, text, code);
        if (!child.code.empty()) code = child.code;
    }
}

// Pairs of what has the same label in both lists, in order, as many as there can be (the longest common subsequence);
// and between them what only one has: null stands for the other.
std::vector<std::pair<const Node*, const Node*>> paired(const std::vector<Node>& a, const std::vector<Node>& b)
{
    std::vector<std::vector<int>> count(a.size() + 1, std::vector<int>(b.size() + 1, 0));
    for (std::size_t i = a.size(); i-- > 0;) {
        for (std::size_t j = b.size(); j-- > 0;) {
            count[i][j] =
                a[i].label == b[j].label ? count[i + 1][j + 1] + 1 : std::max(count[i + 1][j], count[i][j + 1]);
        }
    }
    std::vector<std::pair<const Node*, const Node*>> pairs;
    std::size_t i = 0, j = 0;
    while (i < a.size() || j < b.size()) {
        if (i < a.size() && j < b.size() && a[i].label == b[j].label) {
            pairs.emplace_back(&a[i++], &b[j++]);
        } else if (j == b.size() || (i < a.size() && count[i + 1][j] >= count[i][j + 1])) {
            pairs.emplace_back(&a[i++], nullptr);
        } else {
            pairs.emplace_back(nullptr, &b[j++]);
        }
    }
    return pairs;
}

// `way`: the labels of what the nodes are in.
std::string differenceInside(const Node& a, const Node& b, const std::string& nameA, const std::string& nameB,
                             const std::string& way)
{
    const auto said = [](const Node* node, const std::string& value) {
        if (node == nullptr) return std::string("has no such value");
        return titleOf(*node) + (value.empty() ? "" : ": " + value) + (node->code.empty() ? "" : "  | " + node->code);
    };
    const auto both = [&](const Node* first, const std::string& firstValue, const Node* second,
                          const std::string& secondValue) {
        return way + nameA + ": " + said(first, firstValue) + "\n" + nameB + ": " + said(second, secondValue);
    };
    for (const auto& [first, second] : paired(a.children, b.children)) {
        if (first == nullptr) return both(nullptr, "", second, second->value);
        if (second == nullptr) return both(first, first->value, nullptr, "");
        if (first->value != second->value) return both(first, first->value, second, second->value);
        if (first->quad && second->quad) {
            for (std::size_t p = 0; p < 4; ++p) {
                const std::string &one = first->quad->values[p], &other = second->quad->values[p];
                static constexpr const char* kPlaces[] = {"upper left", "upper right", "lower left", "lower right"};
                const std::string place = std::string(" in the quad's ") + kPlaces[p] + " pixel";
                if (one != other) return both(first, one + place, second, other + place);
            }
        }
        const std::string inside = differenceInside(*first, *second, nameA, nameB, way + titleOf(*first) + "\n");
        if (!inside.empty()) return inside;
    }
    return "";
}

}  // namespace

std::string titleOf(const Node& node)
{
    return (node.line > 0 ? std::to_string(node.line) + "  " : "") + node.label;
}

Subject::Subject(const TracedStage& its, std::string itsCommand)
    : stage(its.plain->name()), command(std::move(itsCommand)), file(its.file)
{
    std::istringstream in(its.text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
}

std::string Subject::line(const t::Site& site) const
{
    if (site.file != file || site.line < 1 || static_cast<std::size_t>(site.line) > lines.size()) return "";
    const std::string& whole = lines[static_cast<std::size_t>(site.line) - 1];
    const std::size_t first = whole.find_first_not_of(" \t");
    std::size_t end = whole.find("  // new");
    if (end == std::string::npos) end = whole.find_last_not_of(" \t\r") + 1;
    while (end > 0 && whole[end - 1] == ' ') --end;
    return first == std::string::npos ? "" : whole.substr(first, end - first);
}

Node tell(const PixelTrace& trace, const Subject& subject)
{
    return PixelTeller(trace, subject).tell();
}

Node tell(const t::VertexTrace& trace, const Subject& subject)
{
    Node all = leaf(subject.stage, "vertex " + std::to_string(trace.vertex) + " of draw " + std::to_string(trace.draw) +
                                       ", " + trace.mesh);
    all.children.push_back(ProgramTeller(subject, trace.lane, false).program(trace.events, trace.textures));
    all.children.push_back(leaf("SV_POSITION", listOf(trace.clip) + ", clip space"));
    std::string sides;
    for (const std::string& side : trace.outside) sides += (sides.empty() ? "" : ", ") + side;
    if (!sides.empty()) all.children.push_back(leaf("outside of the view", sides));
    if (trace.clip[3] > 0) {
        all.children.push_back(leaf("on the screen", pixels(trace.position[0]) + "," + pixels(trace.position[1]) +
                                                         ", depth " + number(trace.depth) + ", 1/w " +
                                                         number(trace.invW)));
    }
    return all;
}

std::string toText(const Node& node, bool all)
{
    std::string text;
    writeText(node, all, 0, text, "");
    return text;
}

std::string firstDifference(const Node& a, const Node& b)
{
    return differenceInside(a, b, a.label, b.label, "");
}

}  // namespace relief::samples::trace
