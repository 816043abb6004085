// Textures from pixels, and their mip levels on demand.
#include "relief/texture/texture.h"

#include <string>
#include <utility>

#include "relief/lanes/environment.h"
#include "relief/lanes/settled.h"
#include "relief/memory.h"
#include "relief/texture/pixels.h"
#include "relief/texture/shading_scope.h"

namespace relief {
namespace {

std::string doesNotFit(int width, int height)
{
    return "a texture of " + std::to_string(width) + "x" + std::to_string(height) +
           " texels does not fit into memory; make it smaller";
}

// A texture with its levels takes a third more than the finest one.
std::string problemWith(TexelFormat format, int width, int height, std::size_t numbers)
{
    std::string problem = problemWithPixels(width, height, channelsPerTexel(format), numbers);
    if (!problem.empty() || fitsInMemory(levelBytes(format, width, height) / 3 * 4)) return problem;
    return doesNotFit(width, height);
}

// Makes each level by averaging the one before.
Texture::MakeLevel averages(TexelFormat format)
{
    return [format](int, const MipLevel* finer) { return coarserLevel(format, *finer); };
}

}  // namespace

Expected<Texture> Texture::fromRgba8(int width, int height, std::span<const std::uint8_t> rgba, ColorSpace meaning)
{
    const DefaultFloatingPoint environment;
    const TexelFormat format = meaning == ColorSpace::linear ? TexelFormat::rgba8 : TexelFormat::rgba16;
    if (std::string problem = problemWith(format, width, height, rgba.size()); !problem.empty())
        return fail(std::move(problem));
    return Texture(format, levelFromRgba8(width, height, rgba, meaning));
}

Expected<Texture> Texture::fromRgba16(int width, int height, std::span<const std::uint16_t> rgba, ColorSpace meaning)
{
    const DefaultFloatingPoint environment;
    if (std::string problem = problemWith(TexelFormat::rgba16, width, height, rgba.size()); !problem.empty())
        return fail(std::move(problem));
    return Texture(TexelFormat::rgba16, levelFromRgba16(width, height, rgba, meaning));
}

Expected<Texture> Texture::fromRgbaFloat(int width, int height, std::span<const float> rgba)
{
    const DefaultFloatingPoint environment;
    if (std::string problem = problemWith(TexelFormat::rgba32Float, width, height, rgba.size()); !problem.empty())
        return fail(std::move(problem));
    return Texture(TexelFormat::rgba32Float, levelFromRgbaFloat(width, height, rgba));
}

Expected<Texture> Texture::fromRed(int width, int height, std::span<const float> red)
{
    const DefaultFloatingPoint environment;
    if (std::string problem = problemWith(TexelFormat::r32Float, width, height, red.size()); !problem.empty())
        return fail(std::move(problem));
    return Texture(TexelFormat::r32Float, levelFromRed(width, height, red));
}

Expected<Texture> Texture::fromLevels(TexelFormat format, int width, int height, MakeLevel make)
{
    const DefaultFloatingPoint environment;
    const auto numbers = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                         static_cast<std::size_t>(channelsPerTexel(format));
    if (std::string problem = problemWith(format, width, height, numbers); !problem.empty())
        return fail(std::move(problem));
    Texture texture(format, width, height, std::move(make));
    if (texture.isConstant()) texture.firstTexel = texture.texel(0, 0);
    return texture;
}

Expected<Texture> Texture::forDrawing(TexelFormat format, int width, int height)
{
    const DefaultFloatingPoint environment;
    const auto numbers = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                         static_cast<std::size_t>(channelsPerTexel(format));
    if (std::string problem = problemWith(format, width, height, numbers); !problem.empty())
        return fail(std::move(problem));
    if (!fitsInMemory(2 * levelBytes(format, width, height))) return fail(doesNotFit(width, height));
    Texture texture(format, MipLevel(format, width, height));
    texture.chain->hidden.emplace(format, width, height);
    return texture;
}

void Texture::show()
{
    const DefaultFloatingPoint environment;
    chain->hidden->fillFrame();
    std::swap(chain->levels[0], chain->hidden);
    for (int k = 1; k < levelsBuilt(); ++k) chain->levels[static_cast<std::size_t>(k)].reset();
    chain->make = averages(texelFormat);
    chain->table.setTexels(0, *chain->levels[0]);
    chain->built.store(1, std::memory_order_release);
    firstTexel = texel(0, 0);
}

const Texture& Texture::white()
{
    static const Texture texture =
        *fromRgba8(1, 1, std::array<std::uint8_t, 4>{255, 255, 255, 255}, ColorSpace::linear);
    return texture;
}

const Texture& Texture::grey()
{
    static const Texture texture = *fromRgba8(1, 1, std::array<std::uint8_t, 4>{128, 128, 128, 255}, ColorSpace::srgb);
    return texture;
}

const Texture& Texture::black()
{
    static const Texture texture = *fromRgba8(1, 1, std::array<std::uint8_t, 4>{0, 0, 0, 255}, ColorSpace::linear);
    return texture;
}

// In floats: no integer code is exactly one half.
const Texture& Texture::flatNormal()
{
    static const Texture texture = *fromRgbaFloat(1, 1, std::array{0.5f, 0.5f, 1.0f, 0.5f});
    return texture;
}

Texture::Texture(TexelFormat format, int width, int height, MakeLevel make)
    : chain(std::make_unique<Chain>()),
      firstTexel(0.0f),
      sizes(1.0f / static_cast<float>(width), 1.0f / static_cast<float>(height), static_cast<float>(width),
            static_cast<float>(height)),
      texelFormat(format),
      columns(width),
      rows(height),
      levels(mipLevelCount(width, height))
{
    chain->make = std::move(make);
    for (int k = 0; k < levels; ++k) {
        chain->table.setSize(format, k, width, height);
        width = nextSide(width);
        height = nextSide(height);
    }
}

Texture::Texture(TexelFormat format, MipLevel finest)
    : Texture(format, finest.width(), finest.height(), averages(format))
{
    add(std::move(finest));
    firstTexel = texel(0, 0);
}

glm::vec4 Texture::texel(int x, int y) const
{
    const DefaultFloatingPoint environment;
    return settled(readTexel(texelFormat, level(0), x, y));
}

const MipLevel& Texture::buildLevel(int k) const
{
    const ShadingScope scope;  // a block may ask for the level while it is shaded
    const DefaultFloatingPoint environment;
    const std::lock_guard lock(chain->building);
    for (int i = levelsBuilt(); i <= k; ++i) {
        add(chain->make(i, i > 0 ? &*chain->levels[static_cast<std::size_t>(i) - 1] : nullptr));
        if (i == levels - 1) chain->make = nullptr;  // with what it kept alive
    }
    return *chain->levels[static_cast<std::size_t>(k)];
}

void Texture::add(MipLevel level) const
{
    const int number = levelsBuilt();
    std::optional<MipLevel>& itsPlace = chain->levels[static_cast<std::size_t>(number)];
    itsPlace = std::move(level);
    chain->table.setTexels(number, *itsPlace);
    chain->built.store(number + 1, std::memory_order_release);
}

}  // namespace relief
