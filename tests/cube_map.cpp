// Cube maps: that each face is where Direct3D has it, that all ways to make one agree, that filters see no edges, and
// what is refused.
#include "relief/texture/cube_map.h"

#include "contents.h"
#include "cube_fixture.h"

using namespace cube_fixture;

namespace {

// Puts a face into a larger picture, its upper left corner at (x, y); upside down is turned by 180 degrees.
void put(ImageFloat& picture, const ImageFile& face, int x, int y, bool upsideDown = false)
{
    const auto& image = std::get<ImageFloat>(face);
    const int side = image.width;
    for (int j = 0; j < side; ++j) {
        for (int i = 0; i < side; ++i) {
            const std::size_t from = upsideDown ? pixelIndex(side - 1 - i, side - 1 - j, side) : pixelIndex(i, j, side);
            std::copy_n(&image.pixels[from], 4, &picture.pixels[pixelIndex(x + i, y + j, picture.width)]);
        }
    }
}

struct At
{
    int column, row;
};

ImageFloat arranged(const Faces& faces, int columns, int rows, const std::array<At, kCubeFaces>& places,
                    bool lastUpsideDown = false)
{
    const int side = std::get<ImageFloat>(faces[0]).width;
    ImageFloat picture = emptyPicture(columns * side, rows * side);
    for (std::size_t f = 0; f < faces.size(); ++f)
        put(picture, faces[f], places[f].column * side, places[f].row * side, f == 5 && lastUpsideDown);
    return picture;
}

ImageFloat horizontalCross(const Faces& faces)
{
    return arranged(faces, 4, 3, {{{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {3, 1}}});
}

ImageFloat verticalCross(const Faces& faces)
{
    return arranged(faces, 3, 4, {{{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {1, 3}}}, true);
}

// The middle of the picture is +z, to the right comes +x.
ImageFloat latitudeLongitude(int height, const Radiance& radiance)
{
    ImageFloat picture = emptyPicture(2 * height, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < 2 * height; ++x) {
            const double turn = ((x + 0.5) / (2 * height) - 0.5) * 2.0 * 3.14159265358979;
            const double tilt = (0.5 - (y + 0.5) / height) * 3.14159265358979;
            const Direction d = {std::cos(tilt) * std::sin(turn), std::sin(tilt), std::cos(tilt) * std::cos(turn)};
            for (int c = 0; c < 4; ++c)
                picture.pixels[pixelIndex(x, y, 2 * height) + static_cast<std::size_t>(c)] =
                    static_cast<float>(radiance(d, c));
        }
    }
    return picture;
}

// The largest difference between texels of two cube maps, over all levels.
double farthest(const CubeMap& a, const CubeMap& b)
{
    REQUIRE(a.levelCount() == b.levelCount());
    REQUIRE(a.side() == b.side());
    double worst = 0.0;
    for (int k = 0; k < a.levelCount(); ++k) {
        const int side = a.level(k).width();
        for (int i = 0; i < kCubeFaces * side * side; ++i) {
            const int face = i / (side * side), x = i % side, y = i / side % side;
            for (int c = 0; c < 4; ++c)
                worst = std::fmax(worst, std::abs(static_cast<double>(a.texel(k, face, x, y)[c]) -
                                                  static_cast<double>(b.texel(k, face, x, y)[c])));
        }
    }
    return worst;
}

std::string errorOf(const Expected<CubeMap>& map)
{
    REQUIRE(!map.has_value());
    CHECK(map.error().message.find('\n') == std::string::npos);
    return map.error().message;
}

// What a sample 1e-5 beside an edge or corner differs by between the faces that meet there, for directions all along
// the edges.
struct Jumps
{
    double edge = 0.0, corner = 0.0;
};

Jumps jumpsOf(const samplerCUBE& s, float lod)
{
    constexpr double beside = 1.0 - 1e-5;
    Jumps jumps;
    Random random(3);
    for (int edge = 0; edge < 12; ++edge) {
        const int axis = edge / 4;  // that the edge runs along
        const double first = edge % 2 == 0 ? 1.0 : -1.0, second = edge / 2 % 2 == 0 ? 1.0 : -1.0;
        const auto direction = [&](double a, double b, double along) -> Direction {
            if (axis == 0) return {along, a, b};
            return axis == 1 ? Direction{b, along, a} : Direction{a, b, along};
        };
        for (int i = 0; i < 400; ++i) {
            const double along = i == 0 ? 0.0 : static_cast<double>(random(-1.0f, 1.0f));
            const float4 here = lodSample(s, direction(first, second * beside, along), lod);
            const float4 there = lodSample(s, direction(first * beside, second, along), lod);
            jumps.edge = std::fmax(jumps.edge, maxDifference(here, there));
        }
        for (const double end : {-1.0, 1.0}) {
            const float4 a = lodSample(s, direction(first, second * beside, end * beside), lod);
            const float4 b = lodSample(s, direction(first * beside, second, end * beside), lod);
            const float4 c = lodSample(s, direction(first * beside, second * beside, end), lod);
            jumps.corner = std::fmax(jumps.corner, std::fmax(maxDifference(a, b), maxDifference(a, c)));
        }
    }
    return jumps;
}

// The same of a reference that knows no neighbours: the frame is the face's own texel.
double jumpsWithoutFrames(const CubeMap& map, int level)
{
    const int side = map.level(level).width();
    double worst = 0.0;
    for (int i = 0; i < side; ++i) {  // the edge between +z and +x
        const glm::vec4 here = map.texel(level, 4, side - 1, i), there = map.texel(level, 0, 0, i);
        for (int c = 0; c < 4; ++c)
            worst = std::fmax(worst, std::abs(static_cast<double>(here[c]) - static_cast<double>(there[c])));
    }
    return worst;
}

}  // namespace

TEST_CASE("cube_map: every texel of every face is where Direct3D's table has it")
{
    for (const TexelFormat format : kColorFormats) {
        for (const int side : {1, 2, 5, 8}) {
            const CubeMap map = noiseCube(format, side, 7);
            const samplerCUBE s{.texture = &map, .filter = Filter::nearest, .mipmaps = false};
            Random random(4);
            int wrong = 0;
            for (int i = 0; i < trials(4000); ++i) {
                const Direction d = randomDirection(random);
                const OnFace place = onFace(d);
                const double x = (place.s + 1.0) * 0.5 * side, y = (place.t + 1.0) * 0.5 * side;
                if (std::abs(x - std::round(x)) < 0.01 || std::abs(y - std::round(y)) < 0.01) continue;
                // Rows of a picture count from the top, rows of texels from below.
                const glm::vec4 texel = map.texel(0, place.face, static_cast<int>(x), side - 1 - static_cast<int>(y));
                const float4 colour = texCUBE(s, toLanes(d));
                for (int c = 0; c < 4; ++c) wrong += colour[c][0] != texel[c] ? 1 : 0;
            }
            measured("texels that are not the table's", wrong, 0);
        }
    }
}

TEST_CASE("cube_map: pictures come in with row 0 on top, the right way round for who looks from the middle")
{
    // +z: left, right, up and down of who looks along +z, y up, in a left-handed world are -x, +x, +y, -y.
    const auto middle = [](double x, double y) { return Direction{x, y, 1.0}; };
    ImageFloat picture = emptyPicture(2, 2);
    for (int i = 0; i < 4; ++i) picture.pixels[static_cast<std::size_t>(i) * 4] = static_cast<float>(i);
    Faces faces;
    faces.fill(emptyPicture(2, 2));
    faces[4] = picture;
    const CubeMap map = *CubeMap::fromFaces(faces, ColorSpace::linear);
    const samplerCUBE s{.texture = &map, .filter = Filter::nearest, .mipmaps = false};
    CHECK(lodSample(s, middle(-0.5, 0.5)).x[0] == 0.0f);
    CHECK(lodSample(s, middle(0.5, 0.5)).x[0] == 1.0f);
    CHECK(lodSample(s, middle(-0.5, -0.5)).x[0] == 2.0f);
    CHECK(lodSample(s, middle(0.5, -0.5)).x[0] == 3.0f);
    CHECK(lodSample(s, {0.5, 0.5, -1.0}).x[0] == 0.0f);  // the other faces are black
}

TEST_CASE("cube_map: crosses, strips and levels below each other give the same cube as six faces")
{
    const int side = 6;
    const Faces faces = facesOf(side, smooth);
    const CubeMap expected = *CubeMap::fromFaces(faces, ColorSpace::linear);
    const ImageFloat beside = arranged(faces, 6, 1, {{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}}});
    const ImageFloat below = arranged(faces, 1, 6, {{{0, 0}, {0, 1}, {0, 2}, {0, 3}, {0, 4}, {0, 5}}});
    for (const ImageFloat& picture : {horizontalCross(faces), verticalCross(faces), beside, below})
        CHECK(farthest(*CubeMap::fromPicture(picture, ColorSpace::linear), expected) == 0.0);

