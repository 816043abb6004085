// E-28: the same program on 1, 4, 8 and 16 numbers at a time, and with multiplications and additions rounded once.
#include <algorithm>
#include <cstring>

#include "experiments.h"
#include "lane_kernel.h"
#include "triangle_scene.h"
#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace relief::experiments {

namespace {

typedef float Four __attribute__((vector_size(16)));
typedef float Eight __attribute__((vector_size(32)));
typedef float Sixteen __attribute__((vector_size(64)));

inline float root(float x)
{
    return std::sqrt(x);
}
inline float positive(float x)
{
    return x > 0.0f ? x : 0.0f;
}
inline Float root(Float x)
{
    return sqrt(x);
}
inline Float positive(Float x)
{
    return max(x, Float(0.0f));
}
#if defined(__SSE2__)
inline Four root(Four x)
{
    return (Four)_mm_sqrt_ps((__m128)x);
}
inline Four positive(Four x)
{
    return (Four)_mm_max_ps((__m128)x, _mm_setzero_ps());
}
#endif
#if defined(__AVX2__)
inline Eight root(Eight x)
{
    return (Eight)_mm256_sqrt_ps((__m256)x);
}
inline Eight positive(Eight x)
{
    return (Eight)_mm256_max_ps((__m256)x, _mm256_setzero_ps());
}
#endif
#if defined(__AVX512F__)
inline Sixteen root(Sixteen x)
{
    return (Sixteen)_mm512_sqrt_ps((__m512)x);
}
inline Sixteen positive(Sixteen x)
{
    return (Sixteen)_mm512_max_ps((__m512)x, _mm512_setzero_ps());
}
#endif

// a * b + c: rounded twice, as everywhere in the engine; or once.
constexpr auto twice = [](auto a, auto b, auto c) { return a * b + c; };
#if defined(__FMA__)
constexpr auto once = [](Eight a, Eight b, Eight c) { return (Eight)_mm256_fmadd_ps((__m256)a, (__m256)b, (__m256)c); };
#endif

// A highlight (exponent 8) and Fresnel's reflection over a diffuse colour: of a normal, a light's direction and an
// albedo, the eye above. Exact operations alone.
template <class T, class MultiplyAdd>
[[gnu::always_inline]] inline T shade(const T (&in)[7], MultiplyAdd madd)
{
    const auto dot = [&](const T* a, const T* b) { return madd(a[0], b[0], madd(a[1], b[1], a[2] * b[2])); };
    T normal[3], light[3], half[3];
    const T toUnit = 1.0f / root(dot(in, in)), lightToUnit = 1.0f / root(dot(in + 3, in + 3));
    for (int i = 0; i < 3; ++i) normal[i] = in[i] * toUnit, light[i] = in[3 + i] * lightToUnit, half[i] = light[i];
    half[2] = half[2] + 1.0f;
    const T halfToUnit = 1.0f / root(dot(half, half));
    T power = positive(dot(normal, half) * halfToUnit);
    for (int i = 0; i < 3; ++i) power = power * power;
    const T grazing = 1.0f - positive(half[2] * halfToUnit), square = grazing * grazing;
    const T fresnel = square * square * grazing * 0.96f + 0.04f;
    return madd(in[6], positive(dot(normal, light)), power * fresnel);
}

template <class T>
T loaded(const float* from)
{
    T value;
    std::memcpy(&value, from, sizeof value);
#if defined(__SSE2__)
    if constexpr (sizeof value == sizeof(float)) asm("" : "+x"(value));  // stays alone: no vector of three of them
#endif
    return value;
}

// The inputs' and the result's columns, a cache line apart from where they would share the cache's sets.
struct Memory
{
    std::vector<float> numbers;
    std::size_t items;

