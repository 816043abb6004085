// explain: what drawing a stage took, and what was left out, as counted while it ran.
#include <cstdio>

#include <nlohmann/json.hpp>

#include "usage.h"

namespace relief::samples {

namespace {

struct Row
{
    const char* name;
    std::uint64_t value;
    std::string note;
};

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
        {"pixels hidden", s.pixelsHidden, "failed the depth test before any shading"},
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
        for (const Row& row : table) {
            const std::string name = row.name;
            all["counts"][name.substr(name.find_first_not_of(' '))] = row.value;
        }
        all["notes"] = prepared->log->notes;
        std::printf("%s\n", all.dump(2).c_str());
        return {};
    }
    std::printf("%s at %dx%d\n", prepared->stage->name().c_str(), size->width, size->height);
    for (const Row& row : table) {
        std::printf("  %-30s %12llu  %s\n", row.name, static_cast<unsigned long long>(row.value), row.note.c_str());
    }
    for (const std::string& note : prepared->log->notes) std::printf("  %s\n", note.c_str());
    return {};
}

}  // namespace relief::samples