    // Its levels, 6, 3 and 1 texels wide, as one picture.
    ImageFloat levels = emptyPicture(36, 10);
    for (int k = 0, y = 0; k < 3; y += expected.level(k++).width()) {
        const int size = expected.level(k).width();
        for (int i = 0; i < kCubeFaces * size * size; ++i) {
            const int face = i / (size * size), column = i % size, row = i / size % size;
            const glm::vec4 texel = expected.texel(k, face, column, size - 1 - row);
            std::copy_n(&texel[0], 4, &levels.pixels[pixelIndex(face * size + column, y + row, 36)]);
        }
    }
    CHECK(farthest(*CubeMap::fromPicture(levels, ColorSpace::linear), expected) == 0.0);
}

TEST_CASE("cube_map: where a cross is folded its pictures go on")
{
    // Of a smooth function neighbours in the picture differ by a step's change, about 1 / side, where the cube's faces
    // meet; the cross is made of faces that Direct3D's table made.
    const int side = 32;
    const Faces faces = facesOf(side, smooth);
    const auto step = [](const ImageFloat& picture, int x0, int y0, int x1, int y1) {
        double worst = 0.0;
        for (std::size_t c = 0; c < 4; ++c)
            worst =
                std::fmax(worst, std::abs(static_cast<double>(picture.pixels[pixelIndex(x0, y0, picture.width) + c]) -
                                          static_cast<double>(picture.pixels[pixelIndex(x1, y1, picture.width) + c])));
        return worst;
    };
    const ImageFloat wide = horizontalCross(faces), high = verticalCross(faces);
    double worst = 0.0;
    for (int i = 0; i < side; ++i) {
        for (const int fold : {1, 2, 3})
            worst = std::fmax(worst, step(wide, fold * side - 1, side + i, fold * side, side + i));
        for (const int fold : {1, 2})
            worst = std::fmax(worst, step(wide, side + i, fold * side - 1, side + i, fold * side));
        for (const int fold : {1, 2, 3})
            worst = std::fmax(worst, step(high, side + i, fold * side - 1, side + i, fold * side));
    }
    measured("step over a fold, of a range of 1", worst, 2.0 / side);
}

