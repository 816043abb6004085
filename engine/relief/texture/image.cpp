// Image files in and out: stb_image decodes and stb_image_write encodes memory; the files are ours (file.h), so that a
// full disk or a truncated file becomes an error and not a half-black picture.
#include "relief/texture/image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#define STBI_NO_STDIO
#include <stb/stb_image.h>
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>

#include "relief/bits.h"
#include "relief/file.h"
#include "relief/lanes/environment.h"
#include "relief/memory.h"
#include "relief/texture/full_palette.h"
#include "relief/texture/jpeg_check.h"
#include "relief/texture/pfm.h"
#include "relief/texture/tga_check.h"
#include "relief/texture/unsupported.h"

namespace relief {
namespace {

using Bytes = std::vector<std::uint8_t>;

struct Size
{
    std::int64_t width = 0;
    std::int64_t height = 0;
};

std::string toString(Size size)
{
    return std::to_string(size.width) + "x" + std::to_string(size.height);
}

// The file as stb's decoders see it. They fill up with zeros, silently, what a truncated JPEG, TGA, BMP or HDR lacks;
// so this counts as truncated every read past the end. stb reads in two ways: into its own small buffer, always the
// same one, where less than asked for is normal and only nothing at all means that bytes are missing; and straight into
// the pixels, where every byte is needed.
struct Source
{
    std::span<const std::uint8_t> bytes;
    bool isHdr = false;
    std::size_t position = 0;
    const char* smallBuffer = nullptr;
    bool truncated = false;
};

int readSome(void* user, char* data, int size)
{
    Source& source = *static_cast<Source*>(user);
    if (!source.smallBuffer) source.smallBuffer = data;  // stb's first read fills its small buffer
    const std::size_t wanted = size > 0 ? static_cast<std::size_t>(size) : 0;
    const std::size_t given = std::min(wanted, source.bytes.size() - source.position);
    if (given > 0) std::memcpy(data, source.bytes.data() + source.position, given);  // no bytes have no address
    source.position += given;
    const bool tooFew = data == source.smallBuffer ? given == 0 : given < wanted;
    source.truncated = source.truncated || tooFew;
    if (given > 0 || data != source.smallBuffer || !source.isHdr) return static_cast<int>(given);
    // stb goes on with zeros. To its HDR decoder a zero is a run of no pixels, and it would wait for the others for
    // ever; with line ends, which end a header too, it comes to an end.
    std::memset(data, '\n', wanted);
    return size;
}

// A damaged header can ask to skip past either end.
void skipSome(void* user, int count)
{
    Source& source = *static_cast<Source*>(user);
    const auto target = static_cast<std::int64_t>(source.position) + count;
    source.position = static_cast<std::size_t>(std::clamp<std::int64_t>(target, 0, std::ssize(source.bytes)));
}

int atEnd(void* user)
{
    const Source& source = *static_cast<const Source*>(user);
    return source.position >= source.bytes.size() ? 1 : 0;
}

constexpr stbi_io_callbacks kSourceCallbacks = {readSome, skipSome, atEnd};

// The size that a PNG's header names, for the message about an image that stb refuses as too large: 8 bytes signature,
// length and "IHDR", then width and height, big-endian (PNG specification, section 11.2.2). Zero for other files.
Size pngSize(const Bytes& bytes)
{
    constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
    if (bytes.size() < 24 || std::memcmp(bytes.data(), kSignature.data(), kSignature.size()) != 0) return {};
    const auto bigEndian = [&](std::size_t at) {
        return std::int64_t{bytes[at]} << 24 | bytes[at + 1] << 16 | bytes[at + 2] << 8 | bytes[at + 3];
    };
    return {bigEndian(16), bigEndian(20)};
}

constexpr std::string_view kNotAnImage = "unknown image type";  // stb's words

// Why the last call of stb on this thread failed. Of a chunk that it does not know stb names the type, four bytes of
// the file. They may be anything, line ends and the end of the text included, and are left out; stb has no other reason
// of fewer than four letters.
std::string_view lastReason()
{
    constexpr std::string_view kUnknownChunk = "PNG chunk not known";
    if (!stbi_failure_reason()) return "";
    const std::string_view reason = stbi_failure_reason();
    return reason.size() < 4 || reason.ends_with(kUnknownChunk) ? kUnknownChunk : reason;
}

// stb's words for HDR files that are intact, but of other numbers than RGBE or with another row or column first.
bool isUnsupported(std::string_view reason)
{
    return reason == "unsupported format" || reason == "unsupported data layout";
}

tl::unexpected<Error> failUnsupported(const std::string& name, const std::string& what)
{
    return fail(name + ": is not supported (" + what + "); convert it to PNG");
}

// Each row the other way round.
Image8 mirrored(Image8 image)
{
    const auto rowLength = static_cast<std::size_t>(image.width) * 4;
    for (std::size_t row = 0; row < image.pixels.size(); row += rowLength) {
        for (std::size_t left = row, right = row + rowLength - 4; left < right; left += 4, right -= 4) {
            std::swap_ranges(&image.pixels[left], &image.pixels[left] + 4, &image.pixels[right]);
        }
    }
    return image;
}

// Runs one of stb's load functions on the file and copies the pixels out of stb's memory.
template <class Channel, class Load>
Expected<ImageFile> decode(const std::string& name, const Bytes& bytes, Size size, Load load)
{
    Source source{.bytes = bytes, .isHdr = std::is_same_v<Channel, float>};
    int width = 0;
    int height = 0;
    int channelsInFile = 0;
    const std::unique_ptr<Channel, void (*)(void*)> pixels(
        load(&kSourceCallbacks, &source, &width, &height, &channelsInFile, STBI_rgb_alpha), stbi_image_free);
    const bool isImage = pixels || lastReason() != kNotAnImage;
    if (source.truncated && isImage) return fail(name + ": is truncated; copy or export it again");
    const auto failMemory = [&] {
        return fail(name + ": " + toString(size) + " does not fit into memory; scale it down");
    };
    if (!pixels && lastReason() == "outofmem") return failMemory();
    if (!pixels && isUnsupported(lastReason())) return failUnsupported(name, std::string(lastReason()));
    if (!pixels) {
        return fail(name + ": is damaged (" + std::string(lastReason()) + "); copy or export it again");
    }
    if (width != size.width || height != size.height) {
        return fail(name + ": is damaged (two different sizes); export it again");
    }
    const auto count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4;
    if (!fitsInMemory(count * sizeof(Channel))) return failMemory();
    return ImageOf<Channel>{width, height, std::vector<Channel>(pixels.get(), pixels.get() + count)};
}

// What to say about a file whose header stbi_info does not accept: it asks every format in turn and so forgets the
// reason, while the decoder goes by the file's first bytes and knows it. (It has the same limit for the sides.)
tl::unexpected<Error> failHeader(const std::string& name, const Bytes& bytes)
{
    const std::string limit = toString({kMaxImageSide, kMaxImageSide});
    const Size size = pngSize(bytes);
    if (size.width > kMaxImageSide || size.height > kMaxImageSide) {
        return fail(name + ": " + toString(size) + " is larger than " + limit + "; scale it down");
    }
    const Expected<ImageFile> image = decode<std::uint8_t>(name, bytes, {}, stbi_load_from_callbacks);
    if (lastReason() == "too large") return fail(name + ": a side is larger than " + limit + "; scale it down");
    if (lastReason() == kNotAnImage) {
        return fail(name + ": is not a PNG, JPEG, TGA, BMP, HDR or PFM image; convert it to PNG");
    }
    return tl::unexpected(image.error());
}

Expected<void> checkWrite(const std::string& path, int width, int height, std::size_t given, int channels)
{
    const std::string size = toString({width, height});
    if (width < 1 || height < 1 || width > kMaxImageSide || height > kMaxImageSide) {
        return fail(path + ": cannot write " + size + " pixels; each side must be in 1.." +
                    std::to_string(kMaxImageSide));
    }
    const auto expected =
        static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * static_cast<std::size_t>(channels);
    if (given == expected) return {};
    return fail(path + ": " + std::to_string(given) + " values are not a picture of " + size + "; pass " +
                std::to_string(expected));
}

}  // namespace

Expected<ImageFile> readImage(const std::string& path)
{
    Expected<Bytes> file = readFile(path);
    if (!file) return tl::unexpected(file.error());
    return decodeImage(std::move(*file), path);
}

Expected<ImageFile> decodeImage(std::vector<std::uint8_t> bytes, const std::string& name)
{
    const DefaultFloatingPoint environment;
    if (isPfm(bytes)) return decodePfm(name, bytes);
    if (const std::string what = unsupportedFeature(bytes); !what.empty()) return failUnsupported(name, what);
    fillPalette(bytes);
    if (!jpegTablesFit(bytes)) return fail(name + ": is damaged (bad Huffman table); copy or export it again");

    if (bytes.size() > kMaxFileBytes) {
        return fail(name + ": its " + std::to_string(bytes.size()) + " bytes are more than 1 GiB; make it smaller");
    }
    const int length = static_cast<int>(bytes.size());
    int width = 0;
    int height = 0;
    int channelsInFile = 0;
    if (!stbi_info_from_memory(bytes.data(), length, &width, &height, &channelsInFile)) return failHeader(name, bytes);
    const Size size{width, std::abs(std::int64_t{height})};  // a BMP that starts with its top row has a negative height
    if (size.width < 1 || size.height < 1) return fail(name + ": is " + toString(size) + "; export it again");
    if (size.width > kMaxImageSide || size.height > kMaxImageSide) {
        return fail(name + ": " + toString(size) + " is larger than " + toString({kMaxImageSide, kMaxImageSide}) +
                    "; scale it down");
    }
    if (const std::uint64_t fewest = fewestTgaBytes(bytes); bytes.size() < fewest) {
        return fail(name + ": is truncated (" + std::to_string(bytes.size()) + " bytes, but " + toString(size) +
                    " takes at least " + std::to_string(fewest) + "); copy or export it again");
    }

    const bool isHdr = stbi_is_hdr_from_memory(bytes.data(), length) != 0;
    const bool is16Bit = !isHdr && stbi_is_16_bit_from_memory(bytes.data(), length) != 0;
    const std::int64_t bytesPerPixel = isHdr ? 16 : is16Bit ? 8 : 4;
    if (static_cast<std::uint64_t>(size.width * size.height * bytesPerPixel) > kMaxDecodedBytes) {
        return fail(name + ": " + toString(size) + " takes more than 1 GiB of memory; scale it down");
    }

    // An HDR file cannot hold NaN or infinity: its largest number is 255 * 2^119, and that fits a float.
    if (isHdr) return decode<float>(name, bytes, size, stbi_loadf_from_callbacks);
    if (is16Bit) return decode<std::uint16_t>(name, bytes, size, stbi_load_16_from_callbacks);
    Expected<ImageFile> image = decode<std::uint8_t>(name, bytes, size, stbi_load_from_callbacks);
    if (image && tgaRunsLeftwards(bytes)) image = mirrored(std::get<Image8>(std::move(*image)));
    return image;
}

Expected<std::vector<std::uint8_t>> encodePng(const std::string& path, int width, int height,
                                              std::span<const std::uint8_t> rgba)
{
    if (const Expected<void> checked = checkWrite(path, width, height, rgba.size(), 4); !checked)
        return tl::unexpected(checked.error());
    if (rgba.size() > kMaxWrittenPngBytes) {
        return fail(path + ": " + toString({width, height}) + " is too large for a PNG; scale it down");
    }
    Bytes png;
    const auto take = [](void* context, void* data, int size) {
        const auto* begin = static_cast<const std::uint8_t*>(data);
        if (!fitsInMemory(static_cast<std::uint64_t>(size))) return;
        static_cast<Bytes*>(context)->assign(begin, begin + size);  // stb hands over the whole file in one call
    };
    if (!stbi_write_png_to_func(take, &png, width, height, 4, rgba.data(), width * 4) || png.empty()) {
        return fail(path + ": not enough memory to compress the picture; scale it down");
    }
    return png;
}

Expected<void> writePng(const std::string& path, int width, int height, std::span<const std::uint8_t> rgba)
{
    const Expected<Bytes> png = encodePng(path, width, height, rgba);
    if (!png) return tl::unexpected(png.error());
    return writeFileAtomically(path, *png);
}

Expected<void> writePfm(const std::string& path, int width, int height, std::span<const float> rgb)
{
    if (const Expected<void> checked = checkWrite(path, width, height, rgb.size(), 3); !checked) return checked;

    // PFM: "PF" is RGB, a negative scale says little-endian, and the rows go from the bottom to the top.
    const std::string header = "PF\n" + std::to_string(width) + " " + std::to_string(height) + "\n-1.0\n";
    const std::size_t floatsPerRow = static_cast<std::size_t>(width) * 3;
    if (!fitsInMemory(header.size() + rgb.size() * 4)) {
        return fail(path + ": not enough memory for the file; scale it down");
    }
    Bytes bytes(header.begin(), header.end());
    bytes.reserve(bytes.size() + rgb.size() * 4);
    for (std::size_t row = static_cast<std::size_t>(height); row-- > 0;) {
        for (const float value : rgb.subspan(row * floatsPerRow, floatsPerRow)) {
            const auto bits = bitCast<std::uint32_t>(value);
            for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(bits >> shift));
        }
    }
    return writeFileAtomically(path, bytes);
}

