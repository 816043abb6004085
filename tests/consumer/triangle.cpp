// Somebody's program, which is built with flags that the library was not built with.
#include <cstdio>

#include <relief/relief.h>

using namespace relief;

struct VertexData
{
    POSITION position;
};
struct Interpolators
{
    SV_POSITION position;
};

int main()
{
    const Mesh mesh = {
        .name = "triangle", .positions = {{-1, -1, 0.5f}, {-1, 3, 0.5f}, {3, -1, 0.5f}}, .indices = {0, 1, 2}};
    Framebuffer target = *Framebuffer::create(16, 16);
    Frame frame(target);
    frame.clear({0, 0, 0, 1});
    const Expected<void> drawn = frame.draw(
        mesh, [](VertexData v) { return Interpolators{v.position}; }, [](Interpolators) { return float4(1.0f); });
    std::puts(drawn ? "drawn" : drawn.error().message.c_str());
}
