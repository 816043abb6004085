// Everything that a program needs to draw: include this one file.
#pragma once

#include "hlsl/conventions.h"
#include "hlsl/derivatives.h"
#include "hlsl/intrinsics.h"
#include "hlsl/semantics.h"
#include "mesh/mesh.h"
#include "mesh/obj.h"
#include "mesh/primitives.h"
#include "pipeline/frame.h"
#include "pipeline/save.h"
#include "pipeline/target_texture.h"
#include "shading/loop.h"
#include "texture/comparison_sampler.h"
#include "texture/cube_sampler.h"
#include "texture/image.h"
#include "texture/sampler.h"
