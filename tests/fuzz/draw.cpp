// Any bytes as the numbers of a scene (../random_scene.h): whatever is drawn, what must always hold holds.
#include <cstdio>
#include <cstdlib>

#include "random_scene.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const random_scene::Result result = random_scene::draw(random_scene::Source(std::span(data, size)));
    if (result.broken.empty()) return 0;
    std::fprintf(stderr, "%s\n", result.broken.c_str());
    std::abort();
}
