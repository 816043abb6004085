// Pictures that must be equal: normal maps, tangent frames and passes through the whole pipeline, with answers that are
// known by algebra.
#include <array>
#include <cmath>

#include "pipeline_fixture.h"
#include "relief/mesh/primitives.h"
#include "relief/mesh/tangents.h"
#include "relief/shading/lights.h"
#include "relief/shading/normals.h"
#include "relief/shading/object_transform.h"
#include "relief/shading/tangent_space.h"
#include "relief/texture/import.h"
#include "relief/texture/sampler.h"

using namespace fixture;

namespace {

struct VertexData
{
    POSITION position;
    NORMAL normal;
    TANGENT tangent;
    TEXCOORD<0, float2> uv;
};

struct Interpolators
{
    SV_POSITION position;
    TEXCOORD<0, float2> uv;
    TEXCOORD<1, float3> normal;
    TEXCOORD<2, float4> tangent;
    TEXCOORD<3, float3> worldPos;
};

struct Vertex
{
    ObjectTransform object;

    Interpolators operator()(VertexData v) const
    {
        Interpolators i;
        i.position = UnityObjectToClipPos(object, v.position);
        i.worldPos = mul(object.worldFromObject, v.position).xyz();
        i.normal = UnityObjectToWorldNormal(object, v.normal);
        i.tangent = float4(UnityObjectToWorldDir(object, v.tangent.xyz()), v.tangent.w);
        i.uv = v.uv;
        return i;
    }
};

// The world-space normal, by the map or, without one, the mesh's own; as it is or lit.
struct Fragment
{
    sampler2D normalMap;
    Float mirrorSign;
    Float lightStrength;
    bool mapped = true, lit = true;

    float4 operator()(Interpolators i) const
    {
        float3 normal = normalize(i.normal);
        if (mapped) {
            const float3 tangent = i.tangent.xyz();
            const float3 binormal = CreateBinormal(i.normal, tangent, i.tangent.w, mirrorSign);
            normal = TangentSpaceToWorld(UnpackScaleNormal(tex2D(normalMap, i.uv), 1.0f), tangent, binormal, i.normal);
        }
        if (!lit) return float4(normal, 1);
        const PointLight lamp = {float3(1.0f, 0.8f, 0.6f) * lightStrength, {-1.0f, 1.5f, -2.0f}, 8.0f};
        const float3 viewDir = normalize(float3(0, 0, -3) - i.worldPos);
        return UNITY_BRDF_PBS({0.8f, 0.7f, 0.6f}, {0.04f, 0.04f, 0.04f}, 0.6f, normal, viewDir,
                              CreateLight(lamp, i.worldPos));
    }
};

constexpr RenderState kAdditive = {.depthTest = Compare::equal, .depthWrite = false, .blend = Blend::additive};

// A camera at z = -3 that looks along +z.
const glm::mat4 kClipFromWorld = {{2, 0, 0, 0}, {0, 2, 0, 0}, {0, 0, 1.1f, 1}, {0, 0, 2.2f, 3}};
const glm::mat4 kTurned = [] {
    const glm::mat4 aboutY = {{0.8f, 0, -0.6f, 0}, {0, 1, 0, 0}, {0.6f, 0, 0.8f, 0}, {0, 0, 0, 1}};
    const glm::mat4 aboutX = {{1, 0, 0, 0}, {0, 0.96f, -0.28f, 0}, {0, 0.28f, 0.96f, 0}, {0, 0, 0, 1}};
    return aboutX * aboutY;
}();

// A bumpy normal map as DXT5nm.
Texture bumps()
{
    Image8 heights{64, 64, {}};
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            const auto h = static_cast<std::uint8_t>((x * x * 3 + y * 7 + (x ^ y) * 2) % 97 + 60);
            heights.pixels.insert(heights.pixels.end(), {h, h, h, 255});
        }
    }
    Expected<Texture> texture = importTexture(
        ImageFile(heights),
        {.kind = ImportSettings::Kind::normalMap, .storage = ImportSettings::Storage::dxt5nm, .bumpiness = 0.02f});
    REQUIRE(texture.has_value());
    return std::move(*texture);
}

