// Meshes, levels and pictures are the same whatever floating-point environment the caller is in: rounding upwards, and
// on x86 with subnormal numbers taken for 0.
#include "relief/lanes/environment.h"

#include <array>
#include <bit>
#include <cfenv>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "contents.h"
#include "relief/mesh/bake.h"
#include "relief/mesh/bake_error.h"
#include "relief/mesh/bounds.h"
#include "relief/mesh/displace.h"
#include "relief/mesh/obj.h"
#include "relief/mesh/primitives.h"
#include "relief/mesh/ray_tree.h"
#include "relief/mesh/spherical_uv.h"
#include "relief/mesh/tangents.h"
#include "relief/mesh/triangulate.h"
#include "relief/pipeline/save.h"
#include "relief/pipeline/target_texture.h"
#include "relief/shading/camera.h"
#include "relief/shading/environment.h"
#include "relief/shading/lights.h"
#include "relief/shading/object_transform.h"
#include "relief/texture/cube_map.h"
#include "relief/texture/dxt5.h"
#include "relief/texture/import.h"
#include "relief/texture/mip_fade.h"
#include "relief/texture/pixels.h"
#include "relief/texture/texture.h"
#include "temporary_folder.h"

using namespace relief;

namespace {

using Bits = std::vector<std::uint32_t>;

template <class Vector>
void append(Bits& bits, const std::vector<Vector>& vectors)
{
    for (const Vector& v : vectors) {
        for (int i = 0; i < Vector::length(); ++i) bits.push_back(std::bit_cast<std::uint32_t>(v[i]));
    }
}

Bits bitsOf(const Mesh& mesh)
{
    Bits bits = mesh.indices;
    append(bits, mesh.positions);
    append(bits, mesh.normals);
    append(bits, mesh.uvs);
    append(bits, mesh.tangents);
    return bits;
}

Bits bitsOf(const MipLevel& level)
{
    Bits bits;
    for (int y = 0; y < level.height(); ++y) {
        const auto* bytes = reinterpret_cast<const std::uint8_t*>(level.texel<std::uint8_t>(0, 0)) +
                            static_cast<std::ptrdiff_t>(level.rowBytes()) * y;
        const std::size_t length =
            static_cast<std::size_t>(level.width()) * (level.rowBytes() / static_cast<std::size_t>(level.rowTexels()));
        bits.insert(bits.end(), bytes, bytes + length);
    }
    return bits;
}

Bits bitsOf(const Texture& texture)
{
    Bits bits;
    for (int k = 0; k < texture.levelCount(); ++k) {
        const Bits level = bitsOf(texture.level(k));
        bits.insert(bits.end(), level.begin(), level.end());
    }
    append(bits, std::vector<glm::vec4>{texture.texelSize(), texture.texel(1, 2), texture.constant()});
    return bits;
}

// The same call in the usual environment and in one that is neither.
bool isSame(const std::function<Bits()>& call)
{
    const Bits expected = call();
    std::fenv_t before;
    std::fegetenv(&before);
    std::fesetround(FE_UPWARD);
#if defined(__SSE2__)
    _mm_setcsr(_mm_getcsr() | 0x8040u);  // FTZ and DAZ
#endif
    const Bits upward = call();
    const bool isRestored = std::fegetround() == FE_UPWARD;
    std::fesetenv(&before);
    return isRestored && expected == upward;
}

// Three numbers out of four of a random picture that is not wide, whose sides are odd.
Image8 noise(int width, int height)
{
    Image8 image{width, height, {}};
    std::uint32_t state = 3;
    for (int i = 0; i < width * height * 4; ++i) {
        state = state * 1664525u + 1013904223u;
        image.pixels.push_back(static_cast<std::uint8_t>(state >> 24));
    }
    return image;
}

}  // namespace

