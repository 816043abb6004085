#include "relief/hlsl/signature.h"

#include <string_view>
#include <vector>

namespace relief::inline RELIEF_WIDTH {

std::string semanticOf(const Field& field)
{
    const std::string_view name = field.name;
    return field.name + (name == "TEXCOORD" || name == "COLOR" ? std::to_string(field.index) : "");
}

namespace {

struct Register
{
    int used;  // components
    Interpolation interpolation;
};

// Where a field goes: the register's number, and its first component there.
struct Place
{
    std::size_t number;
    int firstComponent;
};

Place placeFor(const Field& field, std::vector<Register>& registers)
{
    const auto fits = [&field](const Register& r) {
        return r.used + field.components <= 4 && r.interpolation == field.interpolation;
    };
    std::size_t number = 0;
    while (number < registers.size() && !fits(registers[number])) ++number;
    if (number == registers.size()) registers.push_back({0, field.interpolation});
    const int first = registers[number].used;
    registers[number].used += field.components;
    return {number, first};
}

const char* systemValueOf(const Field& field)
{
    switch (field.systemValue) {
        case SystemValue::position:
            return "POS";
        case SystemValue::clipDistance:
            return "CLIPDST";
        default:
            return "NONE";
    }
}

std::string left(std::string text, std::size_t width)
{
    return text + std::string(text.size() < width ? width - text.size() : 0, ' ');
}
std::string right(std::string text, std::size_t width)
{
    return std::string(text.size() < width ? width - text.size() : 0, ' ') + text;
}

}  // namespace

std::string signatureOf(Fields fields)
{
    std::string table =
        "// Output signature:\n"
        "//\n"
        "// Name                 Index   Mask Register SysValue  Format   Used\n"
        "// -------------------- ----- ------ -------- -------- ------- ------\n";
    std::vector<Register> registers;
    for (const Field& field : fields) {
        if (field.systemValue == SystemValue::facing) continue;  // no vertex program gives it
        const Place place = placeFor(field, registers);
        std::string mask = "    ";
        for (int i = 0; i < field.components; ++i) {
            const auto c = static_cast<std::size_t>(place.firstComponent + i);
            mask[c] = "xyzw"[c];
        }
        std::string line = "// " + left(field.name, 20) + right(std::to_string(field.index), 6) + right(mask, 7) +
                           right(std::to_string(place.number), 9) + right(systemValueOf(field), 9) +
                           right(field.isInteger ? "int" : "float", 8) + right(mask, 7);
        line.erase(line.find_last_not_of(' ') + 1);
        table += line + "\n";
    }
    return table;
}

}  // namespace relief::inline RELIEF_WIDTH
