#include "report_options.h"

namespace relief::samples {

namespace {

constexpr ReportKind kReports[] = {
    {"triplanar", "960x540", 31, "--size --rounds --counted-program"},
    {"performance", "1920x1080", 5, "--size --rounds --part"},
    {"error", "", 15, "--rounds --only --counted-program"},
    {"stability", "", 0, "--only --tests"},
    {"leave-out", "480x270", 0, "--size --counted-program --switchable-program"},
    {"build", "", 1, "--rounds --only --build"},
    {"doctor", "", 5, "--rounds"},
    {"exercises", "", 300, "--rounds"},
};

}  // namespace

Expected<const ReportKind*> findReport(const std::string& name)
{
    std::string names;
    for (const ReportKind& r : kReports) {
        if (name == r.name) return &r;
        names += (names.empty() ? "" : ", ") + std::string(r.name);
    }
    return fail("report " + name + ": there is no such report; there is " + names);
}

Expected<ReportOptions> completeReport(const ReportOptions& options)
{
    const Expected<const ReportKind*> found = findReport(options.name);
    if (!found) return tl::unexpected(found.error());
    const std::pair<bool, std::string> given[] = {{!options.size.empty(), "--size"},
                                                  {options.rounds != 0, "--rounds"},
                                                  {options.part < 1.0, "--part"},
                                                  {!options.only.empty(), "--only"},
                                                  {!options.tests.empty(), "--tests"},
                                                  {!options.buildFolder.empty(), "--build"},
                                                  {!options.countedProgram.empty(), "--counted-program"},
                                                  {!options.switchableProgram.empty(), "--switchable-program"}};
    for (const auto& [isGiven, option] : given) {
        const bool taken = (std::string((*found)->takes) + " ").find(option + " ") != std::string::npos;
        if (isGiven && !taken) return fail("report " + options.name + ": it does not take " + option);
    }
    ReportOptions complete = options;
    if (complete.size.empty()) complete.size = (*found)->size;
    if (complete.rounds == 0) complete.rounds = (*found)->rounds;
    return complete;
}

}  // namespace relief::samples
