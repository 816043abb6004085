// Cube maps from pictures: which part of a picture is which face, levels, and the frames around faces.
#include "relief/texture/cube_map.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <variant>

#include "relief/lanes/environment.h"
#include "relief/lanes/math.h"
#include "relief/memory.h"
#include "relief/texture/pixels.h"
#include "relief/texture/sampler.h"
#include "relief/texture/shading_scope.h"

namespace relief {
namespace {

std::string sizeOf(const ImageFile& picture)
{
    return std::visit(
        [](const auto& image) { return std::to_string(image.width) + "x" + std::to_string(image.height); }, picture);
}

int widthOf(const ImageFile& picture)
{
    return std::visit([](const auto& image) { return image.width; }, picture);
}

int heightOf(const ImageFile& picture)
{
    return std::visit([](const auto& image) { return image.height; }, picture);
}

// --- what is wrong with a picture, or nothing ---

std::string problemWithSide(TexelFormat format, int side)
{
    const std::string name = std::to_string(side) + "x" + std::to_string(side);
    if (side < 1 || side > kMaxCubeSide) {
        return "faces of " + name + " pixels are not possible; each side must be in 1.." + std::to_string(kMaxCubeSide);
    }
    // Pictures of the faces, their texels, and those with a third more in coarser levels.
    if (fitsInMemory(4 * kCubeFaces * levelBytes(format, side, side))) return {};
    return "a cube map with faces of " + name + " texels does not fit into memory; make it smaller";
}

std::string problemWithTexels(const ImageFile& picture)
{
    const auto* image = std::get_if<ImageFloat>(&picture);
    if (image == nullptr) return {};
    const auto isFine = [](float number) { return std::abs(number) <= kMaxCubeTexel; };  // no NaN is
    const auto wrong = std::find_if_not(image->pixels.begin(), image->pixels.end(), isFine);
    if (wrong == image->pixels.end()) return {};
    const auto pixel = (wrong - image->pixels.begin()) / 4;
    return "pixel (" + std::to_string(pixel % image->width) + ", " + std::to_string(pixel / image->width) +
           ") is NaN, infinite or larger than 1.7e38; replace it";
}

std::string problemWithPicture(const ImageFile& picture)
{
    if (std::string problem = problemWithPixels(picture); !problem.empty()) return problem;
    return problemWithTexels(picture);
}

// --- parts of pictures ---

struct Part
{
    int x, y, side;  // pixels, from the upper left corner
    bool upsideDown = false;
};

template <class Channel>
ImageOf<Channel> cut(const ImageOf<Channel>& image, const Part& part)
{
    const auto side = static_cast<std::size_t>(part.side);
    ImageOf<Channel> face{part.side, part.side, std::vector<Channel>(side * side * 4)};
    for (int y = 0; y < part.side; ++y) {
        for (int x = 0; x < part.side; ++x) {
            const int fromX = part.x + (part.upsideDown ? part.side - 1 - x : x);
            const int fromY = part.y + (part.upsideDown ? part.side - 1 - y : y);
            const auto from = static_cast<std::size_t>(fromY) * static_cast<std::size_t>(image.width) +
                              static_cast<std::size_t>(fromX);
            const auto to = static_cast<std::size_t>(y) * side + static_cast<std::size_t>(x);
            std::copy_n(&image.pixels[from * 4], 4, &face.pixels[to * 4]);
        }
    }
    return face;
}

ImageFile cutPart(const ImageFile& picture, const Part& part)
{
    return std::visit([&part](const auto& image) { return ImageFile(cut(image, part)); }, picture);
}

using Parts = std::array<Part, kCubeFaces>;

// Where the faces of a cross or strip are, by column and row.
Parts partsOf(int side, const std::array<std::array<int, 2>, kCubeFaces>& places)
{
    Parts parts{};
    for (std::size_t f = 0; f < parts.size(); ++f) parts[f] = {places[f][0] * side, places[f][1] * side, side};
    return parts;
}

Parts stripAt(int side, int y)
{
    Parts parts = partsOf(side, {{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}}});
    for (Part& part : parts) part.y = y;
    return parts;
}

std::vector<MipLevel> facesIn(const ImageFile& picture, const Parts& parts, ColorSpace meaning)
{
    std::vector<MipLevel> faces;
    for (const Part& part : parts) faces.push_back(levelFromPicture(cutPart(picture, part), meaning));
    return faces;
}

// Of a picture of so many pixels that is a cross or one strip; nothing where it is neither.
std::optional<Parts> partsOfShape(int width, int height)
{
    const auto isShape = [&](int columns, int rows) {
        return width % columns == 0 && height % rows == 0 && width / columns == height / rows;
    };
    if (isShape(4, 3)) return partsOf(width / 4, {{{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {3, 1}}});
    if (isShape(6, 1)) return stripAt(height, 0);
    if (isShape(1, 6)) return partsOf(width, {{{0, 0}, {0, 1}, {0, 2}, {0, 3}, {0, 4}, {0, 5}}});
    if (!isShape(3, 4)) return std::nullopt;
    Parts parts = partsOf(width / 3, {{{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {1, 3}}});
    parts[5].upsideDown = true;
    return parts;
}

// The sides of the levels that a picture of strips below each other holds; empty where its height is that of none.
std::vector<int> sidesOfStrips(int width, int height)
{
    std::vector<int> sides;
    int side = width / kCubeFaces, left = height;
    while (width % kCubeFaces == 0 && left >= side && side > 0) {
        sides.push_back(side);
        left -= side;
        side /= 2;
    }
    return left == 0 ? sides : std::vector<int>();
}

// --- longitude and latitude ---

// What a texture is made of, without levels that nobody asks for.
Expected<Texture> worldOf(const ImageFile& picture, ColorSpace meaning)
{
    const TexelFormat format = formatOf(picture, meaning);
    return Texture::fromLevels(format, widthOf(picture), heightOf(picture),
                               [&picture, meaning, format](int k, const MipLevel* finer) {
                                   return k == 0 ? levelFromPicture(picture, meaning) : coarserLevel(format, *finer);
                               });
}

// One face: every texel is the mean of n x n samples, kept as a running mean, so that equal samples give exactly
// themselves.
MipLevel faceOfWorld(const Texture& world, int face, int side)
{
    const sampler2D s = {.texture = &world, .filter = Filter::bilinear, .v = AddressMode::clamp, .mipmaps = false};
    constexpr float pi = 3.14159265f;
    const int n = static_cast<int>(std::ceil(static_cast<float>(world.width()) / (pi * static_cast<float>(side))));
    const float step = 2.0f / static_cast<float>(side * n);
    float firstLanes[kLanes];
    for (int i = 0; i < kLanes; ++i) firstLanes[i] = static_cast<float>(i * n);
    const Float first = Float::load(firstLanes);

    MipLevel level(TexelFormat::rgba32Float, side, side);
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; x += kLanes) {
            float4 mean(0.0f);
            for (int i = 0; i < n * n; ++i) {
                const float column = static_cast<float>(x * n + i % n) + 0.5f;
                const float row = static_cast<float>(y * n + i / n) + 0.5f;
                const float3 d = cubeDirection(face, (first + column) * step - 1.0f, Float(row * step - 1.0f));
                const Float u = atan2(d.x, d.z) * (0.5f / pi) + 0.5f;
                const Float v = atan2(d.y, sqrt(d.x * d.x + d.z * d.z)) * (1.0f / pi) + 0.5f;
                mean = mean + (tex2D(s, {u, v}) - mean) * (1.0f / static_cast<float>(i + 1));
            }
            for (int i = 0; i < std::min(kLanes, side - x); ++i) {
                for (int c = 0; c < 4; ++c) level.texel<float>(x + i, y)[c] = mean[c][i];
            }
        }
    }
    return level;
}

// --- frames ---

template <class Channel>
void average(const std::array<const Channel*, 3>& texels, Channel* result)
{
    for (int c = 0; c < 4; ++c) {
        if constexpr (std::is_floating_point_v<Channel>) {
            const double sum = static_cast<double>(texels[0][c]) + texels[1][c] + texels[2][c];
            result[c] = static_cast<Channel>(sum / 3.0);
        } else {
            const std::uint32_t sum = std::uint32_t{texels[0][c]} + texels[1][c] + texels[2][c];
            result[c] = static_cast<Channel>((2 * sum + 3) / 6);
        }
    }
}

// A texel (x, y) of face f's frame, from the texels of the other faces that lie at the same point of the cube. Points
// count half texels: the cube goes from -side to side, a texel's middle is at an odd number where its side is even.
template <class Channel>
void fillFrameTexel(MipLevel& level, int f, int x, int y)
{
    const int side = level.width();
    const auto place = [side](int at) { return std::clamp(2 * at + 1 - side, -side, side); };
    const CubeFaceAxes& axes = kCubeFaceAxes[static_cast<std::size_t>(f)];
    const glm::ivec3 point = axes.middle * side + axes.right * place(x) + axes.up * place(y);
    const auto dot = [&point](const glm::ivec3& axis) {
        return point.x * axis.x + point.y * axis.y + point.z * axis.z;
    };

    std::array<const Channel*, 3> texels{};
    std::size_t count = 0;
    for (int g = 0; g < kCubeFaces; ++g) {
        const CubeFaceAxes& other = kCubeFaceAxes[static_cast<std::size_t>(g)];
        if (dot(other.middle) != side) continue;  // not on this face
        const int column = std::min((dot(other.right) + side) / 2, side - 1);
        const int row = std::min((dot(other.up) + side) / 2, side - 1);
        const Channel* texel = level.texel<Channel>(column, CubeMap::rowOf(g, row, side));
        const bool isCorner = (x < 0 || x == side) && (y < 0 || y == side);
        if (isCorner || g != f) texels[count++] = texel;
    }
    Channel* result = level.texel<Channel>(x, CubeMap::rowOf(f, y, side));
    if (count == 3)
        average(texels, result);
    else
        std::copy_n(texels[0], 4, result);
}

template <class Channel>
void fillFrames(MipLevel& level)
{
    const int side = level.width();
    for (int f = 0; f < kCubeFaces; ++f) {
        for (int i = -1; i <= side; ++i) {
            fillFrameTexel<Channel>(level, f, i, -1);
            fillFrameTexel<Channel>(level, f, i, side);
            fillFrameTexel<Channel>(level, f, -1, i);
            fillFrameTexel<Channel>(level, f, side, i);
        }
    }
}

// The frames and all of an empty level.
template <class Channel>
void fill(MipLevel& level, std::span<const MipLevel> faces)
{
    const int side = level.width();
    for (int f = 0; f < kCubeFaces; ++f) {
        const MipLevel& face = faces[static_cast<std::size_t>(f)];
        for (int y = 0; y < side; ++y)
            std::copy_n(face.texel<Channel>(0, y), side * 4, level.texel<Channel>(0, CubeMap::rowOf(f, y, side)));
    }
    fillFrames<Channel>(level);
    // Looks whether alpha is 1 everywhere, frames included, and writes over the outer ones.
    level.fillFrame();
    fillFrames<Channel>(level);
}

}  // namespace

