// `check review`: the page. Pictures go into it as PNGs of opaque bytes, from which a browser gets every channel back
// as it was: alpha in a picture of its own, 16 bits and floats byte by byte.
#include <algorithm>
#include <bit>
#include <cstdio>

#include <nlohmann/json.hpp>

#include "check/check.h"
#include "relief/path.h"
#include "relief/texture/image.h"

namespace relief::samples::check {

namespace {

using Json = nlohmann::ordered_json;

std::string base64(std::span<const std::uint8_t> bytes)
{
    static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t word = 0;
        for (std::size_t k = 0; k < 3; ++k) word = word << 8 | (k < count ? bytes[i + k] : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += k <= count ? kDigits[word >> (18 - 6 * k) & 63u] : '=';
    }
    return text;
}

// Byte number `byte` of red, green and blue, or of alpha three times, as an opaque PNG.
template <class Channel>
Expected<std::string> plane(const ImageOf<Channel>& picture, std::size_t byte, bool isAlpha)
{
    std::vector<std::uint8_t> bytes(picture.pixels.size(), 255);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        if (i % 4 == 3) continue;
        const Channel value = picture.pixels[isAlpha ? i / 4 * 4 + 3 : i];
        std::uint32_t bits = 0;
        if constexpr (sizeof(Channel) == 4) bits = std::bit_cast<std::uint32_t>(value);
        if constexpr (sizeof(Channel) < 4) bits = value;
        bytes[i] = static_cast<std::uint8_t>(bits >> 8 * byte);
    }
    return encodePng("review", picture.width, picture.height, bytes).map(base64);
}

template <class Channel>
Expected<Json> pictureOf(const ImageOf<Channel>& picture)
{
    Json json = {{"width", picture.width}, {"height", picture.height}, {"bytes", sizeof(Channel)}};
    bool isOpaque = true;
    const Channel opaque = sizeof(Channel) == 4 ? Channel(1) : static_cast<Channel>(-1);
    for (std::size_t i = 3; i < picture.pixels.size(); i += 4) isOpaque = isOpaque && picture.pixels[i] == opaque;
    for (const bool isAlpha : {false, true}) {
        if (isAlpha && isOpaque) continue;
        for (std::size_t byte = 0; byte < sizeof(Channel); ++byte) {
            const Expected<std::string> png = plane(picture, byte, isAlpha);
            if (!png) return tl::unexpected(png.error());
            json[isAlpha ? "alpha" : "color"].push_back(*png);
        }
    }
    return json;
}

// null where there is no such picture, or none that can be read: the message says so.
Expected<Json> pictureIn(const std::string& path)
{
    const Expected<ImageFile> file = path.empty() ? fail("") : readImage(path);
    if (!file) return Json();
    return std::visit([](const auto& picture) { return pictureOf(picture); }, *file);
}

}  // namespace

Expected<int> review(const CheckOptions& options)
{
    Expected<std::vector<GoldenRecord>> records = readRecords(options.failures);
    if (!records) return tl::unexpected(records.error());
    if (records->empty())
        return fail(options.failures + ": has no records; run the tests, or name the folder that they wrote");
    if (!options.junit.empty()) {
        const Expected<void> junit = writeText(options.junit, junitOf(*records));
        if (!junit) return tl::unexpected(junit.error());
    }
    const std::size_t all = records->size();
    std::erase_if(*records, [](const GoldenRecord& record) { return record.passes(); });
    // First what cannot be compared, then the largest differences.
    std::stable_sort(records->begin(), records->end(), [](const GoldenRecord& a, const GoldenRecord& b) {
        const auto rank = [](const GoldenRecord& r) {
            return r.outcome == GoldenRecord::Outcome::different ? r.differing : ~std::uint64_t{0};
        };
        return rank(a) > rank(b);
    });
    std::error_code error;
    Json data = {{"failures", utf8Of(std::filesystem::absolute(pathOf(options.failures), error))}, {"all", all}};
    data["cases"] = Json::array();
    for (const GoldenRecord& record : *records) {
        const Expected<Json> golden = pictureIn(record.golden), actual = pictureIn(record.actual);
        if (!golden || !actual) return tl::unexpected((golden ? actual : golden).error());
        data["cases"].push_back({{"name", record.name},
                                 {"outcome", wordOf(record.outcome)},
                                 {"updated", record.updated},
                                 {"differing", record.differing},
                                 {"largest", record.largest},
                                 {"window8x8", record.window8x8},
                                 {"range", record.range},
                                 {"message", record.message},
                                 {"hash", record.actualHash},
                                 {"golden", *golden},
                                 {"actual", *actual}});
    }
    // Nothing in the text may end the script that it stands in.
    std::string text = data.dump(-1, ' ', false, Json::error_handler_t::replace);
    for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at))
        text.replace(at, 1, "\\u003c");
    std::string page = kReviewPage;
    const std::string mark = "\"(data)\"";
    page.replace(page.find(mark), mark.size(), text);
    const std::string output = options.output.empty() ? "review.html" : options.output;
    const Expected<void> written = writeText(output, page);
    if (!written) return tl::unexpected(written.error());
    std::printf("%s: %zu of %zu goldens to look at\n", output.c_str(), records->size(), all);
    return 0;
}

}  // namespace relief::samples::check
