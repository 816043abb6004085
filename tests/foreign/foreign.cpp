// Somebody else's program: one triangle, and the hash of what it leaves in the target.
#include <cstdio>

#include <relief/check/hash.h>
#include <relief/relief.h>

using namespace relief;

struct VertexData
{
    POSITION position;
    COLOR<0, float4> color;
};
struct Interpolators
{
    SV_POSITION position;
    COLOR<0, float4> color;
};

int main()
{
    const Mesh mesh = {.name = "triangle",
                       .positions = {{-0.8f, -0.8f, 0.5f}, {0.0f, 0.8f, 0.5f}, {0.8f, -0.8f, 0.5f}},
                       .colors = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}},
                       .indices = {0, 1, 2}};
    Framebuffer target = *Framebuffer::create(320, 240);
    Frame frame(target);
    frame.clear({0, 0, 0, 1});
    const Expected<void> drawn = frame.draw(
        mesh,
        [](VertexData v) {
            return Interpolators{v.position, v.color};
        },
        [](Interpolators i) { return pow(i.color, float4(0.7f)); });
    if (!drawn) {
        std::fprintf(stderr, "%s\n", drawn.error().message.c_str());
        return 1;
    }
    frame.run();
    std::printf("%d lanes: %s\n", kLanes, hexadecimal(hashOf(target)).c_str());
    return 0;
}
