// Instructions, counted by valgrind, since the processor's own counters are out of reach in most virtual machines.
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <sstream>

#include <sys/wait.h>

#include "cost.h"

namespace relief::samples {

namespace {

struct Count
{
    std::uint64_t instructions = 0, pixels = 0;
};

// The options of a command that draws the same picture on one thread.
std::string arguments(const RenderOptions& options)
{
    std::string all = " --stage " + quoted(options.stage) + " --size " + quoted(options.size) + " --threads 1";
    const auto add = [&all](const char* name, const std::string& value) {
        if (!value.empty()) all += std::string(" --") + name + " " + quoted(value);
    };
    for (const std::string& setting : options.settings) add("set", setting);
    for (const std::string& setting : options.files.import) add("import", setting);
    add("camera", options.camera);
    add("mesh", options.files.mesh);
    add("albedo", options.files.albedo);
    add("height", options.files.height);
    add("normal", options.files.normal);
    add("detail", options.files.detail);
    add("detail-normal", options.files.detailNormal);
    if (options.showTangents) {
        all += " --show-tangents --tangent-scale " + std::to_string(options.tangentScale) + " --tangent-offset " +
               std::to_string(options.tangentOffset);
    }
    return all;
}

std::uint64_t numberAt(const std::string& text, std::size_t at)
{
    std::uint64_t number = 0;
    std::from_chars(text.data() + std::min(at, text.size()), text.data() + text.size(), number);
    return number;
}

// The program prints the pixels on a line of their own, valgrind "==1234== Collected : 5678" at the end.
Expected<Count> count(const std::string& program, const RenderOptions& options, int frames)
{
    const std::string command = "valgrind --tool=callgrind --callgrind-out-file=/dev/null " + quoted(program) +
                                " bench" + arguments(options) + " --frames " + std::to_string(frames);
    const std::optional<std::string> output = outputOf(command);
    Count result;
    std::stringstream lines(output.value_or(""));
    const std::string collected = "Collected : ";
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("==")) {
            const std::size_t at = line.find(collected);
            if (at != std::string::npos) result.instructions = numberAt(line, at + collected.size());
        } else if (line.find_first_not_of("0123456789") == std::string::npos) {
            result.pixels = numberAt(line, 0);
        }
    }
    if (result.instructions == 0 || result.pixels == 0) {
        return fail("instructions were not counted; run this to see why: " + command);
    }
    return result;
}

}  // namespace

std::string quoted(const std::string& word)
{
    std::string result = "'";
    for (const char c : word) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return result + "'";
}

std::optional<std::string> outputOf(const std::string& command)
{
    std::FILE* const pipe = popen(("exec 2>&1; " + command).c_str(), "r");
    if (pipe == nullptr) return std::nullopt;
    std::string output;
    char buffer[4096];
    for (std::size_t got; (got = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) output.append(buffer, got);
    const int status = pclose(pipe);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) return std::nullopt;
    return output;
}

Expected<double> instructionsPerFragment(const std::string& program, const RenderOptions& options)
{
    if (!std::filesystem::is_regular_file(program)) {
        return fail("--counted-program " + program + ": there is no such program; `./relief bench --instructions` " +
                    "builds one, with `cmake --preset counted`");
    }
    if (!outputOf("valgrind --version")) {
        return fail("instructions cannot be counted: valgrind does not run; install valgrind, or leave the option out");
    }
    const Expected<Count> two = count(program, options, 2);
    if (!two) return tl::unexpected(two.error());
    const Expected<Count> three = count(program, options, 3);
    if (!three) return tl::unexpected(three.error());
    return static_cast<double>(three->instructions - two->instructions) / static_cast<double>(three->pixels);
}

}  // namespace relief::samples
