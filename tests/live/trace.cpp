// Traces of pixels: that they end at the picture's pixel, in every stage, and what they say.
//
// RELIEF_FULL_TRIALS=1: all stages, 150 pixels each.
#include <cstdlib>
#include <fstream>
#include <random>
#include <sstream>

#include <doctest/doctest.h>

#include "check/hash.h"
#include "common/render.h"
#include "live/load.h"
#include "live/watch.h"
#include "trace/instrument.h"
#include "trace/pixel_trace.h"
#include "trace/tell.h"

using namespace relief;
using namespace relief::samples;

namespace {

struct Picture
{
    Framebuffer target;
    Frame frame;
    PreparedStage stage;

    Picture(const Stage& its, int width, int height, int samples, FrameOptions how = {.threads = 2})
        : target(*Framebuffer::create(width, height, Format::rgba8Srgb, Store::discard, samples)),
          frame(target, how),
          stage(*PreparedStage::prepare(its))
    {
        stage.record(frame, width, height);
    }
};

const Stage* tracedStage(const std::string& name)
{
    const live::StageSource source = *live::findSource(name);
    Expected<live::StageCompile> compile = live::StageCompile::start(
        source, samples::trace::instrumented(*live::readText(source.path), source.stem), true);
    REQUIRE_MESSAGE(compile.has_value(), compile.error().message);
    const Expected<const Stage*> stage = compile->finish();
    REQUIRE_MESSAGE(stage.has_value(), stage.error().message);
    return *stage;
}

std::uint64_t hashOfStage(const Stage& its)
{
    Framebuffer target = *Framebuffer::create(480, 270, Format::rgba32f, Store::keep);
    Frame frame(target);
    const PreparedStage stage = *PreparedStage::prepare(its);
    stage.record(frame, 480, 270);
    frame.run();
    return hashOf(target);
}

// All values that a trace's program tells, as "name" or "name.field".
std::vector<std::string> namesIn(const relief::trace::PixelTrace& trace)
{
    std::vector<std::string> names;
    for (const auto& draw : trace.draws) {
        for (const auto& primitive : draw.primitives) {
            for (const auto& piece : primitive.pieces) {
                if (!piece.fragment) continue;
                for (const auto& event : piece.fragment->events) {
                    if (event.kind == relief::trace::Event::Kind::value) names.push_back(event.site.name + event.field);
                }
            }
        }
    }
    return names;
}

}  // namespace

TEST_CASE("trace: an instrumented stage has the book's hash, and a trace ends at the picture's pixel")
{
    std::ifstream file(RELIEF_GOLDEN_FOLDER "/hashes.txt");
    std::string hash, id, stem;
    const bool all = std::getenv("RELIEF_FULL_TRIALS") != nullptr;
    std::mt19937 random(1);
    int stages = 0, pixels = 0, covered = 0, told = 0, textures = 0;
    while (file >> hash >> id >> stem) {
        const bool isChosen = id == "0.03" || id == "1.25" || id == "4.05" || id == "5.14" || id == "5.18";
        if (!all && !isChosen) continue;
        CAPTURE(id);
        ++stages;
        const Stage& stage = *tracedStage(id);
        CHECK(hexadecimal(hashOfStage(stage)) == hash);
        for (const int samples : {1, 4}) {
            Picture picture(stage, 320, 180, samples), followed(stage, 320, 180, samples);
            picture.frame.run();
            for (int i = 0; i < (all ? 75 : 40); ++i) {
                const int x = static_cast<int>(random() % 320), y = static_cast<int>(random() % 180);
                CAPTURE(x);
                CAPTURE(y);
                const Expected<relief::trace::PixelTrace> trace = relief::trace::tracePixel(followed.frame, x, y);
                REQUIRE_MESSAGE(trace.has_value(), trace.error().message);
                const std::uint32_t pixel = picture.target.color8()[static_cast<std::size_t>(y * 320 + x)];
                REQUIRE(trace->storedWords.at(0) == pixel);
                ++pixels;
                for (const auto& draw : trace->draws) {
                    for (const auto& primitive : draw.primitives) {
                        for (const auto& piece : primitive.pieces) {
                            covered += piece.fragment.has_value();
                            told += piece.fragment && !piece.fragment->events.empty();
                            if (piece.fragment) textures += static_cast<int>(piece.fragment->textures.size());
                        }
                    }
                }
            }
        }
    }
    MESSAGE(stages, " stages, ", pixels, " pixels, ", covered, " triangles over them, ", told, " programs told, ",
            textures, " texture samples put together again");
    CHECK(stages >= 5);
    CHECK(told > pixels / 3);
    CHECK(textures > pixels / 2);
}
