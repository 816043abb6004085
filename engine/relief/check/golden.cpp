#include "relief/check/golden.h"

#include <cmath>
#include <system_error>
#include <variant>
#include <vector>

#include "relief/bits.h"
#include "relief/check/hash.h"
#include "relief/file.h"
#include "relief/path.h"
#include "relief/pipeline/format.h"
#include "relief/pipeline/save.h"

namespace relief {

namespace {

using Outcome = GoldenRecord::Outcome;

// Writes a picture to `path`, and says where, or why not.
bool kept(const std::string& path, const ImageFile& picture, const char* what, std::string& message)
{
    const Expected<void> written = writePicture(path, picture);
    message += "\n  " + std::string(what) + (written ? path : "not written: " + written.error().message);
    return written.has_value();
}

// The attachment that a test looks at: a colour, else the depth.
int attachmentOf(const Framebuffer& target, int n)
{
    const int color = target.colorIndex(n);
    return color >= 0 ? color : n == 0 ? target.depthIndex() : -1;
}

// Four floats a pixel of a kept attachment.
std::vector<float> floatsOf(const Framebuffer& target, int attachment, Format format)
{
    std::vector<float> all;
    for (const std::uint32_t word : target.words(attachment)) {
        if (format == Format::rgba32f) {
            all.push_back(bitCast<float>(word));
        } else if (format == Format::rgba16f) {
            for (const std::uint32_t half : {word & 0xffffu, word >> 16})
                all.push_back(fromHalf(Int(static_cast<int>(half)))[0]);
        } else {
            all.insert(all.end(), 3, bitCast<float>(word));
            all.push_back(1.0f);
        }
    }
    return all;
}

}  // namespace

Expected<ImageFile> pictureOf(const Framebuffer& target, int n)
{
    const int attachment = attachmentOf(target, n);
    if (attachment < 0 || target.words(attachment).empty())
        return fail("the target keeps no colour " + std::to_string(n) + " and no depth; give it one with Store::keep");
    const Format format = target.attachments()[static_cast<std::size_t>(attachment)].format;
    if (format == Format::rgba8 || format == Format::rgba8Srgb) {
        Image8 picture{target.width(), target.height(), {}};
        for (const std::uint32_t pixel : target.words(attachment)) {
            for (int shift = 0; shift < 32; shift += 8)
                picture.pixels.push_back(static_cast<std::uint8_t>(pixel >> shift));
        }
        return picture;
    }
    ImageFloat picture{target.width(), target.height(), floatsOf(target, attachment, format)};
    for (std::size_t i = 3; i < picture.pixels.size(); i += 4) picture.pixels[i] = 1.0f;
    return picture;
}

Expected<ImageFile> alphaOf(const Framebuffer& target, int n)
{
    const int attachment = target.colorIndex(n);
    const Format format =
        attachment < 0 ? Format::r32f : target.attachments()[static_cast<std::size_t>(attachment)].format;
    if (format != Format::rgba32f && format != Format::rgba16f)
        return fail("the target has no colour " + std::to_string(n) + " of floats with alpha");
    ImageFloat picture{target.width(), target.height(), floatsOf(target, attachment, format)};
    for (std::size_t i = 0; i < picture.pixels.size(); i += 4) {
        const float alpha = picture.pixels[i + 3];
        picture.pixels[i] = picture.pixels[i + 1] = picture.pixels[i + 2] = alpha;
        picture.pixels[i + 3] = 1.0f;
    }
    return picture;
}

Expected<void> writePicture(const std::string& path, const ImageFile& picture)
{
    const std::filesystem::path folder = pathOf(path).parent_path();
    std::error_code error;
    if (!folder.empty()) std::filesystem::create_directories(folder, error);
    if (error) return fail(utf8Of(folder) + ": cannot make the folder (" + error.message() + "); choose another one");
    if (const auto* const bytes = std::get_if<Image8>(&picture))
        return writePng(path, bytes->width, bytes->height, bytes->pixels);
    const auto* const floats = std::get_if<ImageFloat>(&picture);
    if (floats == nullptr) return fail(path + ": pictures of 16 bits are read and not written; compare them as files");
    std::vector<float> rgb;
    for (std::size_t i = 0; i < floats->pixels.size(); ++i) {
        if (i % 4 == 3) continue;
        const float value = floats->pixels[i];
        rgb.push_back(value);
        if (std::abs(value) <= 1.7e38f) continue;
        const auto number = static_cast<int>(i / 4);
        return fail(path + ": pixel (" + std::to_string(number % floats->width) + ", " +
                    std::to_string(number / floats->width) +
                    ") is NaN, infinite or larger than 1.7e38; no golden holds that, make the program give a number");
    }
    return writePfm(path, floats->width, floats->height, rgb);
}

GoldenRecord judge(const GoldenCase& check, const Expected<ImageFile>& picture, const Expected<ImageFile>& expected)
{
    GoldenRecord record;
    record.name = check.name;
    record.golden = check.golden;
    record.actual = check.actual;
    record.range = textOf(check.tolerance);
    std::string why, pixels, differenceLine;
    std::error_code ignored;
    if (!picture) {
        record.outcome = Outcome::unreadable;
        why = "the picture cannot be read: " + picture.error().message;
    } else if (!expected) {
        const bool isThere = std::filesystem::exists(pathOf(check.golden), ignored);
        record.outcome = isThere ? Outcome::unreadable : Outcome::missing;
        why = isThere ? "the golden cannot be read: " + expected.error().message
                      : "there is no golden, so this picture is a candidate";
    } else if (const Expected<Comparison> comparison = compare(*picture, *expected); !comparison) {
        record.outcome = Outcome::otherKind;
        why = comparison.error().message;
    } else {
        record.differing = comparison->differing;
        record.largest = comparison->largest;
        record.window8x8 = comparison->window8x8;
        why = comparison->breaks(check.tolerance);
        record.outcome = !why.empty() ? Outcome::different : comparison->same() ? Outcome::same : Outcome::inRange;
        if (record.passes()) return record;
        pixels = comparison->report();
        if (check.tell && !comparison->same())
            pixels += check.tell(comparison->first[0].x, comparison->first[0].y) + "\n";
        const std::string path = utf8Of(pathOf(check.failures) / pathOf(check.name + ".difference.png"));
        const Image8 difference{std::visit([](const auto& p) { return p.width; }, *picture),
                                std::visit([](const auto& p) { return p.height; }, *picture), comparison->amplified};
        if (!comparison->same() && kept(path, difference, "difference  ", differenceLine)) record.difference = path;
    }
    record.message = check.name + ": " + why + "\n  golden      " + check.golden;
    if (record.actual.empty() && picture) {
        const char* const ending = std::holds_alternative<ImageFloat>(*picture) ? ".actual.pfm" : ".actual.png";
        const std::string path = utf8Of(pathOf(check.failures) / pathOf(check.name + ending));
        if (kept(path, *picture, "picture     ", record.message)) record.actual = path;
    } else {
        record.message += "\n  picture     " + check.actual;
    }
    if (const Expected<std::vector<std::uint8_t>> bytes = readFile(record.actual))
        record.actualHash = hexadecimal(hashOf(*bytes));
    record.message += differenceLine + "\n" + pixels +
                      "look at the picture, and if it is right, make it the golden: " + check.updating;
    return record;
}

namespace {

Expected<ImageFile> pictureFor(const std::string& golden, const Framebuffer& target)
{
    Expected<ImageFile> picture = pictureOf(target);
    if (picture && std::holds_alternative<Image8>(*picture)) return picture;
    return fail(golden + ": goldens are 8-bit pictures, the target's first colour is not; use expectGolden()");
}

}  // namespace

Expected<void> checkGolden(const Framebuffer& target, const std::string& golden, const std::string& failures)
{
    const Expected<ImageFile> picture = pictureFor(golden, target);
    if (!picture) return tl::unexpected(picture.error());
    const GoldenCase check{.name = utf8Of(pathOf(golden).stem()),
                           .golden = golden,
                           .actual = "",
                           .failures = failures,
                           .tolerance = {},
                           .updating = "updateGolden() does, or copy the file"};
    const GoldenRecord record = judge(check, picture, readImage(golden));
    if (record.passes()) return {};
    return fail(record.message);
}

Expected<void> updateGolden(const Framebuffer& target, const std::string& golden)
{
    return pictureFor(golden, target).and_then([&](const ImageFile& picture) { return writePicture(golden, picture); });
}

}  // namespace relief