void add(Frame& frame, const Mesh& mesh, const glm::mat4& worldFromObject, Fragment fragment)
{
    const ObjectTransform object(kClipFromWorld, worldFromObject);
    fragment.mirrorSign = object.unity_WorldTransformParams.w;
    frame.setFrontCounterClockwise(mirrorSign(worldFromObject) < 0.0f);
    frame.draw(mesh, Vertex{object}, fragment);
}

Framebuffer picture(const Mesh& mesh, const glm::mat4& worldFromObject, const Fragment& fragment)
{
    Framebuffer target = makeTarget(160, 120);
    Frame frame(target, {1, kDefaultTileSize});
    frame.clear(glm::vec4(0.0f));
    add(frame, mesh, worldFromObject, fragment);
    frame.run();
    return target;
}

struct Difference
{
    int covered = 0, onlyOne = 0;  // pixels of both, and of one alone
    float largest = 0.0f;          // where both are covered
    int above1e4 = 0;
};

Difference compare(const Framebuffer& a, const Framebuffer& b)
{
    Difference d;
    for (std::size_t i = 0; i < a.color32f().size(); ++i) {
        const glm::vec4 p = a.color32f()[i], q = b.color32f()[i];
        if ((p.w != 0.0f) != (q.w != 0.0f)) ++d.onlyOne;
        if (p.w == 0.0f || q.w == 0.0f) continue;
        ++d.covered;
        float difference = 0.0f;
        for (int c = 0; c < 3; ++c) difference = std::max(difference, std::abs(p[c] - q[c]));
        d.largest = std::max(d.largest, difference);
        d.above1e4 += difference > 1e-4f;
    }
    return d;
}

}  // namespace

TEST_CASE("shading pictures: a flat normal map gives the picture of the mesh's own normals, bit for bit")
{
    const sampler2D flat = {.texture = &Texture::flatNormal()};
    for (const Mesh& mesh : {makeCube(), makeSphere(24, 12), makeCubeSphere(6)}) {
        const Framebuffer own = picture(mesh, kTurned, {flat, 1.0f, 4.0f, false, true});
        CHECK(own.samePixels(picture(mesh, kTurned, {flat, 1.0f, 4.0f, true, true})));
    }
}

TEST_CASE("shading pictures: a flat map of 8-bit codes tilts every normal of a cube by 0.3178 degrees")
{
    const std::array<std::uint8_t, 4> codes = {255, 128, 255, 128};
    const Expected<Texture> texture = Texture::fromRgba8(1, 1, codes, ColorSpace::linear);
    REQUIRE(texture.has_value());
    const sampler2D flat = {.texture = &*texture};
    const Framebuffer own = picture(makeCube(), kTurned, {flat, 1.0f, 1.0f, false, false});
    const Framebuffer mapped = picture(makeCube(), kTurned, {flat, 1.0f, 1.0f, true, false});
    int checked = 0;
    for (std::size_t i = 0; i < own.color32f().size(); ++i) {
        const glm::vec4 p = own.color32f()[i], q = mapped.color32f()[i];
        if (p.w == 0.0f) continue;
        double difference = 0.0, sum = 0.0;
        for (int c = 0; c < 3; ++c) {
            difference += std::pow(static_cast<double>(p[c]) - static_cast<double>(q[c]), 2);
            sum += std::pow(static_cast<double>(p[c]) + static_cast<double>(q[c]), 2);
        }
        const double degrees = 2.0 * std::atan2(std::sqrt(difference), std::sqrt(sum)) * 180.0 / 3.14159265358979;
        CHECK(degrees == doctest::Approx(0.31776).epsilon(1e-3));
        ++checked;
    }
    CHECK(checked > 3000);
}