TEST_CASE("cube_map: a picture of longitude and latitude gives the cube of the same function")
{
    for (const int height : {32, 128}) {
        const CubeMap world = *CubeMap::fromPicture(latitudeLongitude(height, smooth), ColorSpace::linear);
        CHECK(world.side() == height / 2);
        CHECK(world.format() == TexelFormat::rgba32Float);
        // A texel is a mean over its area: a second derivative over a texel, 1 / side^2.
        measured("farthest from the cube of six faces", farthest(world, cubeOf(height / 2, smooth)) * height * height,
                 4.0);
    }
    Image8 picture{8, 4, std::vector<std::uint8_t>(8 * 4 * 4, 188)};
    const CubeMap grey = *CubeMap::fromPicture(picture, ColorSpace::srgb);
    CHECK(grey.side() == 2);
    CHECK(grey.texel(0, 2, 0, 0).x == static_cast<float>(srgbToLinear16(std::uint8_t{188})) / 65535.0f);
    CHECK(CubeMap::fromPicture(Image8{2, 1, std::vector<std::uint8_t>(8, 1)}, ColorSpace::srgb)->side() == 1);
}

TEST_CASE("cube_map: no jump at edges and corners, on any level, where texels know no pattern")
{
    for (const TexelFormat format : kColorFormats) {
        for (const int side : {1, 2, 5, 16}) {
            const CubeMap map = noiseCube(format, side);
            const samplerCUBE s{.texture = &map};
            for (int k = 0; k < map.levelCount(); ++k) {
                const Jumps jumps = jumpsOf(s, static_cast<float>(k));
                // 1e-5 of a face is 8e-5 texels; weights are rounded to 1/4096, on both faces and along both axes.
                measured("jump over an edge, of a range of 1", jumps.edge, 8e-4);
                measured("jump at a corner", jumps.corner, 8e-4);
            }
            stability::noted("the same without a frame", jumpsWithoutFrames(map, 0));
            CHECK(jumpsWithoutFrames(map, 0) > 0.1);
        }
    }
}

