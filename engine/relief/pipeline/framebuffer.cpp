#include "relief/pipeline/framebuffer.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <string>
#include <utility>

#include "relief/bits.h"

namespace relief {

namespace {

bool isDepth(Format format)
{
    return format == Format::depth32f;
}
bool isStencil(Format format)
{
    return format == Format::stencil8;
}

// The n-th attachment, counted from 0, that `is` says; -1 where there are not so many.
template <class Is>
int find(const std::vector<Attachment>& attachments, int n, const Is& is)
{
    for (std::size_t i = 0; i < attachments.size(); ++i) {
        if (is(attachments[i].format) && n-- == 0) return static_cast<int>(i);
    }
    return -1;
}

// What a texture of such pixels holds; nothing where they are no texels.
std::optional<TexelFormat> texelFormat(Format format)
{
    switch (format) {
        case Format::rgba8:
            return TexelFormat::rgba8;
        case Format::r32f:
        case Format::depth32f:
            return TexelFormat::r32Float;
        case Format::rgba32f:
            return TexelFormat::rgba32Float;
        case Format::rgba8Srgb:
        case Format::rgba16f:
        case Format::stencil8:
            break;
    }
    return std::nullopt;
}

// A level's rows: its upper one is the last.
template <class Word, class Level>
Framebuffer::Rows<Word> rowsOf(Level& level)
{
    return {reinterpret_cast<Word*>(level.template texel<float>(0, level.height() - 1)),
            -static_cast<std::ptrdiff_t>(level.rowBytes() / sizeof(Word))};
}

std::string countOf(int number, const char* what)
{
    return std::to_string(number) + " " + what;
}

}  // namespace

Expected<Framebuffer> Framebuffer::create(int width, int height, const std::vector<Attachment>& attachments,
                                          int samples)
{
    const std::string size = "size " + std::to_string(width) + "x" + std::to_string(height);
    if (width < 1 || height < 1 || width > kMaxTargetSize || height > kMaxTargetSize) {
        return fail(size + " is not possible: width and height must be 1 to " + std::to_string(kMaxTargetSize));
    }
    const auto numberOf = [&](const auto& is) {
        return static_cast<int>(
            std::count_if(attachments.begin(), attachments.end(), [&](const Attachment& a) { return is(a.format); }));
    };
    const int colors = numberOf(isColor), depths = numberOf(isDepth), stencils = numberOf(isStencil);
    if (attachments.empty() || colors > kMaxColors || depths > 1 || stencils > 1) {
        return fail("a target of " + countOf(colors, "colour, ") + countOf(depths, "depth and ") +
                    countOf(stencils, "stencil attachments is not possible: give it at most ") +
                    std::to_string(kMaxColors) + ", 1 and 1, and at least one of them");
    }
    if (samplePattern(samples) == nullptr) {
        return fail("a target with " + std::to_string(samples) +
                    " samples a pixel is not possible: choose 1, 2, 4 or 8");
    }

    Framebuffer target;
    target.mWidth = width;
    target.mHeight = height;
    target.mSamples = samplePattern(samples);
    target.mAttachments = attachments;
    target.mWords.resize(attachments.size());
    target.mTextures.resize(attachments.size());
    for (std::size_t i = 0; i < attachments.size(); ++i) {
        if (attachments[i].store == Store::texture) {
            const Expected<void> made = target.makeTexture(static_cast<int>(i));
            if (!made) return tl::unexpected(made.error());
        }
        const std::size_t count = target.wordCount(static_cast<int>(i));
        if (count == 0) continue;
        target.mWords[i].reset(static_cast<std::uint32_t*>(std::calloc(count, sizeof(std::uint32_t))));
        if (!target.mWords[i]) {
            return fail(size + " takes " + std::to_string(count / 262144) +
                        " MiB for one attachment, which this machine does not have; choose a smaller size");
        }
    }
    std::fill(target.depth().begin(), target.depth().end(), 1.0f);
    return target;
}

Expected<Framebuffer> Framebuffer::create(int width, int height, Format color, Store depth, int samples)
{
    return create(width, height, std::vector<Attachment>{{color, Store::keep}, {Format::depth32f, depth}}, samples);
}

Framebuffer::Framebuffer(const Framebuffer& other)
    : mWidth(other.mWidth),
      mHeight(other.mHeight),
      mSamples(other.mSamples),
      mAttachments(other.mAttachments),
      mWords(other.mWords.size()),
      mTextures(other.mTextures.size())
{
    for (std::size_t i = 0; i < mWords.size(); ++i) {
        if (other.mTextures[i] != nullptr && !makeTexture(static_cast<int>(i)))
            std::abort();  // as for every copy of a container, without exceptions
        const std::size_t bytes = wordCount(static_cast<int>(i)) * sizeof(std::uint32_t);
        if (bytes == 0) continue;
        mWords[i].reset(static_cast<std::uint32_t*>(std::malloc(bytes)));
        if (!mWords[i]) std::abort();
    }
    copyPixels(other);
}

Framebuffer& Framebuffer::operator=(const Framebuffer& other)
{
    if (this == &other) return *this;
    if (!isLike(other)) return *this = Framebuffer(other);
    mSamples = other.mSamples;
    copyPixels(other);
    return *this;
}

bool Framebuffer::isLike(const Framebuffer& other) const
{
    const auto same = [](const Attachment& a, const Attachment& b) {
        return a.format == b.format && a.store == b.store;
    };
    return mWidth == other.mWidth && mHeight == other.mHeight &&
           std::equal(mAttachments.begin(), mAttachments.end(), other.mAttachments.begin(), other.mAttachments.end(),
                      same);
}

void Framebuffer::copyPixels(const Framebuffer& other)
{
    for (std::size_t i = 0; i < mWords.size(); ++i) {
        if (mTextures[i] != nullptr) {
            mTextures[i]->hidden() = other.mTextures[i]->level(0);
            mTextures[i]->show();
        }
        const std::size_t bytes = wordCount(static_cast<int>(i)) * sizeof(std::uint32_t);
        if (bytes > 0) std::memcpy(mWords[i].get(), other.mWords[i].get(), bytes);
    }
}

std::size_t Framebuffer::wordCount(int attachment) const
{
    const Attachment& a = mAttachments[static_cast<std::size_t>(attachment)];
    if (a.store != Store::keep) return 0;
    return static_cast<std::size_t>(mWidth) * static_cast<std::size_t>(mHeight) *
           static_cast<std::size_t>(wordsPerPixel(a.format));
}

Expected<void> Framebuffer::makeTexture(int attachment)
{
    const auto i = static_cast<std::size_t>(attachment);
    const std::optional<TexelFormat> format = texelFormat(mAttachments[i].format);
    if (!format) {
        return fail(
            "attachment " + std::to_string(attachment) +
            " cannot be stored as a texture, its pixels are no texels; choose rgba8, r32f, rgba32f or depth32f, "
            "or keep it, and copy it with textureOf()");
    }
    Expected<Texture> made = Texture::forDrawing(*format, mWidth, mHeight);
    if (!made) return tl::unexpected(made.error());
    mTextures[i] = std::make_unique<Texture>(std::move(*made));
    if (!isDepth(mAttachments[i].format)) return {};
    const Rows<std::uint32_t> rows = drawnRows(attachment);
    for (int y = 0; y < mHeight; ++y) std::fill_n(rows.top + y * rows.stride, mWidth, bitCast<std::uint32_t>(1.0f));
    mTextures[i]->show();
    return {};
}

int Framebuffer::colorIndex(int n) const
{
    return find(mAttachments, n, isColor);
}
int Framebuffer::depthIndex() const
{
    return find(mAttachments, 0, isDepth);
}
int Framebuffer::stencilIndex() const
{
    return find(mAttachments, 0, isStencil);
}

std::span<std::uint32_t> Framebuffer::words(int attachment)
{
    const auto i = static_cast<std::size_t>(attachment);
    if (i >= mWords.size()) return {};
    return {mWords[i].get(), wordCount(attachment)};
}
std::span<const std::uint32_t> Framebuffer::words(int attachment) const
{
    const auto i = static_cast<std::size_t>(attachment);
    if (i >= mWords.size()) return {};
    return {mWords[i].get(), wordCount(attachment)};
}

const Texture* Framebuffer::texture(int attachment) const
{
    const auto i = static_cast<std::size_t>(attachment);
    return i < mTextures.size() ? mTextures[i].get() : nullptr;
}

Framebuffer::Rows<std::uint32_t> Framebuffer::drawnRows(int attachment)
{
    const auto i = static_cast<std::size_t>(attachment);
    if (mTextures[i] != nullptr) return rowsOf<std::uint32_t>(mTextures[i]->hidden());
    return {mWords[i].get(), static_cast<std::ptrdiff_t>(mWidth) * wordsPerPixel(mAttachments[i].format)};
}
Framebuffer::Rows<const std::uint32_t> Framebuffer::shownRows(int attachment) const
{
    const auto i = static_cast<std::size_t>(attachment);
    if (mTextures[i] != nullptr) return rowsOf<const std::uint32_t>(mTextures[i]->level(0));
    return {mWords[i].get(), static_cast<std::ptrdiff_t>(mWidth) * wordsPerPixel(mAttachments[i].format)};
}

void Framebuffer::show()
{
    for (const std::unique_ptr<Texture>& texture : mTextures) {
        if (texture != nullptr) texture->show();
    }
}

// The pixels of the attachment with this format.
template <class Pixel>
std::span<Pixel> Framebuffer::pixels(Format format) const
{
    for (std::size_t i = 0; i < mWords.size(); ++i) {
        if (mAttachments[i].format != format) continue;
        const std::size_t bytes = wordCount(static_cast<int>(i)) * sizeof(std::uint32_t);
        return {reinterpret_cast<Pixel*>(mWords[i].get()), bytes / sizeof(Pixel)};
    }
    return {};
}

std::span<std::uint32_t> Framebuffer::color8()
{
    const auto linear = pixels<std::uint32_t>(Format::rgba8);
    return linear.empty() ? pixels<std::uint32_t>(Format::rgba8Srgb) : linear;
}
std::span<const std::uint32_t> Framebuffer::color8() const
{
    const auto linear = pixels<const std::uint32_t>(Format::rgba8);
    return linear.empty() ? pixels<const std::uint32_t>(Format::rgba8Srgb) : linear;
}
std::span<std::array<std::uint16_t, 4>> Framebuffer::color16f()
{
    return pixels<std::array<std::uint16_t, 4>>(Format::rgba16f);
}
std::span<const std::array<std::uint16_t, 4>> Framebuffer::color16f() const
{
    return pixels<const std::array<std::uint16_t, 4>>(Format::rgba16f);
}
std::span<float> Framebuffer::colorR32f()
{
    return pixels<float>(Format::r32f);
}
std::span<const float> Framebuffer::colorR32f() const
{
    return pixels<const float>(Format::r32f);
}
std::span<glm::vec4> Framebuffer::color32f()
{
    return pixels<glm::vec4>(Format::rgba32f);
}
std::span<const glm::vec4> Framebuffer::color32f() const
{
    return pixels<const glm::vec4>(Format::rgba32f);
}
std::span<float> Framebuffer::depth()
{
    return pixels<float>(Format::depth32f);
}
std::span<const float> Framebuffer::depth() const
{
    return pixels<const float>(Format::depth32f);
}

std::span<std::uint32_t> Framebuffer::stencil()
{
    return pixels<std::uint32_t>(Format::stencil8);
}
std::span<const std::uint32_t> Framebuffer::stencil() const
{
    return pixels<const std::uint32_t>(Format::stencil8);
}

bool Framebuffer::samePixels(const Framebuffer& other) const
{
    if (!isLike(other)) return false;
    for (std::size_t i = 0; i < mAttachments.size(); ++i) {
        const auto [format, store] = mAttachments[i];
        if (store == Store::discard) continue;
        const auto mine = shownRows(static_cast<int>(i)), theirs = other.shownRows(static_cast<int>(i));
        const auto bytes = static_cast<std::size_t>(mWidth) * static_cast<std::size_t>(wordsPerPixel(format)) * 4;
        for (int y = 0; y < mHeight; ++y) {
            if (std::memcmp(mine.top + y * mine.stride, theirs.top + y * theirs.stride, bytes) != 0) return false;
        }
    }
    return true;
}

}  // namespace relief
