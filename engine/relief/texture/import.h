// Import settings: from a picture to the texture that a material wants, as Unity's importer does it. What enters is an
// image file or its pixels, and the settings; what leaves is a texture whose levels are made when they are first
// sampled. How it is filtered and repeated is the sampler's business (sampler.h).
//
// Grey, for mip levels that fade out, is what detail maps and normal maps do nothing with: code 128 of 8 bits for
// colours, which is Texture::grey() in sRGB (times 4.59, Unity's factor for detail maps, 0.992), one half for pictures
// of floats, and (0, 0, 1) for normals. Colours go there in their codes, sRGB ones in sRGB; alpha stays.
#pragma once

#include <memory>
#include <string>

#include "relief/error.h"
#include "relief/texture/image.h"
#include "relief/texture/normal_map.h"
#include "relief/texture/texture.h"

namespace relief {

inline constexpr float kMaxBumpiness = 16.0f;

struct ImportSettings
{
    enum class Kind
    {
        color,
        normalMap  // from heights or from a picture of normals; always linear
    };
    enum class FromGreyscale
    {
        automatic,  // a picture with red = green = blue everywhere holds heights, any other normals
        no,
        yes
    };
    // rgb: colours as Texture::from... keep them; normals as rgba8 codes.
    // dxt5nm: normals only: rgba8 codes, y in green, x in alpha, 255 in red and blue. Normals below the surface, which
    // only pictures of normals can have, lose their sign of z.
    // dxt5: what blocks of DXT5 (dxt5.h) keep of 8-bit codes: for normals those of dxt5nm, for colours the picture's.
    enum class Storage
    {
        rgb,
        dxt5nm,
        dxt5
    };

    Kind kind = Kind::color;
    ColorSpace colorSpace = ColorSpace::srgb;  // of a colour; pictures of floats are linear whatever it says
    Storage storage = Storage::rgb;

    // Of a normal map.
    FromGreyscale fromGreyscale = FromGreyscale::automatic;
    float bumpiness = 0.25f;  // 0..kMaxBumpiness, of the heights: see normalsFromHeights
    NormalFilter normalFilter = NormalFilter::smooth;

    // Level fadeFirst and those before are as they are; from there to fadeLast they go evenly to grey, and stay grey.
    // 0 <= fadeFirst <= fadeLast < kMaxMipLevels; equal: grey from that level on.
    bool fadeOutMips = false;
    int fadeFirst = 1;
    int fadeLast = 3;

    bool operator==(const ImportSettings&) const = default;
};

// The texture of a picture in memory. No level exists before it is sampled (except that of a 1x1 texture), and the
// picture is released once level 0 is made. Level k of a normal map is the area average of the normals of level 0, made
// unit length, then faded, then stored; colours are averaged in linear light.
// `picture` is not null. An error when a setting is out of range or does not fit the picture, or the picture has no
// possible size.
Expected<Texture> importTexture(std::shared_ptr<const ImageFile> picture, const ImportSettings& settings);
Expected<Texture> importTexture(ImageFile picture, const ImportSettings& settings);

// The texture of an image file. The file is read at once. Imports are remembered: the same path, size and time of
// change of the file, and settings give the same texture, as long as somebody holds it or it is among the last 8 that
// were asked for. Settings differing, the decoded picture is shared if it is still needed. Any number of threads may
// call at once. An error, with the path in front, when the file is not an image (see readImage) or as above.
Expected<std::shared_ptr<const Texture>> importTexture(const std::string& path, const ImportSettings& settings);

}  // namespace relief
