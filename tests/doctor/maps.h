// Normal maps that are sound, and the same with faults that people make: what the doctor's tests and its report are
// made of. All by arithmetic from seeds and from assets/; every map repeats.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "doctor/doctor.h"

namespace doctor_trials {

using namespace relief;
using namespace relief::samples::doctor;

struct SoundMap
{
    std::string name;
    Channels heights;   // 0 ... 1, floats
    float scale;        // texels that heights 0 and 1 lie apart
    NormalField field;  // unit normals
};

// Marble and bricks of assets/, smoothed; noise of several sizes and strengths; domes on a flat ground.
std::vector<SoundMap> soundMaps(const std::string& assetFolder);

struct MadeFault
{
    const char* name;
    std::vector<Fault> faults;  // what is to be said
    std::function<Image8(const SoundMap&)> make;
    bool givesHeights = false;  // the doctor gets the heights, too
};

// One at a time, and two at a time.
const std::vector<MadeFault>& singleFaults();
const std::vector<MadeFault>& doubleFaults();

// What is said of a map: how many of a fault's own are named, and how many others are.
struct Verdict
{
    int named = 0, others = 0;
};
Verdict verdictOf(const Diagnosis& diagnosis, const std::vector<Fault>& faults);

// Codes of a sound map.
Image8 codesOf(const SoundMap& map);

}  // namespace doctor_trials
