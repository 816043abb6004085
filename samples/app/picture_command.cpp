#include "picture_command.h"

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

void add(std::string& command, const std::string& option, const std::string& value)
{
    command += " " + option + " " + word(value);
}

std::string nameOf(const live::StageSource& source)
{
    return word(source.id.empty() ? source.path : source.id);
}

// What a picture depends on.
void addPicture(std::string& command, const live::Look& look)
{
    const live::Look usual;
    for (const std::string& setting : look.settings) add(command, "--set", setting);
    // With =, since a number may begin with a minus.
    if (look.camera) command += " --camera=" + cameraText(*look.camera);
    const InputFiles& files = look.files;
    if (!files.mesh.empty()) add(command, "--mesh", files.mesh);
    for (std::size_t i = 0; i < kTextureOptions.size(); ++i) {
        if (!files.textures[i].empty()) add(command, std::string("--") + kTextureOptions[i], files.textures[i]);
    }
    for (const std::string& setting : files.import) add(command, "--import", setting);
    if (look.showTangents) {
        command += " --show-tangents";
        if (look.tangentScale != usual.tangentScale) add(command, "--tangent-scale", exactText(look.tangentScale));
        if (look.tangentOffset != usual.tangentOffset) add(command, "--tangent-offset", exactText(look.tangentOffset));
    }
    if (look.tileSize != usual.tileSize) add(command, "--tile", std::to_string(look.tileSize));
    if (look.samples != usual.samples) add(command, "--samples", std::to_string(look.samples));
    if (look.threads != usual.threads) add(command, "--threads", std::to_string(look.threads));
    if (look.width != usual.width || look.height != usual.height)
        add(command, "--size", std::to_string(look.width) + "x" + std::to_string(look.height));
}

}  // namespace

std::string renderCommand(const std::string& program, const live::StageSource& source, const live::Look& look,
                          const std::string& output)
{
    std::string command = word(program) + " render " + nameOf(source);
    addPicture(command, look);
    if (!look.show.empty()) add(command, "--show", look.show);
    add(command, "-o", output);
    return command;
}

std::string traceCommand(const std::string& program, const live::StageSource& source, const std::string& words,
                         const live::Look& look)
{
    std::string command = word(program) + " trace " + nameOf(source) + " " + words;
    addPicture(command, look);
    return command;
}

}  // namespace relief::samples
