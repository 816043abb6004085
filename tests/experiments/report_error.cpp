// report error: what each approximation costs beside its error; a page, a table and a plot per experiment, an index and
// a page of findings.
#include <algorithm>
#include <cstdio>

#include "command_line.h"
#include "cost.h"
#include "experiments.h"
#include "measure.h"
#include "report.h"

namespace relief::samples {

namespace {

using namespace experiments;

struct Measured
{
    Experiment experiment;
    Rows rows;
    std::vector<double> checked;  // what each check measured
};

// Six digits, and "0" for what is below what doubles can tell from it.
std::string digits(double value)
{
    return std::abs(value) < 1e-12 ? "0" : text("%.6g", value);
}

std::string orDash(const std::optional<double>& value, const char* format)
{
    return value ? text(format, *value) : "-";
}

std::string fullName(const Row& row)
{
    return row.parameter.empty() ? row.name : row.name + ", " + row.parameter;
}

// --- the tables ---

std::string variantsTable(const Measured& m)
{
    std::string head = "| variant | largest error | RMS error |", rule = "|---|---|---|";
    for (const Fact& fact : m.rows.all[0].outcome.facts) head += " " + fact.name + " |", rule += "---|";
    head += " ns, fastest | median | ± | ns, streaming | instructions | on the front |\n";
    std::string table = head + rule + "---|---|---|---|---|---|\n";
    for (const Row& row : m.rows.all) {
        table +=
            "| " + fullName(row) + " | " + digits(row.outcome.error.max) + " | " + digits(row.outcome.error.rms) + " |";
        for (const Fact& fact : row.outcome.facts) table += " " + digits(fact.value) + " |";
        table += " " + text("%.3f", row.fastest) + " | " + text("%.3f", row.median) + " | " +
                 text("%.3f", row.deviation) + " | " + orDash(row.streaming, "%.3f") + " | " +
                 orDash(row.instructions, "%.2f") + " | " + (row.isOnFront ? "yes" : "") + " |\n";
    }
    return table;
}

std::string checksTable(const Measured& m)
{
    if (m.checked.empty()) return "";
    std::string table =
        "## Against reference values\n\n| what | to be | measured | tolerance | verdict |\n|---|---|---|---|---|\n";
    for (std::size_t i = 0; i < m.checked.size(); ++i) {
        const Check& check = m.experiment.checks[i];
        table += "| " + check.what + " | " + (check.isBound ? "at most " : "") + digits(check.expected) + " | " +
                 digits(m.checked[i]) + " | " + (check.isBound ? "" : digits(check.tolerance)) + " | " +
                 (check.holds(m.checked[i]) ? "holds" : "**does not**") + " |\n";
    }
    return table + "\n";
}

std::string dominated(const Rows& rows)
{
    std::string names;
    for (const Row& row : rows.all) {
        if (!row.isOnFront) names += (names.empty() ? "" : "; ") + fullName(row);
    }
    return names.empty() ? "No variant is dominated: each is the fastest at its error."
                         : "Dominated, another is at least as exact and as fast: " + names + ".";
}

std::string threadsOf(const Experiment& e)
{
    const auto isSingle = [](const Variant& v) { return v.threads == 1; };
    return std::all_of(e.variants.begin(), e.variants.end(), isSingle) ? ", one thread" : "";
}

std::string page(const Measured& m, const ReportOptions& options)
{
    const Experiment& e = m.experiment;
    return reportHead(e.id + " " + e.title, options) + "\n" + e.question + "\n\nErrors in " + e.unit +
           "; times in ns per " + e.item + threadsOf(e) + "; instructions per " + e.item +
           (options.countedProgram.empty() ? ": not counted" : ", counted in a build for x86-64-v3, 8 lanes") +
           ".\n\n" + variantsTable(m) + "\n" + dominated(m.rows) + "\n\n![Error against time](" + e.id + ".svg)\n\n" +
           m.experiment.finding(m.rows) + "\n\n" + checksTable(m);
}

std::string csv(const Measured& m, const std::string& commit)
{
    std::string lines =
        "exp,variant,param,n,err_max,err_rms,err_unit,ns_min,ns_med,ns_mad,ns_streaming,instr,on_front,image_hash,"
        "lanes,threads,commit";
    for (const Fact& fact : m.rows.all[0].outcome.facts) {
        std::string name = fact.name;
        std::replace(name.begin(), name.end(), ',', ';');
        lines += "," + name;
    }
    lines += "\n";
    for (std::size_t i = 0; i < m.rows.all.size(); ++i) {
        const Row& row = m.rows.all[i];
        char hash[20] = "";
        if (row.outcome.imageHash)
            std::snprintf(hash, sizeof hash, "%016llx", static_cast<unsigned long long>(*row.outcome.imageHash));
        lines += m.experiment.id + ",\"" + row.name + "\",\"" + row.parameter + "\"," +
                 std::to_string(row.outcome.error.count) + "," + text("%.9g", row.outcome.error.max) + "," +
                 text("%.9g", row.outcome.error.rms) + ",\"" + m.experiment.unit + "\"," + text("%.5g", row.fastest) +
                 "," + text("%.5g", row.median) + "," + text("%.3g", row.deviation) + "," +
                 (row.streaming ? text("%.5g", *row.streaming) : "") + "," +
                 (row.instructions ? text("%.6g", *row.instructions) : "") + "," + (row.isOnFront ? "1" : "0") + "," +
                 hash + "," + std::to_string(kLanes) + "," + std::to_string(m.experiment.variants[i].threads) + "," +
                 commit;
        for (const Fact& fact : row.outcome.facts) lines += "," + text("%.9g", fact.value);
        lines += "\n";
    }
    return lines;
}

// What docs/report/error.gnuplot asks for.
std::string plotSettings(const Measured& m)
{
    std::string names, groups, front;
    std::vector<std::size_t> order(m.rows.all.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return m.rows.all[a].outcome.error.rms < m.rows.all[b].outcome.error.rms;
    });
    for (const std::size_t i : order) front += m.rows.all[i].isOnFront ? std::to_string(i) + " " : "";
    for (const Row& row : m.rows.all) {
        names += "'" + fullName(row) + "' ";
        const std::string group = "'" + row.name + "' ";
        if (groups.find(group) == std::string::npos) groups += group;
    }
    return "id=\"" + m.experiment.id + "\"; unit=\"" + m.experiment.unit + "\"; item=\"" + m.experiment.item +
           "\"; names=\"" + names + "\"; groups=\"" + groups + "\"; front=\"" + front +
           "\"; joined=" + (m.experiment.rivals == Rivals::all ? "1" : "0");
}

// --- measuring and writing ---

Expected<Measured> measured(const Entry& entry, const ReportOptions& options)
{
    Measured m{entry.make({}), {}, {}};
    m.rows = measure(m.experiment, options.rounds, showProgress);
    for (const Check& check : m.experiment.checks) {
        showProgress(m.experiment.id + ": " + check.what);
        m.checked.push_back(check.measured());
    }
    if (options.countedProgram.empty()) return m;
    showProgress(m.experiment.id + ": counting instructions");
    const Expected<Counts> counts =
        countInstructions(options.countedProgram, "report error --count-only --only " + m.experiment.id);
    if (!counts) return tl::unexpected(counts.error());
    const std::vector<Variant>& variants = m.experiment.variants;
    const auto isCounted = [](const Variant& v) { return v.isCounted; };
    const auto counted = std::count_if(variants.begin(), variants.end(), isCounted);
    if (counted != static_cast<std::ptrdiff_t>(counts->instructions.size())) {
        return fail("report error: " + options.countedProgram + " has other variants of " + m.experiment.id +
                    "; build it again");
    }
    std::size_t next = 0;
    for (std::size_t i = 0; i < variants.size(); ++i) {
        if (variants[i].isCounted) m.rows.all[i].instructions = counts->instructions[next++] / variants[i].work.items;
    }
    return m;
}

Expected<void> write(const Measured& m, const ReportOptions& options)
{
    const Experiment& e = m.experiment;
    const Expected<void> table = writeReport(options, e.id + ".csv", csv(m, reportCommit()));
    if (!table) return table;
    const Expected<void> plot = plotReport(options, "error", e.id, plotSettings(m));
    if (!plot) return plot;
    return writeReport(options, e.id + ".md", page(m, options));
}

// What surprises most, in order.
constexpr const char* kSurprises[] = {"E-22", "E-05", "E-03", "E-15", "E-30"};

std::string index(const std::vector<Measured>& all, const ReportOptions& options)
{
    const auto link = [](const Experiment& e) { return "[" + e.id + " " + e.title + "](" + e.id + ".md)"; };
    std::string surprises, list;
    for (const char* const id : kSurprises) {
        for (const Measured& m : all) {
            if (m.experiment.id == id)
                surprises += "1. " + link(m.experiment) + ": " + m.experiment.finding(m.rows) + "\n";
        }
    }
    for (const Measured& m : all) {
        std::size_t held = 0;
        for (std::size_t i = 0; i < m.checked.size(); ++i) held += m.experiment.checks[i].holds(m.checked[i]);
        list += "| " + link(m.experiment) + " | " + std::to_string(m.rows.all.size()) + " | " + std::to_string(held) +
                " of " + std::to_string(m.checked.size()) + " | " + m.experiment.finding(m.rows) + " |\n";
    }
    return reportHead("Error against run time", options) +
           "\nEach approximation beside its exact reference: what it gets wrong, and what that saves. An experiment's "
           "page has all variants, the plot, and the reference values that the errors were held to. The numbers in the "
           "sentences are those of the pages' tables.\n\n## The five that surprise most\n\n" +
           surprises +
           "\n## All\n\n| experiment | variants | reference values held | what came out |\n|---|---|---|---|\n" + list;
}

// Into a folder of its own.
Expected<void> reportError(const ReportOptions& given)
{
    ReportOptions options = given;
    options.output += "/error";
    if (!options.countOnly) {
        const Expected<void> canPlot = checkPlotting();
        if (!canPlot) return canPlot;
    }
    const std::vector<Entry>& entries = experiments::experiments();
    for (const std::string& id : options.only) {
        if (std::none_of(entries.begin(), entries.end(), [&](const Entry& entry) { return id == entry.id; }))
            return fail("report error --only " + id + ": there is no such experiment; the first is E-01");
    }
    std::vector<Measured> all;
    for (const Entry& entry : entries) {
        const bool wanted = options.only.empty() || std::count(options.only.begin(), options.only.end(), entry.id) > 0;
        if (!wanted) continue;
        if (options.countOnly) {
            runForCounting(entry.make({}));
            continue;
        }
        Expected<Measured> m = measured(entry, options);
        if (!m) return tl::unexpected(m.error());
        const Expected<void> written = write(*m, options);
        if (!written) return written;
        all.push_back(std::move(*m));
    }
    showProgress("");
    if (options.countOnly) return {};
    if (options.only.empty()) {
        const Expected<void> written = writeReport(options, "README.md", index(all, options));
        if (!written) return written;
    }
    std::printf("%s/: %zu experiments\n", options.output.c_str(), all.size());
    return {};
}

}  // namespace

}  // namespace relief::samples

int main(int argc, char** argv)
{
    return relief::samples::runProgram(argc, argv, {.reportName = "error", .report = relief::samples::reportError});
}