CubeMap::CubeMap(const CubeMap& other) : texelFormat(other.texelFormat), levels(other.levels), table(other.table)
{
    for (int k = 0; k < levelCount(); ++k) table.setTexels(k, level(k));
}

// Puts six faces above each other, as the next level.
void CubeMap::add(std::span<const MipLevel> faces)
{
    const int side = faces[0].width();
    MipLevel& level = levels.emplace_back(texelFormat, side, rowOf(kCubeFaces, -2, side));
    switch (texelFormat) {
        case TexelFormat::rgba8:
            fill<std::uint8_t>(level, faces);
            break;
        case TexelFormat::rgba16:
            fill<std::uint16_t>(level, faces);
            break;
        case TexelFormat::rgba32Float:
        case TexelFormat::r32Float:  // which no picture gives
            fill<float>(level, faces);
            break;
    }
    const int number = levelCount() - 1;
    table.setSize(texelFormat, number, level.width(), level.height());
    table.setTexels(number, level);
}

CubeMap CubeMap::fromFinest(TexelFormat format, std::vector<MipLevel> faces)
{
    CubeMap map(format);
    const int count = mipLevelCount(faces[0].width(), faces[0].height());
    for (int k = 0; k < count; ++k) {
        if (k > 0) {
            for (MipLevel& face : faces) face = coarserLevel(format, face);
        }
        map.add(faces);
    }
    return map;
}

