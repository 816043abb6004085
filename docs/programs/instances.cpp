// A hundred thousand cubes in one draw: the mesh is there once, and a stream holds what each instance has of its own.
// Writes instances.png.
#include <cstdio>

#include <relief/relief.h>
#include <relief/shading/camera.h>

using namespace relief;

struct VertexData
{
    POSITION position;
    NORMAL normal;
    TEXCOORD<1, float4> place;  // of the instance: its centre, and its size in w
    SV_InstanceID instance;
};

struct Interpolators
{
    SV_POSITION position;
    nointerpolation<COLOR<0, float3>> color;
};

struct PlaceEach
{
    float4x4 clipFromWorld;

    Interpolators operator()(VertexData v) const
    {
        Interpolators i;
        i.position = mul(clipFromWorld, float4(v.place.xyz() + v.position.xyz() * v.place.w, 1.0f));
        const Float hue = frac(Float(v.instance) * 0.618034f) * 6.2831853f;
        const float3 tint = 0.55f + 0.45f * float3(cos(hue), cos(hue - 2.1f), cos(hue + 2.1f));
        i.color = tint * (0.3f + 0.7f * saturate(dot(v.normal, normalize(float3(-0.4f, 0.8f, -0.5f)))));
        return i;
    }
};

struct Show
{
    float4 operator()(Interpolators i) const { return float4(i.color, 1.0f); }
};

int main()
{
    constexpr std::uint32_t count = 100000;
    Mesh cubes = makeCube();
    VertexStream places = {.semantic = "TEXCOORD", .index = 1, .components = 4, .perInstance = true};
    for (std::uint32_t i = 0; i < count; ++i) {
        const float t = static_cast<float>(i) / count, angle = 0.01f * static_cast<float>(i);
        const float radius = 3.0f + 17.0f * t;
        places.floats.insert(places.floats.end(), {radius * std::cos(angle), 6.0f * std::sin(60.0f * t) * (1.0f - t),
                                                   radius * std::sin(angle), 0.05f + 0.05f * t});
    }
    cubes.streams.push_back(places);

    Framebuffer target = *Framebuffer::create(960, 540);
    Frame frame(target);
    frame.clear({0.01f, 0.01f, 0.02f, 1.0f});
    const glm::mat4 clipFromWorld =
        perspective(50.0f, 960.0f / 540.0f, 0.1f, 100.0f) * lookAt({0.0f, 14.0f, -24.0f}, {0.0f, -1.0f, 0.0f});
    const Expected<void> drawn =
        frame.draw(cubes, PlaceEach{broadcast(clipFromWorld)}, Show{}, {}, {.instances = count});
    const Statistics statistics = frame.run();
    const Expected<void> written = drawn.and_then([&] { return writePng("instances.png", target); });
    if (!written) {
        std::fprintf(stderr, "%s\n", written.error().message.c_str());
        return 2;
    }
    std::printf("%llu triangles, %llu pixels\n", static_cast<unsigned long long>(statistics.trianglesSubmitted),
                static_cast<unsigned long long>(statistics.pixelsShaded));
}
