// One stage against its golden and its hash: `check_stage golden 1.06`, `check_stage hash 1.06`. The picture must be
// the same byte for byte (with --update it becomes the golden; `relief check review golden_failures` shows both); the
// float colours and depths must have the committed hash for every number of threads and every tile size. The number of
// lanes, the compiler and the build type vary with the build: each is held to the same hash.
#include <algorithm>
#include <bit>
#include <cstdio>
#include <fstream>
#include <optional>
#include <span>

#include "common/shell.h"
#include "golden_stage.h"
#include "relief/check/golden_run.h"
#include "relief/leave_out.h"

namespace {

using namespace relief;
using namespace relief::samples;

Expected<std::string> expectedHash(const Stage& stage)
{
    std::ifstream file(hashesPath());
    std::string hash, id, stem;
    while (file >> hash >> id >> stem) {
        if (id == stage.id) return hash;
    }
    return fail(hashesPath().string() + ": has no hash of " + stage.id + "; update_goldens");
}

std::string lifeOf(const Stage& stage, int x, int y, const FrameOptions& options = {})
{
    std::string words = "its life: ./relief trace " + stage.id + " --size " + std::to_string(kGoldenWidth) + "x" +
                        std::to_string(kGoldenHeight) + " --pixel " + std::to_string(x) + "," + std::to_string(y);
    if (options.threads > 0) words += " --threads " + std::to_string(options.threads);
    if (options.tileSize != FrameOptions{}.tileSize) words += " --tile " + std::to_string(options.tileSize);
    return words;
}

// The first value in which a pixel's life is not what it is by the committed source. Empty where the program that tells
// it, or git, is not there.
std::string firstValue(const Stage& stage, int x, int y)
{
    const std::string size = std::to_string(kGoldenWidth) + "x" + std::to_string(kGoldenHeight);
    const std::optional<std::string> said =
        outputOf(quoted(RELIEF_VIEW_PROGRAM) + " trace " + stage.id + " --size " + size + " --pixel " +
                 std::to_string(x) + "," + std::to_string(y) + " --against committed 2>/dev/null");
    if (!said) return "";
    if (said->starts_with("the traces are the same")) return "\nits lines tell the same as the committed source's";
    return "\nfirst value that is not as in the committed source:\n" +
           said->substr(0, said->find_last_not_of('\n') + 1);
}

Expected<void> checkPicture(const Stage& stage, bool update)
{
    const Expected<Framebuffer> target = renderForGolden(stage, Format::rgba8Srgb);
    if (!target) return tl::unexpected(target.error());
    GoldenRun run({.goldens = RELIEF_GOLDEN_FOLDER, .failures = "golden_failures", .update = update});
    const auto tell = [&](int x, int y) { return lifeOf(stage, x, y) + firstValue(stage, x, y); };
    return run.check(stage.folder + "/" + stage.stem, *target, {}, tell).map_error([](const Error& error) {
        return Error{error.message + " (of all stages: update_goldens)"};
    });
}

// All numbers of threads with all tile sizes; in slow builds, few threads and many, small tiles and large ones.
std::vector<FrameOptions> everyKindOfFrame()
{
#if defined(RELIEF_SHORT_TESTS)
    return {{3, 32}, {8, 128}};
#else
    std::vector<FrameOptions> all;
    for (const int threads : {1, 2, 3, 8}) {
        for (const int tileSize : {32, 64, 128}) all.push_back({threads, tileSize});
    }
    return all;
#endif
}

// Where two pictures of a stage part: the first pixel, both values, and how its life is told.
std::string firstDifference(const Stage& stage, const Framebuffer& wrong, const FrameOptions& options,
                            const Framebuffer& right)
{
    const std::span<const std::uint32_t> is = wrong.words(0), shouldBe = right.words(0);
    const auto [at, other] = std::mismatch(is.begin(), is.end(), shouldBe.begin(), shouldBe.end());
    if (at == is.end()) return "\nthe colours are the same, the depths are not";
    const auto word = static_cast<int>(at - is.begin());
    const int x = word / 4 % kGoldenWidth, y = word / 4 / kGoldenWidth;
    char values[128];
    std::snprintf(values, sizeof values, "\npixel (%d, %d), component %d: %.9g, should be %.9g\n", x, y, word % 4,
                  static_cast<double>(std::bit_cast<float>(*at)), static_cast<double>(std::bit_cast<float>(*other)));
    return values + lifeOf(stage, x, y, options);
}

// What the golden says, where no frame has the right hash.
std::string goldenOf(const Stage& stage)
{
    const Expected<void> picture = checkPicture(stage, false);
    return picture ? "; the picture of 8 bits is still the golden" : "\n" + picture.error().message;
}

Expected<void> checkHash(const Stage& stage)
{
    const Expected<std::string> expected = expectedHash(stage);
    if (!expected) return tl::unexpected(expected.error());
    std::optional<Framebuffer> right;
    for (const FrameOptions& options : everyKindOfFrame()) {
        Expected<Framebuffer> target = renderForGolden(stage, Format::rgba32f, options);
        if (!target) return tl::unexpected(target.error());
        const std::string hash = hexadecimal(hashOf(*target));
        if (hash == *expected) {
            if (!right) right = std::move(*target);
            continue;
        }
        const std::string where = right ? firstDifference(stage, *target, options, *right)
                                        : "\nno frame of this build has it" + goldenOf(stage);
        return fail(stage.id + ": hash " + hash + " with " + std::to_string(options.threads) + " threads, tiles of " +
                    std::to_string(options.tileSize) + " px and " + std::to_string(kLanes) + " lanes; should be " +
                    *expected + where);
    }
    return {};
}

}  // namespace

int main(int argc, char** argv)
{
    const Expected<bool> update = takeUpdateFlag(argc, argv);
    const std::string what = argc == 3 ? argv[1] : "";
    if (!update) std::fprintf(stderr, "%s\n", update.error().message.c_str());
    if (!update) return 2;
    if (what != "golden" && what != "hash") {
        std::fprintf(stderr, "usage: check_stage golden|hash STAGE [--update]\n");
        return 2;
    }
    const Expected<void> generic = leavesOut::checkGeneric(leavesOut::generic());
    const Expected<const Stage*> stage = findStage(argv[2]);
    const Expected<void> result = !generic           ? generic
                                  : !stage           ? Expected<void>(tl::unexpected(stage.error()))
                                  : what == "golden" ? checkPicture(**stage, *update)
                                                     : checkHash(**stage);
    if (result) return 0;
    std::fprintf(stderr, "%s\n", result.error().message.c_str());
    return 1;
}
