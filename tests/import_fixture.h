// What the tests of imports share: pictures, settings, and whether two levels are the same.
#pragma once

#include <cstring>
#include <memory>
#include <string>
#include <utility>

#include <doctest/doctest.h>

#include "relief/texture/import.h"

namespace import_fixture {

using namespace relief;
using Kind = ImportSettings::Kind;
using Storage = ImportSettings::Storage;

inline const std::string kHeights = std::string(RELIEF_SOURCE_FOLDER) + "/assets/marble-heights.png";
inline const std::string kAlbedo = std::string(RELIEF_SOURCE_FOLDER) + "/assets/marble-albedo.png";

inline ImportSettings normalMap(Storage storage = Storage::rgb, float bumpiness = 0.05f)
{
    return {.kind = Kind::normalMap, .storage = storage, .bumpiness = bumpiness};
}

template <class Function>
Image8 pictureBy(int width, int height, Function f)  // f(x, y, channel)
{
    Image8 image{width, height, {}};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (int c = 0; c < 4; ++c) image.pixels.push_back(static_cast<std::uint8_t>(f(x, y, c)));
        }
    }
    return image;
}

inline Image8 onlyColour(int width, int height, int red, int green, int blue, int alpha)
{
    const int channels[] = {red, green, blue, alpha};
    return pictureBy(width, height, [&](int, int, int c) { return channels[c]; });
}

inline std::shared_ptr<const ImageFile> pictureOf(const std::string& path)
{
    Expected<ImageFile> picture = readImage(path);
    REQUIRE(picture);
    return std::make_shared<const ImageFile>(std::move(*picture));
}

inline bool holds(const std::uint8_t* texel, int red, int green, int blue, int alpha)
{
    return texel[0] == red && texel[1] == green && texel[2] == blue && texel[3] == alpha;
}

inline bool isFlat(const std::uint8_t* texel, Storage storage)
{
    return storage == Storage::rgb ? holds(texel, 128, 128, 255, 255) : holds(texel, 255, 128, 255, 128);
}

inline bool sameLevel(const MipLevel& a, const MipLevel& b)
{
    const std::size_t bytes = a.rowBytes() * static_cast<std::size_t>(a.height() + 2);
    return a.rowBytes() == b.rowBytes() && a.height() == b.height() && std::memcmp(a.texels(), b.texels(), bytes) == 0;
}

}  // namespace import_fixture
