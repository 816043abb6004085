// The user's files for a stage. A header of its own, so that what reads the command line needs no engine.
#pragma once

#include <string>
#include <vector>

namespace relief::samples {

// The user's files in place of the defaults; empty: the default, "none": nothing. `mesh` may also be the name of a
// primitive. And how to import normal maps.
struct InputFiles
{
    std::string mesh, albedo, height, normal, detail, detailNormal;
    std::vector<std::string> import;  // see import_options.h

    bool operator==(const InputFiles&) const = default;
};

}  // namespace relief::samples