TEST_CASE("rounding: matrices, objects and surroundings")
{
    const auto bits = [](const glm::mat4& m) {
        Bits all;
        append(all, std::vector<glm::vec4>{m[0], m[1], m[2], m[3]});
        return all;
    };
    const glm::mat4 view = lookAt({1.3f, 0.7f, -2.1f}, {0.1f, 0.3f, 0.2f}), turned = rotationY(33.3f);
    CHECK(isSame([&] { return bits(lookAt({1.3f, 0.7f, -2.1f}, {0.1f, 0.3f, 0.2f})); }));
    CHECK(isSame([&] { return bits(perspective(41.7f, 1.7f, 0.07f, 93.1f)); }));
    CHECK(isSame([&] { return bits(perspectiveReversed(41.7f, 1.7f, 0.07f, 93.1f)); }));
    CHECK(isSame([&] { return bits(orthographic(3.1f, 1.7f, 0.07f, 93.1f)); }));
    CHECK(isSame([&] { return bits(rotationX(17.3f)); }));
    CHECK(isSame([&] { return bits(rotationY(17.3f)); }));
    CHECK(isSame([&] { return bits(rotationZ(17.3f)); }));
    CHECK(isSame([&] {
        const ObjectTransform object(view, turned);
        Bits all = bits(firstLane(object.clipFromObject));
        append(all,
               std::vector<glm::vec3>{firstLane(object.normalFromObject)[0], firstLane(object.normalFromObject)[2]});
        return all;
    }));
    CHECK(isSame([] {
        const SphericalHarmonics sky =
            gradientSurroundings({0.1f, 0.3f, 0.7f}, {0.2f, 0.2f, 0.3f}, {0.05f, 0.07f, 0.03f});
        Bits all;
        append(all, std::vector<glm::vec4>{firstLane(sky.A[0]), firstLane(sky.A[1]), firstLane(sky.A[2])});
        return all;
    }));
}

TEST_CASE("rounding: cube maps, and what they become")
{
    ImageFloat world{32, 16, {}};
    for (const std::uint8_t value : noise(32, 16).pixels) world.pixels.push_back(static_cast<float>(value) * 0.37f);
    const ImageFile picture = world, faces = noise(30, 5);
    const auto bitsOfCube = [](const CubeMap& map) {
        Bits bits;
        for (int k = 0; k < map.levelCount(); ++k) {
            for (int face = 0; face < kCubeFaces; ++face)
                append(bits, std::vector<glm::vec4>{map.texel(k, face, 0, 0)});
        }
        return bits;
    };
    CHECK(isSame([&] { return bitsOfCube(*CubeMap::fromPicture(faces, ColorSpace::srgb)); }));
    CHECK(isSame([&] { return bitsOfCube(*CubeMap::fromPicture(picture, ColorSpace::linear)); }));
    const std::array<ImageFile, 6> sides = {noise(5, 5), noise(5, 5), noise(5, 5),
                                            noise(5, 5), noise(5, 5), noise(5, 5)};
    CHECK(isSame([&] { return bitsOfCube(*CubeMap::fromFaces(sides, ColorSpace::srgb)); }));
    const std::array<ImageFile, 3> levels = {noise(24, 4), noise(12, 2), noise(6, 1)};
    CHECK(isSame([&] { return bitsOfCube(*CubeMap::fromLevels(levels, ColorSpace::srgb)); }));
    const CubeMap map = *CubeMap::fromPicture(picture, ColorSpace::linear);
    CHECK(isSame([&] { return bitsOfCube(map); }));
    CHECK(isSame([&] {
        Bits bits;
        const ImageFloat prefiltered = *prefilteredEnvironment(map, {.side = 8, .samples = 16});
        for (const float value : prefiltered.pixels) bits.push_back(std::bit_cast<std::uint32_t>(value));
        return bits;
    }));
    CHECK(isSame([&] {
        const SphericalHarmonics sh = irradianceOf(map);
        Bits all;
        append(all, std::vector<glm::vec4>{firstLane(sh.A[0]), firstLane(sh.B[1]), firstLane(sh.A[2])});
        return all;
    }));
}

