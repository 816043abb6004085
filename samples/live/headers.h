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

#include "relief.h"
#include "shading/lights.h"
#include "shading/object_transform.h"
#include "shading/tangent_space.h"
#include "texture/import.h"

#include "common/baked_sphere.h"
#include "common/stage.h"
#include "common/triplanar_methods.h"
