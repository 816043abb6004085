// signature<Interpolators>(): the table that Direct3D's compiler prints for what a vertex program gives, from the
// struct as it is written. It shows what every field costs: which of the four-component registers it takes, and which
// components of it.
//
// Registers are given out in the order of the fields. A field is never split over two registers; it goes to the first
// one that has enough components left and the same interpolation (a register is interpolated in one way), else to a new
// one.
#pragma once

#include <string>
#include <vector>

#include "hlsl/semantics.h"

namespace relief {

// One field of a struct of semantics, and where it is kept.
struct SignatureElement
{
    std::string name;
    int index;
    int components;
    Interpolation interpolation;
    bool isPosition;
    int reg = 0;             // the register
    int firstComponent = 0;  // in it: 0 is x
};

// Fills in the elements' registers.
inline void assignRegisters(std::vector<SignatureElement>& elements)
{
    struct Register
    {
        int used;
        Interpolation interpolation;
    };
    std::vector<Register> registers;
    for (SignatureElement& element : elements) {
        std::size_t r = 0;
        const auto fits = [&element](const Register& candidate) {
            return candidate.used + element.components <= 4 && candidate.interpolation == element.interpolation;
        };
        while (r < registers.size() && !fits(registers[r])) ++r;
        if (r == registers.size()) registers.push_back({0, element.interpolation});
        element.reg = static_cast<int>(r);
        element.firstComponent = registers[r].used;
        registers[r].used += element.components;
    }
}

// The table, as a comment block; every line ends with a newline and has no blanks before it.
inline std::string formatSignature(const std::vector<SignatureElement>& elements)
{
    const auto left = [](std::string text, std::size_t width) {
        return text + std::string(text.size() < width ? width - text.size() : 0, ' ');
    };
    const auto right = [](std::string text, std::size_t width) {
        return std::string(text.size() < width ? width - text.size() : 0, ' ') + text;
    };
    std::string table =
        "// Output signature:\n"
        "//\n"
        "// Name                 Index   Mask Register SysValue  Format   Used\n"
        "// -------------------- ----- ------ -------- -------- ------- ------\n";
    for (const SignatureElement& element : elements) {
        std::string mask = "    ";
        for (int i = 0; i < element.components; ++i) {
            const auto c = static_cast<std::size_t>(element.firstComponent + i);
            mask[c] = "xyzw"[c];
        }
        std::string line = "// " + left(element.name, 20) + right(std::to_string(element.index), 6) + right(mask, 7) +
                           right(std::to_string(element.reg), 9) + right(element.isPosition ? "POS" : "NONE", 9) +
                           right("float", 8) + right(mask, 7);
        line.erase(line.find_last_not_of(' ') + 1);
        table += line + "\n";
    }
    return table;
}

// The fields of a struct of semantics, with their registers.
template <class Struct>
std::vector<SignatureElement> signatureElements()
{
    std::vector<SignatureElement> elements;
    const auto list = [&elements]<class... Field>(FieldList<Field...>) {
        (elements.push_back({Field::kName, Field::kIndex, kComponents<typename Field::Value>, Field::kInterpolation,
                             Field::kIsPosition}),
         ...);
    };
    list(FieldsOf<Struct>{});
    assignRegisters(elements);
    return elements;
}

template <class Interpolators>
std::string signature()
{
    return formatSignature(signatureElements<Interpolators>());
}

}  // namespace relief
