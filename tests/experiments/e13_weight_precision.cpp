// E-13: how many bits the weights of a bilinear fetch need.
#include "experiments.h"
#include "lane_kernel.h"
#include "relief/texture/filter.h"

namespace relief::experiments {

namespace {

constexpr int kSide = 64;

// A texture of random codes, or one whose columns or texels alternate between black and white.
enum class Content
{
    random,
    columns,
    texels
};

Texture textureOf(Content content)
{
    std::mt19937 random(5);
    std::vector<std::uint8_t> pixels;
    for (int i = 0; i < kSide * kSide * 4; ++i) {
        const int x = i / 4 % kSide, y = kSide - 1 - i / 4 / kSide;  // row 0 is on top
        const bool white = content == Content::columns ? x % 2 != 0 : x % 2 != 0 && y % 2 != 0;
        pixels.push_back(static_cast<std::uint8_t>(content == Content::random ? random() >> 24 : white ? 255u : 0u));
    }
    return *Texture::fromRgba8(kSide, kSide, pixels, ColorSpace::linear);
}

const Texture& texture(Content content)
{
    static const Texture all[] = {textureOf(Content::random), textureOf(Content::columns), textureOf(Content::texels)};
    return all[static_cast<std::size_t>(content)];
}

// --- kernels: RGBA at (u, v), times 255 ---

// The position of the first of two texels, with `bits` of fraction; the texture repeats.
template <int bits>
Int position(Float u)
{
    constexpr auto one = static_cast<float>(1 << bits);
    return Int(native::roundToInt(((u - floor(u)) * (kSide * one) + one / 2.0f).value));
}

// The engine's fetch, which takes 12 bits; fewer are rounded before.
template <int bits>
float4 engineFetch(const MipLevel& level, Float u, Float v)
{
    constexpr int mask = (1 << bits) - 1, missing = kSubtexelBits - bits;
    const Int x = position<bits>(u), y = position<bits>(v);
    const float4 raw = FetchRgba8::bilinear(level, (y >> bits) * level.rowTexels() + (x >> bits), (x & mask) << missing,
                                            (y & mask) << missing);
    return raw * (1.0f / kSubtexels);
}

struct Texels
{
    Int lowerLeft, lowerRight, upperLeft, upperRight;
};
Texels fetched(const MipLevel& level, Int index)
{
    native::IntVector lower[2], upper[2];
    const relief::detail::TexelIndices indices(index);
    const std::byte* texels = level.texels();
    native::loadTransposed<native::TwoWords>(indices.from<4>(texels), indices.from<4>(texels + level.rowBytes()), lower,
                                             upper);
    return {Int(lower[0]), Int(lower[1]), Int(upper[0]), Int(upper[1])};
}

// Everything in floats; `bits` 0 does not round the weights.
template <int bits>
float4 floatFetch(const MipLevel& level, Float u, Float v)
{
    const Float x = (u - floor(u)) * static_cast<float>(kSide) + 0.5f;
    const Float y = (v - floor(v)) * static_cast<float>(kSide) + 0.5f;
    Float fx = x - floor(x), fy = y - floor(y);
    if constexpr (bits > 0) {
        constexpr auto one = static_cast<float>(1 << bits);
        fx = floor(fx * one + 0.5f) * (1.0f / one);
        fy = floor(fy * one + 0.5f) * (1.0f / one);
    }
    const Texels t = fetched(level, truncateToInt(y) * level.rowTexels() + truncateToInt(x));
    float4 result;
    for (int c = 0; c < 4; ++c) {
        const auto channel = [c](Int texel) { return Float(shiftRightLogical(texel, 8 * c) & 255); };
        const Float a = channel(t.lowerLeft), b = channel(t.lowerRight), d = channel(t.upperLeft);
        const Float lower = a + (b - a) * fx, upper = d + (channel(t.upperRight) - d) * fx;
        result[c] = lower + (upper - lower) * fy;
    }
    return result;
}

// Two channels per multiplication, as their products with 8 bits of weight fit 16 bits each. Between the axes and at
// the end they are rounded to 8 bits again.
float4 packedFetch(const MipLevel& level, Float u, Float v)
{
    constexpr int bits = 8, mask = (1 << bits) - 1;
    const Int x = position<bits>(u), y = position<bits>(v);
    const Texels t = fetched(level, (y >> bits) * level.rowTexels() + (x >> bits));
    const auto mix = [](Int a, Int b, Int weight) {  // of the even bytes
        const Int sum = (a & 0x00ff00ff) * (256 - weight) + (b & 0x00ff00ff) * weight;
        return shiftRightLogical(sum + 0x00800080, 8) & 0x00ff00ff;
    };
    const auto both = [&](int shift) {
        const auto part = [shift](Int texel) { return shiftRightLogical(texel, shift); };
        return mix(mix(part(t.lowerLeft), part(t.lowerRight), x & mask),
                   mix(part(t.upperLeft), part(t.upperRight), x & mask), y & mask);
    };
    const Int even = both(0), odd = both(8);
    return {Float(even & 255), Float(odd & 255), Float(even >> 16), Float(odd >> 16)};
}

// --- reference ---

double exact(const MipLevel& level, std::size_t channel, double u, double v)
{
    const double x = u * kSide - 0.5, y = v * kSide - 0.5, left = std::floor(x), low = std::floor(y);
    const auto texel = [&](int i, int j) {
        const int column = static_cast<int>(left) + i, row = static_cast<int>(low) + j;
        return static_cast<double>(level.texel<std::uint8_t>(column, row)[channel]);  // -1 and 64 are in the frame
    };
    const double fx = x - left, fy = y - low;
    return (texel(0, 0) * (1 - fx) + texel(1, 0) * fx) * (1 - fy) + (texel(0, 1) * (1 - fx) + texel(1, 1) * fx) * fy;
}

template <class Kernel>
Error errorOf(Kernel kernel, Content content, const Columns& uv)
{
    const MipLevel& level = texture(content).level(0);
    const Columns colors = evaluate<2>(uv, [&](Float u, Float v) { return kernel(level, u, v); });
    ErrorSum sum;
    for (std::size_t i = 0; i < uv[0].size(); ++i) {
        for (std::size_t c = 0; c < 4; ++c)
            sum.add(static_cast<double>(colors[c][i]) - exact(level, c, uv[0][i], uv[1][i]));
    }
    return sum.result();
}

// Places in one cell of four texels, close together: up to (1, 1), where the weights of a white corner are steepest.
Columns closeTogether(int steps, bool alongBoth)
{
    Columns uv(2);
    for (int i = 0; i < steps; ++i) {
        const double along = (i + 0.5) / steps;
        uv[0].push_back(static_cast<float>((2.5 + along) / kSide));
        uv[1].push_back(static_cast<float>((2.5 + (alongBoth ? along : 0.0)) / kSide));
    }
    return uv;
}

template <class Kernel>
void add(Experiment& e, const std::string& name, Kernel kernel, Effort effort)
{
    const auto uv = randomColumns({{0, 1}, {0, 1}});
    const std::size_t some = static_cast<std::size_t>(effort.samples(1 << 16, 1 << 12));
    const int steps = effort.samples(16 * 4093, 16 * 257);  // not binary fractions alone
    const MipLevel& level = texture(Content::random).level(0);
    const auto timed = [kernel, &level](Float u, Float v) { return kernel(level, u, v); };
    e.variants.push_back(laneVariant<2>(name, "", uv, timed, [=] {
        const Columns first = {{(*uv)[0].begin(), (*uv)[0].begin() + static_cast<std::ptrdiff_t>(some)},
                               {(*uv)[1].begin(), (*uv)[1].begin() + static_cast<std::ptrdiff_t>(some)}};
        return Outcome(errorOf(kernel, Content::random, first),
                       {{"worst along one axis", errorOf(kernel, Content::columns, closeTogether(steps, false)).max},
                        {"along both", errorOf(kernel, Content::texels, closeTogether(steps, true)).max}});
    }));
}

}  // namespace

Experiment weightPrecision(Effort effort)
{
    Experiment e;
    e.id = "E-13";
    e.title = "Bits of a bilinear weight";
    e.question =
        "A bilinear fetch mixes four texels by where the coordinate lies between them. Graphics hardware keeps 8 bits "
        "of that place, Vulkan asks for no more than 4, this engine keeps 12. What does it show in 8-bit codes, and "
        "are fewer bits faster? With 8 or less, two channels can share a multiplication.";
    e.item = "fetch";
    e.unit = "codes of 255";
    add(
        e, "float", [](const MipLevel& l, Float u, Float v) { return floatFetch<0>(l, u, v); }, effort);
    add(
        e, "16 bits", [](const MipLevel& l, Float u, Float v) { return floatFetch<16>(l, u, v); }, effort);
    add(
        e, "12 bits, engine", [](const MipLevel& l, Float u, Float v) { return engineFetch<12>(l, u, v); }, effort);
    add(
        e, "8 bits", [](const MipLevel& l, Float u, Float v) { return engineFetch<8>(l, u, v); }, effort);
    add(
        e, "8 bits, packed", [](const MipLevel& l, Float u, Float v) { return packedFetch(l, u, v); }, effort);
    add(
        e, "4 bits", [](const MipLevel& l, Float u, Float v) { return engineFetch<4>(l, u, v); }, effort);

    // Half a step of the weight, times 255; along one axis it is reached, along both it is a bound.
    struct Reference
    {
        const char* name;
        double oneAxis;
    };
    constexpr Reference kReferences[] = {{"16 bits", 255.0 / 131072.0},
                                         {"12 bits, engine", 255.0 / 8192.0},
                                         {"8 bits", .498047},
                                         {"4 bits", 255.0 / 32.0}};
    for (const Reference& r : kReferences) {
        const auto fact = [name = std::string(r.name), outcomes = e.variants](std::size_t i) {
            for (const Variant& v : outcomes) {
                if (v.name == name) return v.outcome().facts[i].value;
            }
            return static_cast<double>(NAN);
        };
        const std::string of = std::string(", ") + r.name;
        // A step of the sweep, and of the coordinate, may lie beside the worst place.
        const double tolerance = 255.0 / effort.samples(16 * 4093, 16 * 257) + 1e-3;
        e.checks.push_back({"worst along one axis" + of, r.oneAxis, [=] { return fact(0); }, tolerance});
        e.checks.push_back({"along both" + of, 2.0 * r.oneAxis + 1e-4, [=] { return fact(1); }, 0.0, true});
    }
    e.finding = [](const Rows& rows) {
        const Row &exactly = rows("float"), &engine = rows("12 bits, engine"), &eight = rows("8 bits"),
                  &packed = rows("8 bits, packed"), &four = rows("4 bits");
        const std::string saved = eight.fastest < 0.97 * engine.fastest
                                      ? number(100.0 - 100.0 * eight.fastest / engine.fastest, 0) + " % of the time"
                                      : "nothing";
        const std::string faster = packed.fastest < 0.97 * engine.fastest ? "faster" : "no faster";
        return "8 bits of weight are at most " + number(eight.fact("worst along one axis"), 3) +
               " codes off along one axis and " + number(eight.fact("along both"), 3) + " along both, 4 bits " +
               number(four.fact("worst along one axis"), 1) + " and " + number(four.fact("along both"), 1) +
               ", the engine's 12 bits " + number(engine.fact("along both"), 3) +
               ". Cutting the engine's weights saves " + saved + ": " + number(engine.fastest, 2) +
               " ns with 12 bits, " + number(eight.fastest, 2) + " with 8, " + number(four.fastest, 2) +
               " with 4. Two channels per multiplication take " + number(packed.fastest, 2) + " ns, which is " +
               faster + ", and round between the axes, an RMS error of " + number(packed.outcome.error.rms, 2) +
               " instead of " + number(eight.outcome.error.rms, 2) + ". Floats for everything take " +
               number(exactly.fastest, 2) + " ns.";
    };
    return e;
}

}  // namespace relief::experiments
