// What a stage's file includes, precompiled for the compilers that live stages are compiled with (CMakeLists.txt).
// Nothing that draws: which compiler makes code for its programs is not known yet.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "live/parts.h"

#include "common/stage_headers.h"

// Never called: what destroys and moves these is then in the precompiled headers, not made again for each stage that
// uses it (5 % fewer instructions of clang for 1.22).
namespace relief::samples::live {

inline void instantiated(Mesh mesh, std::vector<std::string> words)
{
    const Mesh moved = std::move(mesh);
    words.emplace_back(moved.name + words[0]);
}

}  // namespace relief::samples::live
