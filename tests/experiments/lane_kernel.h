// Functions of lanes as what experiments time and evaluate: over columns of numbers, one row per fragment. Hand them on
// as lambdas, not by the names of functions: a pointer to a function is not inlined.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <random>
#include <utility>

#include "experiment.h"
#include "relief/hlsl/types.h"

namespace relief::experiments {

// One column per input; all of the same length, a multiple of 16.
using Columns = std::vector<std::vector<float>>;

inline constexpr std::size_t kWarmItems = 256, kStreamedItems = 1 << 16;

namespace detail {

inline void store(Float value, const std::array<float*, 1>& out, std::size_t at)
{
    value.store(out[0] + at);
}
template <int size, std::size_t columns>
void store(const FloatN<size>& value, const std::array<float*, columns>& out, std::size_t at)
{
    for (int i = 0; i < size; ++i) value[i].store(out[static_cast<std::size_t>(i)] + at);
}

template <class Result>
inline constexpr std::size_t kComponents = 1;
template <int size>
inline constexpr std::size_t kComponents<FloatN<size>> = size;

template <std::size_t inputs, class Function, std::size_t... i>
auto call(const Function& f, const std::array<const float*, inputs>& in, std::size_t at, std::index_sequence<i...>)
{
    return f(Float::load(in[i] + at)...);
}

template <std::size_t inputs, class Function>
using ResultOf =
    decltype(call<inputs>(std::declval<const Function&>(), std::declval<std::array<const float*, inputs>>(), 0,
                          std::make_index_sequence<inputs>()));

template <std::size_t inputs, class Function, std::size_t outputs>
[[gnu::noinline]] void apply(const Function& f, const std::array<const float*, inputs>& in,
                             const std::array<float*, outputs>& out, std::size_t items)
{
    for (std::size_t at = 0; at < items; at += kLanes)
        store(call<inputs>(f, in, at, std::make_index_sequence<inputs>()), out, at);
    asm volatile("" : : : "memory");  // the results count as read
}

}  // namespace detail

// f(Float, ...) with as many arguments as there are columns, returning Float or a vector, for all rows.
template <std::size_t inputs, class Function>
Columns evaluate(const Columns& columns, const Function& f)
{
    constexpr std::size_t outputs = detail::kComponents<detail::ResultOf<inputs, Function>>;
    Columns results(outputs, std::vector<float>(columns[0].size()));
    std::array<const float*, inputs> in;
    std::array<float*, outputs> out;
    for (std::size_t i = 0; i < inputs; ++i) in[i] = columns[i].data();
    for (std::size_t i = 0; i < outputs; ++i) out[i] = results[i].data();
    detail::apply<inputs>(f, in, out, columns[0].size());
    return results;
}

// The same as work: for the first so many rows. They lie in memory as those of every other such work do: each column a
// cache line away from where it would share the cache's sets with the one before.
template <std::size_t inputs, class Function>
Work laneWork(const std::shared_ptr<const Columns>& columns, Function f, std::size_t items)
{
    constexpr std::size_t outputs = detail::kComponents<detail::ResultOf<inputs, Function>>;
    struct alignas(64) Line
    {
        float numbers[16];
    };
    const std::size_t lines = items / 16 + 1;
    const auto memory = std::make_shared<std::vector<Line>>((inputs + outputs) * lines);
    std::array<const float*, inputs> in;
    std::array<float*, outputs> out;
    for (std::size_t i = 0; i < inputs; ++i) {
        float* const column = (*memory)[i * lines].numbers;
        std::copy_n((*columns)[i].data(), items, column);
        in[i] = column;
    }
    for (std::size_t i = 0; i < outputs; ++i) out[i] = (*memory)[(inputs + i) * lines].numbers;
    return {[memory, f, in, out, items] { detail::apply<inputs>(f, in, out, items); }, static_cast<double>(items)};
}

// A variant that is such a function; `columns` has kStreamedItems rows.
template <std::size_t inputs, class Function>
Variant laneVariant(std::string name, std::string parameter, std::shared_ptr<const Columns> columns, Function f,
                    std::function<Outcome()> outcome)
{
    return {std::move(name), std::move(parameter), std::move(outcome), laneWork<inputs>(columns, f, kWarmItems),
            laneWork<inputs>(columns, f, kStreamedItems)};
}

// Rows of random numbers, evenly spread in each column's range: the same in every run.
struct ColumnRange
{
    double low, high;
};
inline std::shared_ptr<const Columns> randomColumns(const std::vector<ColumnRange>& ranges,
                                                    std::size_t rows = kStreamedItems, unsigned seed = 1)
{
    auto columns = std::make_shared<Columns>();
    std::mt19937 random(seed);
    for (const ColumnRange& range : ranges) {
        std::vector<float>& column = columns->emplace_back(rows);
        for (float& x : column) {
            x = static_cast<float>(range.low + (range.high - range.low) * uniform(random));
        }
    }
    return columns;
}

// A row of a result, as a vector of doubles.
struct Vector
{
    double x, y, z;
};
inline Vector vectorAt(const Columns& columns, std::size_t row)
{
    return {columns[0][row], columns[1][row], columns[2][row]};
}

}  // namespace relief::experiments