TEST_CASE("cube_map: of a smooth function a sample is as near at edges and corners as elsewhere")
{
    const int side = 32;
    const CubeMap map = cubeOf(side, smooth);
    const samplerCUBE s{.texture = &map, .filter = Filter::bilinear, .mipmaps = false};
    Random random(8);
    double middle = 0.0, edge = 0.0;
    for (int i = 0; i < trials(20000); ++i) {
        const Direction d = randomDirection(random);
        const OnFace place = onFace(d);
        const float4 colour = texCUBE(s, toLanes(d));
        const bool isEdge = std::fmax(std::abs(place.s), std::abs(place.t)) > 1.0 - 1.0 / side;
        double& worst = isEdge ? edge : middle;
        for (int c = 0; c < 4; ++c)
            worst = std::fmax(worst, std::abs(static_cast<double>(colour[c][0]) - smooth(d.unit(), c)));
    }
    measured("error inside of faces", middle, 4e-4);
    // Beyond the edge the frame's texel lies at another distance than the next one on this face would: half a texel's
    // change at most.
    measured("error within half a texel of edges", edge, 0.5 / side);
}

TEST_CASE("cube_map: levels are averages of the areas that their texels cover")
{
    const CubeMap map = noiseCube(TexelFormat::rgba32Float, 8);
    CHECK(map.levelCount() == 4);
    for (int f = 0; f < kCubeFaces; ++f) {
        for (int k = 1; k < 4; ++k) {
            const int side = 8 >> k;
            for (int i = 0; i < side * side; ++i) {
                const int x = i % side, y = i / side;
                const glm::vec4 mean =
                    (map.texel(k - 1, f, 2 * x, 2 * y) + map.texel(k - 1, f, 2 * x + 1, 2 * y) +
                     map.texel(k - 1, f, 2 * x, 2 * y + 1) + map.texel(k - 1, f, 2 * x + 1, 2 * y + 1)) *
                    0.25f;
                for (int c = 0; c < 4; ++c) CHECK(std::abs(map.texel(k, f, x, y)[c] - mean[c]) < 1e-6f);
            }
        }
    }
}

