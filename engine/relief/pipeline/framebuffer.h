// The render target: a list of attachments, each a picture of one format. Row 0 is the top row.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <span>
#include <vector>

#include <glm/vec4.hpp>

#include "relief/error.h"
#include "relief/pipeline/limits.h"
#include "relief/pipeline/sample_pattern.h"
#include "relief/texture/texture.h"

namespace relief {

enum class Format
{
    rgba8,      // UNORM, written as it is
    rgba8Srgb,  // UNORM, encoded from linear colour when written, decoded when blended with
    rgba16f,    // halves: within +-65504, rounded to nearest
    r32f,       // red alone
    rgba32f,
    depth32f,
    stencil8  // the low byte of a word
};

constexpr bool isColor(Format format)
{
    return format != Format::depth32f && format != Format::stencil8;
}

// 32-bit words of a pixel.
constexpr int wordsPerPixel(Format format)
{
    return format == Format::rgba32f ? 4 : format == Format::rgba16f ? 2 : 1;
}

// What becomes of an attachment when a frame has run. One that is discarded lives in the tiles only, while they are
// drawn: it takes no memory, and every frame clears it. Keep it when something reads it afterwards, or when a later
// frame draws on without clearing. As a texture it is kept where samplers read it, and nothing has to be copied: of the
// formats rgba8, r32f, rgba32f and depth32f, whose pixels are texels.
enum class Store
{
    keep,
    discard,
    texture
};

// What it holds before the first draw, each frame says: it clears (Frame::clear, clearColor, clearDepth ...) or, where
// it does not, goes on with what is there.
struct Attachment
{
    Format format = Format::rgba8Srgb;
    Store store = Store::keep;
};

class Framebuffer
{
public:
    // At most four colour attachments, one depth and one stencil, in any order. Width and height 1 ... 16384. Colours
    // and stencils are 0 at first, depths 1. An error for other sizes and lists, and where the memory cannot be had.
    //
    // Samples: 1, 2, 4 or 8 a pixel. More than one live in the tiles only, while they are drawn. What is kept of them
    // is their mean, of colours in linear light, and the first one's depth and stencil. A frame that does not clear
    // begins with all samples of a pixel the same.
    static Expected<Framebuffer> create(int width, int height, const std::vector<Attachment>& attachments,
                                        int samples = 1);

    // The usual: a colour that is kept, and a depth.
    static Expected<Framebuffer> create(int width, int height, Format color = Format::rgba8Srgb,
                                        Store depth = Store::discard, int samples = 1);

    // Assigned one of the same size and attachments, a target keeps its textures, which then hold the other one's
    // pixels.
    Framebuffer(const Framebuffer& other);
    Framebuffer(Framebuffer&&) noexcept = default;
    Framebuffer& operator=(const Framebuffer& other);
    Framebuffer& operator=(Framebuffer&&) noexcept = default;

    int width() const { return mWidth; }
    int height() const { return mHeight; }
    const SamplePattern& samples() const { return *mSamples; }

    const std::vector<Attachment>& attachments() const { return mAttachments; }

    // The attachment of that kind, -1 where there is none; of several colours the one that SV_Target<n> is written to.
    int colorIndex(int n = 0) const;
    int depthIndex() const;
    int stencilIndex() const;

    // What the last frame left of an attachment with Store::texture, for samplers; null where there is none. It lives
    // as long as the target, and changes when a frame has run: a program that reads it while it draws into the same
    // target reads the frame before. The target's lower left pixel is at uv (0, 0). Colours are linear; depths and r32f
    // are red alone. Mip levels are built when they are asked for.
    const Texture* texture(int attachment) const;

    // An attachment's pixels, wordsPerPixel() each, row by row, no padding; empty where it is not Store::keep, and
    // where there is none.
    std::span<std::uint32_t> words(int attachment);
    std::span<const std::uint32_t> words(int attachment) const;

    // The same as what they are; of several with this format the first. Empty where there is none, or it is not kept.
    std::span<std::uint32_t> color8();  // both 8-bit formats: R, G, B, A from the lowest byte up
    std::span<std::array<std::uint16_t, 4>> color16f();
    std::span<float> colorR32f();
    std::span<glm::vec4> color32f();
    std::span<float> depth();
    std::span<std::uint32_t> stencil();
    std::span<const std::uint32_t> color8() const;
    std::span<const std::array<std::uint16_t, 4>> color16f() const;
    std::span<const float> colorR32f() const;
    std::span<const glm::vec4> color32f() const;
    std::span<const float> depth() const;
    std::span<const std::uint32_t> stencil() const;

    // Whether all that is stored, and how, is equal, bit by bit.
    bool samePixels(const Framebuffer& other) const;

    // --- for frames ---

    // Where an attachment's rows lie: `top` is null where it is discarded.
    template <class Word>
    struct Rows
    {
        Word* top;
        std::ptrdiff_t stride;  // words from a row to the one below it
    };
    Rows<std::uint32_t> drawnRows(int attachment);              // what the next frame writes
    Rows<const std::uint32_t> shownRows(int attachment) const;  // what the last one left

    // The textures hold from now on what a frame has written.
    void show();

private:
    struct Free
    {
        void operator()(std::uint32_t* words) const { std::free(words); }
    };
    using Words = std::unique_ptr<std::uint32_t[], Free>;

    Framebuffer() = default;
    std::size_t wordCount(int attachment) const;
    Expected<void> makeTexture(int attachment);
    bool isLike(const Framebuffer& other) const;
    void copyPixels(const Framebuffer& other);
    template <class Pixel>
    std::span<Pixel> pixels(Format format) const;

    int mWidth = 0, mHeight = 0;
    const SamplePattern* mSamples = &kOneSample;
    std::vector<Attachment> mAttachments;
    std::vector<Words> mWords;                        // of each attachment that is kept
    std::vector<std::unique_ptr<Texture>> mTextures;  // of each that is stored as one
};

}  // namespace relief
