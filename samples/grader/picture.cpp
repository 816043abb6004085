#include "grader/picture.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "common/render.h"
#include "relief/pipeline/format.h"

namespace relief::samples::grader {

namespace {

Expected<Framebuffer> emptyPicture()
{
    return Framebuffer::create(kWidth, kHeight, Format::rgba32f, Store::keep);
}

}  // namespace

Expected<Framebuffer> draw(const Stage& stage, int threads)
{
    const Expected<PreparedStage> prepared = PreparedStage::prepare(stage);
    if (!prepared) return tl::unexpected(prepared.error());
    Expected<Framebuffer> target = emptyPicture();
    if (!target) return target;
    Frame frame(*target, {.threads = threads});
    prepared->record(frame, kWidth, kHeight);
    if (const std::string problem = prepared->problem(frame); !problem.empty()) return fail(problem);
    frame.run();
    return target;
}

std::vector<std::uint8_t> rawBytes(const Framebuffer& picture)
{
    std::vector<std::uint8_t> bytes;
    for (int i = 0; i < static_cast<int>(picture.attachments().size()); ++i) {
        const auto words = std::as_bytes(picture.words(i));
        const auto* const first = reinterpret_cast<const std::uint8_t*>(words.data());
        bytes.insert(bytes.end(), first, first + words.size());
    }
    return bytes;
}

Expected<Framebuffer> pictureOf(std::span<const std::uint8_t> bytes)
{
    Expected<Framebuffer> picture = emptyPicture();
    if (!picture) return picture;
    for (int i = 0; i < static_cast<int>(picture->attachments().size()); ++i) {
        const std::span<std::uint32_t> words = picture->words(i);
        if (bytes.size() < words.size_bytes()) return fail("it wrote no whole picture");
        std::memcpy(words.data(), bytes.data(), words.size_bytes());
        bytes = bytes.subspan(words.size_bytes());
    }
    if (!bytes.empty()) return fail("it wrote more than a picture");
    return picture;
}

Image8 codesOf(const Framebuffer& picture)
{
    const std::span<const glm::vec4> colors = picture.color32f();
    Image8 image{picture.width(), picture.height(), std::vector<std::uint8_t>(4 * colors.size())};
    for (std::size_t first = 0; first < colors.size(); first += kLanes) {
        float channels[4][kLanes] = {};
        const std::size_t count = std::min<std::size_t>(kLanes, colors.size() - first);
        for (std::size_t i = 0; i < count; ++i) {
            for (int c = 0; c < 4; ++c) channels[c][i] = colors[first + i][c];
        }
        std::int32_t codes[kLanes];
        packRgba8(
            encodeSrgb(float4(Float::load(channels[0]), Float::load(channels[1]), Float::load(channels[2]), 1.0f)))
            .store(codes);
        std::memcpy(&image.pixels[4 * first], codes, 4 * count);
    }
    return image;
}

Image8 smallOf(const Image8& codes)
{
    Image8 small{kSmallWidth, kSmallHeight, {}};
    for (int y = 0; y < kSmallHeight; ++y) {
        for (int x = 0; x < kSmallWidth; ++x) {
            const int pixel = (y * kStep + kStep / 2) * codes.width + x * kStep + kStep / 2;
            const auto at = codes.pixels.begin() + 4 * pixel;
            small.pixels.insert(small.pixels.end(), at, at + 4);
        }
    }
    return small;
}

Distance distanceOf(std::span<const std::uint8_t> first, std::span<const std::uint8_t> second, int width)
{
    Distance distance;
    std::uint64_t sum = 0;
    const std::size_t pixels = std::min(first.size(), second.size()) / 4;
    for (std::size_t i = 0; i < pixels; ++i) {
        int largest = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            const int apart = std::abs(first[4 * i + c] - second[4 * i + c]);
            sum += static_cast<std::uint64_t>(apart);
            largest = std::max(largest, apart);
        }
        distance.differing += largest > 0;
        if (largest <= distance.largest) continue;
        distance.largest = largest;
        distance.x = static_cast<int>(i) % width;
        distance.y = static_cast<int>(i) / width;
    }
    distance.mean = static_cast<double>(sum) / static_cast<double>(3 * std::max<std::size_t>(1, pixels));
    return distance;
}

}  // namespace relief::samples::grader
