#include "report.h"

#include <cstdio>
#include <filesystem>
#include <fstream>

#include <unistd.h>

#include "common/shell.h"
#include "cost.h"
#include "relief/file.h"
#include "report_options.h"

namespace relief::samples {

namespace {

std::string processor()
{
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with("model name") && line.find(": ") != std::string::npos)
            return line.substr(line.find(": ") + 2);
    }
    return "unknown processor";
}

std::string compiler()
{
#ifdef __clang__
    return "clang++ " __clang_version__;
#else
    return "g++ " __VERSION__;
#endif
}

}  // namespace

// Of the sources that lie where they were built. Reports that were written since are no change of these.
std::string reportCommit()
{
    const std::string git = "git -C " + quoted(RELIEF_SOURCE_FOLDER) + " ";
    std::string hash = outputOf(git + "rev-parse --short=12 HEAD").value_or("unknown");
    if (!hash.empty() && hash.back() == '\n') hash.pop_back();
    const std::optional<std::string> changes =
        outputOf(git + "status --porcelain --untracked-files=no -- ':!docs/report'");
    return changes && !changes->empty() ? hash + " and changes that are not committed" : hash;
}

std::string reportHead(const std::string& title, const ReportOptions& options)
{
    const ReportKind& usual = **findReport(options.name);
    std::string command = "./relief report " + options.name;
    if (options.size != usual.size) command += " --size " + options.size;
    if (options.rounds != usual.rounds) command += " --rounds " + std::to_string(options.rounds);
    if (options.part < 1.0) command += " --part " + text("%g", options.part);
    for (const std::string& id : options.only) command += " --only " + id;
    return "# " + title + "\n\n    " + command + "\n\n- processor: " + processor() +
           "\n- lanes: " + std::to_string(kLanes) + "\n- compiler: " + compiler() + "\n- commit: " + reportCommit() +
           "\n";
}

Expected<void> writeReport(const ReportOptions& options, const std::string& file, const std::string& text)
{
    std::error_code error;
    std::filesystem::create_directories(options.output, error);
    if (error) {
        return fail(options.output + ": cannot make the folder (" + error.message() +
                    "); choose another with --output");
    }
    return writeFileAtomically(std::filesystem::path(options.output) / file,
                               {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

Expected<void> checkPlotting()
{
    if (outputOf("gnuplot --version")) return {};
    return fail("the plot cannot be drawn: gnuplot does not run; install gnuplot-nox");
}

Expected<void> plotReport(const ReportOptions& options, const std::string& script, const std::string& plot,
                          const std::string& settings)
{
    const std::string command = "cd " + quoted(options.output) + " && gnuplot -e " + quoted(settings) + " " +
                                quoted(RELIEF_SOURCE_FOLDER "/docs/report/" + script + ".gnuplot");
    const std::optional<std::string> svg = outputOf(command + " 2>/dev/null");
    if (!svg || !svg->starts_with("<?xml")) {
        return fail(plot + ".svg was not drawn; run this to see why: " + command);
    }
    return writeReport(options, plot + ".svg", *svg);
}

void showProgress(const std::string& line)
{
    if (isatty(STDOUT_FILENO) == 0) return;
    std::printf("\r\033[K%s", line.c_str());
    std::fflush(stdout);
}

}  // namespace relief::samples
