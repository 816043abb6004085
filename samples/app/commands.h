// The commands of the program `relief`, one function each. They print their results; an error comes back as one line,
// which runProgram() prints to stderr with exit code 2.
#pragma once

#include "prepare.h"

namespace relief::samples {

Expected<void> list(bool json);
Expected<void> render(const RenderOptions& options, const std::string& output);
Expected<void> renderScene(const RenderOptions& options, const std::string& output);
Expected<void> renderAtEverySave(const RenderOptions& options, const std::string& output);
Expected<void> newStage(const std::string& path, const std::string& from);
Expected<void> benchLive(const LiveBenchOptions& options);
Expected<void> hash(const RenderOptions& options);
Expected<void> signature(const RenderOptions& options, const std::string& binormal);
Expected<void> explain(const RenderOptions& options, bool json);
Expected<void> gallery(const std::string& folder, const std::string& shard, int threads);
Expected<void> view(const ViewOptions& options);

// Renders into 8-bit sRGB colours with so many samples a pixel, the picture or one of its views (common/inside.h), and
// writes a PNG.
Expected<Statistics> renderToFile(const PreparedStage& stage, Size size, const FrameOptions& how, int samples,
                                  const std::string& path, const std::string& show = "");

}  // namespace relief::samples
