// explain: what drawing a stage took, and what was left out, as counted while it ran.
#include <cstdio>
#include <set>

#include <nlohmann/json.hpp>

#include "commands.h"

namespace relief::samples {

namespace {

// Components (floats) that the stage's draws interpolate, and those that some pixel depends on: found by drawing the
// picture again with one component after the other replaced by NaN.
struct SlotUse
{
    int declared = 0, used = 0;
};

// Mip levels that exist in memory and that would, if every texture had its whole chain: of the stage's inputs and of
// the textures that it made.
struct MipUse
{
    int built = 0, whole = 0;
};

MipUse mipUse(const LoadedInputs& inputs, const SceneLog& log)
{
    std::set<const Texture*> textures = log.textures;
    for (const auto& texture : {inputs.albedo, inputs.height, inputs.normal, inputs.detail, inputs.detailNormal}) {
        if (texture) textures.insert(texture.get());
    }
    MipUse use;
    for (const Texture* texture : textures) {
        use.built += texture->levelsBuilt();
        use.whole += texture->levelCount();
    }
    return use;
}

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

std::vector<Row> rows(const Statistics& s, const SlotUse& slots, const MipUse& mips)
{
    return {
        {"passes (draws)", s.draws, ""},
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
        {"components used", static_cast<std::uint64_t>(slots.used),
         slots.used == slots.declared
             ? "all that are declared"
             : "of " + std::to_string(slots.declared) + " declared; no pixel depends on the others"},
        {"texture fetches, nearest", s.fetches.nearest, ""},
        {"texture fetches, bilinear", s.fetches.bilinear, ""},
        {"texture fetches, trilinear", s.fetches.trilinear, ""},
        {"texture fetches, anisotropic", s.fetches.anisotropic, ""},
        {"  second mip level left out", s.fetches.secondLevelSkipped, "the level of detail was a whole number, or 0"},
        {"  magnified, finest level only", s.fetches.magnified, ""},
        {"  constant textures, no fetch", s.fetches.constant, ""},
        {"mip levels built", static_cast<std::uint64_t>(mips.built), "of " + std::to_string(mips.whole)},
    };
}

}  // namespace

Expected<void> explain(const RenderOptions& options, bool json)
{
    const Expected<Size> size = parseSize(options.size);
    if (!size) return tl::unexpected(size.error());
    const Expected<PreparedStage> prepared = prepare(options);
    if (!prepared) return tl::unexpected(prepared.error());
    Expected<Framebuffer> target = Framebuffer::create(size->width, size->height, ColorFormat::rgba32f);
    if (!target) return tl::unexpected(target.error());

    Frame frame(*target, {.threads = options.threads});
    prepared->record(frame, size->width, size->height);
    const Statistics statistics = frame.run();
    const MipUse mips = mipUse(*prepared->inputs, *prepared->log);

    SlotUse slots;
    for (int draw = 0; draw < frame.drawCount(); ++draw) {
        slots.declared += frame.componentCount(draw);
        for (int c = 0; c < frame.componentCount(draw); ++c) slots.used += frame.dependsOn(draw, c) ? 1 : 0;
    }

    const std::vector<Row> table = rows(statistics, slots, mips);
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
    std::printf("%s %s at %dx%d\n", prepared->stage->id.c_str(), prepared->stage->title.c_str(), size->width,
                size->height);
    for (const Row& row : table) {
        std::printf("  %-30s %12llu  %s\n", row.name, static_cast<unsigned long long>(row.value), row.note.c_str());
    }
    for (const std::string& note : prepared->log->notes) std::printf("  %s\n", note.c_str());
    return {};
}

}  // namespace relief::samples
