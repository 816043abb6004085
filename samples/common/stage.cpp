#include "common/stage.h"

namespace relief::samples {

std::string Stage::name() const
{
    return id + " " + std::string(title);
}

std::vector<Property> Stage::properties() const
{
    return uniforms.list().properties;
}

Inputs Stage::inputs() const
{
    Inputs all = uniforms.list().inputs;
    all.mesh = mesh;
    all.cubesTurnedBy = cubesTurnedBy;
    return all;
}

}  // namespace relief::samples
