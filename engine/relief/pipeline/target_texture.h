// What a frame has drawn, copied to a texture. An attachment that is stored as one (Store::texture, framebuffer.h)
// needs no copy; one that is kept, or whose pixels are no texels, does.
#pragma once

#include "relief/error.h"
#include "relief/pipeline/framebuffer.h"
#include "relief/texture/texture.h"

namespace relief {

// An attachment's pixels as a texture: the target's lower left pixel is at uv (0, 0). Colours are linear, of rgba8Srgb
// as those of a picture; depths and r32f are red alone. Mip levels are built when they are asked for.
//
// The texture is a copy. What is drawn into the target afterwards does not show in it, so a program may read it while
// it draws into the same target, and reads what the last frame left there. An error, one line, where the target has no
// such attachment, does not keep it, or the memory cannot be had. A stencil is not a texture.
Expected<Texture> textureOf(const Framebuffer& target, int attachment);

}  // namespace relief
