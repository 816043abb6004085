// A diagnosis of files: read, told as text or JSON, and shown as pictures. What the command, the window and the book
// share.
#pragma once

#include <string>

#include "doctor/doctor.h"
#include "relief/texture/image.h"

namespace relief::samples::doctor {

struct Examination
{
    std::string file;
    Channels picture;
    Diagnosis diagnosis;

    bool isNormalMap() const;
};

// `heights` is the height map that it was made of, `mesh` (.obj, .gltf, .glb) what it is for; both may be empty.
Expected<Examination> examine(const std::string& file, const std::string& heights, const std::string& mesh);

std::string textOf(const Examination& all);
std::string jsonOf(const Examination& all);

// The heights that would give the map, the lowest black and the highest white. Of a tangent-space map.
Image8 heightsPicture(const Heights& heights);

// Side by side, as far as there is such a thing: the picture as it is; cured; how long its vectors are (black 0, red
// 1.5, 2 and more white ...; see common/ramp.h); the heights.
Image8 evidencePicture(const Examination& all);
std::string evidenceWords(const Examination& all);  // what stands side by side in it

}  // namespace relief::samples::doctor
