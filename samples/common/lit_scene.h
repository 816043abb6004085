// A scene of a file (scene/gltf.h), lit: what `render --scene` draws. glTF's metallic-roughness materials under one
// sun, which casts shadows, and a sky: of two colours, or a picture; or under the file's own lights and that sky.
#pragma once

#include "common/camera.h"
#include "common/punctual_lights.h"
#include "relief/pipeline/frame.h"
#include "relief/scene/scene_file.h"
#include "relief/shading/environment.h"
#include "relief/shading/lights.h"

namespace relief::samples {

// What the sun sees of a scene: the depth of what is nearest to it.
struct SunShadow
{
    Texture depth;
    glm::vec3 sun;           // towards it
    glm::mat4 sunFromWorld;  // to its clip space
    float texel;             // its width in the world
};

// The light that a scene stands in. What it points to is not owned.
struct Surroundings
{
    DirectionalLight sun;
    SphericalHarmonics sky;
    const CubeMap* mirrored = nullptr;          // none: the sky, which is as smooth as the roughest
    const SunShadow* shadow = nullptr;          // none: the sun shines through everything
    std::span<const PunctualLight> lamps = {};  // they shine through everything
};

// A clear day, from the left of a camera that looks along -z; and its sky alone.
Surroundings usualSurroundings();
SphericalHarmonics clearSky(float strength);

class LitScene
{
public:
    // Moves the scene so that the middle of its bounds is the origin, and scales it to 2 units along its longest side.
    explicit LitScene(SceneFile scene);

    // A camera's matrix, and where it stands, in the units above.
    struct View
    {
        glm::mat4 clipFromWorld;
        glm::vec3 position;
    };

    // The light of a file that has lights: its first directional one in place of the sun, or none, all others as lamps,
    // and the sky as it is. Of another file the light itself. The scene must outlive it.
    Surroundings lightOf(const Surroundings& day) const;

    // Records the scene on a cleared frame of a target of this size: what is opaque in the file's order, then what is
    // blended from the farthest to the nearest, by the middle of each instance's bounds. Two-sided triangles are drawn
    // twice, backs first, with the normal that faces the viewer. The scene must outlive the frame's run. An error where
    // the frame leaves a draw out.
    Expected<void> record(Frame& frame, int width, int height, const Surroundings& light) const;

    // The same on a frame as it is, seen from anywhere.
    Expected<void> draw(Frame& frame, const View& from, const Surroundings& light) const;

    // The shadows of a sun in this direction (towards it), on a map of `side` x `side` texels. What is blended casts
    // none. An error where the memory cannot be had.
    Expected<SunShadow> shadowOf(const float3& sun, int threads, int side = 1024) const;

    // The next record() looks from there, in the units above; without it from the file's camera, or, where it has none,
    // from the front, the left and above, with all of the scene in the picture.
    void lookFrom(const Camera& camera) { chosen = camera; }

    const SceneFile& file() const { return scene; }

private:
    View view(float aspect) const;
    void draw(Frame& frame, const SceneInstance& instance, const View& from, const Surroundings& light) const;

    SceneFile scene;
    glm::mat4 worldFromScene;
    float scale;
    std::optional<DirectionalLight> filesSun;
    std::vector<PunctualLight> filesLamps;
    std::optional<Camera> chosen;
};

}  // namespace relief::samples
