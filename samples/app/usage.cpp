#include "usage.h"

#include <set>

#include "relief/pipeline/instruments.h"

namespace relief::samples {

namespace {

void countLevels(const LoadedInputs& inputs, const SceneLog& log, Usage& usage)
{
    std::set<const Texture*> textures = log.textures;
    for (const auto& texture : inputs.textures) {
        if (texture) textures.insert(texture.get());
    }
    for (const Texture* texture : textures) {
        usage.levelsBuilt += texture->levelsBuilt();
        usage.levelsWhole += texture->levelCount();
    }
}

}  // namespace

Expected<Usage> usageOf(const PreparedStage& stage, Size size, int threads)
{
    Expected<Framebuffer> target = Framebuffer::create(size.width, size.height, Format::rgba32f);
    if (!target) return tl::unexpected(target.error());
    Frame frame(*target, {.threads = threads});
    stage.log->tellsDraws = true;
    stage.record(frame, size.width, size.height);
    if (const std::string problem = stage.problem(frame); !problem.empty()) return fail(problem);
    Usage usage;
    usage.statistics = frame.run();
    countLevels(*stage.inputs, *stage.log, usage);
    usage.before = stage.log->passes;
    usage.passesLeftOut = stage.log->passesLeftOut;
    for (int draw = 0; draw < frame.drawCount(); ++draw) {
        const int components = *componentCount(frame, draw);
        usage.componentsDeclared += components;
        for (int c = 0; c < components; ++c) usage.componentsUsed += *dependsOn(frame, draw, c) ? 1 : 0;
    }
    return usage;
}

}  // namespace relief::samples
