// What the golden test, the hash test and update_goldens share: how a stage is rendered for its golden.
#pragma once

#include <filesystem>
#include <string>

#include "common/inside.h"
#include "common/render.h"
#include "relief/check/golden.h"

namespace relief::samples {

inline constexpr int kGoldenWidth = 480, kGoldenHeight = 270;

inline std::filesystem::path goldenPath(const Stage& stage)
{
    return std::filesystem::path(RELIEF_GOLDEN_FOLDER) / stage.folder / (stage.stem + ".png");
}

// The hashes of all stages' float colour and depth: lines of "hash id stem".
inline std::filesystem::path hashesPath()
{
    return std::filesystem::path(RELIEF_GOLDEN_FOLDER) / "hashes.txt";
}

inline Expected<Framebuffer> renderForGolden(const Stage& stage, Format format, const FrameOptions& options = {})
{
    // A golden is of one variant, whatever the CMake option BINORMAL_PER_FRAGMENT says.
    std::vector<std::string> settings;
    for (const Property& p : stage.properties()) {
        if (p.name == "binormalPerFragment" && p.choices.size() == 2) settings.push_back("binormalPerFragment=0");
    }
    const Expected<PreparedStage> prepared = PreparedStage::prepare(stage, settings);
    if (!prepared) return tl::unexpected(prepared.error());
    Expected<Framebuffer> target = Framebuffer::create(kGoldenWidth, kGoldenHeight, format,
                                                       format == Format::rgba32f ? Store::keep : Store::discard);
    if (!target) return target;
    Frame frame(*target, options);
    prepared->record(frame, kGoldenWidth, kGoldenHeight);
    const std::vector<Label> none;
    const bool isPicture = format == Format::rgba8Srgb;  // labels are the picture's, not the stage's
    const Expected<Statistics> run = runInside(frame, *target, "", isPicture ? prepared->log->labels : none);
    if (!run) return tl::unexpected(run.error());
    return target;
}

}  // namespace relief::samples
