// From the words of the command line to what is drawn.
#pragma once

#include "common/render.h"
#include "live/renderer.h"
#include "options.h"

namespace relief::samples {

struct Size
{
    int width, height;
};

// "WIDTHxHEIGHT", 1 to 16384 each.
Expected<Size> parseSize(const std::string& text);

// A stage of this program by number or name, or of a file (its name ends with .cpp), which is compiled and loaded here.
Expected<const Stage*> stageOf(const std::string& name);

// The stage that the options name, with their settings and files.
Expected<PreparedStage> prepare(const RenderOptions& options);

// The same, telling what its lines give: for `render --show NAME@LINE`.
Expected<PreparedStage> prepareTraced(const RenderOptions& options);

// The same with a stage that is at hand.
Expected<PreparedStage> prepare(const Stage& stage, const RenderOptions& options);

// "X,Y,Z": a camera there that looks at the origin. Three more numbers: at that point instead; a seventh: the field of
// view in degrees; two more: the near and the far plane.
Expected<Camera> parseCamera(const std::string& text);

// The shortest such text that gives the same camera, to the last bit.
std::string cameraText(const Camera& camera);

// Whether --camera takes it.
bool isPossible(const Camera& camera);

// The shortest text that is read as the same number.
std::string exactText(float number);

// What the options say of the picture, for a stage that is compiled while the program runs.
Expected<live::Look> lookOf(const RenderOptions& options);

}  // namespace relief::samples
