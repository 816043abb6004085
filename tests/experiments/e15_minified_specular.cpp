// E-15: the highlight of a bumpy surface whose bumps are smaller than a pixel.
#include <numbers>

#include "experiments.h"
#include "lane_kernel.h"
#include "relief/hlsl/intrinsics.h"

namespace relief::experiments {

namespace {

// --- kernels: Blinn and Phong's (N.H)^s, from what a mip level holds of the normals below it; H is the half vector ---

// The mean normal made unit length: as if the surface were smooth.
const auto renormalized = [](float s) {
    return [s](Float nx, Float ny, Float nz, Float hx, Float hy, Float hz) {
        return pow(saturate(dot(normalize(float3(nx, ny, nz)), float3(hx, hy, hz))), s);
    };
};

// Toksvig (2005): the mean normal is the shorter the more the normals differ, and a wider lobe makes up for it.
const auto toksvig = [](float s) {
    return [s](Float nx, Float ny, Float nz, Float hx, Float hy, Float hz) {
        const float3 n = {nx, ny, nz};
        const Float shorter = length(n), factor = shorter / (shorter + s * (1.0f - shorter)), wider = factor * s;
        const Float angle = saturate(dot(n, float3(hx, hy, hz)) / shorter);
        return (1.0f + wider) / (1.0f + s) * pow(angle, wider);
    };
};

// LEAN (Olano and Baker 2010): means of slopes and of their products, so a Gaussian lobe can be wider one way than the
// other. The exponent is a variance of 1/s.
const auto lean = [](float s) {
    return [s](Float bx, Float by, Float xx, Float yy, Float xy, Float hx, Float hy, Float hz) {
        const Float a = xx - bx * bx + 1.0f / s, c = yy - by * by + 1.0f / s, b = xy - bx * by;
        const Float x = hx / hz - bx, y = hy / hz - by, determinant = a * c - b * b;
        const Float square = (c * x * x - 2.0f * b * x * y + a * y * y) / determinant;
        return exp2(square * -0.721347520f) * (1.0f / s) / sqrt(determinant);
    };
};

// CLEAN: the same with one variance for both directions.
const auto clean = [](float s) {
    return [s](Float bx, Float by, Float squares, Float hx, Float hy, Float hz) {
        const Float variance = 0.5f * (squares - bx * bx - by * by) + 1.0f / s;
        const Float x = hx / hz - bx, y = hy / hz - by;
        return exp2((x * x + y * y) / variance * -0.721347520f) * (1.0f / s) / variance;
    };
};

// --- surfaces, and what their coarsest mip level holds ---

struct Slope
{
    double x, y;
};
struct Surface
{
    std::vector<Vector> normals;
    double nx = 0, ny = 0, nz = 0, bx = 0, by = 0, xx = 0, yy = 0, xy = 0;  // means

