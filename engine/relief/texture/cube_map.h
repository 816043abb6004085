// A cube map: six square pictures that together are what one sees all around from a point, and their mip levels. Made
// once and complete; how it is read is the sampler's business (cube_sampler.h). Which face is where: cube_face.h.
//
// Pictures become texels as those of a texture do (texture.h): row 0 in memory is a picture's lower row, sRGB codes are
// decoded once to 16 bits of linear light, and every coarser level is the average of the areas that its texels cover.
//
// Filters see no edges. Every face has a frame of one texel (mip_chain.h), and it holds the texels of the four faces
// around it, so that the 2x2 texels of a bilinear fetch are always those that lie there. Beyond a corner there is no
// face: the frame's corner is the average of the three texels that meet, which gives the same result from all three.
#pragma once

#include <span>
#include <vector>

#include "relief/error.h"
#include "relief/texture/color_space.h"
#include "relief/texture/cube_face.h"
#include "relief/texture/image.h"
#include "relief/texture/mip_chain.h"

namespace relief {

inline constexpr int kMaxCubeSide = 4096;        // texels: the six faces of a level are one block of memory
inline constexpr float kMaxCubeTexel = 1.7e38f;  // half the range of floats: differences are finite

class CubeMap
{
public:
    // From six square pictures of the same kind and size, in the order of kCubeFaceNames. `meaning` is that of 8-bit
    // and 16-bit pictures; floats are linear. As all of these, an error of one line when a picture is not square, a
    // size or kind differs from the first one's, a side is not in 1..kMaxCubeSide, a float is NaN, infinite or beyond
    // kMaxCubeTexel, or the cube map does not fit into memory.
    static Expected<CubeMap> fromFaces(std::span<const ImageFile, kCubeFaces> faces, ColorSpace meaning);

    // From one picture, whose shape says what it is:
    //   4:3         a cross:                +y             3:4   a cross:       +y
    //                                    -x +z +x -z                         -x +z +x
    //                                       -y                                  -y
    //                                                                           -z, upside down
    //   6:1, 1:6    a strip of the faces in their order, beside or below each other
    //   2:1         longitude and latitude: the middle is +z, to the right comes +x, the upper edge is +y, the lower
    //   -y.
    //               Faces are width / 4 texels wide, and floats, whatever the picture is: a texel is the average of
    //               bilinear samples that lie as close as the picture's pixels
    //   levels      strips of six beside each other, left-aligned below each other, each half as high as the one above:
    //               levels that are given, as the prefiltered ones of shading/environment.h. Nothing is made of them
    // An error as above, or when the shape is none of these.
    static Expected<CubeMap> fromPicture(const ImageFile& picture, ColorSpace meaning);

    // From levels that are given, all of them or the first few: strips of six faces beside each other, the first one of
    // any side, each of the others half of that, rounded down (nextSide()). An error as above, or when there are none,
    // or more than go down to a side of 1.
    static Expected<CubeMap> fromLevels(std::span<const ImageFile> strips, ColorSpace meaning);

    CubeMap(const CubeMap& other);
    CubeMap(CubeMap&&) noexcept = default;
    CubeMap& operator=(const CubeMap& other) { return *this = CubeMap(other); }
    CubeMap& operator=(CubeMap&&) noexcept = default;

    static const CubeMap& white();  // one texel a face: (1, 1, 1, 1)

    int side() const { return levels[0].width(); }  // of level 0, in texels
    int levelCount() const { return static_cast<int>(levels.size()); }
    TexelFormat format() const { return texelFormat; }

    // The six faces of level k in 0..levelCount() - 1 above each other, frames included: texel (x, y) of face f,
    // counted from the lower left, is (x, rowOf(f, y, side)), for x and y = -1..side.
    const MipLevel& level(int k) const { return levels[static_cast<std::size_t>(k)]; }
    const LevelTable& levelTable() const { return table; }
    int levelsBuilt() const { return levelCount(); }
    static constexpr int rowOf(int face, int y, int side) { return face * (side + 2) + y; }

    // A texel as a fetch gives it, x and y from the lower left; -1 and the level's side are the frame.
    glm::vec4 texel(int k, int face, int x, int y) const;

private:
    explicit CubeMap(TexelFormat format) : texelFormat(format) {}  // without any level
    void add(std::span<const MipLevel> faces);
    static CubeMap fromFinest(TexelFormat format, std::vector<MipLevel> faces);

    TexelFormat texelFormat;
    std::vector<MipLevel> levels;
    LevelTable table;
};

}  // namespace relief
