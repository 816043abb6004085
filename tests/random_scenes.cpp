// Scenes of extreme numbers in every stage of the pipeline, and what must hold after each. RELIEF_SCENE=n draws scene n
// alone; a scene that breaks something is named by that number.
#include <cstdlib>

#include "random_scene.h"
#include "stability.h"

TEST_CASE("random scenes: no NaN, nothing outside of the scissor, counts that add up, the same bits every time")
{
    const char* const one = std::getenv("RELIEF_SCENE");
    const std::uint64_t first = one == nullptr ? 0 : std::strtoull(one, nullptr, 10);
    const int count = one == nullptr ? stability::trials(1000, 10000) : 1;
    int broken = 0, shaded = 0;
    std::uint64_t submitted = 0, dropped = 0, invalid = 0, pixels = 0;
    double longest = 0.0;
    for (int i = 0; i < count; ++i) {
        const std::uint64_t scene = first + static_cast<std::uint64_t>(i);
        const random_scene::Result result = random_scene::draw(random_scene::Source(scene));
        if (!result.broken.empty()) {
            ++broken;
            MESSAGE("RELIEF_SCENE=" << scene << ": " << result.broken);
        }
        shaded += result.pixelsShaded > 0;
        submitted += result.trianglesSubmitted;
        dropped += result.dropped;
        invalid += result.invalidColors;
        pixels += result.pixelsShaded;
        longest = result.seconds > longest ? result.seconds : longest;
    }
    stability::noted("scenes", count);
    stability::measured("scenes that break an invariant", broken, 0);
    stability::measured("seconds of the slowest scene", longest, 5.0);
    stability::noted("triangles", static_cast<double>(submitted));
    stability::noted("of them with NaN, infinite positions or bad indices", static_cast<double>(dropped));
    stability::noted("pixels shaded", static_cast<double>(pixels));
    stability::noted("colours NaN or infinite that were replaced", static_cast<double>(invalid));
    if (one == nullptr) {
        CHECK(shaded > count / 4);  // they do draw
        CHECK(dropped > 0);
        CHECK(invalid > 0);
    }
}
