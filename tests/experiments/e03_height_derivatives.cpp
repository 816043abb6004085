// E-03: slopes from a height map, taken in the fragment program.
#include "experiments.h"
#include "height_wave.h"
#include "lane_kernel.h"
#include "relief/texture/sampler.h"

namespace relief::experiments {

namespace {

constexpr int kPoints = 65536;

// --- in a fragment program: (u, v) in texels, the distance between two samples in texels, slopes out ---

struct Heights
{
    std::shared_ptr<const Texture> texture;
    sampler2D sampler;
    Float scale;

    Heights(const HeightWave& wave, int bits, Filter filter)
        : texture(waveTexture(wave, bits)),
          sampler{.texture = texture.get(), .filter = filter, .mipmaps = false},
          scale(wave.scale())
    {
    }
    Float operator()(Float u, Float v) const { return tex2D(sampler, float2(u, v) * (1.0f / kWaveTexels)).x * scale; }
};

constexpr auto forward = [](const Heights& h, Float u, Float v, Float delta) {
    const Float here = h(u, v);
    return float2(h(u + delta, v) - here, h(u, v + delta) - here) / delta;
};
constexpr auto central = [](const Heights& h, Float u, Float v, Float delta) {
    const Float half = delta * 0.5f;
    return float2(h(u + half, v) - h(u - half, v), h(u, v + half) - h(u, v - half)) / delta;
};
constexpr auto diagonal = [](const Heights& h, Float u, Float v, Float delta) {
    const Float half = delta * 0.5f;
    const Float a = h(u - half, v - half), b = h(u + half, v - half), c = h(u - half, v + half),
                d = h(u + half, v + half);
    return float2(b + d - (a + c), c + d - (a + b)) / (delta * 2.0f);
};
constexpr auto sobel = [](const Heights& h, Float u, Float v, Float delta) {
    const Float ul = h(u - delta, v + delta), um = h(u, v + delta), ur = h(u + delta, v + delta);
    const Float ml = h(u - delta, v), mr = h(u + delta, v);
    const Float ll = h(u - delta, v - delta), lm = h(u, v - delta), lr = h(u + delta, v - delta);
    return float2(ur + 2.0f * mr + lr - (ul + 2.0f * ml + ll), ul + 2.0f * um + ur - (ll + 2.0f * lm + lr)) /
           (delta * 8.0f);
};

template <class Method>
struct OnHeights
{
    Method method;
    std::shared_ptr<const Heights> heights;
    Float delta;
    float2 operator()(Float u, Float v) const { return method(*heights, u, v, delta); }
};

// Points all over the map; or every texel's centre.
Columns points(int count)
{
    Columns uv(2);
    for (int i = 0; i < count; ++i) {
        uv[0].push_back(static_cast<float>((i + 0.5) / count * kWaveTexels));
        uv[1].push_back(static_cast<float>((i % 256 + 0.5) * 0.37 + 32.0));
    }
    return uv;
}

// The normal's error.
template <class Kernel>
Error errorOf(const Kernel& kernel, const HeightWave& wave, int count)
{
    const Columns uv = points(count), slopes = evaluate<2>(uv, kernel);
    ErrorSum sum;
    for (std::size_t i = 0; i < uv[0].size(); ++i) {
        sum.add(degreesBetween(Vector{slopes[0][i], slopes[1][i], -1.0},
                               Vector{wave.slopeU(uv[0][i], uv[1][i]), wave.slopeV(uv[0][i], uv[1][i]), -1.0}));
    }
    return sum.result();
}

// How much of the true slope comes out at the texels' centres; `shift`: where the slope is meant, in texels on.
template <class Method>
double gain(Method method, double delta, const HeightWave& wave, double shift)
{
    const OnHeights<Method> kernel{method, std::make_shared<const Heights>(wave, 0, Filter::bilinear), Float(delta)};
    Columns uv(2);
    for (int i = 0; i < 128; ++i) {  // in the middle: a wave across does not meet itself at the border
        uv[0].push_back(64.5f + static_cast<float>(i));
        uv[1].push_back(128.5f);
    }
    const Columns slopes = evaluate<2>(uv, kernel);
    double product = 0.0, square = 0.0;
    for (std::size_t i = 0; i < uv[0].size(); ++i) {
        const double exact = wave.slopeU(uv[0][i] + shift, uv[1][i]);
        product += slopes[0][i] * exact;
        square += exact * exact;
    }
    return product / square;
}

// --- the reference values: in doubles, along u ---

// Heights of a continuous wave, or between the texels of a map; weights of so many bits, 0 for exact ones.
struct Reference
{
    bool isMap;
    int bits, weightBits;

