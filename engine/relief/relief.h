// Everything that a program needs to draw: include this one file.
#pragma once

#include "relief/hlsl/conventions.h"
#include "relief/hlsl/derivatives.h"
#include "relief/hlsl/intrinsics.h"
#include "relief/hlsl/semantics.h"
#include "relief/mesh/mesh.h"
#include "relief/mesh/obj.h"
#include "relief/mesh/primitives.h"
#include "relief/pipeline/frame.h"
#include "relief/pipeline/save.h"
#include "relief/pipeline/target_texture.h"
#include "relief/shading/loop.h"
#include "relief/texture/comparison_sampler.h"
#include "relief/texture/cube_sampler.h"
#include "relief/texture/image.h"
#include "relief/texture/sampler.h"
