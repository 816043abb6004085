// signature<Interpolators>(): the table that Direct3D's compiler prints for what a vertex program gives, from the
// struct as it is written. It shows what every field costs: which of the four-component registers it takes, and which
// components of it.
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "relief/hlsl/semantics.h"

namespace relief::inline RELIEF_WIDTH {

// One field of a struct of semantics.
struct Field
{
    const char* name;
    int index;
    int components;  // 1 ... 4
    Interpolation interpolation;
    SystemValue systemValue;
    bool isInteger;
};

// "TEXCOORD1", "NORMAL".
std::string semanticOf(const Field& field);

// The fields of a struct, in order. What a std::span checks of its iterators would be most of a draw's compile time.
class Fields
{
public:
    constexpr Fields() = default;
    template <std::size_t n>
    constexpr Fields(const std::array<Field, n>& all) : first(all.data()), count(n)
    {
    }
    constexpr const Field* begin() const { return first; }
    constexpr const Field* end() const { return first + count; }
    constexpr std::size_t size() const { return count; }
    constexpr const Field& operator[](std::size_t i) const { return first[i]; }

private:
    const Field* first = nullptr;
    std::size_t count = 0;
};

namespace detail {

template <class... F>
constexpr std::array<Field, sizeof...(F)> listFields(FieldList<F...>)
{
    return {Field{F::kName, F::kIndex, kComponents<typename F::Value>, F::kInterpolation, F::kSystemValue,
                  kIsInteger<typename F::Value>}...};
}

}  // namespace detail

// The fields of a struct of semantics, in order.
template <class Struct>
inline constexpr auto kFields = detail::listFields(FieldsOf<Struct>{});

// The table, as a comment block; every line ends with a newline and has no blanks before it.
//
// Registers are given out in the order of the fields. A field is never split over two registers; it goes to the first
// one that has enough components left and the same interpolation (a register is interpolated in one way), else to a new
// one.
std::string signatureOf(Fields fields);

template <class Interpolators>
std::string signature()
{
    return signatureOf(kFields<Interpolators>);
}

}  // namespace relief::inline RELIEF_WIDTH