namespace {

// Three mantissas of 8 bits and the exponent of the largest, rounded to nearest (Ward 1991): colour = mantissa *
// 2^(exponent - 136). Of a number above 0 the largest mantissa is 128 or more, so no pixel looks like the mark of a
// compressed row.
std::array<std::uint8_t, 4> toRgbe(const float* rgb)
{
    constexpr float kLargest = 0x1.fep126f;  // 255 * 2^119
    std::array<float, 3> color;
    for (std::size_t c = 0; c < 3; ++c) color[c] = rgb[c] > 0.0f ? std::min(rgb[c], kLargest) : 0.0f;
    int exponent = 0;
    const float largest = std::max({color[0], color[1], color[2]});
    const float fraction = std::frexp(largest, &exponent);
    if (fraction >= 255.5f / 256.0f) ++exponent;  // else its mantissa would be 256
    if (largest == 0.0f || exponent < -127) return {0, 0, 0, 0};
    std::array<std::uint8_t, 4> pixel;
    for (std::size_t c = 0; c < 3; ++c) pixel[c] = static_cast<std::uint8_t>(std::ldexp(color[c], 8 - exponent) + 0.5f);
    pixel[3] = static_cast<std::uint8_t>(exponent + 128);
    return pixel;
}

}  // namespace

Expected<void> writeHdr(const std::string& path, int width, int height, std::span<const float> rgb)
{
    const DefaultFloatingPoint environment;
    if (const Expected<void> checked = checkWrite(path, width, height, rgb.size(), 3); !checked) return checked;
    const std::string header =
        "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " + std::to_string(width) + "\n";
    if (!fitsInMemory(header.size() + rgb.size() / 3 * 4)) {
        return fail(path + ": not enough memory for the file; scale it down");
    }
    Bytes bytes(header.begin(), header.end());
    bytes.reserve(bytes.size() + rgb.size() / 3 * 4);
    for (std::size_t i = 0; i < rgb.size(); i += 3) {
        const std::array<std::uint8_t, 4> pixel = toRgbe(&rgb[i]);
        bytes.insert(bytes.end(), pixel.begin(), pixel.end());
    }
    return writeFileAtomically(path, bytes);
}

}  // namespace relief