    double height(double u) const
    {
        const HeightWave wave;
        if (!isMap) return quantized(wave.height(u), bits);
        double at = u - 0.5;
        if (weightBits > 0) at = std::floor(std::ldexp(at, weightBits) + 0.5) / std::ldexp(1.0, weightBits);
        const double first = std::floor(at), weight = at - first;
        return quantized(wave.height(first + 0.5), bits) * (1.0 - weight) +
               quantized(wave.height(first + 1.5), bits) * weight;
    }
    Error error(double delta, bool isCentral) const
    {
        const HeightWave wave;
        ErrorSum sum;
        for (int i = 0; i < kPoints; ++i) {
            const double u = (i + 0.5) / kPoints * kWaveTexels, before = isCentral ? delta / 2.0 : 0.0;
            const double slope = (height(u + delta - before) - height(u - before)) / delta * wave.scale();
            sum.add((std::atan(slope) - std::atan(wave.slopeU(u))) * kDegrees);
        }
        return sum.result();
    }
};

void checkReference(Experiment& e, const std::string& what, const Reference& reference, double delta, bool isCentral,
                    double max, double rms)
{
    const std::string name = what + (isCentral ? ", central" : ", forward") + ", delta " +
                             (delta < 1.0 ? "1/" + number(1.0 / delta, 0) : number(delta, 0));
    e.checks.push_back(
        {name + ": largest", max, [=] { return reference.error(delta, isCentral).max; }, max * 1e-5 + 1e-9});
    e.checks.push_back({name + ": RMS", rms, [=] { return reference.error(delta, isCentral).rms; }, rms * 1e-5 + 1e-9});
}

void checkReferences(Experiment& e, Effort effort)
{
    struct Line
    {
        double delta, values[12];
    };
    constexpr Line kContinuous[] = {
        {1.0 / 64,
         {.0439453, .0261300, 73.9538, 34.2512, 1.16110, .341904, 2.80885e-6, 2.36191e-6, 73.9103, 34.2512, 1.11739,
          .340904}},
        {1.0 / 4,
         {.703103, .418074, 17.4821, 5.28127, .765554, .418606, 7.19057e-4, 6.04651e-4, 16.8718, 5.26482, .0677132,
          .0211174}},
        {1.0 / 2,
         {1.40608, .836107, 9.58664, 2.78276, 1.43672, .836176, .00287627, .00241862, 8.38522, 2.65441, .0340482,
          .0110441}},
        {1,
         {2.81112, 1.67189, 6.65137, 2.14855, 2.82694, 1.67190, .0115058, .00967468, 4.03445, 1.34974, .0229345,
          .0110030}},
        {2,
         {5.61398, 3.34118, 7.33248, 3.40617, 5.62133, 3.34118, .0460342, .0387022, 1.97192, .661881, .0505288,
          .0387931}},
        {4,
         {11.1624, 6.66161, 12.1057, 6.67089, 11.1657, 6.66161, .184314, .154864, 1.15533, .370097, .186468, .154870}},
        {6,
         {16.5826, 9.94088, 17.2128, 9.94436, 16.5847, 9.94088, .415364, .348649, .909875, .411600, .416678, .348650}},
        {8,
         {21.8173, 13.1591, 22.3235, 13.1612, 21.8191, 13.1591, .740051, .620317, 1.06092, .639485, .741096, .620317}},
        {16,
         {40.0251, 25.0560, 40.2649, 25.0569, 40.0256, 25.0560, 3.00278, 2.49327, 3.15039, 2.49281, 3.00327, 2.49327}},
        {32,
         {59.7124, 41.0826, 59.8340, 41.0833, 59.7126, 41.0826, 12.5184, 10.0393, 12.6094, 10.0384, 12.5187, 10.0393}}};
    // Forward and central, of floats, of 8 bits, of 8 bits with weights of 8 bits.
    constexpr Line kMap[] = {
        {1.0 / 512,
         {2.79817, .965339, 2.79817, .965339, 5.13108, 1.49535, 5.13108, 1.49535, 45, 33.6185, 21.4176, 17.3207}},
        {1.0 / 256,
         {2.79817, .959714, 2.79817, .965339, 5.13108, 1.49037, 5.13108, 1.49535, 5.14966, 1.49541, 5.13108, 1.49535}},
        {1.0 / 8,
         {2.79817, .870189, 2.44771, .844728, 5.13108, 1.40544, 4.83291, 1.38978, 5.14966, 1.40658, 4.85160, 1.38995}},
        {1,
         {2.80963, 1.67163, .0460338, .0302879, 5.13275, 1.84848, 2.70221, .785439, 5.14966, 1.85440, 2.71912,
          .785476}},
        {2,
         {5.61381, 3.34046, .0805620, .0586867, 6.26669, 3.36960, .896119, .414445, 6.27976, 3.37607, .905733,
          .414500}},
        {4,
         {11.1564, 6.66009, .218841, .174397, 11.7746, 6.67115, .618299, .260951, 11.7870, 6.67763, .630730, .261033}},
        {8,
         {21.8079, 13.1561, .774567, .639595, 21.8266, 13.1701, .955895, .610560, 21.8372, 13.1764, .957075, .610594}}};
    int line = 0;
    for (const Line& l : kContinuous) {
        if (!effort.full && line++ % 4 != 3) continue;
        for (int i = 0; i < 6; ++i) {
            const int bits = i % 3 == 0 ? 0 : i % 3 == 1 ? 8 : 16;
            checkReference(e, "continuous, " + (bits == 0 ? std::string("exact") : std::to_string(bits) + " bits"),
                           {false, bits, 0}, l.delta, i >= 3, l.values[2 * i], l.values[2 * i + 1]);
        }
    }
    line = 0;
    for (const Line& l : kMap) {
        if (!effort.full && line++ % 4 != 3) continue;
        constexpr const char* kNames[] = {"map of floats", "map of 8 bits", "map of 8 bits, weights of 8 bits"};
        for (int i = 0; i < 6; ++i) {
            checkReference(e, kNames[i / 2], {true, i < 2 ? 0 : 8, i < 4 ? 0 : 8}, l.delta, i % 2 == 1, l.values[2 * i],
                           l.values[2 * i + 1]);
        }
    }
}

void checkGains(Experiment& e)
{
    struct Line
    {
        double period, forward, central, diagonalCentral, diagonalSobel, angleLoss;
    };
    constexpr Line kGains[] = {{4, .900316, .636620, .806700, .582444, 12.5184},
                               {8, .974495, .900316, .949383, .878042, 3.00278},
                               {16, .993587, .974495, .987198, .968291, .740051},
                               {32, .998394, .993587, .996790, .991994, .184314},
                               {64, .999598, .998394, .999197, .997994, .0460342}};
    constexpr double kAcross = std::numbers::pi / 4.0, kTolerance = 1e-4;
    for (const Line& l : kGains) {
        const HeightWave along{l.period, 0.0}, across{l.period, kAcross};
        const std::string at = "gain at period " + number(l.period, 0) + ": ";
        e.checks.push_back({at + "forward", l.forward, [=] { return gain(forward, 1.0, along, 0.5); }, kTolerance});
        e.checks.push_back({at + "central", l.central, [=] { return gain(central, 2.0, along, 0.0); }, kTolerance});
        e.checks.push_back({at + "Sobel", l.central, [=] { return gain(sobel, 1.0, along, 0.0); }, kTolerance});
        e.checks.push_back({at + "central, wave across", l.diagonalCentral,
                            [=] { return gain(central, 2.0, across, 0.0); }, kTolerance});
        e.checks.push_back(
            {at + "Sobel, wave across", l.diagonalSobel, [=] { return gain(sobel, 1.0, across, 0.0); }, kTolerance});
        e.checks.push_back({at + "degrees that central loses", l.angleLoss,
                            [=] { return 45.0 - std::atan(gain(central, 2.0, along, 0.0)) * kDegrees; },
                            l.angleLoss * 1e-4 + 1e-3});
    }
}

template <class Method>
void add(Experiment& e, const std::string& name, Method method, double fetches, int bits, double delta, Filter filter,
         Effort effort)
{
    const auto on = [=](const HeightWave& wave) {
        return OnHeights<Method>{method, std::make_shared<const Heights>(wave, bits, filter), Float(delta)};
    };
    const std::string parameter = (bits == 0 ? "floats" : std::to_string(bits) + " bits") + ", delta " +
                                  (delta < 1.0 ? "1/" + number(1.0 / delta, 0) : number(delta, 0)) +
                                  (filter == Filter::nearest ? ", nearest" : "");
    const int count = effort.samples(kPoints, 2048);
    e.variants.push_back(
        laneVariant<2>(name, parameter, randomColumns({{0.0, 256.0}, {0.0, 256.0}}), on(kWaveAlong), [=] {
            return Outcome(
                errorOf(on(kWaveAlong), kWaveAlong, count),
                {{"fetches", fetches}, {"RMS, wave across", errorOf(on(kWaveAcross), kWaveAcross, count).rms}});
        }));
}

}  // namespace

Experiment heightDerivatives(Effort effort)
{
    Experiment e;
    e.id = "E-03";
    e.title = "Slopes from a height map";
    e.question =
        "A bump map holds heights; a fragment program takes differences. Between which samples, how far apart, and "
        "from how many bits? A short distance magnifies the steps of 8 bits, a long one flattens the bumps: the error "
        "has a minimum between. The map is a sine of 64 texels, its steepest slope 45 degrees; errors are those of the "
        "normal, all over the map, between texels too.";
    e.item = "fragment";
    e.unit = "degrees";
    for (const int bits : {8, 16, 0}) {
        add(e, "forward", forward, 3, bits, 1.0, Filter::bilinear, effort);
        add(e, "central", central, 4, bits, 1.0, Filter::bilinear, effort);
        add(e, "diagonal", diagonal, 4, bits, 1.0, Filter::bilinear, effort);
        add(e, "Sobel", sobel, 8, bits, 1.0, Filter::bilinear, effort);
    }
    for (const double delta : {1.0 / 512, 1.0 / 8, 2.0, 4.0, 8.0})
        add(e, "central", central, 4, 8, delta, Filter::bilinear, effort);
    add(e, "central", central, 4, 8, 1.0, Filter::nearest, effort);
    checkReferences(e, effort);
    checkGains(e);
    e.finding = [](const Rows& rows) {
        const Row &one = rows("central", "8 bits, delta 1"), &four = rows("central", "8 bits, delta 4"),
                  &eight = rows("central", "8 bits, delta 8"), &forwardOne = rows("forward", "8 bits, delta 1"),
                  &deep = rows("central", "16 bits, delta 1"), &sobelOne = rows("Sobel", "8 bits, delta 1");
        return "From 8-bit heights one texel is not the best distance: central differences err by " +
               number(one.outcome.error.rms, 3) + " degrees RMS at 1 texel, " + number(four.outcome.error.rms, 3) +
               " at 4, " + number(eight.outcome.error.rms, 3) + " at 8. 16 bits bring 1 texel to " +
               number(deep.outcome.error.rms, 3) + " for the same fetches. Forward differences err by " +
               number(forwardOne.outcome.error.rms, 2) +
               ", because they mean a point half a texel on; they save one "
               "fetch of four (" +
               number(forwardOne.fastest, 2) + " ns against " + number(one.fastest, 2) + "). Sobel's eight fetches (" +
               number(sobelOne.fastest, 2) + " ns) smooth the steps: " + number(sobelOne.outcome.error.rms, 3) +
               " degrees.";
    };
    return e;
}

}  // namespace relief::experiments
