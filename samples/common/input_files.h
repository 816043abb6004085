// The user's files for a stage. A header of its own, so that what reads the command line needs no engine.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace relief::samples {

// The pictures that a stage can have, each with an option of its own: --albedo FILE ... --environment FILE.
enum class TextureSlot
{
    albedo,
    height,
    normal,
    detail,
    detailNormal,
    mask,
    emission,
    environment  // no texture: what surrounds the scene (environment.h)
};
inline constexpr std::array kTextureOptions = {"albedo",        "height", "normal",   "detail",
                                               "detail-normal", "mask",   "emission", "environment"};

// Something of each of them, in this order.
template <class T>
struct PerTexture : std::array<T, kTextureOptions.size()>
{
    using std::array<T, kTextureOptions.size()>::operator[];
    T& operator[](TextureSlot slot) { return (*this)[static_cast<std::size_t>(slot)]; }
    const T& operator[](TextureSlot slot) const { return (*this)[static_cast<std::size_t>(slot)]; }
};

// The user's files in place of the defaults; empty: the default, "none": nothing. `mesh` may also be the name of a
// primitive. And how to import normal maps.
struct InputFiles
{
    std::string mesh;
    PerTexture<std::string> textures;
    std::vector<std::string> import;  // see import_options.h

    bool operator==(const InputFiles&) const = default;
};

}  // namespace relief::samples
