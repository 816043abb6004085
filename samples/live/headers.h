// What a stage's file includes, precompiled for the compilers that live stages are compiled with (CMakeLists.txt).
// Nothing that draws: which compiler makes code for its programs is not known yet.
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
#include "pipeline/draw.h"
#pragma clang optimize off
#include "pipeline/frame.h"
#pragma clang optimize on
#include "common/camera.h"
#include "common/input_files.h"
#include "common/uniforms.h"
#include "mesh/bounds.h"
#pragma clang optimize off
#include "common/scene.h"
#pragma clang optimize on

#include "relief.h"
#include "shading/lights.h"
#include "shading/object_transform.h"
#include "shading/tangent_space.h"
#include "texture/import.h"

#include "common/baked_sphere.h"
#include "common/stage.h"
#include "common/triplanar_methods.h"
