// What `./relief view FILE.glb` shows: the scene of a glTF file, in its own materials, under a sun and a sky.
// The programs are those of common/lit_scene.cpp.
#include "common/lit_scene.h"
#include "common/stage.h"

namespace relief::samples {
namespace {

struct Day : Uniforms
{
    UnityLight light = sun(47.0f, -126.0f);
    Float sunStrength = number("sunStrength", 0.9f, {0, 16}, "of the directional light");
    Float skyStrength = number("skyStrength", 1.0f, {0, 16}, "of the light from everywhere");
};

}  // namespace

Stage scene_of_file()
{
    return {.title = "A scene of a file",
            .section = "",
            .news = "A glTF file's meshes and materials, lit.",
            .uniforms = declared<Day>(),
            .mesh = kSceneOfFile,
            .camera = {.position = {2.3f, 1.9f, 4.2f}},
            .draw = [](const Scene& s) {
                const Day day = s.uniforms();
                s.drawFile(
                    {.sun = {day.light.color * day.sunStrength, day.light.dir}, .sky = clearSky(day.skyStrength[0])});
            }};
}

}  // namespace relief::samples