    Memory(const Columns& in, std::size_t count) : numbers(8 * (count + 16)), items(count)
    {
        for (std::size_t i = 0; i < 7; ++i) std::copy_n(in[i].begin(), items, column(i));
    }
    float* column(std::size_t i) { return numbers.data() + i * (items + 16); }
    const float* results() { return column(7); }
};

template <class T, class MultiplyAdd>
[[gnu::noinline]] void shadeAll(Memory& memory, MultiplyAdd madd)
{
    constexpr std::size_t lanes = sizeof(T) / sizeof(float);
    float* columns[8];
    for (std::size_t i = 0; i < 8; ++i) columns[i] = memory.column(i);
    const std::size_t items = memory.items;
    for (std::size_t at = 0; at < items; at += lanes) {
        T row[7];
        for (std::size_t i = 0; i < 7; ++i) row[i] = loaded<T>(columns[i] + at);
        const T result = shade(row, madd);
        std::memcpy(columns[7] + at, &result, sizeof result);
        asm volatile("" : : : "memory");  // and so no compiler joins several turns into one
    }
}

template <class T, class MultiplyAdd>
void add(Experiment& e, const std::string& name, MultiplyAdd madd, const Columns& in)
{
    const auto small = std::make_shared<Memory>(in, kWarmItems), large = std::make_shared<Memory>(in, kStreamedItems);
    const auto alone = std::make_shared<Memory>(in, kStreamedItems);
    const auto outcome = [=] {
        shadeAll<float>(*alone, twice);
        shadeAll<T>(*large, madd);
        ErrorSum sum;
        double other = 0.0;
        for (std::size_t i = 0; i < kStreamedItems; ++i) {
            const float one = alone->results()[i], result = large->results()[i];
            sum.add(255.0 * (static_cast<double>(result) - static_cast<double>(one)));
            other += std::memcmp(&one, &result, sizeof one) != 0;
        }
        return Outcome(sum.result(), {{"% with other bits", 100.0 * other / static_cast<double>(kStreamedItems)}});
    };
    Variant v = {name,
                 "",
                 outcome,
                 {[=] { shadeAll<T>(*small, madd); }, static_cast<double>(kWarmItems)},
                 {[=] { shadeAll<T>(*large, madd); }, static_cast<double>(kStreamedItems)}};
    v.isCounted = sizeof(T) < 64 || name == "engine";  // the counted program has no AVX-512
    e.variants.push_back(v);
    Check same = {name + ", % with other bits", 0.0, [=] { return outcome().facts[0].value; }, 0.0};
    if (name.find("fused") != std::string::npos)
        same = {name + ", codes", 1.0, [=] { return outcome().error.max; }, 0.0, true};
    e.checks.push_back(same);
}

}  // namespace

Experiment lanes(Effort)
{
    Experiment e;
    e.id = "E-28";
    e.title = "Lanes";
    e.question =
        "A shader runs on 4, 8 or 16 pixels at a time. Does each get the same bits as alone, and how much faster is "
        "it? The same program on plain floats, on vectors as wide as this build's instruction set has them, and on "
        "the engine's lanes. One more variant rounds a * b + c once instead of twice. (Whole engines of other lane "
        "counts are other builds; that their pictures have the same hash is checked in each.)";
    e.item = "fragment";
    e.unit = "8-bit codes";
    const Columns in =
        *randomColumns({{-0.7, 0.7}, {-0.7, 0.7}, {0.3, 1.0}, {-1.0, 1.0}, {-1.0, 1.0}, {0.1, 1.0}, {0.0, 1.0}});
    add<float>(e, "1 lane", twice, in);
#if defined(__SSE2__)
    add<Four>(e, "4 lanes", twice, in);
#endif
#if defined(__AVX2__)
    add<Eight>(e, "8 lanes", twice, in);
#endif
#if defined(__AVX512F__)
    add<Sixteen>(e, "16 lanes", twice, in);
#endif
    add<Float>(e, "engine", twice, in);
#if defined(__FMA__)
    add<Eight>(e, "8 lanes, fused", once, in);
#endif
    const auto triangles = std::make_shared<const TriangleScene>(500, 64);
    e.checks.push_back({"coverage against exact integers, pixels that differ", 0.0,
                        [triangles] { return coverageError(*triangles, {.threads = 1}).max; }, 0.0});
    // The hash of the picture by every build: 4, 8 and 16 lanes, g++ and clang++.
    constexpr std::uint64_t kHash = 0x1b4f06b457f4a64e;
    const auto sameHash = [triangles] {
        const auto f = framed(*triangles, {.threads = 1}, false);
        f->frame.run();
        return hashOf(f->target) == kHash ? 1.0 : 0.0;
    };
    e.checks.push_back({"the picture's hash is that of all builds", 1.0, sameHash, 0.0});
    e.finding = [](const Rows& rows) {
        const Row &one = rows("1 lane"), &engine = rows("engine");
        std::string text = "The same bits from any number of lanes; one lane takes " + number(one.fastest, 2) + " ns.";
        for (const Row& row : rows.all) {
            if (&row == &one) continue;
            text += " " + row.name + ": " + number(one.fastest / row.fastest, 1) + " times as fast as one lane (" +
                    number(row.fastest, 2) + " ns).";
            if (row.fact("% with other bits") > 0.0) {
                text += " Rounding once changes the bits of " + number(row.fact("% with other bits"), 0) +
                        " % of the results, by at most " + number(row.outcome.error.max * 1e6, 0) +
                        " millionths of a code: invisible, but no longer the same everywhere.";
            }
        }
        return text + " The engine's lanes here are " + std::to_string(kLanes) + ", in " + number(engine.fastest, 2) +
               " ns.";
    };
    return e;
}

}  // namespace relief::experiments
