// What stages are called on a command line.
#pragma once

#include <string>
#include <vector>

#include "relief/error.h"

namespace relief::samples {

// Among things with a stage's `id`, `stem` and `folder`: by number (1.06, also 1.6) or stem (06_rotated_tangent,
// rotated_tangent). An error names the nearest ones.
template <class Named>
Expected<const Named*> findByName(const std::vector<Named>& all, const std::string& name)
{
    std::string closest;
    for (const Named& one : all) {
        if (name == one.id || name == one.stem) return &one;
        if (one.folder.empty()) continue;  // a user's own has no number
        // 1.06 may be written 1.6, and 06_rotated_tangent without its number.
        const std::string shortId = one.id[2] == '0' ? one.id.substr(0, 2) + one.id.substr(3) : one.id;
        const std::string bare = one.stem.substr(3);
        if (name == shortId || name == bare) return &one;
        const bool related = name.size() >= 3 && (bare.find(name) != std::string::npos || one.id.starts_with(name));
        if (related) closest += (closest.empty() ? "" : ", ") + one.id + " " + one.stem;
    }
    return fail("there is no stage '" + name + "'" + (closest.empty() ? "" : " (did you mean " + closest + "?)") +
                "; `relief list` shows them all");
}

}  // namespace relief::samples
