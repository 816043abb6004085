#include "opengl.h"

#include <dlfcn.h>
#include <string>
#include <type_traits>

namespace relief::benchmarks {

EglFunctions egl;
GlFunctions gl;

Expected<void> loadOpenGl()
{
    static void* const library = dlopen("libEGL.so.1", RTLD_LAZY | RTLD_LOCAL);
    if (library == nullptr) {
        return fail("bench --peer: there is no libEGL.so.1; install libegl1 and libgl1-mesa-dri");
    }
    using GetFunction = decltype(&::eglGetProcAddress);
    const auto getFunction = reinterpret_cast<GetFunction>(dlsym(library, "eglGetProcAddress"));
    const char* missing = getFunction == nullptr ? "eglGetProcAddress" : nullptr;
    const auto load = [&](const char* name, auto& function) {
        if (missing != nullptr) return;
        function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(getFunction(name));
        if (function == nullptr) missing = name;
    };
#define RELIEF_LOAD_EGL(name) load("egl" #name, egl.name);
#define RELIEF_LOAD_GL(name) load("gl" #name, gl.name);
    RELIEF_EGL_FUNCTIONS(RELIEF_LOAD_EGL)
    RELIEF_GL_FUNCTIONS(RELIEF_LOAD_GL)
#undef RELIEF_LOAD_EGL
#undef RELIEF_LOAD_GL
    if (missing == nullptr) return {};
    return fail("bench --peer: libEGL.so.1 has no " + std::string(missing) + "; install libegl1 1.5 or later");
}

}  // namespace relief::benchmarks
