// A cube that turns: a colour at each vertex, and two uv sets, one for the bricks and one for the marble's grain over
// them. Writes twelve frames of one turn, cube-00.png to cube-11.png.
#include <cstdio>

#include <relief/relief.h>
#include <relief/shading/camera.h>

using namespace relief;

struct VertexData
{
    POSITION position;
    COLOR<0, float4> color;
    TEXCOORD<0, float2> uv;
    TEXCOORD<1, float2> grainUv;
};

struct Interpolators
{
    SV_POSITION position;
    COLOR<0, float4> color;
    TEXCOORD<0, float4> uv;  // bricks in xy, grain in zw
};

struct Turn
{
    float4x4 clipFromObject;

    Interpolators operator()(VertexData v) const
    {
        Interpolators i;
        i.position = mul(clipFromObject, v.position);
        i.color = v.color;
        i.uv = float4(v.uv, v.grainUv);
        return i;
    }
};

struct Paint
{
    sampler2D bricks, grain;

    float4 operator()(Interpolators i) const
    {
        return i.color * tex2D(bricks, i.uv.xy()) * (0.5f + tex2D(grain, i.uv.zw()));
    }
};

// Squares of two greys.
Texture checkers(int squares, std::uint8_t dark)
{
    std::vector<std::uint8_t> texels;
    for (int i = 0; i < squares * squares; ++i) {
        const bool isDark = (i % squares + i / squares) % 2 != 0;
        for (int c = 0; c < 4; ++c) texels.push_back(c < 3 && isDark ? dark : 255);
    }
    return *Texture::fromRgba8(squares, squares, texels, ColorSpace::srgb);
}

int main()
{
    Mesh cube = makeCube();
    VertexStream grainUv = {.semantic = "TEXCOORD", .index = 1, .components = 2};
    for (std::size_t i = 0; i < cube.positions.size(); ++i) {
        cube.colors.emplace_back(cube.positions[i] + 0.5f, 1.0f);
        grainUv.floats.insert(grainUv.floats.end(), {4.0f * cube.uvs[i].x, 4.0f * cube.uvs[i].y});
    }
    cube.streams.push_back(grainUv);
    const Texture bricks = checkers(4, 160), grain = checkers(2, 120);

    Framebuffer target = *Framebuffer::create(320, 240);
    Frame frame(target);
    const glm::mat4 clipFromWorld =
        perspective(60.0f, 320.0f / 240.0f, 0.1f, 10.0f) * lookAt({0.0f, 0.9f, -1.8f}, {0.0f, 0.0f, 0.0f});
    for (int i = 0; i < 12; ++i) {
        frame.reset();
        frame.clear({0.02f, 0.02f, 0.03f, 1.0f});
        const glm::mat4 worldFromObject = rotationY(30.0f * static_cast<float>(i));
        frame.draw(cube, Turn{broadcast(clipFromWorld * worldFromObject)},
                   Paint{{.texture = &bricks}, {.texture = &grain}});
        frame.run();
        char name[16];
        std::snprintf(name, sizeof name, "cube-%02d.png", i);
        const Expected<void> written = writePng(name, target);
        if (!written || !frame.problem().empty()) {
            std::fprintf(stderr, "%s\n", written ? frame.problem().c_str() : written.error().message.c_str());
            return 2;
        }
    }
}
