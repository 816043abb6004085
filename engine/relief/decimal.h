// Decimal numbers to floats: the same bits on every machine, whatever the locale.
#pragma once

#include <optional>
#include <string_view>

namespace relief {

// The float nearest to [+-] digits [. digits] [e [+-] digits], with a digit before or behind the point; 0 where that is
// nearest. Nothing for other words (nan, inf and hexadecimal numbers included), and where no finite float is near.
std::optional<float> parseDecimal(std::string_view word);

}  // namespace relief
