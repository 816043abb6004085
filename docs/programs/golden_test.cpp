// A pixel test without a tolerance: draws a lens and compares it, byte for byte, with the picture that was approved.
//   golden_test GOLDEN FAILURES [--update]
// says what differs and where the pictures lie; the exit code is 1 then. With --update the picture is approved.
#include <cstdio>
#include <cstring>

#include <relief/check/golden.h>
#include <relief/check/hash.h>
#include <relief/relief.h>

using namespace relief;

struct VertexData
{
    POSITION position;
    TEXCOORD<0, float2> uv;
};

struct Interpolators
{
    SV_POSITION position;
    TEXCOORD<0, float2> uv;
};

struct Flat
{
    Interpolators operator()(VertexData v) const { return {v.position, v.uv}; }
};

struct Lens
{
    float4 operator()(Interpolators i, Discard& discard) const
    {
        const float2 fromCentre = i.uv * 2.0f - 1.0f;
        const Float r = length(fromCentre);
        discard(r > 0.95f);
        return float4(0.2f + 0.8f * sqrt(saturate(1.0f - r * r)) * float3(0.3f, 0.6f, 1.0f), 1.0f);
    }
};

int main(int argc, char** argv)
{
    if (argc < 3) {
        std::fputs("usage: golden_test GOLDEN FAILURES [--update]\n", stderr);
        return 2;
    }
    const Mesh quad = {.name = "quad",
                       .positions = {{-1, -1, 0.5f}, {-1, 1, 0.5f}, {1, 1, 0.5f}, {1, -1, 0.5f}},
                       .uvs = {{0, 0}, {0, 1}, {1, 1}, {1, 0}},
                       .indices = {0, 1, 2, 0, 2, 3}};
    Framebuffer target = *Framebuffer::create(64, 64);
    Frame frame(target);
    frame.clear({0, 0, 0, 1});
    frame.draw(quad, Flat{}, Lens{});
    frame.run();
    std::printf("%s\n", hexadecimal(hashOf(target)).c_str());

    const bool update = argc > 3 && std::strcmp(argv[3], "--update") == 0;
    const Expected<void> result = update ? updateGolden(target, argv[1]) : checkGolden(target, argv[1], argv[2]);
    if (!result) std::fprintf(stderr, "%s\n", result.error().message.c_str());
    return result ? 0 : 1;
}
