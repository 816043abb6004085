// Level by level: what a colour and a normal map keep from one level to the next, and what they show of it. Below, the
// imports that are remembered.
#include "relief/texture/import.h"

#include <algorithm>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

#include "relief/path.h"
#include "relief/texture/dxt5.h"
#include "relief/texture/mip_fade.h"
#include "relief/texture/pixels.h"

namespace relief {
namespace {

using Picture = std::shared_ptr<const ImageFile>;
using Settings = ImportSettings;

Fade fadeOf(const Settings& settings, int level)
{
    return settings.fadeOutMips ? fadeOfLevel(level, settings.fadeFirst, settings.fadeLast) : Fade{};
}

// --- colours ---

// 16-bit codes to 8 bits, to nearest.
std::uint8_t narrow(std::uint16_t code)
{
    return static_cast<std::uint8_t>((code * 255u + 32767u) / 65535u);
}

// An rgba16 level, of linear light if srgb, in 8-bit codes.
MipLevel narrowed(const MipLevel& level, ColorSpace meaning)
{
    MipLevel codes(TexelFormat::rgba8, level.width(), level.height());
    for (int y = 0; y < level.height(); ++y) {
        for (int x = 0; x < level.width(); ++x) {
            const std::uint16_t* from = level.texel<std::uint16_t>(x, y);
            std::uint8_t* to = codes.texel<std::uint8_t>(x, y);
            for (int c = 0; c < 4; ++c) {
                to[c] = narrow(meaning == ColorSpace::srgb && c < 3 ? encodeSrgb16(from[c]) : from[c]);
            }
        }
    }
    return codes;
}

// 8-bit sRGB codes as linear light in rgba16.
MipLevel widened(const MipLevel& codes)
{
    MipLevel level(TexelFormat::rgba16, codes.width(), codes.height());
    for (int y = 0; y < codes.height(); ++y) {
        for (int x = 0; x < codes.width(); ++x) {
            const std::uint8_t* from = codes.texel<std::uint8_t>(x, y);
            std::uint16_t* to = level.texel<std::uint16_t>(x, y);
            for (int c = 0; c < 4; ++c) {
                const auto wide = static_cast<std::uint16_t>(from[c] * 257);
                to[c] = c < 3 ? decodeSrgb16(wide) : wide;
            }
        }
    }
    level.fillFrame();
    return level;
}

MipLevel throughBlocks(const MipLevel& codes)
{
    return decodeDxt5(encodeDxt5(codes), codes.width(), codes.height());
}

// What Texture::fromLevels calls. `source` is the level before fading and blocks: the next one is averaged from it.
struct ColorLevels
{
    Picture picture;
    Settings settings;
    TexelFormat format;  // of the source
    std::optional<MipLevel> source;

    MipLevel operator()(int level, const MipLevel* finer)
    {
        const bool shownAsIs = !settings.fadeOutMips && settings.storage == Settings::Storage::rgb;
        MipLevel next = level == 0  ? levelFromPicture(*picture, settings.colorSpace)
                        : shownAsIs ? coarserLevel(format, *finer)
                                    : coarserLevel(format, *source);
        picture.reset();
        if (shownAsIs) return next;
        source = std::move(next);
        MipLevel shown = *source;
        fadeToGrey(format, settings.colorSpace, shown, fadeOf(settings, level));
        if (settings.storage == Settings::Storage::rgb) return shown;
        if (format == TexelFormat::rgba8) return throughBlocks(shown);
        const MipLevel codes = throughBlocks(narrowed(shown, settings.colorSpace));
        return settings.colorSpace == ColorSpace::srgb ? widened(codes) : codes;
    }
};

// --- normals ---

// The same for normals; `means` are the averages of level 0's unit vectors.
struct NormalLevels
{
    Picture picture;
    Settings settings;
    std::optional<MipLevel> means;

    MipLevel operator()(int level, const MipLevel*)
    {
        means = level == 0 ? finest() : coarserLevel(TexelFormat::rgba32Float, *means);
        picture.reset();
        MipLevel normals = level == 0 ? *means : normalizedNormals(*means);
        const Fade fade = fadeOf(settings, level);
        fadeToFlat(normals, static_cast<double>(fade.step) / fade.span);
        if (settings.storage == Settings::Storage::rgb) return encodeNormals(normals, NormalChannels::rgb);
        MipLevel codes = encodeNormals(normals, NormalChannels::alphaGreen);
        return settings.storage == Settings::Storage::dxt5 ? throughBlocks(codes) : codes;
    }

