// Renders one stage: what the command line, the window, the golden tests and the benchmarks all do.
#pragma once

#include <string>
#include <vector>

#include "common/stage.h"
#include "common/tangent_space_visualizer.h"
#include "relief/check/hash.h"

namespace relief::samples {

// The background of all stages, linear.
inline constexpr glm::vec4 kBackground{0.035f, 0.04f, 0.05f, 1.0f};

// Sets one of these properties of a stage: "name=value", where a value is a number or, for colours and vectors, up to
// four of them with commas. An unknown name, or a value that is no number or out of the property's range, is an error.
Expected<void> applySetting(const std::string& setting, const std::string& stageId, std::vector<Property>& properties);

// A stage with its inputs loaded and its properties as the user wants them; can be drawn again and again.
class PreparedStage
{
public:
    // A setting that does not fit, or a file that cannot be read, is an error.
    static Expected<PreparedStage> prepare(const Stage& stage, const std::vector<std::string>& settings = {},
                                           const InputFiles& files = {});

    // Records the stage's draws on a cleared frame of a target of this size.
    void record(Frame& frame, int width, int height) const { record(frame, width, height, camera()); }
    void record(Frame& frame, int width, int height, const Camera& camera) const;

    // What is wrong with what record() has recorded, in one line; empty: nothing.
    std::string problem(const Frame& frame) const { return log->problem.empty() ? frame.problem() : log->problem; }

    // What the stage's draw function gets.
    Scene scene(Frame& frame, int width, int height, const Camera& camera) const;

    // The user's, or the stage's, or one that looks at a mesh of the user's from the front.
    const Camera& camera() const;

    const Stage* stage = nullptr;
    std::vector<Property> properties;
    std::unique_ptr<LoadedInputs> inputs;
    std::optional<Camera> usersCamera;
    std::optional<TangentSpaceVisualizer> tangentLines;  // over the picture, for every mesh that was drawn
    std::unique_ptr<SceneLog> log;                       // of the last record()
};

}  // namespace relief::samples
