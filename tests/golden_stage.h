// What the golden test, the hash test and update_goldens share: how a stage is rendered for its golden.
#pragma once

#include <filesystem>
#include <string>

#include "check/golden.h"
#include "common/render.h"

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

inline Expected<Framebuffer> renderForGolden(const Stage& stage, ColorFormat format, const FrameOptions& options = {})
{
    const Expected<PreparedStage> prepared = PreparedStage::prepare(stage);
    if (!prepared) return tl::unexpected(prepared.error());
    Expected<Framebuffer> target =
        Framebuffer::create(kGoldenWidth, kGoldenHeight, format,
                            format == ColorFormat::rgba32f ? DepthStorage::keep : DepthStorage::transient);
    if (!target) return target;
    Frame frame(*target, options);
    prepared->record(frame, kGoldenWidth, kGoldenHeight);
    frame.run();
    return target;
}

}  // namespace relief::samples
