// E-21: linear colours to sRGB and back: tables, and curves that look alike.
#include "exact_srgb.h"
#include "experiments.h"
#include "lane_kernel.h"
#include "relief/lanes/math.h"
#include "relief/texture/color_space.h"

namespace relief::experiments {

namespace {

// The nearest of evenly spaced entries, fetched lane by lane.
Float fetch(const float* table, int entries, Float x)
{
    std::int32_t at[kLanes];
    roundToInt(x * static_cast<float>(entries - 1)).store(at);
    float found[kLanes];
    for (int lane = 0; lane < kLanes; ++lane) found[lane] = table[at[lane]];
    return Float::load(found);
}

auto encodeByTable(int entries)
{
    std::vector<float> table;
    for (int i = 0; i < entries; ++i)
        table.push_back(static_cast<float>(encodedSrgb(static_cast<double>(i) / (entries - 1))));
    return [entries, kept = std::make_shared<const std::vector<float>>(std::move(table))](Float x) {
        return fetch(kept->data(), entries, x);
    };
}

constexpr auto encodeUnity = [](Float x) { return max(1.055f * pow(x, 0.416666667f) - 0.055f, Float(0.0f)); };
constexpr auto encodeGamma = [](Float x) { return pow(x, 1.0f / 2.2f); };
constexpr auto encodeRoot = [](Float x) { return sqrt(x); };
constexpr auto encodeByLibrary = [](Float x) {
    float numbers[kLanes];
    x.store(numbers);
    for (float& n : numbers) n = n <= 0.0031308f ? n * 12.92f : 1.055f * std::pow(n, 1.0f / 2.4f) - 0.055f;
    return Float::load(numbers);
};

constexpr auto decodeUnity = [](Float c) { return c * (c * (c * 0.305306011f + 0.682171111f) + 0.012522878f); };
constexpr auto decodeGamma = [](Float c) { return pow(c, 2.2f); };
constexpr auto decodeSquare = [](Float c) { return c * c; };
auto decodeByTable(bool sixteenBits)
{
    std::vector<float> table;
    for (int code = 0; code < 256; ++code) {
        const auto c = static_cast<std::uint8_t>(code);
        table.push_back(sixteenBits ? static_cast<float>(srgbToLinear16(c)) / 65535.0f : srgbToLinear(c));
    }
    return [kept = std::make_shared<const std::vector<float>>(std::move(table))](Float x) {
        return fetch(kept->data(), 256, x);
    };
}

// Closer together near black, where the curve is steepest.
template <class Function>
Error encodeError(Function f, int samples)
{
    Columns in(1);
    for (int i = 0; i < samples; ++i) {
        const double t = static_cast<double>(i) / (samples - 1);
        in[0].push_back(static_cast<float>(t * t * t));
    }
    const Columns out = evaluate<1>(in, f);
    ErrorSum sum;
    for (std::size_t i = 0; i < in[0].size(); ++i) {
        const double x = in[0][i], weight = std::cbrt(x * x);  // as if evenly spread
        sum.add(255.0 * (out[0][i] - encodedSrgb(x)), weight);
    }
    return sum.result();
}

Columns allCodes(bool decoded)
{
    Columns codes(1);
    for (int code = 0; code < 256; ++code)
        codes[0].push_back(decoded ? srgbToLinear(static_cast<std::uint8_t>(code)) : static_cast<float>(code) / 255.0f);
    return codes;
}

template <class Function>
Error decodeError(Function f)
{
    const Columns out = evaluate<1>(allCodes(false), f);
    ErrorSum sum;
    for (std::size_t code = 0; code < 256; ++code)
        sum.add(255.0 * encodedSrgb(out[0][code]) - static_cast<double>(code));
    return sum.result();
}

// Of the 256 codes, those that do not come back, through this function and the exact other way.
template <class Function>
double wrongCodes(Function f, bool encodes)
{
    const Columns out = evaluate<1>(allCodes(encodes), f);
    double wrong = 0.0;
    for (std::size_t code = 0; code < 256; ++code) {
        const double y = out[0][code];
        wrong += std::floor(255.0 * (encodes ? y : encodedSrgb(y)) + 0.5) != static_cast<double>(code);
    }
    return wrong;
}

}  // namespace

Experiment srgb(Effort effort)
{
    Experiment e;
    e.id = "E-21";
    e.title = "Linear light to sRGB and back";
    e.question =
        "The exact curve has a power of 2.4. Tables, a cubic, a power of 2.2 and a square stand in for it. How far "
        "off are they, in codes of an 8-bit picture, how many of its 256 codes come back as another one, and what do "
        "they save? The curve is steepest near black: there a table of evenly spaced entries is worst.";
    e.item = "channel";
    e.unit = "8-bit codes";
    e.rivals = Rivals::ofOneName;
    const auto in = randomColumns({{0.0, 1.0}});
    const int samples = effort.samples(1 << 20, 1 << 17);
    const auto encode = [&](const std::string& name, auto f, int entries) {
        e.variants.push_back(laneVariant<1>("encode", name, in, f, [=] {
            return Outcome(encodeError(f, samples),
                           {{"codes changed", wrongCodes(f, true)}, {"table bytes", 4.0 * entries}});
        }));
    };
    const auto decode = [&](const std::string& name, auto f, int entries) {
        e.variants.push_back(laneVariant<1>("decode", name, in, f, [=] {
            return Outcome(decodeError(f), {{"codes changed", wrongCodes(f, false)}, {"table bytes", 4.0 * entries}});
        }));
    };
    encode(
        "engine", [](Float x) { return linearToSrgb(x); }, 0);
    encode("C library", encodeByLibrary, 0);
    for (const int entries : {256, 1024, 4096, 16384, 65536})
        encode("table of " + std::to_string(entries), encodeByTable(entries), entries);
    encode("Unity", encodeUnity, 0);
    encode("power 1/2.2", encodeGamma, 0);
    encode("root", encodeRoot, 0);
    decode("engine", decodeByTable(false), 256);
    decode("16 bits", decodeByTable(true), 256);
    decode("Unity", decodeUnity, 0);
    decode("power 2.2", decodeGamma, 0);
    decode("square", decodeSquare, 0);

    struct Reference
    {
        int entries;
        double error;
    };
    for (const Reference& r : {Reference{256, 6.46},
                               {1024, 1.61026},
                               {4096, .402271},
                               {8192, .201111},
                               {16384, .100549},
                               {16474, .1},
                               {32768, .0502731},
                               {65536, .0251362}}) {
        e.checks.push_back({"encode, table of " + std::to_string(r.entries), r.error,
                            [=] { return encodeError(encodeByTable(r.entries), samples).max; }, 1e-3});
    }
    // Unity's curve is worst where it reaches 0, at (0.055 / 1.055)^2.4 = 8.338e-4. A search in steps of 1/65536 stops
    // at 55 of them, beside it.
    e.checks.push_back({"encode, Unity, at 55/65536", 2.72697,
                        [] {
                            const Columns one(1, std::vector<float>(16, 55.0f / 65536.0f));
                            return 255.0 * (encodedSrgb(one[0][0]) - evaluate<1>(one, encodeUnity)[0][0]);
                        },
                        1e-3});
    e.checks.push_back({"encode, Unity", 2.74700, [=] { return encodeError(encodeUnity, samples).max; }, 1e-3});
    e.checks.push_back({"decode, engine", 0.0, [] { return decodeError(decodeByTable(false)).max; }, 1e-5});
    e.checks.push_back({"decode, Unity", 4.97651, [] { return decodeError(decodeUnity).max; }, 5e-4});
    e.checks.push_back({"decode, power 2.2", 8.54447, [] { return decodeError(decodeGamma).max; }, 9e-4});
    e.checks.push_back({"decode, square", 9.52531, [] { return decodeError(decodeSquare).max; }, 1e-3});
    const auto engineEncode = [](Float x) { return linearToSrgb(x); };
    e.checks.push_back({"encode, engine, codes changed", 0.0, [=] { return wrongCodes(engineEncode, true); }, 0.0});

    e.finding = [](const Rows& rows) {
        const Row &engine = rows("encode", "engine"), &table = rows("encode", "table of 65536"),
                  &small = rows("encode", "table of 256"), &unity = rows("encode", "Unity"),
                  &square = rows("decode", "square"), &exact = rows("decode", "engine");
        const auto codes = [](const Row& row) { return number(row.fact("codes changed"), 0) + " of 256 codes"; };
        const bool faster = table.fastest < 0.97 * engine.fastest;
        return "The engine's polynomial takes " + number(engine.fastest, 2) + " ns and is off by at most " +
               number(engine.outcome.error.max, 3) + " codes. A table of 65536 entries is " +
               (faster ? "faster" : "no faster") + " (" + number(table.fastest, 2) +
               " ns), although it is 256 KiB; "
               "of 256 entries it is wrong by up to " +
               number(small.outcome.error.max, 1) +
               " codes near black and "
               "changes " +
               codes(small) + ". Unity's power without the straight piece changes " + codes(unity) + " and takes " +
               number(unity.fastest, 2) + " ns. Decoding by a table of 256 numbers is exact (" +
               number(exact.fastest, 2) + " ns); a square (" + number(square.fastest, 2) + " ns) changes " +
               codes(square) + ".";
    };
    return e;
}

}  // namespace relief::experiments
