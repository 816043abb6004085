// A scene of a file (scene/gltf.h), lit: what `render --scene` draws. glTF's metallic-roughness materials under one sun
// and a sky of two colours.
#pragma once

#include "common/camera.h"
#include "pipeline/frame.h"
#include "scene/scene_file.h"
#include "shading/lights.h"

namespace relief::samples {

// The light that a scene stands in. Shadows of the sun and a picture of the surroundings belong here, too.
struct Surroundings
{
    DirectionalLight sun;
    SphericalHarmonics sky;
};

// A clear day, from the left of a camera that looks along -z.
Surroundings usualSurroundings();

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

    // Records the scene on a cleared frame of a target of this size: what is opaque in the file's order, then what is
    // blended from the farthest to the nearest, by the middle of each instance's bounds. Two-sided triangles are drawn
    // twice, backs first, with the normal that faces the viewer. The scene must outlive the frame's run. An error where
    // the frame leaves a draw out.
    Expected<void> record(Frame& frame, int width, int height, const Surroundings& light) const;

    // The same on a frame as it is, seen from anywhere.
    Expected<void> draw(Frame& frame, const View& from, const Surroundings& light) const;

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
    std::optional<Camera> chosen;
};

}  // namespace relief::samples
