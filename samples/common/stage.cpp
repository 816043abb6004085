#include "common/stage.h"

#include "common/stage_names.h"

namespace relief::samples {

Expected<const Stage*> findStage(const std::string& name)
{
    return findByName(allStages(), name);
}

}  // namespace relief::samples
