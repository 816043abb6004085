// What a picture is - a height map, a normal map and of which kind - and what is wrong with it, each with its evidence
// and its remedy. Nothing is known but the picture, and the heights and the mesh where they are given.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "doctor/slopes.h"
#include "relief/mesh/mesh.h"

namespace relief::samples::doctor {

enum class Kind
{
    heights,
    tangentSpace,
    objectSpace,
    noMap
};

enum class Fault
{
    alphaGreen,     // x lies in alpha: DXT5nm
    greenMirrored,  // the slopes are of no surface, but with green turned they are
    redMirrored,    // the same of red; only given heights can tell it from green
    bothMirrored,   // against the given heights: bumps are dents
    wasEncoded,     // linear codes that were stored as sRGB
    wasDecoded,     // the other way round
    belowSurface,   // z below 0
    notFlat,        // the codes of a flat surface are not 127 or 128
    averaged,       // averaged, as mip levels are, and not made unit length again
    notUnit,        // of another length than 1
    missingLevels,  // quantised twice, or stretched
    blocks,         // of JPEG or DXT
    seam,           // does not repeat
    wrongScale,     // against the given heights
    meshMirrored    // of the mesh: uv mirrored where its tangents do not say so, or the other way round
};

struct Finding
{
    Fault fault;
    std::string words;     // what it is
    std::string evidence;  // numbers
    std::string remedy;    // a command or what to do; --fix does what `isCured` says
    bool isCured = false;
};

struct Diagnosis
{
    Kind kind = Kind::noMap;
    std::string kindEvidence;
    Layout layout = Layout::rgb;
    Transfer transfer = Transfer::none;
    std::array<float, 2> bias{};  // of x and y in a flat texel
    std::vector<Finding> findings;
    std::vector<std::string> notes;  // what is no fault, and what cannot be known
    double curl = 0.0;
    Strength strength;
    Heights heights;    // of a tangent-space map, as it is cured
    NormalField cured;  // the same as a unit field

    bool has(Fault fault) const;
};

// What there is besides the picture.
struct Given
{
    std::optional<Channels> heights;
    std::vector<Mesh> meshes;
    std::string name = "FILE.png";  // of the picture, for commands
};

// An error for a picture of less than 8 texels a side.
Expected<Diagnosis> diagnose(const Channels& picture, const Given& given = {});

// "green is mirrored", a word of each fault and kind, for tables and JSON.
const char* nameOf(Fault fault);
const char* nameOf(Kind kind);

}  // namespace relief::samples::doctor
