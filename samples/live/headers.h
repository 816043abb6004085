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

// What calls programs runs once for each draw: clang is not to optimise it, which would take as long as some programs.
// Whatever these two headers include stands above them.
#include "relief/pipeline/draw.h"
#pragma clang optimize off
#include "relief/pipeline/frame.h"
#pragma clang optimize on

#include "relief/relief.h"
#include "relief/shading/cotangent_frame.h"
#include "relief/shading/lights.h"
#include "relief/shading/normals.h"
#include "relief/shading/object_transform.h"
#include "relief/shading/tangent_space.h"
#include "relief/shading/triplanar.h"
#include "relief/texture/import.h"

#include "common/camera.h"
#include "common/overlay.h"
#include "common/uniforms.h"
#pragma clang optimize off
#include "common/scene.h"
#pragma clang optimize on

#include "common/baked_sphere.h"
#include "common/stage.h"
#include "common/triplanar_methods.h"

// Never called: what destroys and moves these is then in the precompiled headers, not made again for each stage that
// uses it (5 % fewer instructions of clang for 1.22).
namespace relief::samples::live {

inline void instantiated(Mesh mesh, std::vector<std::string> words)
{
    const Mesh moved = std::move(mesh);
    words.emplace_back(moved.name + words[0]);
}

}  // namespace relief::samples::live
