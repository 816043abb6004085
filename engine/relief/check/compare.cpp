#include "relief/check/compare.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "relief/bits.h"

namespace relief {

namespace {

template <class Channel>
std::uint64_t distance(Channel a, Channel b)
{
    return static_cast<std::uint64_t>(std::abs(static_cast<int>(a) - static_cast<int>(b)));
}

// Steps from one float to the next: the bits of a float, taken as a number with a sign, are in the floats' order.
std::uint64_t distance(float a, float b)
{
    const auto bitsA = bitCast<std::uint32_t>(a), bitsB = bitCast<std::uint32_t>(b);
    if (bitsA == bitsB) return 0;
    if (a != a || b != b) return std::uint64_t{1} << 32;
    const auto ordered = [](std::uint32_t bits) {
        const auto magnitude = static_cast<std::int64_t>(bits & 0x7fffffffu);
        return bits >> 31 != 0 ? -magnitude : magnitude;
    };
    const std::int64_t steps = ordered(bitsA) - ordered(bitsB);
    return static_cast<std::uint64_t>(std::max<std::int64_t>(1, std::abs(steps)));  // +0 and -0
}

template <class Channel>
std::uint8_t amplify(std::uint64_t difference)
{
    if constexpr (sizeof(Channel) == 1) return static_cast<std::uint8_t>(std::min<std::uint64_t>(255, difference * 8));
    return static_cast<std::uint8_t>(
        std::min<std::uint64_t>(255, 16 * static_cast<std::uint64_t>(std::bit_width(difference))));
}

// The most marks in any square of 8x8, from sums down the columns of the last eight rows.
std::uint64_t densest(const std::vector<std::uint8_t>& marks, std::size_t columns, std::size_t rows)
{
    constexpr std::size_t kSide = 8;
    std::vector<std::uint32_t> sums(columns, 0);
    std::uint64_t most = 0;
    for (std::size_t y = 0; y < rows; ++y) {
        std::uint64_t window = 0;
        for (std::size_t x = 0; x < columns; ++x) {
            sums[x] += marks[y * columns + x];
            if (y >= kSide) sums[x] -= marks[(y - kSide) * columns + x];
            window += sums[x];
            if (x >= kSide) window -= sums[x - kSide];
            most = std::max(most, window);
        }
    }
    return most;
}

template <class Channel>
Comparison compareChannels(int width, int height, std::span<const Channel> actual, std::span<const Channel> expected)
{
    constexpr std::size_t kReported = 10;
    const auto columns = static_cast<std::size_t>(std::max(width, 0)),
               rows = static_cast<std::size_t>(std::max(height, 0));
    const std::size_t count = columns * rows, shorter = std::min(actual.size(), expected.size());
    const auto pixelOf = [](std::span<const Channel> picture, std::size_t at) {
        std::array<Channel, 4> pixel{};
        if (at < picture.size())
            std::copy_n(&picture[at], std::min<std::size_t>(4, picture.size() - at), pixel.begin());
        return pixel;
    };
    Comparison result;
    if (shorter >= count * 4 &&
        (count == 0 || std::memcmp(actual.data(), expected.data(), count * 4 * sizeof(Channel)) == 0))
        return result;
    result.amplified.resize(count * 4);
    for (std::size_t at = 3; at < result.amplified.size(); at += 4) result.amplified[at] = 255;

    std::vector<std::uint8_t> marks(count, 0);
    for (std::size_t number = 0; number < count; ++number) {
        const std::size_t at = number * 4;
        if (at + 4 <= shorter && std::memcmp(&actual[at], &expected[at], 4 * sizeof(Channel)) == 0) continue;
        const std::array<Channel, 4> is = pixelOf(actual, at), shouldBe = pixelOf(expected, at);
        for (std::size_t c = 0; c < 4; ++c) {
            const std::uint64_t difference = distance(is[c], shouldBe[c]);
            result.largest = std::max(result.largest, difference);
            if (c < 3) result.amplified[at + c] = amplify<Channel>(difference);
        }
        marks[number] = 1;
        ++result.differing;
        if (result.first.size() >= kReported) continue;
        PixelDifference pixel{static_cast<int>(number % columns), static_cast<int>(number / columns), {}, {}};
        std::copy(is.begin(), is.end(), pixel.actual.begin());
        std::copy(shouldBe.begin(), shouldBe.end(), pixel.expected.begin());
        result.first.push_back(pixel);
    }
    result.window8x8 = densest(marks, columns, rows);
    return result;
}

std::string textOf(const Between& range)
{
    return std::to_string(range.least) + (range.least == range.most ? "" : "-" + std::to_string(range.most));
}

std::string plural(std::uint64_t pixels)
{
    return std::to_string(pixels) + (pixels == 1 ? " pixel differs" : " pixels differ");
}

// "40-60", or "40".
bool readRange(std::string_view text, Between& range)
{
    const auto read = [&](std::uint64_t& number) {
        const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
        text.remove_prefix(static_cast<std::size_t>(end - text.data()));
        return problem == std::errc();
    };
    if (!read(range.least)) return false;
    range.most = range.least;
    if (!text.starts_with('-')) return text.empty();
    text.remove_prefix(1);
    return read(range.most) && text.empty() && range.least <= range.most;
}

}  // namespace

Comparison compare(int width, int height, std::span<const std::uint8_t> actual, std::span<const std::uint8_t> expected)
{
    return compareChannels(width, height, actual, expected);
}

Expected<Comparison> compare(const ImageFile& actual, const ImageFile& expected)
{
    if (sizeOf(actual) != sizeOf(expected))
        return fail("is " + sizeOf(actual) + " and should be " + sizeOf(expected) + "; draw it in the golden's size");
    if (actual.index() != expected.index()) {
        return fail(std::string("is a picture of ") + kindOf(actual) + " channels and should be one of " +
                    kindOf(expected) + "; save both in the same kind of file");
    }
    return std::visit(
        [&]<class Channel>(const ImageOf<Channel>& picture) {
            const auto& other = std::get<ImageOf<Channel>>(expected);
            return compareChannels<Channel>(picture.width, picture.height, picture.pixels, other.pixels);
        },
        actual);
}

std::string sizeOf(const ImageFile& picture)
{
    return std::visit([](const auto& p) { return std::to_string(p.width) + "x" + std::to_string(p.height); }, picture);
}

const char* kindOf(const ImageFile& picture)
{
    static constexpr const char* kKinds[] = {"8-bit", "16-bit", "float"};
    return kKinds[picture.index()];
}

Expected<Tolerance> toleranceOf(const std::string& text)
{
    Tolerance tolerance;
    std::string_view rest = text;
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find_first_of(", "), rest.size());
        const std::string_view word = rest.substr(0, end);
        rest.remove_prefix(std::min(end + 1, rest.size()));
        if (word.empty()) continue;
        const std::size_t equals = std::min(word.find('='), word.size());
        const std::string_view name = word.substr(0, equals);
        Between range;
        const bool isRange = equals < word.size() && readRange(word.substr(equals + 1), range);
        if (isRange && name == "pixels") {
            tolerance.pixels = range;
        } else if (isRange && name == "largest") {
            tolerance.largest = range;
        } else if (isRange && name == "window8x8" && range.least == range.most) {
            tolerance.window8x8 = range.most;
        } else {
            return fail("range \"" + text + "\": does not understand \"" + std::string(word) +
                        "\"; write it as in pixels=40-60,largest=1-2,window8x8=3");
        }
    }
    if ((tolerance.pixels.most == 0) == (tolerance.largest.most == 0)) return tolerance;
    return fail("range \"" + text + "\": pixels that differ have a largest difference; give both");
}

