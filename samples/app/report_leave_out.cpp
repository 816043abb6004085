// report leave-out: what each stage did not need, as counted while it ran; and for some stages what leaving it out
// saved, in instructions, by putting one thing after the other back.
#include <algorithm>
#include <cstdio>

#include "command_line.h"
#include "cost.h"
#include "relief/leave_out.h"
#include "report.h"
#include "usage.h"

namespace relief::samples {

namespace {

using leavesOut::LeftOut;

// A stage of each kind: depth, filters, detail textures, three objects and lights, two passes, three planes, one plane,
// a pass before the picture, a mirror's pixels that are marked without a colour, light where anything was drawn.
constexpr const char* kSwitchedStages[] = {"0.03", "0.04", "1.15", "1.25", "2.06", "3.05",
                                           "4.07", "4.11", "5.05", "5.19", "5.20"};

struct Switched
{
    std::string stage, title;
    double ordinary = 0.0;        // instructions per fragment of a build without switches
    double asIs = 0.0;            // of the build with switches, nothing put back
    std::vector<double> putBack;  // one for each of leavesOut::kAll
    double all = 0.0;
};

RenderOptions renderOptions(const std::string& stage, const ReportOptions& options)
{
    return {.stage = stage, .size = options.size, .threads = 1};
}

// --- what was not needed ---

struct Counted
{
    const Stage* stage;
    Usage usage;
};

Expected<std::vector<Counted>> countedStages(const ReportOptions& options)
{
    const Expected<Size> size = parseSize(options.size);
    if (!size) return tl::unexpected(size.error());
    std::vector<Counted> all;
    for (const Stage& stage : allStages()) {
        showProgress("counting " + stage.id);
        const Expected<PreparedStage> prepared = prepare(renderOptions(stage.id, options));
        if (!prepared) return tl::unexpected(prepared.error());
        const Expected<Usage> usage = usageOf(*prepared, *size, 0);
        if (!usage) return tl::unexpected(usage.error());
        all.push_back({&stage, *usage});
    }
    return all;
}

// "part of whole", and where there is none of it nothing.
std::string share(std::uint64_t part, std::uint64_t whole)
{
    if (whole == 0) return "";
    return text("%.1f %%", 100.0 * static_cast<double>(part) / static_cast<double>(whole));
}

Statistics statisticsOfPasses(const Usage& usage)
{
    Statistics all;
    for (const SceneLog::Pass& pass : usage.before) all += pass.statistics;
    return all;
}

std::string countsTable(const std::vector<Counted>& all)
{
    std::string table =
        "| stage | draws | passes left out | components not used | triangles not clipped | tiles not touched | hidden, "
        "not shaded | without program, in passes before | samples | no derivatives | no second level | magnified | "
        "constant | mip levels not built |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
    for (const Counted& c : all) {
        const Statistics& s = c.usage.statistics;
        const Statistics before = statisticsOfPasses(c.usage);
        const std::uint64_t samples = s.fetches.samples();
        table +=
            "| " + c.stage->name() + " | " + std::to_string(s.draws) + " | " + std::to_string(c.usage.passesLeftOut) +
            " | " + std::to_string(c.usage.componentsDeclared - c.usage.componentsUsed) + " of " +
            std::to_string(c.usage.componentsDeclared) + " | " +
            share(s.trianglesSubmitted - s.trianglesClipped, s.trianglesSubmitted) + " | " +
            share(s.tiles - s.tilesTouched, s.tiles) + " | " + share(s.pixelsHidden, s.pixelsHidden + s.pixelsShaded) +
            " | " + share(before.pixelsColorless, before.pixelsShaded) + " | " + std::to_string(samples) + " | " +
            share(s.fetches.noDerivatives, samples) + " | " + share(s.fetches.secondLevelSkipped, samples) + " | " +
            share(s.fetches.magnified, samples) + " | " + share(s.fetches.constant, samples) + " | " +
            std::to_string(c.usage.levelsWhole - c.usage.levelsBuilt) + " of " + std::to_string(c.usage.levelsWhole) +
            " |\n";
    }
    return table;
}

std::string countsCsv(const std::vector<Counted>& all)
{
    std::string lines =
        "stage,draws,passes_left_out,components,components_used,triangles,triangles_clipped,tiles,tiles_touched,"
        "pixels_shaded,pixels_hidden,samples,no_derivatives,second_level_skipped,magnified,constant,levels,"
        "levels_built,passes_before,pixels_before,pixels_before_without_program\n";
    for (const Counted& c : all) {
        const Statistics& s = c.usage.statistics;
        const Statistics before = statisticsOfPasses(c.usage);
        lines += c.stage->id;
        for (const std::uint64_t n : {s.draws,
                                      static_cast<std::uint64_t>(c.usage.passesLeftOut),
                                      static_cast<std::uint64_t>(c.usage.componentsDeclared),
                                      static_cast<std::uint64_t>(c.usage.componentsUsed),
                                      s.trianglesSubmitted,
                                      s.trianglesClipped,
                                      s.tiles,
                                      s.tilesTouched,
                                      s.pixelsShaded,
                                      s.pixelsHidden,
                                      s.fetches.samples(),
                                      s.fetches.noDerivatives,
                                      s.fetches.secondLevelSkipped,
                                      s.fetches.magnified,
                                      s.fetches.constant,
                                      static_cast<std::uint64_t>(c.usage.levelsWhole),
                                      static_cast<std::uint64_t>(c.usage.levelsBuilt),
                                      static_cast<std::uint64_t>(c.usage.before.size()),
                                      before.pixelsShaded,
                                      before.pixelsColorless})
            lines += "," + std::to_string(n);
        lines += "\n";
    }
    return lines;
}

// --- what that saved ---

Expected<std::vector<Switched>> switchedStages(const ReportOptions& options)
{
    std::vector<Switched> all;
    for (const char* const id : kSwitchedStages) {
        const RenderOptions render = renderOptions(id, options);
        const Expected<PreparedStage> prepared = prepare(render);
        if (!prepared) return tl::unexpected(prepared.error());
        Switched s{.stage = id, .title = std::string(prepared->stage->title)};
        Expected<void> result;
        const auto count = [&](const std::string& program, const std::string& generic) {
            showProgress("counting the instructions of " + s.stage + " " + generic);
            const Expected<double> n = instructionsPerFragment(program, render, "RELIEF_GENERIC=" + generic);
            if (!n) result = tl::unexpected(n.error());
            return n.value_or(0.0);
        };
        s.ordinary = count(options.countedProgram, "");
        s.asIs = count(options.switchableProgram, "");
        for (const LeftOut& left : leavesOut::kAll) {
            if (result) s.putBack.push_back(count(options.switchableProgram, left.name));
        }
        if (result) s.all = count(options.switchableProgram, "all");
        if (!result) return tl::unexpected(result.error());
        all.push_back(std::move(s));
    }
    return all;
}

std::string savingsTable(const std::vector<Switched>& all)
{
    std::string head = "| stage | ordinary build | with switches |", rule = "|---|---|---|";
    for (const LeftOut& left : leavesOut::kAll) head += std::string(" ") + left.name + " |", rule += "---|";
    std::string table = head + " all |\n" + rule + "---|\n";
    for (const Switched& s : all) {
        const auto more = [&](double n) {
            return std::abs(n - s.asIs) < 0.05
                       ? std::string("0")
                       : text("%+.1f", n - s.asIs) + text(" (%+.1f %%)", 100.0 * (n / s.asIs - 1.0));
        };
        table +=
            "| " + s.stage + " " + s.title + " | " + text("%.1f", s.ordinary) + " | " + text("%.1f", s.asIs) + " |";
        for (const double n : s.putBack) table += " " + more(n) + " |";
        table += " " + more(s.all) + " |\n";
    }
    return table;
}

std::string savingsCsv(const std::vector<Switched>& all)
{
    std::string lines = "stage,put_back,instructions\n";
    for (const Switched& s : all) {
        const auto line = [&](const std::string& name, double n) {
            lines += s.stage + "," + name + "," + text("%.3f", n) + "\n";
        };
        line("ordinary build", s.ordinary);
        line("nothing", s.asIs);
        for (std::size_t i = 0; i < s.putBack.size(); ++i) line(leavesOut::kAll[i].name, s.putBack[i]);
        line("all", s.all);
    }
    return lines;
}

// The stages and the names, in the order of the bars.
std::string plotSettings()
{
    std::string stages, names;
    for (const char* const id : kSwitchedStages) stages += std::string(id) + " ";
    for (const LeftOut& left : leavesOut::kAll) names += std::string(left.name) + " ";
    return "stages=\"" + stages + "\"; names=\"" + names + "all\"";
}

std::string document(const std::vector<Counted>& counted, const std::vector<Switched>& switched,
                     const ReportOptions& options)
{
    std::string names;
    for (const LeftOut& left : leavesOut::kAll) {
        names += std::string("| ") + left.name + " | " + left.putBack + " | `engine/relief/" + left.decidedIn + "` |\n";
    }
    std::string savings = "Not counted: `./relief report leave-out` builds the programs for it.\n";
    if (!switched.empty()) {
        savings =
            "Instructions per fragment of a whole frame, with the passes before the picture, such as shadow maps, "
            "counted by valgrind (x86-64-v3, 8 lanes, one thread): of an ordinary build; of one in which what is left "
            "out can be put back (`cmake --preset switchable`), with nothing put back; and how many more it takes with "
            "one thing put back, and with all. A minus: looking whether a thing can be left out costs a little where "
            "it cannot. The "
            "pictures are the same to the last bit: the tests named generic.* see to that for every stage.\n\n" +
            savingsTable(switched) + "\n| put back | which means | decided in |\n|---|---|---|\n" + names +
            "\n![What leaving out saves](leave-out.svg)\n";
    }
    return reportHead("What was left out", options) + "\nDrawn at " + options.size + ".\n\n## What it saved\n\n" +
           savings +
           "\nWhat a shader itself leaves out is in [E-30](error/E-30.md): features removed, skipped by a branch, or "
           "fed a neutral input.\n\n## What each stage did not need\n\nCounted while it ran, as `./relief explain "
           "STAGE` shows it: additive passes whose light does not reach the object (the lamps of 2.06 and 3.05 have no "
           "range, so all of their passes are drawn); interpolated components that no pixel depends on (their programs "
           "are the tutorials'); triangles that needed no clipping; tiles that no triangle touches; covered pixels "
           "that failed the stencil or the depth test before any shading; pixels of passes before the picture, such as "
           "shadow maps, "
           "that were "
           "drawn without their program, as no target keeps its colours; texture samples that took no derivatives, "
           "having no mip "
           "level to choose, whose second mip level has no part, that are magnified, or that are from a texture of one "
           "texel; mip levels that nothing asked for.\n\n" +
           countsTable(counted);
}

Expected<void> reportLeaveOut(const ReportOptions& options)
{
    const bool counts = !options.countedProgram.empty();
    if (counts != !options.switchableProgram.empty())
        return fail("report leave-out: --counted-program and --switchable-program go together");
    const Expected<void> canPlot = counts ? checkPlotting() : Expected<void>();
    if (!canPlot) return canPlot;
    const Expected<std::vector<Counted>> counted = countedStages(options);
    if (!counted) return tl::unexpected(counted.error());
    std::vector<Switched> switched;
    if (counts) {
        Expected<std::vector<Switched>> all = switchedStages(options);
        if (!all) return tl::unexpected(all.error());
        switched = std::move(*all);
    }
    showProgress("");
    for (const Expected<void>& written :
         {writeReport(options, "leave-out.csv", countsCsv(*counted)),
          counts ? writeReport(options, "leave-out-instructions.csv", savingsCsv(switched)) : Expected<void>(),
          writeReport(options, "leave-out.md", document(*counted, switched, options)),
          counts ? plotReport(options, "leave-out", "leave-out", plotSettings()) : Expected<void>()}) {
        if (!written) return written;
    }
    std::printf("%s/leave-out.md and .csv\n", options.output.c_str());
    return {};
}

}  // namespace

}  // namespace relief::samples

int main(int argc, char** argv)
{
    return relief::samples::runProgram(argc, argv,
                                       {.reportName = "leave-out", .report = relief::samples::reportLeaveOut});
}
