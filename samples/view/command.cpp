#include "view/command.h"

#include <algorithm>
#include <cctype>

#include "common/shell.h"
#include "prepare.h"

namespace relief::samples {

namespace {

// Quoted where a shell would read more than a word.
std::string word(const std::string& text)
{
    const auto plain = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
               std::string("_-./,=+:@%").find(c) != std::string::npos;
    };
    return !text.empty() && std::all_of(text.begin(), text.end(), plain) ? text : quoted(text);
}

}  // namespace

std::string renderCommand(const live::StageSource& source, const live::Look& look, const std::string& output)
{
    const live::Look usual;
    std::string command = "./relief render " + word(source.id.empty() ? source.path : source.id);
    const auto add = [&](const std::string& option, const std::string& value) {
        command += " " + option + " " + word(value);
    };
    for (const std::string& setting : look.settings) add("--set", setting);
    // With =, since a number may begin with a minus.
    if (look.camera) command += " --camera=" + cameraText(*look.camera);
    const InputFiles& files = look.files;
    if (!files.mesh.empty()) add("--mesh", files.mesh);
    for (std::size_t i = 0; i < kTextureOptions.size(); ++i) {
        if (!files.textures[i].empty()) add(std::string("--") + kTextureOptions[i], files.textures[i]);
    }
    for (const std::string& setting : files.import) add("--import", setting);
    if (look.showTangents) {
        command += " --show-tangents";
        if (look.tangentScale != usual.tangentScale) add("--tangent-scale", exactText(look.tangentScale));
        if (look.tangentOffset != usual.tangentOffset) add("--tangent-offset", exactText(look.tangentOffset));
    }
    if (!look.show.empty()) add("--show", look.show);
    if (look.tileSize != usual.tileSize) add("--tile", std::to_string(look.tileSize));
    if (look.samples != usual.samples) add("--samples", std::to_string(look.samples));
    if (look.threads != usual.threads) add("--threads", std::to_string(look.threads));
    if (look.width != usual.width || look.height != usual.height) {
        add("--size", std::to_string(look.width) + "x" + std::to_string(look.height));
    }
    add("-o", output);
    return command;
}

}  // namespace relief::samples