TEST_CASE("shading pictures: a turned cube is lit like six turned quads")
{
    const Texture map = bumps();
    const Fragment fragment = {{.texture = &map}, 1.0f, 4.0f, true, true};
    const Mesh cube = makeCube(), quad = makeQuad();
    const Framebuffer whole = picture(cube, kTurned, fragment);

    Framebuffer parts = makeTarget(160, 120);
    Frame frame(parts, {1, kDefaultTileSize});
    frame.clear(glm::vec4(0.0f));
    for (std::size_t first = 0; first < 24; first += 4) {
        // The quad's x, y and -z are the face's tangent, binormal and normal.
        const glm::vec3 n = cube.normals[first], t(cube.tangents[first]);
        const glm::vec3 b = glm::vec3(n.y * t.z - n.z * t.y, n.z * t.x - n.x * t.z, n.x * t.y - n.y * t.x) * -1.0f;
        const glm::mat4 faceFromQuad = {{t, 0}, {b, 0}, {-n, 0}, {n * 0.5f, 1}};
        add(frame, quad, kTurned * faceFromQuad, fragment);
    }
    frame.run();
    const Difference d = compare(whole, parts);
    CHECK(d.covered > 3000);
    CHECK(d.onlyOne <= 3);  // snapping: the corners' last bits differ
    CHECK(d.above1e4 <= d.covered / 100);
}

