// The one place where tinygltf is compiled.
#include <fstream>

#define TINYGLTF_IMPLEMENTATION
#include "relief/scene/tinygltf.h"
