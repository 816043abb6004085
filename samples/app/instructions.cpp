// Instructions, counted by valgrind, since the processor's own counters are out of reach in most virtual machines.
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <unistd.h>

#include "common/shell.h"
#include "cost.h"
#if __has_include(<valgrind/callgrind.h>)
#include <valgrind/callgrind.h>
#endif

namespace relief::samples {

namespace {

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
    for (std::size_t i = 0; i < kTextureOptions.size(); ++i) add(kTextureOptions[i], options.files.textures[i]);
    if (options.showTangents) {
        all += " --show-tangents --tangent-scale " + std::to_string(options.tangentScale) + " --tangent-offset " +
               std::to_string(options.tangentOffset);
    }
    return all;
}

// valgrind writes the counts of dump k to FOLDER/counts.k, on a line "totals: 1234".
std::vector<double> dumpedCounts(const std::filesystem::path& folder)
{
    std::vector<double> counts;
    for (int k = 1;; ++k) {
        std::ifstream file(folder / ("counts." + std::to_string(k)));
        if (!file) return counts;
        const std::string totals = "totals: ";
        for (std::string line; std::getline(file, line);) {
            if (line.starts_with(totals)) counts.push_back(std::strtod(line.c_str() + totals.size(), nullptr));
        }
    }
}

}  // namespace

#if __has_include(<valgrind/callgrind.h>)
void runCounted(const std::function<void()>& work)
{
    CALLGRIND_START_INSTRUMENTATION;
    CALLGRIND_ZERO_STATS;
    work();
    CALLGRIND_DUMP_STATS;
    CALLGRIND_STOP_INSTRUMENTATION;
}
#else
void runCounted(const std::function<void()>& work)
{
    work();
}
#endif

Expected<Counts> countInstructions(const std::string& program, const std::string& arguments,
                                   const std::string& environment)
{
    if (!std::filesystem::is_regular_file(program)) {
        return fail("--counted-program " + program + ": there is no such program; `./relief bench --instructions` " +
                    "builds one, with `cmake --preset counted`");
    }
    if (!outputOf("valgrind --version")) {
        return fail("instructions cannot be counted: valgrind does not run; install valgrind, or leave the option out");
    }
    static std::atomic<int> runs = 0;
    const std::filesystem::path folder = std::filesystem::temp_directory_path() /
                                         ("relief-counts-" + std::to_string(getpid()) + "-" + std::to_string(runs++));
    std::error_code ignored;
    std::filesystem::create_directories(folder, ignored);
    const std::string command = environment + " valgrind -q --tool=callgrind --instr-atstart=no " +
                                "--callgrind-out-file=" + quoted((folder / "counts").string()) + " " + quoted(program) +
                                " " + arguments;
    const std::optional<std::string> output = outputOf(command);
    Counts counts{dumpedCounts(folder), output.value_or("")};
    std::filesystem::remove_all(folder, ignored);
    if (!output || counts.instructions.empty()) {
        return fail("instructions were not counted; build " + program +
                    " again, now that valgrind is installed, or run this to see why: " + command);
    }
    return counts;
}

// The program prints the pixels of a frame.
Expected<double> instructionsPerFragment(const std::string& program, const RenderOptions& options,
                                         const std::string& environment)
{
    const Expected<Counts> counts =
        countInstructions(program, "bench" + arguments(options) + " --frames 2", environment);
    if (!counts) return tl::unexpected(counts.error());
    const double pixels = std::strtod(counts->output.c_str(), nullptr);
    if (!(pixels > 0.0)) return fail("instructions were not counted: " + program + " printed " + counts->output);
    return counts->instructions[0] / pixels;
}

}  // namespace relief::samples
