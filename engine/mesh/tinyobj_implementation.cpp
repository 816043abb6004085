// The one place where tinyobjloader is compiled: here and not in the system's library, whose compile flags we do not
// know, so that a number in an OBJ file becomes the same float everywhere.
#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>