    explicit Surface(const std::vector<Slope>& slopes)
    {
        const double share = 1.0 / static_cast<double>(slopes.size());
        for (const Slope& b : slopes) {
            const double up = 1.0 / std::sqrt(b.x * b.x + b.y * b.y + 1.0);
            normals.push_back({b.x * up, b.y * up, up});
            nx += b.x * up * share, ny += b.y * up * share, nz += up * share;
            bx += b.x * share, by += b.y * share;
            xx += b.x * b.x * share, yy += b.y * b.y * share, xy += b.x * b.y * share;
        }
    }
};

Surface waves(double slope, int count)
{
    std::vector<Slope> slopes;
    for (int i = 0; i < count; ++i)
        slopes.push_back({slope * std::sin(2.0 * std::numbers::pi * (i + 0.5) / count), 0.0});
    return Surface(slopes);
}

// Waves in all directions, as steep on the whole.
Surface noise(double slope, int side)
{
    std::vector<Slope> slopes(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), {0, 0});
    constexpr int kWaves[][2] = {{1, 5}, {4, -3}, {5, 2}, {-2, 4}, {3, 3}, {6, 0}, {0, -4}, {-5, 1}};
    for (std::size_t i = 0; i < slopes.size(); ++i) {
        for (std::size_t w = 0; w < 8; ++w) {
            const double kx = kWaves[w][0], ky = kWaves[w][1], size = std::hypot(kx, ky);
            const double x = static_cast<double>(i % static_cast<std::size_t>(side)),
                         y = std::floor(static_cast<double>(i) / side);
            const double wave =
                slope / std::sqrt(8.0) *
                std::sin(2.0 * std::numbers::pi * (kx * x + ky * y) / side + 2.1 * static_cast<double>(w));
            slopes[i].x += wave * kx / size;
            slopes[i].y += wave * ky / size;
        }
    }
    return Surface(slopes);
}

// Half vectors 0 to 60 degrees from upright, so many each way: 1 is along x alone.
std::vector<Vector> halfVectors(int azimuths, int steps)
{
    std::vector<Vector> all;
    for (int a = 0; a < azimuths; ++a) {
        for (int i = 0; i <= steps; ++i) {
            const double tilt = i * std::numbers::pi / 3.0 / steps, around = 2.0 * std::numbers::pi * a / azimuths;
            all.push_back({std::sin(tilt) * std::cos(around), std::sin(tilt) * std::sin(around), std::cos(tilt)});
        }
    }
    return all;
}

// The mean of (N.H)^s over all normals.
std::vector<double> exactly(const Surface& surface, double s, const std::vector<Vector>& halfs)
{
    std::vector<double> all;
    for (const Vector& h : halfs) {
        double sum = 0.0;
        for (const Vector& n : surface.normals) sum += std::pow(std::fmax(n.x * h.x + n.y * h.y + n.z * h.z, 0.0), s);
        all.push_back(sum / static_cast<double>(surface.normals.size()));
    }
    return all;
}

// --- measuring ---

struct Case
{
    double slope, s;
};
constexpr Case kCases[] = {{.1, 64}, {.1, 256}, {.1, 1024}, {.3, 16}, {.3, 64}, {.3, 256}};
constexpr std::size_t kCaseCount = std::size(kCases), kNoise = kCaseCount;  // the last is noise, {.3, 64}

struct Lit
{
    Surface surface;
    double s;
    std::vector<Vector> halfs;
    std::vector<double> exact, weights;  // the latter: of a half vector in sums of light
};

const std::vector<Lit>& lit(Effort effort)
{
    const auto make = [](int normals, int side) {
        std::vector<Lit> all;
        for (const Case& c : kCases) all.push_back({waves(c.slope, normals), c.s, halfVectors(1, 240), {}, {}});
        all.push_back({noise(.3, side), 64, halfVectors(12, 60), {}, {}});
        for (Lit& l : all) {
            l.exact = exactly(l.surface, l.s, l.halfs);
            for (const Vector& h : l.halfs) l.weights.push_back(&l == &all[kNoise] ? std::hypot(h.x, h.y) : 1.0);
            if (&l != &all[kNoise]) l.weights.front() = l.weights.back() = 0.5;  // trapezoids
        }
        return all;
    };
    if (effort.full) {
        static const std::vector<Lit> full = make(16384, 64);
        return full;
    }
    static const std::vector<Lit> few = make(512, 32);  // enough: the means of smooth waves converge fast
    return few;
}

enum class Holds  // what a kernel reads of a texel
{
    normal,
    slopes,
    slopesAndOneVariance
};

template <Holds holds>
constexpr std::size_t kInputs = holds == Holds::slopes ? 8 : 6;

Columns inputs(Holds holds, const Surface& f, const std::vector<Vector>& halfs)
{
    const std::vector<double> texel = holds == Holds::normal   ? std::vector{f.nx, f.ny, f.nz}
                                      : holds == Holds::slopes ? std::vector{f.bx, f.by, f.xx, f.yy, f.xy}
                                                               : std::vector{f.bx, f.by, f.xx + f.yy};
    Columns all;
    for (const double number : texel) all.emplace_back((halfs.size() + 15) / 16 * 16, static_cast<float>(number));
    for (std::size_t c = 0; c < 3; ++c) {
        std::vector<float>& column = all.emplace_back(all[0].size(), c == 2 ? 1.0f : 0.0f);
        for (std::size_t i = 0; i < halfs.size(); ++i)
            column[i] = static_cast<float>(c == 0 ? halfs[i].x : c == 1 ? halfs[i].y : halfs[i].z);
    }
    return all;
}

struct Measured
{
    Error error;
    double energy, peak;  // of all the light, of the middle
};

template <Holds holds, class Kernel>
Measured measured(Kernel kernel, const Lit& l, ErrorSum* also = nullptr)
{
    const Columns shown = evaluate<kInputs<holds>>(inputs(holds, l.surface, l.halfs), kernel(static_cast<float>(l.s)));
    ErrorSum sum;
    double light = 0.0, exactLight = 0.0;
    for (std::size_t i = 0; i < l.halfs.size(); ++i) {
        sum.add(static_cast<double>(shown[0][i]) - l.exact[i]);
        if (also) also->add(static_cast<double>(shown[0][i]) - l.exact[i]);
        light += l.weights[i] * static_cast<double>(shown[0][i]);
        exactLight += l.weights[i] * l.exact[i];
    }
    return {sum.result(), light / exactLight, shown[0][0]};
}

template <Holds holds, class Kernel>
void add(Experiment& e, const std::string& name, double numbers, Kernel kernel, Effort effort)
{
    const Surface surface = waves(.3, 512);
    const auto timed = std::make_shared<const Columns>(inputs(holds, surface, halfVectors(64, 1023)));
    e.variants.push_back(laneVariant<kInputs<holds>>(name, "", timed, kernel(64.0f), [=] {
        const std::vector<Lit>& all = lit(effort);
        ErrorSum sum;
        for (std::size_t i = 0; i < kCaseCount; ++i) measured<holds>(kernel, all[i], &sum);
        const Measured third = measured<holds>(kernel, all[4]), rough = measured<holds>(kernel, all[kNoise], &sum);
        return Outcome(sum.result(), {{"numbers per texel", numbers},
                                      {"peak of waves", third.peak},
                                      {"energy of waves", third.energy},
                                      {"RMS of noise", rough.error.rms},
                                      {"energy of noise", rough.energy}});
    }));
}

}  // namespace