Expected<CubeMap> CubeMap::fromFaces(std::span<const ImageFile, kCubeFaces> faces, ColorSpace meaning)
{
    const DefaultFloatingPoint environment;
    const TexelFormat format = formatOf(faces[0], meaning);
    const int side = widthOf(faces[0]);
    for (std::size_t f = 0; f < faces.size(); ++f) {
        const auto problem = [f](const std::string& what) {
            return fail("face " + std::string(kCubeFaceNames[f]) + ": " + what);
        };
        const ImageFile& face = faces[f];
        if (widthOf(face) != heightOf(face)) return problem("is " + sizeOf(face) + " pixels; make it square");
        if (widthOf(face) != side || face.index() != faces[0].index()) {
            return problem("is " + sizeOf(face) + " pixels, and +x is " + sizeOf(faces[0]) +
                           "; all six must have one size and kind of number");
        }
        if (f == 0) {
            if (const std::string what = problemWithSide(format, side); !what.empty()) return problem(what);
        }
        if (const std::string what = problemWithPicture(face); !what.empty()) return problem(what);
    }
    std::vector<MipLevel> finest;
    for (const ImageFile& face : faces) finest.push_back(levelFromPicture(face, meaning));
    return fromFinest(format, std::move(finest));
}

Expected<CubeMap> CubeMap::fromLevels(std::span<const ImageFile> strips, ColorSpace meaning)
{
    const DefaultFloatingPoint environment;
    if (strips.empty()) return fail("levels: there are none; pass at least one strip of six faces");
    CubeMap map(formatOf(strips[0], meaning));
    int side = heightOf(strips[0]);
    for (std::size_t k = 0; k < strips.size(); ++k) {
        const auto problem = [k](const std::string& what) { return fail("level " + std::to_string(k) + ": " + what); };
        const ImageFile& strip = strips[k];
        if (k > 0 && side == 1) return problem("the one before has faces of one pixel; leave this one out");
        if (k > 0) side /= 2;
        if (heightOf(strip) != side || widthOf(strip) != kCubeFaces * side || strip.index() != strips[0].index()) {
            return problem("is " + sizeOf(strip) + " pixels; a strip of six faces of one kind of number, " +
                           std::to_string(kCubeFaces * side) + "x" + std::to_string(side) + ", is needed");
        }
        if (const std::string what = problemWithSide(map.format(), side); !what.empty()) return problem(what);
        if (const std::string what = problemWithPicture(strip); !what.empty()) return problem(what);
        map.add(facesIn(strip, stripAt(side, 0), meaning));
    }
    return map;
}