std::string textOf(const Tolerance& tolerance)
{
    if (tolerance.isExact()) return "";
    const std::string text = "pixels=" + textOf(tolerance.pixels) + ",largest=" + textOf(tolerance.largest);
    return text + (tolerance.window8x8 ? ",window8x8=" + std::to_string(*tolerance.window8x8) : "");
}

std::string Comparison::breaks(const Tolerance& tolerance) const
{
    if (tolerance.isExact()) return same() ? "" : plural(differing);
    std::string text;
    const auto hold = [&](std::uint64_t measured, const Between& range, const std::string& what) {
        if (measured >= range.least && measured <= range.most) return;
        text += (text.empty() ? "" : ", ") + what + ", the tolerance is " + textOf(range);
        if (measured < range.least) text += " (the picture is better than that: measure the range again)";
    };
    hold(differing, tolerance.pixels, plural(differing));
    hold(largest, tolerance.largest, "the largest difference is " + std::to_string(largest));
    if (tolerance.window8x8) {
        hold(window8x8, {0, *tolerance.window8x8}, std::to_string(window8x8) + " of them lie in a square of 8x8");
    }
    return text;
}

std::string Comparison::report() const
{
    std::string text = plural(differing) + ", the largest difference is " + std::to_string(largest) + ", " +
                       std::to_string(window8x8) + " lie in one square of 8x8\n";
    const auto values = [](const std::array<double, 4>& pixel) {
        std::string all;
        for (const double value : pixel) {
            char number[32];
            std::snprintf(number, sizeof number, " %3.9g", value);
            all += number;
        }
        return all;
    };
    for (const PixelDifference& p : first) {
        text += "  (" + std::to_string(p.x) + ", " + std::to_string(p.y) + ")  is" + values(p.actual) + "  should be" +
                values(p.expected) + "\n";
    }
    return text;
}

}  // namespace relief
