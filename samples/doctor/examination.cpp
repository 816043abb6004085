#include "doctor/examination.h"

#include <algorithm>
#include <cstdio>

#include <nlohmann/json.hpp>

#include "common/ramp.h"
#include "relief/mesh/obj.h"
#include "relief/path.h"
#include "relief/scene/gltf.h"

namespace relief::samples::doctor {

namespace {

const char* const kKinds[] = {"a height map", "a tangent-space normal map", "an object-space normal map",
                              "no height map and no normal map"};

Expected<Channels> readChannels(const std::string& file)
{
    const Expected<ImageFile> picture = readImage(file);
    if (!picture) return tl::unexpected(picture.error());
    return channelsOf(*picture);
}

Expected<std::vector<Mesh>> readMeshes(const std::string& file)
{
    std::vector<Mesh> meshes;
    if (hasEnding(file, {".gltf", ".glb"})) {
        Expected<SceneFile> scene = readGltf(file);
        if (!scene) return tl::unexpected(scene.error());
        meshes = std::move(scene->meshes);
        return meshes;
    }
    Expected<Mesh> mesh = readObj(file);
    if (!mesh) return tl::unexpected(mesh.error());
    meshes.push_back(std::move(*mesh));
    return meshes;
}

// Pictures of one size, side by side.
Image8 besideEachOther(const std::vector<Image8>& pictures)
{
    Image8 row{0, pictures.front().height, {}};
    for (const Image8& picture : pictures) row.width += picture.width;
    for (int y = 0; y < row.height; ++y) {
        for (const Image8& picture : pictures) {
            const auto bytes = static_cast<std::ptrdiff_t>(picture.width) * 4;
            const auto line = picture.pixels.begin() + y * bytes;
            row.pixels.insert(row.pixels.end(), line, line + bytes);
        }
    }
    return row;
}

// What `colorOf` gives for every texel, rows from the top.
template <class ColorOf>
Image8 pictureOfTexels(int width, int height, const ColorOf& colorOf)
{
    Image8 picture{width, height, {}};
    const auto row = static_cast<std::size_t>(width), rows = static_cast<std::size_t>(height);
    picture.pixels.reserve(row * rows * 4);
    for (std::size_t y = rows; y-- > 0;) {
        for (std::size_t i = y * row; i < (y + 1) * row; ++i) {
            const SrgbCode color = colorOf(i);
            picture.pixels.insert(picture.pixels.end(), {color[0], color[1], color[2], 255});
        }
    }
    return picture;
}

std::uint8_t codeOf(float value)
{
    return static_cast<std::uint8_t>(std::clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f);
}

}  // namespace

bool Examination::isNormalMap() const
{
    return diagnosis.kind == Kind::tangentSpace || diagnosis.kind == Kind::objectSpace;
}

Expected<Examination> examine(const std::string& file, const std::string& heights, const std::string& mesh)
{
    Expected<Channels> picture = readChannels(file);
    if (!picture) return tl::unexpected(picture.error());
    Given given;
    given.name = file;
    if (!heights.empty()) {
        Expected<Channels> read = readChannels(heights);
        if (!read) return tl::unexpected(read.error());
        given.heights = std::move(*read);
    }
    if (!mesh.empty()) {
        Expected<std::vector<Mesh>> meshes = readMeshes(mesh);
        if (!meshes) return tl::unexpected(meshes.error());
        given.meshes = std::move(*meshes);
    }
    Expected<Diagnosis> diagnosis = diagnose(*picture, given);
    if (!diagnosis) return tl::unexpected(diagnosis.error());
    return Examination{file, std::move(*picture), std::move(*diagnosis)};
}

std::string textOf(const Examination& all)
{
    const Diagnosis& d = all.diagnosis;
    std::string text = all.file + ": " + kKinds[static_cast<std::size_t>(d.kind)] + "\n  " + d.kindEvidence + "\n";
    char line[256];
    if (d.kind == Kind::tangentSpace) {
        std::snprintf(line, sizeof line,
                      "  normals lean by %.1f degrees on average, by %.1f at most (99.9 %% of them); slopes %.3f (root "
                      "mean square)\n",
                      d.strength.meanDegrees, d.strength.mostDegrees, d.strength.rootMeanSquare);
        text += line;
        std::snprintf(line, sizeof line,
                      "  heights that would give it: %.1f texels from the lowest to the highest; %.1f %% of the slopes "
                      "are of no heights\n",
                      d.heights.range, 100.0 * d.heights.residual);
        text += line;
    }
    for (const Finding& f : d.findings)
        text += "fault: " + f.words + "\n  evidence: " + f.evidence + "\n  remedy: " + f.remedy + "\n";
    if (d.findings.empty() && d.kind != Kind::noMap) text += "no fault was found\n";
    for (const std::string& note : d.notes) text += "note: " + note + "\n";
    return text;
}

std::string jsonOf(const Examination& all)
{
    const Diagnosis& d = all.diagnosis;
    nlohmann::ordered_json json = {{"file", all.file}, {"kind", nameOf(d.kind)}, {"evidence", d.kindEvidence}};
    json["faults"] = nlohmann::ordered_json::array();
    for (const Finding& f : d.findings) {
        json["faults"].push_back({{"fault", nameOf(f.fault)},
                                  {"words", f.words},
                                  {"evidence", f.evidence},
                                  {"remedy", f.remedy},
                                  {"cured", f.isCured}});
    }
    json["notes"] = d.notes;
    if (d.kind == Kind::tangentSpace) {
        json["curl"] = d.curl;
        json["meanDegrees"] = d.strength.meanDegrees;
        json["mostDegrees"] = d.strength.mostDegrees;
        json["heightsInTexels"] = d.heights.range;
        json["residual"] = d.heights.residual;
    }
    return json.dump(2) + "\n";
}

Image8 heightsPicture(const Heights& heights)
{
    const float low = *std::min_element(heights.values.begin(), heights.values.end());
    const float scale = heights.range > 0.0 ? 1.0f / static_cast<float>(heights.range) : 0.0f;
    return pictureOfTexels(heights.width, heights.height, [&](std::size_t i) {
        const std::uint8_t code = codeOf((heights.values[i] - low) * scale);
        return SrgbCode{code, code, code};
    });
}

Image8 evidencePicture(const Examination& all)
{
    const Channels& p = all.picture;
    const Diagnosis& d = all.diagnosis;
    std::vector<Image8> parts = {pictureOfTexels(p.width, p.height, [&](std::size_t i) {
        return SrgbCode{codeOf(p.texels[i][0]), codeOf(p.texels[i][1]), codeOf(p.texels[i][2])};
    })};
    if (all.isNormalMap()) {
        const NormalField before = fieldOf(p, d.layout, Transfer::none);
        parts.push_back(pictureOf(d.cured));
        parts.push_back(pictureOfTexels(p.width, p.height,
                                        [&](std::size_t i) { return ramp(lengthOf(before.normals[i]) * 0.5f); }));
    }
    if (d.kind == Kind::tangentSpace) parts.push_back(heightsPicture(d.heights));
    return besideEachOther(parts);
}

std::string evidenceWords(const Examination& all)
{
    std::string words = "the map";
    if (all.isNormalMap()) words += ", cured, the lengths of its vectors (green: 1)";
    if (all.diagnosis.kind == Kind::tangentSpace) words += ", the heights";
    return words;
}

}  // namespace relief::samples::doctor