TEST_CASE("rounding: the smallest halves of a target, as a texture and as a file")
{
    Framebuffer target = *Framebuffer::create(5, 3, Format::rgba16f, Store::keep);
    for (auto& pixel : target.color16f()) pixel = {1, 17, 503, 0x3c00};
    CHECK(isSame([&] { return bitsOf(*textureOf(target, 0)); }));
    const TemporaryFolder folder;
    CHECK(isSame([&] {
        CHECK(writePfm(folder / "halves.pfm", target).has_value());
        const std::string bytes = contents(folder / "halves.pfm");
        return Bits(bytes.begin(), bytes.end());
    }));
}

TEST_CASE("rounding: shapes")
{
    CHECK(isSame([] { return bitsOf(makeCube()); }));
    CHECK(isSame([] { return bitsOf(makeSphere(23, 11)); }));
    CHECK(isSame([] { return bitsOf(makeCubeSphere(7)); }));
    CHECK(isSame([] { return bitsOf(makeTerrain(13, 9)); }));
}

TEST_CASE("rounding: meshes that are made of meshes")
{
    const Mesh sphere = makeSphere(23, 11), cube = makeCubeSphere(5);
    CHECK(isSame([&] { return bitsOf(withMirroredUv(sphere)); }));
    CHECK(isSame([&] { return bitsOf(*withTangents(sphere)); }));
    CHECK(isSame([&] { return bitsOf(*withSphericalUvs(cube)); }));
    CHECK(isSame([&] {
        return bitsOf(*displaced(
            sphere, [](float u, float v) { return u * v; }, 0.1f));
    }));
    CHECK(isSame([&] {
        Mesh mesh = sphere;
        computeNormals(mesh);
        return bitsOf(mesh);
    }));
    CHECK(isSame([&] {
        const Bounds bounds = transformed(boundsOf(sphere), glm::mat4(0.3f));
        Bits bits;
        append(bits, std::vector<glm::vec3>{Bounds{{0.1f, 0.3f, -0.7f}, {0.77f, 0.9f, 1e-40f}}.centre()});
        append(bits, std::vector<glm::vec3>{bounds.low,
                                            bounds.high,
                                            bounds.centre(),
                                            {bounds.radius(), bounds.squaredDistance({0.7f, 0.9f, 1.3f}), 0.0f}});
        return bits;
    }));
    CHECK(isSame([&] {
        Bits bits;
        const RayTree tree(sphere);
        for (int i = 0; i < 50; ++i) {
            const auto hit = tree.firstHit({glm::dvec3(0.0078125 * i, 0.3, -2.0), glm::dvec3(0, 0, 1), 0.0, 10.0});
            if (!hit) continue;
            const auto t = std::bit_cast<std::uint64_t>(hit->t);
            bits.insert(bits.end(), {hit->triangle, static_cast<std::uint32_t>(t)});
        }
        return bits;
    }));
    const TemporaryFolder folder;
    const std::string path = folder.write("a.obj", "v 0.1 0.7 1e-40\nv 1.3 0.123456789123 0\nv 0 1 0.3\nf 1 2 3\n");
    CHECK(isSame([&] { return bitsOf(*readObj(path)); }));
}

TEST_CASE("rounding: baked maps")
{
    const Mesh low = *withTangents(makeSphere(12, 6)), high = makeSphere(40, 20);
    const BakeOptions options{.width = 32, .height = 24};
    const BakedNormalMap map = *bakeNormalMap(low, high, options);
    const auto bitsOfMap = [](const BakedNormalMap& m) {
        Bits bits = m.triangles;
        append(bits, m.normals);
        append(bits, m.detailNormals);
        return bits;
    };
    CHECK(isSame([&] { return bitsOfMap(*bakeNormalMap(low, high, options)); }));
    CHECK(isSame([&] { return bitsOfMap(roundedTo8Bits(map)); }));
    CHECK(isSame([&] {
        const AngleError error = *bakeError(map, low, {.binormal = BinormalAt::fragment, .orthonormalise = true});
        const auto mean = std::bit_cast<std::uint64_t>(error.mean), max = std::bit_cast<std::uint64_t>(error.max);
        return Bits{static_cast<std::uint32_t>(mean), static_cast<std::uint32_t>(mean >> 32),
                    static_cast<std::uint32_t>(max), static_cast<std::uint32_t>(max >> 32)};
    }));
    CHECK(isSame([&] {
        Bits bits;
        for (const float value : rgbaOf(map)) bits.push_back(std::bit_cast<std::uint32_t>(value));
        return bits;
    }));
}