Experiment minifiedSpecular(Effort effort)
{
    Experiment e;
    e.id = "E-15";
    e.title = "Highlights of bumps below a pixel";
    e.question =
        "Far away a pixel covers many bumps, and its highlight is the mean of theirs: dim and wide. A mip level of "
        "unit normals has forgotten the bumps and shows a small, bright one. Toksvig widens it by how short the mean "
        "normal is; LEAN keeps means of slopes and of their squares. How far is each from the mean over all normals "
        "(a lobe's peak is 1), for waves along x and for noise, and what does the shading cost?";
    e.item = "pixel";
    e.unit = "peaks";
    add<Holds::normal>(e, "unit length", 2, renormalized, effort);
    add<Holds::normal>(e, "Toksvig", 3, toksvig, effort);
    add<Holds::slopesAndOneVariance>(e, "CLEAN", 3, clean, effort);
    add<Holds::slopes>(e, "LEAN", 5, lean, effort);

    struct Reference
    {
        double exactPeak, unitMax, unitRms, toksvigMax, toksvigRms, toksvigEnergy, exponent, leanMax, leanRms,
            leanEnergy;
    };
    constexpr Reference kReferences[] = {
        {.858064, .141936, .0413322, .0513231, .0198062, .930375, 55.1961, .0147464, .00635228, .984373},
        {.583535, .416465, .0911049, .148073, .0425854, .782795, 156.287, .0787308, .0185306, .992290},
        {.266583, .733417, .129012, .234730, .0549480, .531582, 288.285, .137643, .0325991, .994370},
        {.726958, .273042, .114981, .0949767, .0528923, .873664, 11.8488, .0583911, .0349565, .930638},
        {.381885, .618115, .201187, .208657, .0905995, .655625, 26.6512, .125788, .0508384, .951710},
        {.170842, .829158, .208684, .235870, .0860839, .395402, 38.7552, .139014, .0535966, .957875}};
    for (std::size_t i = 0; i < kCaseCount; ++i) {
        const Reference& r = kReferences[i];
        const Case& c = kCases[i];
        const std::string of = ", slopes " + number(c.slope, 1) + " sin t, exponent " + number(c.s, 0);
        const auto check = [&](const std::string& what, double expected, auto measure) {
            e.checks.push_back({what + of, expected, [=] { return measure(lit(effort)[i]); }, 1e-4 * expected + 1e-5});
        };
        check("exact peak", r.exactPeak, [](const Lit& l) { return l.exact[0]; });
        const auto unit = [](const Lit& l) { return measured<Holds::normal>(renormalized, l); };
        const auto tok = [](const Lit& l) { return measured<Holds::normal>(toksvig, l); };
        const auto both = [](const Lit& l) { return measured<Holds::slopes>(lean, l); };
        check("unit length, largest", r.unitMax, [=](const Lit& l) { return unit(l).error.max; });
        check("unit length, RMS", r.unitRms, [=](const Lit& l) { return unit(l).error.rms; });
        check("Toksvig, largest", r.toksvigMax, [=](const Lit& l) { return tok(l).error.max; });
        check("Toksvig, RMS", r.toksvigRms, [=](const Lit& l) { return tok(l).error.rms; });
        check("Toksvig, energy", r.toksvigEnergy, [=](const Lit& l) { return tok(l).energy; });
        check("Toksvig, exponent", r.exponent, [](const Lit& l) {
            const double shorter = l.surface.nz;
            return l.s * shorter / (shorter + l.s * (1.0 - shorter));
        });
        check("LEAN, largest", r.leanMax, [=](const Lit& l) { return both(l).error.max; });
        check("LEAN, RMS", r.leanRms, [=](const Lit& l) { return both(l).error.rms; });
        check("LEAN, energy", r.leanEnergy, [=](const Lit& l) { return both(l).energy; });
    }
    e.finding = [effort](const Rows& rows) {
        const Row &unit = rows("unit length"), &tok = rows("Toksvig"), &cleaned = rows("CLEAN"), &leaned = rows("LEAN");
        return "Waves of slope 0.3 under an exponent of 64 dim the highlight's middle to " +
               number(lit(effort)[4].exact[0], 3) + " of its peak; unit normals leave " +
               number(unit.fact("peak of waves"), 3) + ", Toksvig shows " + number(tok.fact("peak of waves"), 3) +
               ", LEAN " + number(leaned.fact("peak of waves"), 3) + ". Over all surfaces the RMS errors are " +
               number(unit.outcome.error.rms, 3) + ", " + number(tok.outcome.error.rms, 3) + " and " +
               number(leaned.outcome.error.rms, 3) + "; on noise, which has no direction, CLEAN with 3 numbers (" +
               number(cleaned.fact("RMS of noise"), 4) + ") does what LEAN does with 5 (" +
               number(leaned.fact("RMS of noise"), 4) + "), and Toksvig has " + number(tok.fact("RMS of noise"), 4) +
               ". Times: " + number(unit.fastest, 2) + ", Toksvig " + number(tok.fastest, 2) + ", CLEAN " +
               number(cleaned.fastest, 2) + ", LEAN " + number(leaned.fastest, 2) + " ns: " +
               (leaned.fastest <= unit.fastest ? "LEAN has no logarithm and costs no more than shading wrongly."
                                               : "the right highlight has its price.");
    };
    return e;
}

}  // namespace relief::experiments
