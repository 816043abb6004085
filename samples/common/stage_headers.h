// What stages' files include, for those who precompile it: for stages that are compiled while a program runs
// (live/headers.h), and for those that are compiled in a page of the book (docs/.vitepress/compiler.mjs).
#pragma once

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
