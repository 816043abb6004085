// The program of `doctor`: reads the files, prints the diagnosis, writes the cured map and the picture of what was
// found.
#include <algorithm>
#include <cstdio>

#include <nlohmann/json.hpp>

#include "command_line.h"
#include "common/ramp.h"
#include "doctor/doctor.h"
#include "relief/file.h"
#include "relief/mesh/obj.h"
#include "relief/path.h"
#include "relief/scene/gltf.h"

namespace {

using namespace relief;
using namespace relief::samples;
using namespace relief::samples::doctor;

const char* const kKinds[] = {"a height map", "a tangent-space normal map", "an object-space normal map",
                              "no height map and no normal map"};

std::string textOf(const Diagnosis& d, const DoctorOptions& options)
{
    std::string text = options.file + ": " + kKinds[static_cast<std::size_t>(d.kind)] + "\n  " + d.kindEvidence + "\n";
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

std::string jsonOf(const Diagnosis& d, const DoctorOptions& options)
{
    nlohmann::ordered_json all = {
        {"file", options.file}, {"kind", doctor::nameOf(d.kind)}, {"evidence", d.kindEvidence}};
    all["faults"] = nlohmann::ordered_json::array();
    for (const Finding& f : d.findings) {
        all["faults"].push_back({{"fault", doctor::nameOf(f.fault)},
                                 {"words", f.words},
                                 {"evidence", f.evidence},
                                 {"remedy", f.remedy},
                                 {"cured", f.isCured}});
    }
    all["notes"] = d.notes;
    if (d.kind == Kind::tangentSpace) {
        all["curl"] = d.curl;
        all["meanDegrees"] = d.strength.meanDegrees;
        all["mostDegrees"] = d.strength.mostDegrees;
        all["heightsInTexels"] = d.heights.range;
        all["residual"] = d.heights.residual;
    }
    return all.dump(2) + "\n";
}

Expected<void> writePicture(const std::string& path, const Image8& picture)
{
    return writePng(path, picture.width, picture.height, picture.pixels);
}

Image8 heightsPicture(const Heights& heights)
{
    Image8 picture{heights.width, heights.height, {}};
    picture.pixels.resize(heights.values.size() * 4, 255);
    const float low = *std::min_element(heights.values.begin(), heights.values.end());
    const float scale = heights.range > 0.0 ? 255.0f / static_cast<float>(heights.range) : 0.0f;
    const auto row = static_cast<std::size_t>(heights.width);
    for (std::size_t i = 0; i < heights.values.size(); ++i) {
        const std::size_t to = (static_cast<std::size_t>(heights.height) - 1 - i / row) * row + i % row;
        for (std::size_t c = 0; c < 3; ++c)
            picture.pixels[to * 4 + c] = static_cast<std::uint8_t>((heights.values[i] - low) * scale + 0.5f);
    }
    return picture;
}

// Side by side: the picture as it is, cured, how long its vectors are, and the heights.
Image8 evidencePicture(const Channels& channels, const Diagnosis& d)
{
    const int w = channels.width, h = channels.height;
    Image8 picture{w * 4, h, {}};
    picture.pixels.resize(static_cast<std::size_t>(w) * 4 * static_cast<std::size_t>(h) * 4, 255);
    const Image8 cured = pictureOf(d.cured), heights = heightsPicture(d.heights);
    const NormalField before = fieldOf(channels, d.layout, Transfer::none);
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
            const std::size_t i = channels.at(x, h - 1 - y),
                              from = (static_cast<std::size_t>(y) * static_cast<std::size_t>(w) +
                                      static_cast<std::size_t>(x)) *
                                     4;
            const SrgbCode length = ramp(lengthOf(before.normals[i]) * 0.5f);
            for (std::size_t c = 0; c < 3; ++c) {
                const auto put = [&](int panel, std::uint8_t code) {
                    picture.pixels[(static_cast<std::size_t>(y) * static_cast<std::size_t>(4 * w) +
                                    static_cast<std::size_t>(panel * w + x)) *
                                       4 +
                                   c] = code;
                };
                put(0, static_cast<std::uint8_t>(std::clamp(channels.texels[i][c], 0.0f, 1.0f) * 255.0f + 0.5f));
                put(1, cured.pixels[from + c]);
                put(2, length[c]);
                put(3, heights.pixels[from + c]);
            }
        }
    }
    return picture;
}

Expected<std::vector<Mesh>> readMeshes(const std::string& file)
{
    const std::string ending = utf8Of(pathOf(file).extension());
    std::vector<Mesh> meshes;
    if (ending == ".gltf" || ending == ".glb") {
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

Expected<int> examine(const DoctorOptions& options)
{
    const Expected<ImageFile> picture = readImage(options.file);
    if (!picture) return tl::unexpected(picture.error());
    const Channels channels = channelsOf(*picture);
    Given given;
    given.name = options.file;
    if (!options.heights.empty()) {
        const Expected<ImageFile> heights = readImage(options.heights);
        if (!heights) return tl::unexpected(heights.error());
        given.heights = channelsOf(*heights);
    }
    if (!options.mesh.empty()) {
        Expected<std::vector<Mesh>> meshes = readMeshes(options.mesh);
        if (!meshes) return tl::unexpected(meshes.error());
        given.meshes = std::move(*meshes);
    }
    const Expected<Diagnosis> d = diagnose(channels, given);
    if (!d) return tl::unexpected(d.error());
    const bool hasField = d->kind == Kind::tangentSpace || d->kind == Kind::objectSpace;
    if (!options.fix.empty()) {
        if (!hasField)
            return fail("--fix " + options.fix + ": " + options.file + " is no normal map; nothing was written");
        if (const Expected<void> written = writePicture(options.fix, pictureOf(d->cured)); !written)
            return tl::unexpected(written.error());
    }
    const bool wantsSlopes = !options.evidence.empty() || !options.writtenHeights.empty();
    if (wantsSlopes && d->kind != Kind::tangentSpace)
        return fail(options.file + ": is no tangent-space map; there are no heights to show");
    if (!options.evidence.empty()) {
        if (const Expected<void> written = writePicture(options.evidence, evidencePicture(channels, *d)); !written)
            return tl::unexpected(written.error());
    }
    if (!options.writtenHeights.empty()) {
        if (const Expected<void> written = writePicture(options.writtenHeights, heightsPicture(d->heights)); !written)
            return tl::unexpected(written.error());
    }
    std::fputs((options.json ? jsonOf(*d, options) : textOf(*d, options)).c_str(), stdout);
    return d->findings.empty() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv)
{
    return runProgram(argc, argv, {.doctor = examine});
}