    MipLevel finest() const
    {
        using From = Settings::FromGreyscale;
        const bool heights =
            settings.fromGreyscale == From::yes || (settings.fromGreyscale == From::automatic && isGreyscale(*picture));
        if (!heights) return normalsFromColors(*picture);
        return normalsFromHeights(heightsOf(*picture), settings.bumpiness, settings.normalFilter);
    }
};

// --- settings ---

// What is wrong with the settings; empty where nothing is.
std::string problemWithSettings(const Settings& settings, bool isFloat)
{
    if (!(settings.bumpiness >= 0.0f && settings.bumpiness <= kMaxBumpiness)) {
        return "bumpiness is " + std::to_string(settings.bumpiness) + "; it must be in 0.." +
               std::to_string(static_cast<int>(kMaxBumpiness));
    }
    if (settings.fadeFirst < 0 || settings.fadeLast < settings.fadeFirst || settings.fadeLast >= kMaxMipLevels) {
        return "fadeFirst and fadeLast are " + std::to_string(settings.fadeFirst) + " and " +
               std::to_string(settings.fadeLast) + "; they must be in 0.." + std::to_string(kMaxMipLevels - 1) +
               ", the first not above the last";
    }
    if (settings.kind == Settings::Kind::normalMap) return {};
    if (settings.storage == Settings::Storage::dxt5nm) {
        return "storage dxt5nm is for normal maps; store a colour as rgb or dxt5";
    }
    if (settings.storage == Settings::Storage::dxt5 && isFloat) {
        return "storage dxt5 holds colours in 0..1 and this picture has a high dynamic range; store it as rgb";
    }
    return {};
}

std::string problemWith(const ImageFile& picture, const Settings& settings)
{
    std::string problem = problemWithSettings(settings, std::holds_alternative<ImageFloat>(picture));
    return problem.empty() ? problemWithPixels(picture) : problem;
}

TexelFormat storedFormat(const ImageFile& picture, const Settings& settings)
{
    if (settings.kind == Settings::Kind::normalMap) return TexelFormat::rgba8;
    if (settings.storage == Settings::Storage::rgb) return formatOf(picture, settings.colorSpace);
    return settings.colorSpace == ColorSpace::srgb ? TexelFormat::rgba16 : TexelFormat::rgba8;
}

}  // namespace

Expected<Texture> importTexture(Picture picture, const ImportSettings& settings)
{
    if (std::string problem = problemWith(*picture, settings); !problem.empty()) return fail(std::move(problem));
    const auto [width, height] =
        std::visit([](const auto& image) { return std::pair(image.width, image.height); }, *picture);
    const TexelFormat stored = storedFormat(*picture, settings);
    if (settings.kind == Settings::Kind::normalMap) {
        return Texture::fromLevels(stored, width, height, NormalLevels{std::move(picture), settings, {}});
    }
    const TexelFormat source = formatOf(*picture, settings.colorSpace);
    return Texture::fromLevels(stored, width, height, ColorLevels{std::move(picture), settings, source, {}});
}

Expected<Texture> importTexture(ImageFile picture, const ImportSettings& settings)
{
    return importTexture(std::make_shared<const ImageFile>(std::move(picture)), settings);
}

// --- imports that are remembered ---

namespace {

// A file as it was when it was read.
struct FileKey
{
    std::string path;  // absolute
    std::uintmax_t bytes = 0;
    std::filesystem::file_time_type changed;

    bool operator==(const FileKey&) const = default;
};

std::optional<FileKey> keyOf(const std::string& path)
{
    const std::filesystem::path file = pathOf(path);
    std::error_code noPath, noSize, noTime;
    FileKey key{utf8Of(std::filesystem::absolute(file, noPath)), std::filesystem::file_size(file, noSize),
                std::filesystem::last_write_time(file, noTime)};
    if (noPath || noSize || noTime) return {};
    return key;
}

class Imports
{
public:
    static Imports& ofProcess()
    {
        static Imports imports;
        return imports;
    }

    Expected<std::shared_ptr<const Texture>> find(const std::string& path, const Settings& settings)
    {
        std::unique_lock lock(importing);
        const std::optional<FileKey> file = keyOf(path);
        if (file)
            wasRead.wait(lock, [&] { return std::find(beingRead.begin(), beingRead.end(), *file) == beingRead.end(); });
        if (file) {
            for (const Import& import : textures) {
                if (!(import.file == *file && import.settings == settings)) continue;
                if (const auto texture = import.texture.lock()) return keep(texture);
            }
        }
        Expected<Picture> picture = pictureOf(path, file, lock);
        if (!picture) return tl::unexpected(picture.error());
        Expected<Texture> imported = importTexture(std::move(*picture), settings);
        if (!imported) return fail(path + ": " + imported.error().message);
        auto texture = std::make_shared<const Texture>(std::move(*imported));
        if (file) textures.push_back({*file, settings, texture});
        return keep(std::move(texture));
    }

private:
    struct Import
    {
        FileKey file;
        Settings settings;
        std::weak_ptr<const Texture> texture;
    };
    struct Decoded
    {
        FileKey file;
        std::weak_ptr<const ImageFile> picture;
    };

    // Reads the file if need be, and meanwhile lets others import theirs.
    Expected<Picture> pictureOf(const std::string& path, const std::optional<FileKey>& file,
                                std::unique_lock<std::mutex>& lock)
    {
        std::erase_if(textures, [](const Import& import) { return import.texture.expired(); });
        std::erase_if(pictures, [](const Decoded& decoded) { return decoded.picture.expired(); });
        for (const Decoded& decoded : pictures) {
            if (file && decoded.file == *file) {
                if (Picture picture = decoded.picture.lock()) return picture;
            }
        }
        if (file) beingRead.push_back(*file);
        lock.unlock();
        Expected<ImageFile> read = readImage(path);
        lock.lock();
        if (file) std::erase(beingRead, *file);
        wasRead.notify_all();
        if (!read) return tl::unexpected(read.error());
        auto picture = std::make_shared<const ImageFile>(std::move(*read));
        if (file) pictures.push_back({*file, picture});
        return picture;
    }

    // To the front of those that stay although nobody holds them: a program that drops its textures before it asks
    // for the same ones again finds them.
    std::shared_ptr<const Texture> keep(std::shared_ptr<const Texture> texture)
    {
        constexpr std::size_t kKept = 8;
        std::erase(recent, texture);
        recent.insert(recent.begin(), texture);
        if (recent.size() > kKept) recent.pop_back();
        return texture;
    }

    std::mutex importing;
    std::vector<FileKey> beingRead;  // by one thread each; others wait for it
    std::condition_variable wasRead;
    std::vector<Import> textures;
    std::vector<Decoded> pictures;
    std::vector<std::shared_ptr<const Texture>> recent;
};

}  // namespace

Expected<std::shared_ptr<const Texture>> importTexture(const std::string& path, const ImportSettings& settings)
{
    return Imports::ofProcess().find(path, settings);
}

}  // namespace relief