TEST_CASE("shading pictures: mirrored by its scale and mirrored by its uv, a cube looks the same")
{
    const Texture map = bumps();
    const Fragment fragment = {{.texture = &map}, 1.0f, 4.0f, true, true};
    const glm::mat4 mirror = {{-1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    const Framebuffer byScale = picture(makeCube(), kTurned * mirror, fragment);
    const Framebuffer byUv = picture(withMirroredUv(makeCube()), kTurned, fragment);
    const Difference d = compare(byScale, byUv);
    CHECK(d.covered > 3000);
    CHECK(d.onlyOne == 0);
    // u and 1 - u round differently, and a texel's weight is a multiple of 1/4096: less than half a code of 8 bits.
    CHECK(d.largest <= 0.5f / 255.0f);

    // Without the signs it does not.
    Framebuffer wrong = makeTarget(160, 120);
    Frame frame(wrong, {1, kDefaultTileSize});
    frame.clear(glm::vec4(0.0f));
    frame.setFrontCounterClockwise(true);
    const Mesh cube = makeCube();
    frame.draw(cube, Vertex{ObjectTransform(kClipFromWorld, kTurned * mirror)}, fragment);
    frame.run();
    CHECK(compare(wrong, byUv).largest > 0.1f);
}

TEST_CASE("shading pictures: the primitives' own tangents and MikkTSpace's light the same")
{
    const Texture map = bumps();
    const Fragment fragment = {{.texture = &map}, 1.0f, 4.0f, true, true};
    const Expected<Mesh> computed = withTangents(makeCube());
    REQUIRE(computed.has_value());
    CHECK(compare(picture(makeCube(), kTurned, fragment), picture(*computed, kTurned, fragment)).largest <= 1e-4f);
}

TEST_CASE("shading pictures: S-816 S-955 K passes of a K-th of a light add up to one pass")
{
    const Texture map = bumps();
    const Mesh sphere = makeSphere(24, 12);
    const ObjectTransform object(kClipFromWorld, kTurned);
    const auto inPasses = [&](Format format, int passes) {
        Framebuffer target = makeTarget(160, 120, format);
        Frame frame(target, {1, kDefaultTileSize});
        frame.clear(glm::vec4(0.0f));
        const Fragment part = {{.texture = &map}, 1.0f, 4.0f / static_cast<float>(passes), true, true};
        frame.draw(sphere, Vertex{object}, part);
        for (int i = 1; i < passes; ++i) frame.draw(sphere, Vertex{object}, part, kAdditive);
        frame.run();
        return target;
    };
    const Framebuffer once = inPasses(Format::rgba32f, 1);
    float relative = 0.0f;
    for (const int passes : {2, 16, 256}) {
        const Framebuffer many = inPasses(Format::rgba32f, passes);
        for (std::size_t i = 0; i < once.color32f().size(); ++i) {
            for (int c = 0; c < 3; ++c) {
                const float expected = once.color32f()[i][c];
                const float bound = passes == 2 ? 0.0f : static_cast<float>(passes) * 0x1p-24f * std::abs(expected);
                const float error = std::abs(many.color32f()[i][c] - expected);
                CHECK(error <= bound);
                if (expected > 0.0f) relative = std::max(relative, error / expected / static_cast<float>(passes));
            }
        }
    }
    measured("relative error by passes, in float", relative, 0x1p-24);
    // In 8 bits every pass rounds once: K / 2 codes, in linear and in sRGB targets.
    for (const Format format : {Format::rgba8, Format::rgba8Srgb}) {
        const Framebuffer one = inPasses(format, 1);
        for (const int passes : {2, 16}) {
            const Framebuffer many = inPasses(format, passes);
            int worst = 0;
            for (std::size_t i = 0; i < one.color8().size(); ++i) {
                for (int shift = 0; shift < 24; shift += 8) {
                    const int p = static_cast<int>(one.color8()[i] >> shift & 255u);
                    worst = std::max(worst, std::abs(p - static_cast<int>(many.color8()[i] >> shift & 255u)));
                }
            }
            measured("codes off in 8 bits", worst, passes / 2);
            MESSAGE("worst error of " << passes << " passes in 8 bits, codes: " << worst);
        }
    }
}

TEST_CASE("shading pictures: an additive pass meets the same depth in every pixel of the base pass")
{
    const Mesh cube = makeCube(), sphere = makeSphere(24, 12);
    const ObjectTransform a(kClipFromWorld, kTurned);
    Framebuffer target = makeTarget(160, 120);
    Frame frame(target, {2, kDefaultTileSize});
    const auto run = [&](bool additive) {
        frame.reset();
        frame.clear(glm::vec4(0.0f));
        for (const Mesh* mesh : {&cube, &sphere}) frame.draw(*mesh, Vertex{a}, Fragment{.mapped = false, .lit = false});
        if (additive) {
            for (const Mesh* mesh : {&cube, &sphere})
                frame.draw(*mesh, Vertex{a}, Fragment{.mapped = false, .lit = false}, kAdditive);
        }
        frame.run();
    };
    run(false);
    const Framebuffer base = target;
    run(true);
    for (std::size_t i = 0; i < base.color32f().size(); ++i) CHECK(target.color32f()[i] == base.color32f()[i] * 2.0f);
}

TEST_CASE("shading pictures: S-659 spheres of 3 to 1024 segments have no NaN at their poles")
{
    const Texture map = bumps();
    for (const int segments : {3, 4, 5, 16, 100, 1024}) {
        const Mesh own = makeSphere(segments, std::max(2, segments / 2));
        const Expected<Mesh> computed = withTangents(own);
        REQUIRE(computed.has_value());
        for (const Mesh* mesh : {&own, &*computed}) {
            Framebuffer target = makeTarget(96, 96);
            Frame frame(target, {1, kDefaultTileSize});
            frame.clear(glm::vec4(0.0f));
            // From above: the pole is in the middle of the picture.
            const glm::mat4 above = {{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}};
            add(frame, *mesh, above, {{.texture = &map}, 1.0f, 4.0f, true, true});
            const Statistics statistics = frame.run();
            measured("colours NaN or infinite", statistics.invalidColors, 0);
            CHECK(statistics.pixelsShaded > 100);
            CHECK(target.color32f()[48 * 96 + 48].x > 0.0f);
        }
    }
}

TEST_CASE("shading pictures: S-607 heights half a texel away do not depend on the last bit of the coordinate")
{
    // At a texel's centre both samples lie on the border of two texels, where point filtering would tie.
    std::vector<std::uint8_t> rgba;
    for (int i = 0; i < 64 * 64; ++i) rgba.insert(rgba.end(), 4, static_cast<std::uint8_t>(i * 37 % 251));
    const Expected<Texture> heights = Texture::fromRgba8(64, 64, rgba, ColorSpace::linear);
    REQUIRE(heights.has_value());
    const sampler2D map = {.texture = &*heights, .filter = Filter::bilinear, .mipmaps = false};
    const float half = 0.5f / 64.0f;
    shading.activeLanes = kAllLanes;
    for (int x = 2; x < 62; ++x) {
        const float u = (static_cast<float>(x) + 0.5f) / 64.0f;
        const auto slope = [&](float at) {
            return (tex2D(map, float2(at - half, 0.3f)).x - tex2D(map, float2(at + half, 0.3f)).x)[0];
        };
        CHECK(slope(u) == slope(std::nextafter(u, 0.0f)));
        CHECK(slope(u) == slope(std::nextafter(u, 1.0f)));
    }
}
