// E-16: formats that a normal map can store its normals in.
#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <numbers>

#include "experiments.h"
#include "half.h"
#include "lane_kernel.h"
#include "relief/shading/normals.h"

namespace relief::experiments {

namespace {

// --- formats: a normal packed into words, and the kernel that unpacks it ---

using Words = std::array<std::uint32_t, 2>;

// -1 ... 1 as a code up to `largest`; nearest, halves up.
std::uint32_t unorm(double v, int largest)
{
    return static_cast<std::uint32_t>(std::floor((v * 0.5 + 0.5) * largest + 0.5));
}

Float channel(Int word, int shift, int bits = 8)  // 0 ... 1
{
    const int largest = (1 << bits) - 1;
    return Float(shiftRightLogical(word, shift) & largest) / static_cast<float>(largest);
}

struct Format
{
    std::string name;
    double bytes;
    std::function<Words(const Vector&)> pack;
};

const Format kRgb8 = {"RGB8", 3, [](const Vector& n) {
                          return Words{unorm(n.x, 255) | unorm(n.y, 255) << 8 | unorm(n.z, 255) << 16, 0};
                      }};
constexpr auto unpackRgb8 = [](Float word) {
    const Int w = asInt(word);
    return UnpackScaleNormalRGB(float4(channel(w, 0), channel(w, 8), channel(w, 16), 1.0f), 1.0f);
};

const Format kXy8 = {"XY8", 2, [](const Vector& n) { return Words{unorm(n.x, 255) | unorm(n.y, 255) << 8, 0}; }};
constexpr auto unpackXy8 = [](Float word) {
    const Int w = asInt(word);
    return UnpackScaleNormal(float4(1.0f, channel(w, 8), 1.0f, channel(w, 0)), 1.0f);
};

// Codes -127 ... 127: 0 is one of them.
const Format kXy8Signed = {"XY8 signed", 2, [](const Vector& n) {
                               const auto code = [](double v) {
                                   return static_cast<std::uint32_t>(static_cast<int>(std::floor(v * 127.0 + 0.5))) &
                                          255u;
                               };
                               return Words{code(n.x) | code(n.y) << 8, 0};
                           }};
constexpr auto unpackXy8Signed = [](Float word) {
    const Int w = asInt(word);
    const Float x = max(Float(w << 24 >> 24) / 127.0f, -1.0f), y = max(Float(w << 16 >> 24) / 127.0f, -1.0f);
    return float3(x, y, sqrt(1.0f - saturate(x * x + y * y)));
};

// What a block of DXT5 stores exactly: an alpha of 8 bits and a green of 6. Values between are coarser still.
// Green is code / 63, or what a decoder into 8 bits, as the engine's, makes of it.
const auto packDxt5 = [](const Vector& n) { return Words{unorm(n.x, 255) | unorm(n.y, 63) << 8, 0}; };
const Format kDxt5 = {"DXT5nm ends", 1, packDxt5}, kDxt5InEight = {"DXT5nm ends in 8", 1, packDxt5};
constexpr auto unpackDxt5 = [](Float word) {
    const Int w = asInt(word);
    return UnpackScaleNormal(float4(1.0f, channel(w, 8, 6), 1.0f, channel(w, 0)), 1.0f);
};
constexpr auto unpackDxt5InEight = [](Float word) {
    const Int w = asInt(word), green = (w >> 8) & 63;
    const Float y = Float(green << 2 | green >> 4) / 255.0f;
    return UnpackScaleNormal(float4(1.0f, y, 1.0f, channel(w, 0)), 1.0f);
};

const Format kXy16 = {"XY16", 4, [](const Vector& n) { return Words{unorm(n.x, 65535) | unorm(n.y, 65535) << 16, 0}; }};
constexpr auto unpackXy16 = [](Float word) {
    const Int w = asInt(word);
    return UnpackScaleNormal(float4(1.0f, channel(w, 16, 16), 1.0f, channel(w, 0, 16)), 1.0f);
};

// Rounded once, from the double: by way of a float some of the RMS errors below are 0.7 % larger.
std::uint32_t half(double v)
{
    const double step = std::ldexp(1.0, std::max(v == 0.0 ? -14 : std::ilogb(v), -14) - 10);
    return static_cast<std::uint32_t>(toHalf(static_cast<float>(std::nearbyint(v / step) * step))[0]);
}
const Format kHalf = {"halves", 6, [](const Vector& n) { return Words{half(n.x) | half(n.y) << 16, half(n.z)}; }};
constexpr auto unpackHalf = [](Float word, Float second) {
    const Int w = asInt(word);
    return normalize(float3(fromHalf(w), fromHalf(shiftRightLogical(w, 16)), fromHalf(asInt(second))));
};

// The hemisphere projected onto an octahedron's upper half, which seen from above is a square on its corner.
const Format kOctahedron = {"hemi-octahedron", 2, [](const Vector& n) {
                                const double sum = std::abs(n.x) + std::abs(n.y) + n.z;
                                return Words{unorm((n.x + n.y) / sum, 255) | unorm((n.x - n.y) / sum, 255) << 8, 0};
                            }};
constexpr auto unpackOctahedron = [](Float word) {
    const Int w = asInt(word);
    const Float s = channel(w, 0) * 2.0f - 1.0f, d = channel(w, 8) * 2.0f - 1.0f;
    const Float x = (s + d) * 0.5f, y = (s - d) * 0.5f;
    return normalize(float3(x, y, 1.0f - abs(x) - abs(y)));
};

// --- normals in rings of one tilt, and their errors ---

Vector normalAt(double tilt, int side, int sides)
{
    const double azimuth = 2.0 * std::numbers::pi * (side + 0.5) / sides, s = std::sin(tilt * kRadians);
    return {s * std::cos(azimuth), s * std::sin(azimuth), std::cos(tilt * kRadians)};
}

// Adds up rings, weighted by the solid angle that they stand for.
template <std::size_t words, class Unpack>
void addRing(ErrorSum& sum, const Format& format, Unpack unpack, double tilt, int sides)
{
    Columns packed(words, std::vector<float>(static_cast<std::size_t>((sides + 15) / 16 * 16)));
    for (int i = 0; i < sides; ++i) {
        const Words all = format.pack(normalAt(tilt, i, sides));
        for (std::size_t w = 0; w < words; ++w) packed[w][static_cast<std::size_t>(i)] = std::bit_cast<float>(all[w]);
    }
    const Columns unpacked = evaluate<words>(packed, unpack);
    for (int i = 0; i < sides; ++i)
        sum.add(degreesBetween(vectorAt(unpacked, static_cast<std::size_t>(i)), normalAt(tilt, i, sides)),
                std::sin(tilt * kRadians) + 1e-30);
}

// What the reference table knows of a format. Its widest cone ends a ring short of 90 degrees, where x and y alone have
// their worst.
struct Measured
{
    Error rings[5], cones[3];
};
constexpr double kRings[] = {0, 30, 60, 75, 85}, kCones[] = {45, 75, 89.75};

template <std::size_t words, class Unpack>
const Measured& measured(const Format& format, Unpack unpack, bool full)
{
    static std::map<std::pair<std::string, bool>, Measured> known;
    const auto at = std::pair(format.name, full);
    if (const auto found = known.find(at); found != known.end()) return found->second;
    Measured m;
    for (std::size_t i = 0; i < 5; ++i) {
        ErrorSum ring;
        addRing<words>(ring, format, unpack, kRings[i], 1440);
        m.rings[i] = ring.result();
    }
    ErrorSum cone;
    std::size_t next = 0;
    for (double tilt = 0.125; next < 3; tilt += 0.25) {
        addRing<words>(cone, format, unpack, tilt, full ? 1440 : 48);
        if (tilt + 0.125 == kCones[next]) m.cones[next++] = cone.result();
    }
    return known[at] = m;
}

// The reference table: degrees, largest and RMS.
struct Reference
{
    double flat;
    double rings[4][2], cones[3][2];
};

template <std::size_t words = 1, class Unpack>
void add(Experiment& e, const Format& format, Unpack unpack, const std::optional<Reference>& reference, Effort effort)
{
    auto packed = std::make_shared<Columns>(words, std::vector<float>(kStreamedItems));
    for (std::size_t i = 0; i < kStreamedItems; ++i) {
        const Words all = format.pack(normalAt(45.0 * static_cast<double>(i % 997) / 997.0, static_cast<int>(i), 1440));
        for (std::size_t w = 0; w < words; ++w) (*packed)[w][i] = std::bit_cast<float>(all[w]);
    }
    const auto all = [=]() -> const Measured& { return measured<words>(format, unpack, effort.full); };
    e.variants.push_back(laneVariant<words>(format.name, "", packed, unpack, [=, bytes = format.bytes] {
        const Measured& m = all();
        return Outcome(m.cones[1], {{"bytes per texel", bytes},
                                    {"flat", m.rings[0].max},
                                    {"RMS at 30 degrees", m.rings[1].rms},
                                    {"worst at 85", m.rings[4].max}});
    }));
    if (!reference) return;
    const Reference& r = *reference;
    const auto check = [&](const std::string& what, const double(&expected)[2], auto error) {
        e.checks.push_back({format.name + what + ", largest", expected[0], [=] { return error(all()).max; },
                            what == ", cone of 89.75 degrees" ? 1e-3 : 1e-4 * expected[0] + 5e-5});
        e.checks.push_back(
            {format.name + what + ", RMS", expected[1], [=] { return error(all()).rms; }, 1e-4 * expected[1] + 2e-5});
    };
    e.checks.push_back({format.name + ", flat", r.flat, [=] { return all().rings[0].max; }, 1e-4 * r.flat + 2e-6});
    for (std::size_t i = 1; i < 5; ++i)
        check(", ring of " + number(kRings[i], 0) + " degrees", r.rings[i - 1],
              [i](const Measured& m) { return m.rings[i]; });
    for (std::size_t i = 0; effort.full && i < 3; ++i)
        check(", cone of " + number(kCones[i], 2) + " degrees", r.cones[i],
              [i](const Measured& m) { return m.cones[i]; });
}

}  // namespace

Experiment normalStorage(Effort effort)
{
    Experiment e;
    e.id = "E-16";
    e.title = "Formats of a normal map";
    e.question =
        "Three numbers or two, 8 bits or 16, halves, or a square unfolded from half an octahedron: how far does a "
        "stored normal point from the one that was meant, and what does unpacking cost? The error is that of normals "
        "tilted by up to 75 degrees, each counting by its share of the sphere. A format without z gets it from x² + "
        "y² + z² = 1, which is steep near 90 degrees. Packed texels are in 32-bit words here.";
    e.item = "texel";
    e.unit = "degrees";
    add(e, kRgb8, unpackRgb8,
        Reference{.317755,
                  {{.297870, .171638}, {.304918, .177181}, {.377499, .257099}, {.316308, .216786}},
                  {{.376682, .183795}, {.378420, .184309}, {.378420, .184395}}},
        effort);
    add(e, kXy8, unpackXy8,
        Reference{.317760,
                  {{.335561, .193443}, {.558795, .282223}, {1.07313, .528330}, {5.00403, 1.93384}},
                  {{.422490, .201619}, {1.10575, .286343}, {5.13265, .758496}}},
        effort);
    add(e, kXy8Signed, unpackXy8Signed,
        Reference{0,
                  {{.337175, .204711}, {.546770, .287959}, {1.12467, .548964}, {5.00301, 1.98606}},
                  {{.425725, .202371}, {1.08630, .287466}, {5.62537, .777431}}},
        effort);
    add(e, kDxt5, unpackDxt5,
        Reference{.936843,
                  {{1.05754, .559596}, {1.82468, .876803}, {3.96604, 1.51517}, {6.04832, 3.64878}},
                  {{1.28916, .594931}, {4.09103, .849980}, {10.1270, 1.71820}}},
        effort);
    add(e, kDxt5InEight, unpackDxt5InEight, {}, effort);
    add(e, kXy16, unpackXy16,
        Reference{.00123642,
                  {{.00136682, 7.83283e-4}, {.00224935, .00114554}, {.00431211, .00201137}, {.0136302, .00541561}},
                  {{.00169556, 7.84123e-4}, {.00435150, .00111416}, {.247346, .00810086}}},
        effort);
    add<2>(e, kHalf, unpackHalf,
           Reference{0,
                     {{.0127654, .00703056}, {.0183982, .00624615}, {.0174364, .00578803}, {.0185517, .00573483}},
                     {{.0196386, .00674195}, {.0216786, .00762896}, {.0216786, .00723884}}},
           effort);
    add(e, kOctahedron, unpackOctahedron,
        Reference{.225573,
                  {{.423449, .255803}, {.494480, .275303}, {.442904, .276330}, {.405380, .253438}},
                  {{.520402, .249156}, {.540615, .270652}, {.540615, .261591}}},
        effort);
    e.finding = [](const Rows& rows) {
        const Row &rgb = rows("RGB8"), &xy = rows("XY8"), &octahedron = rows("hemi-octahedron"), &half = rows("halves"),
                  &wide = rows("XY16"), &dxt = rows("DXT5nm ends");
        return "In two bytes x and y are " + number(xy.outcome.error.max, 2) +
               " degrees off at worst, the octahedron " + number(octahedron.outcome.error.max, 2) + " at " +
               number(octahedron.fastest, 2) + " ns instead of " + number(xy.fastest, 2) +
               "; at 30 degrees, where most bumps are, x and y are the better (RMS " +
               number(xy.fact("RMS at 30 degrees"), 3) + " and " + number(octahedron.fact("RMS at 30 degrees"), 3) +
               "). A third byte for z brings the worst down to " + number(rgb.outcome.error.max, 2) +
               " and asks for a normalize(), " + number(rgb.fastest, 2) + " ns. 16 bits for x and y (RMS " +
               number(wide.outcome.error.rms, 4) + ") are better than three halves (" +
               number(half.outcome.error.rms, 4) +
               ") in less memory. DXT5nm stores y in 6 bits, so even flat is tilted by " + number(dxt.fact("flat"), 2) +
               " degrees, and by " + number(rows("DXT5nm ends in 8").fact("flat"), 2) +
               " where a decoder, as the engine's, first makes 8 bits of the 6; with 8 bits stored by " +
               number(xy.fact("flat"), 2) + ", with signed codes not at all.";
    };
    return e;
}

}  // namespace relief::experiments
