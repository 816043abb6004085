// explain: what drawing a stage took, and what was left out, as counted while it ran.
#include <cstdio>
#include <cstring>

#include <nlohmann/json.hpp>

#include "trace/words.h"
#include "usage.h"

namespace relief::samples {

namespace {

struct Row
{
    const char* name;
    std::uint64_t value;
    std::string note;
};

// Without the spaces that set it below another one.
std::string nameOf(const Row& row)
{
    const std::string name = row.name;
    return name.substr(name.find_first_not_of(' '));
}

std::string percent(std::uint64_t part, std::uint64_t whole)
{
    if (whole == 0) return "";
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.1f %%", 100.0 * static_cast<double>(part) / static_cast<double>(whole));
    return buffer;
}

std::vector<Row> rows(const Usage& usage)
{
    const Statistics& s = usage.statistics;
    return {
        {"passes (draws)", s.draws, ""},
        {"passes left out", static_cast<std::uint64_t>(usage.passesLeftOut), "their light does not reach the object"},
        {"vertices shaded", s.verticesShaded, ""},
        {"triangles submitted", s.trianglesSubmitted, ""},
        {"  culled, facing away", s.culledFacing, ""},
        {"  culled, no pixel centre", s.culledNoSample, ""},
        {"  outside the view", s.outside, ""},
        {"  dropped, not a number", s.droppedNan + s.droppedInfinite + s.droppedIndex, ""},
        {"  rasterised", s.rasterised, ""},
        {"triangles clipped", s.trianglesClipped, "the others needed no clipping"},
        {"triangles binned", s.trianglesBinned, "pairs of a triangle and a tile"},
        {"tiles touched", s.tilesTouched, "of " + std::to_string(s.tiles) + "; the others were only cleared"},
        {"blocks shaded", s.blocksShaded, "of " + std::to_string(kLanes) + " lanes"},
        {"quads shaded", s.quadsShaded, ""},
        {"pixels shaded", s.pixelsShaded, percent(s.pixelsShaded, s.blocksShaded * kLanes) + " of the lanes that ran"},
        {"  without their program", s.pixelsColorless, "no target keeps what it gives"},
        {"pixels hidden", s.pixelsHidden, "failed the stencil or the depth test before any shading"},
        {"invalid colours", s.invalidColors, "NaN or infinite, replaced"},
        {"components used", static_cast<std::uint64_t>(usage.componentsUsed),
         usage.componentsUsed == usage.componentsDeclared
             ? "all that are declared"
             : "of " + std::to_string(usage.componentsDeclared) + " declared; no pixel depends on the others"},
        {"texture fetches, nearest", s.fetches.nearest, ""},
        {"texture fetches, bilinear", s.fetches.bilinear, ""},
        {"texture fetches, trilinear", s.fetches.trilinear, ""},
        {"texture fetches, anisotropic", s.fetches.anisotropic, ""},
        {"  second mip level left out", s.fetches.secondLevelSkipped, "the level of detail was a whole number, or 0"},
        {"  magnified, finest level only", s.fetches.magnified, ""},
        {"  constant textures, no fetch", s.fetches.constant, ""},
        {"  no derivatives taken", s.fetches.noDerivatives, "no level of detail to choose, or one that is given"},
        {"mip levels built", static_cast<std::uint64_t>(usage.levelsBuilt), "of " + std::to_string(usage.levelsWhole)},
    };
}

// --- passes before the picture ---

std::vector<Row> rowsOfPass(const Statistics& s)
{
    return {
        {"draws", s.draws, ""},
        {"vertices shaded", s.verticesShaded, ""},
        {"triangles submitted", s.trianglesSubmitted, ""},
        {"  rasterised", s.rasterised, ""},
        {"tiles touched", s.tilesTouched, "of " + std::to_string(s.tiles) + "; the others were only cleared"},
        {"pixels shaded", s.pixelsShaded, ""},
        {"  without their program", s.pixelsColorless, "no target keeps what it gives"},
        {"pixels hidden", s.pixelsHidden, ""},
        {"stencil tests passed", s.stencilPassed, ""},
        {"stencil tests failed", s.stencilFailed, "their pixels are not shaded"},
        {"invalid colours", s.invalidColors, "NaN or infinite, replaced"},
        {"texture fetches", s.fetches.samples(), ""},
    };
}

// "colour 1"; "colour", where there is one.
std::string nameOf(const Framebuffer& target, int attachment)
{
    if (attachment == target.depthIndex()) return "depth";
    if (attachment == target.stencilIndex()) return "stencil";
    int n = 0;
    while (target.colorIndex(n) != attachment) ++n;
    return target.colorIndex(1) < 0 ? "colour" : "colour " + std::to_string(n);
}

std::vector<std::string> writtenBy(const DrawFacts& draw, const Framebuffer& target)
{
    std::vector<std::string> names;
    for (int n = 0; n < kMaxColors; ++n) {
        if ((draw.colors & 1u << n) != 0) names.push_back(nameOf(target, target.colorIndex(n)));
    }
    if (draw.depth) names.emplace_back("depth");
    if (draw.stencil) names.emplace_back("stencil");
    return names;
}

nlohmann::json jsonOf(const SceneLog::Pass& pass)
{
    const Framebuffer& target = *pass.target;
    nlohmann::json its = {{"width", target.width()}, {"height", target.height()}, {"samples", target.samples().count}};
    for (const Row& row : rowsOfPass(pass.statistics)) its["counts"][nameOf(row)] = row.value;
    for (std::size_t i = 0; i < target.attachments().size(); ++i) {
        const auto [format, store] = target.attachments()[i];
        its["targets"].push_back({{"name", nameOf(target, static_cast<int>(i))},
                                  {"format", trace::wordsOf(format)},
                                  {"kept", store != Store::discard},
                                  {"read", (pass.read & 1u << i) != 0}});
    }
    for (std::size_t i = 0; i < pass.draws.size(); ++i) {
        const DrawFacts& facts = pass.draws[i];
        nlohmann::json draw = {{"mesh", facts.mesh}, {"writes", writtenBy(facts, target)}, {"program", facts.program}};
        if (facts.testsStencil) {
            draw["stencil"] = {{"passed", pass.ofDraws[i].stencilPassed}, {"failed", pass.ofDraws[i].stencilFailed}};
        }
        its["draws"].push_back(draw);
    }
    return its;
}

void print(const Row& row, const char* indent)
{
    std::printf("%s%-*s %12llu  %s\n", indent, static_cast<int>(32 - std::strlen(indent)), row.name,
                static_cast<unsigned long long>(row.value), row.note.c_str());
}

// What of a pass is not 0; what became of its targets; and its draws.
void print(const SceneLog::Pass& pass)
{
    const Framebuffer& target = *pass.target;
    const int samples = target.samples().count;
    std::printf("  before the picture, a pass of %dx%d%s\n", target.width(), target.height(),
                samples > 1 ? (", " + std::to_string(samples) + " samples a pixel").c_str() : "");
    for (const Row& row : rowsOfPass(pass.statistics)) {
        if (row.value != 0) print(row, "    ");
    }
    for (std::size_t i = 0; i < target.attachments().size(); ++i) {
        const auto [format, store] = target.attachments()[i];
        const char* became = (pass.read & 1u << i) != 0 ? "a texture afterwards"
                             : store == Store::discard  ? "not kept: it is in tiles only, and takes no memory"
                                                        : "kept, but nobody reads it";
        std::printf("    target %s, %s: %s\n", nameOf(target, static_cast<int>(i)).c_str(),
                    trace::wordsOf(format).c_str(), became);
    }
    for (std::size_t i = 0; i < pass.draws.size(); ++i) {
        const DrawFacts& facts = pass.draws[i];
        std::string line = "    draw " + std::to_string(i + 1) + ", " + facts.mesh + ": ";
        const std::vector<std::string> written = writtenBy(facts, target);
        for (const std::string& name : written) line += (&name == written.data() ? "writes " : ", ") + name;
        if (written.empty()) line += "writes nothing";
        if (!facts.program) line += "; its program is not run";
        if (facts.testsStencil) {
            line += "; stencil tests: " + std::to_string(pass.ofDraws[i].stencilPassed) + " passed, " +
                    std::to_string(pass.ofDraws[i].stencilFailed) + " failed";
        }
        std::printf("%s\n", line.c_str());
    }
}

}  // namespace

Expected<void> explain(const RenderOptions& options, bool json)
{
    const Expected<Size> size = parseSize(options.size);
    if (!size) return tl::unexpected(size.error());
    const Expected<PreparedStage> prepared = prepare(options);
    if (!prepared) return tl::unexpected(prepared.error());
    const Expected<Usage> usage = usageOf(*prepared, *size, options.threads);
    if (!usage) return tl::unexpected(usage.error());
    const std::vector<Row> table = rows(*usage);
    if (json) {
        nlohmann::json all = {{"stage", prepared->stage->id}, {"stem", prepared->stage->stem}, {"lanes", kLanes}};
        for (const Row& row : table) all["counts"][nameOf(row)] = row.value;
        all["passes"] = nlohmann::json::array();
        for (const SceneLog::Pass& pass : usage->before) all["passes"].push_back(jsonOf(pass));
        all["notes"] = prepared->log->notes;
        std::printf("%s\n", all.dump(2).c_str());
        return {};
    }
    std::printf("%s at %dx%d\n", prepared->stage->name().c_str(), size->width, size->height);
    for (const Row& row : table) print(row, "  ");
    for (const SceneLog::Pass& pass : usage->before) print(pass);
    for (const std::string& note : prepared->log->notes) std::printf("  %s\n", note.c_str());
    return {};
}

}  // namespace relief::samples