TEST_CASE("rounding: textures and all of their levels")
{
    const Image8 image = noise(37, 21);
    Image16 wide{37, 21, {}};
    ImageFloat floats{37, 21, {}};
    for (const std::uint8_t value : image.pixels) {
        wide.pixels.push_back(static_cast<std::uint16_t>(value * 251 + 7));
        floats.pixels.push_back(static_cast<float>(value) * 0.37f + 1e-40f);
    }
    for (const ColorSpace meaning : {ColorSpace::linear, ColorSpace::srgb}) {
        CHECK(isSame([&] { return bitsOf(*Texture::fromRgba8(37, 21, image.pixels, meaning)); }));
        CHECK(isSame([&] { return bitsOf(*Texture::fromRgba16(37, 21, wide.pixels, meaning)); }));
    }
    CHECK(isSame([&] { return bitsOf(*Texture::fromRgbaFloat(37, 21, floats.pixels)); }));

    using Settings = ImportSettings;
    for (const auto kind : {Settings::Kind::color, Settings::Kind::normalMap}) {
        for (const auto storage : {Settings::Storage::rgb, Settings::Storage::dxt5}) {
            const Settings settings{
                .kind = kind, .storage = storage, .normalFilter = NormalFilter::sobel, .fadeOutMips = true};
            CHECK(isSame([&] { return bitsOf(*importTexture(ImageFile(image), settings)); }));
        }
    }
}

TEST_CASE("rounding: the steps of an import by themselves")
{
    const ImageFile picture = noise(37, 21);
    const HeightField heights = heightsOf(picture);
    const MipLevel normals = normalsFromColors(picture), colors = levelFromPicture(picture, ColorSpace::srgb);
    CHECK(isSame([&] {
        Bits bits;
        for (const float value : heightsOf(picture).values) bits.push_back(std::bit_cast<std::uint32_t>(value));
        return bits;
    }));
    CHECK(isSame([&] { return bitsOf(normalsFromHeights(heights, 0.3f, NormalFilter::smooth)); }));
    CHECK(isSame([&] { return bitsOf(normalsFromColors(picture)); }));
    CHECK(isSame([&] { return bitsOf(normalizedNormals(normals)); }));
    CHECK(isSame([&] { return bitsOf(encodeNormals(normals, NormalChannels::rgb)); }));
    CHECK(isSame([&] { return bitsOf(coarserLevel(TexelFormat::rgba32Float, normals)); }));
    CHECK(isSame([&] { return bitsOf(levelFromPicture(picture, ColorSpace::srgb)); }));
    CHECK(isSame([&] {
        MipLevel faded = normals;
        fadeToFlat(faded, 0.3);
        return bitsOf(faded);
    }));
    CHECK(isSame([&] {
        MipLevel faded = normals;
        fadeToGrey(TexelFormat::rgba32Float, ColorSpace::linear, faded, {1, 3});
        return bitsOf(faded);
    }));
    CHECK(isSame([&] {
        const MipLevel codes = levelFromPicture(picture, ColorSpace::linear);
        return bitsOf(decodeDxt5(encodeDxt5(codes), codes.width(), codes.height()));
    }));
    CHECK(isSame([&] {
        Bits bits;
        for (int code = 0; code < 65536; code += 77) {
            bits.push_back(srgbToLinear16(static_cast<std::uint16_t>(code)));
            bits.push_back(static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(decodeSrgb(code / 65536.0))));
        }
        return bits;
    }));
}

TEST_CASE("rounding: the smallest numbers of an HDR picture")
{
    const TemporaryFolder folder;
    const std::string path = folder.write(
        "a.hdr", std::string("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n") + std::string("\x80\x81\x07\x03", 4));
    CHECK(isSame([&] {
        Bits bits;
        const Expected<ImageFile> image = readImage(path);
        for (const float value : std::get<ImageFloat>(*image).pixels)
            bits.push_back(std::bit_cast<std::uint32_t>(value));
        return bits;
    }));
}
