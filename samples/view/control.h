// Which control fits a property.
#pragma once

#include <string>
#include <vector>

#include "common/scene.h"

namespace relief::samples {

struct Control
{
    enum class Kind
    {
        number,  // a slider
        whole,   // a slider of whole numbers
        color,   // three or four components
        vector,  // two to four
        tick,    // 0 or 1
        choice   // 0, 1, 2 ... by name
    };
    Kind kind = Kind::number;
    std::vector<std::string> names;  // of choices
};

Control controlOf(const Property& property);

}  // namespace relief::samples