Expected<CubeMap> CubeMap::fromPicture(const ImageFile& picture, ColorSpace meaning)
{
    const DefaultFloatingPoint environment;
    if (std::string problem = problemWithPicture(picture); !problem.empty()) return fail("picture: " + problem);
    const int width = widthOf(picture), height = heightOf(picture);
    const std::optional<Parts> parts = partsOfShape(width, height);
    const std::vector<int> strips = sidesOfStrips(width, height);
    const bool isWorld = width == 2 * height;
    if (!parts && strips.empty() && !isWorld) {
        return fail("picture: is " + sizeOf(picture) +
                    " pixels; a cube map takes a cross (4:3 or 3:4), six faces in a strip (6:1 or 1:6), longitude and "
                    "latitude (2:1), or levels below each other");
    }

    CubeMap map(isWorld ? TexelFormat::rgba32Float : formatOf(picture, meaning));
    const int side = parts ? (*parts)[0].side : isWorld ? std::max(1, width / 4) : strips[0];
    if (std::string problem = problemWithSide(map.format(), side); !problem.empty()) return fail("picture: " + problem);
    if (parts) return fromFinest(map.format(), facesIn(picture, *parts, meaning));
    if (isWorld) {
        const ShadingScope scope;
        const Expected<Texture> world = worldOf(picture, meaning);
        if (!world) return tl::unexpected(world.error());
        std::vector<MipLevel> faces;
        for (int f = 0; f < kCubeFaces; ++f) faces.push_back(faceOfWorld(*world, f, side));
        return fromFinest(map.format(), std::move(faces));
    }
    int y = 0;
    for (const int level : strips) {
        map.add(facesIn(picture, stripAt(level, y), meaning));
        y += level;
    }
    return map;
}

const CubeMap& CubeMap::white()
{
    static const CubeMap map = *fromPicture(Image8{6, 1, std::vector<std::uint8_t>(24, 255)}, ColorSpace::linear);
    return map;
}

glm::vec4 CubeMap::texel(int k, int face, int x, int y) const
{
    const DefaultFloatingPoint environment;
    return readTexel(texelFormat, level(k), x, rowOf(face, y, level(k).width()));
}

}  // namespace relief
