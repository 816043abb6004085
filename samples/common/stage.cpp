#include "common/stage.h"

#include <algorithm>

namespace relief::samples {

Expected<const Stage*> findStage(const std::string& name)
{
    std::string closest;
    for (const Stage& stage : allStages()) {
        if (stage.folder.empty()) {  // a user's own
            if (name == stage.stem) return &stage;
            continue;
        }
        // 1.06 may be written 1.6, and 06_rotated_tangent without its number.
        const std::string shortId = stage.id[2] == '0' ? stage.id.substr(0, 2) + stage.id.substr(3) : stage.id;
        const std::string bare = stage.stem.substr(3);
        if (name == stage.id || name == shortId || name == stage.stem || name == bare) return &stage;
        const bool related = name.size() >= 3 && (bare.find(name) != std::string::npos || stage.id.starts_with(name));
        if (related) closest += (closest.empty() ? "" : ", ") + stage.id + " " + stage.stem;
    }
    return fail("there is no stage '" + name + "'" + (closest.empty() ? "" : " (did you mean " + closest + "?)") +
                "; `relief list` shows them all");
}

}  // namespace relief::samples