TEST_CASE("cube_map: what cannot be one is refused in a line that names it")
{
    const auto of = [](int width, int height) {
        return CubeMap::fromPicture(emptyPicture(width, height), ColorSpace::linear);
    };
    for (const auto& [width, height] :
         {std::pair{5, 5}, {100, 50 + 1}, {24, 3}, {7, 1}, {12, 4}, {6, 3}, {1, 1}, {3, 1}})
        if (width != 2 * height) CHECK(contains(errorOf(of(width, height)), "pixels; a cube map takes a cross"));
    CHECK(contains(errorOf(CubeMap::fromPicture(ImageFloat{8, 4, {1.0f}}, ColorSpace::linear)), "picture: 1 numbers"));
    CHECK(contains(errorOf(CubeMap::fromPicture(ImageFloat{}, ColorSpace::linear)), "each side must be in 1.."));

    Faces faces = facesOf(4, smooth);
    faces[3] = emptyPicture(4, 5);
    CHECK(contains(errorOf(CubeMap::fromFaces(faces, ColorSpace::linear)), "face -y: is 4x5 pixels; make it square"));
    faces[3] = emptyPicture(5, 5);
    CHECK(contains(errorOf(CubeMap::fromFaces(faces, ColorSpace::linear)), "face -y: is 5x5 pixels, and +x is 4x4"));
    faces[3] = Image8{4, 4, std::vector<std::uint8_t>(64)};
    CHECK(contains(errorOf(CubeMap::fromFaces(faces, ColorSpace::linear)), "one size and kind of number"));
    faces.fill(Image8{kMaxCubeSide + 1, kMaxCubeSide + 1, {}});
    CHECK(contains(errorOf(CubeMap::fromFaces(faces, ColorSpace::linear)), "face +x: faces of 4097x4097 pixels"));

    for (const float number : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                               -std::numeric_limits<float>::infinity(), 3e38f}) {
        faces = facesOf(4, smooth);
        std::get<ImageFloat>(faces[2]).pixels[pixelIndex(3, 1, 4) + 2] = number;
        CHECK(contains(errorOf(CubeMap::fromFaces(faces, ColorSpace::linear)),
                       "face +y: pixel (3, 1) is NaN, infinite or larger than 1.7e38"));
        CHECK(contains(errorOf(CubeMap::fromPicture(horizontalCross(faces), ColorSpace::linear)),
                       "picture: pixel (7, 1)"));
    }

    std::vector<ImageFile> strips;
    CHECK(contains(errorOf(CubeMap::fromLevels(strips, ColorSpace::linear)), "levels: there are none"));
    strips = {emptyPicture(24, 4), emptyPicture(12, 2), emptyPicture(6, 1)};
    CHECK(CubeMap::fromLevels(strips, ColorSpace::linear)->levelCount() == 3);
    strips.push_back(emptyPicture(6, 1));
    CHECK(
        contains(errorOf(CubeMap::fromLevels(strips, ColorSpace::linear)), "level 3: the one before has faces of one"));
    strips = {emptyPicture(24, 4), emptyPicture(18, 3)};
    CHECK(contains(errorOf(CubeMap::fromLevels(strips, ColorSpace::linear)), "level 1: is 18x3 pixels"));
}

TEST_CASE("cube_map: huge texels stay finite through levels, frames and filters")
{
    for (const float number : {1e30f, kMaxCubeTexel, -kMaxCubeTexel}) {
        const CubeMap map = cubeOf(4, [=](const Direction& d, int) { return d.x > 0 ? number : -number; });
        const samplerCUBE s{.texture = &map};
        Random random(5);
        int wrong = 0;
        for (int i = 0; i < 300; ++i) {
            const float4 colour = lodSample(s, randomDirection(random), random(0.0f, 2.0f));
            for (int c = 0; c < 4; ++c) wrong += std::abs(colour[c][0]) <= kMaxCubeTexel ? 0 : 1;
        }
        measured("numbers that are not finite", wrong, 0);
    }
}
