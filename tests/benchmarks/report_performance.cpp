// report performance: how the time of a frame and the memory of the process grow with pixels, triangles, threads,
// lights and the side of a texture.
#include <algorithm>
#include <cstdio>

#include "command_line.h"
#include "cost.h"
#include "relief/pipeline/workers.h"
#include "report.h"
#include "scalings.h"

namespace relief::samples {

namespace {

using benchmarks::Drawn;
using benchmarks::Point;

// A point, drawn by a process in each round.
struct Measured
{
    Point point;
    std::vector<Drawn> rounds;

    Quartiles frames() const
    {
        std::vector<double> all;
        for (const Drawn& drawn : rounds) all.insert(all.end(), drawn.seconds.begin(), drawn.seconds.end());
        return quartiles(all);
    }
    double firstFrame() const
    {
        std::vector<double> all;
        for (const Drawn& drawn : rounds) all.push_back(drawn.firstSeconds);
        return quartiles(all).median;
    }
    double peakMebibytes() const
    {
        const auto less = [](const Drawn& a, const Drawn& b) { return a.peakMebibytes < b.peakMebibytes; };
        return std::max_element(rounds.begin(), rounds.end(), less)->peakMebibytes;
    }
    const Drawn& any() const { return rounds.front(); }
};
using Table = std::vector<Measured>;

// The points take turns, round by round.
Expected<Table> measured(const std::vector<Point>& points, int rounds)
{
    Table table;
    for (const Point& point : points) table.push_back({point, {}});
    for (int round = 0; round < rounds; ++round) {
        for (Measured& m : table) {
            showProgress("round " + std::to_string(round + 1) + " of " + std::to_string(rounds) + ": " +
                         m.point.scaling + ", " + m.point.curve + ", " + text("%.0f", m.point.x));
            const Expected<Drawn> drawn = benchmarks::drawPoint(m.point);
            if (!drawn) return tl::unexpected(drawn.error());
            m.rounds.push_back(*drawn);
        }
    }
    showProgress("");
    return table;
}

double fastest(const Drawn& drawn)
{
    return *std::min_element(drawn.seconds.begin(), drawn.seconds.end());
}

// How many times as fast as on one thread, round by round: by the fastest frame of either process. Every scene's first
// point is the one with one thread.
Quartiles speedUp(const Table& table, const Measured& m)
{
    const auto sameScene = [&](const Measured& other) {
        return other.point.scaling == m.point.scaling && other.point.curve == m.point.curve;
    };
    const Measured& one = *std::find_if(table.begin(), table.end(), sameScene);
    std::vector<double> ratios;
    for (std::size_t i = 0; i < m.rounds.size(); ++i) ratios.push_back(fastest(one.rounds[i]) / fastest(m.rounds[i]));
    return quartiles(ratios);
}

// --- the tables ---

std::string csv(const Table& table)
{
    std::string lines =
        "scaling,curve,x,width,height,threads,frames,lower_ms,median_ms,upper_ms,first_ms,memory_MiB,fragments,draws,"
        "levels_built,times_as_fast\n";
    for (const Measured& m : table) {
        const Quartiles q = m.frames();
        std::size_t frames = 0;
        for (const Drawn& drawn : m.rounds) frames += drawn.seconds.size();
        const int threads = Workers(m.point.threads).count();
        lines += m.point.scaling + "," + m.point.curve + "," + text("%.0f", m.point.x) + "," +
                 std::to_string(m.point.size.width) + "," + std::to_string(m.point.size.height) + "," +
                 std::to_string(threads) + "," + std::to_string(frames) + "," + text("%.4f", q.lower * 1e3) + "," +
                 text("%.4f", q.median * 1e3) + "," + text("%.4f", q.upper * 1e3) + "," +
                 text("%.4f", m.firstFrame() * 1e3) + "," + text("%.1f", m.peakMebibytes()) + "," +
                 std::to_string(m.any().pixelsShaded) + "," + std::to_string(m.any().draws) + "," +
                 std::to_string(m.any().levelsBuilt) + "," +
                 (m.point.scaling == "threads" ? text("%.3f", speedUp(table, m).median) : "") + "\n";
    }
    return lines;
}

// What only some of the scalings have.
struct Column
{
    const char* title;
    std::string (*cell)(const Measured&);
};

struct Section
{
    const char* scaling;
    const char* title;
    std::string what;
    const char* x;
    std::vector<Column> columns;
};

std::string nanosecondsPerX(const Measured& m)
{
    return text("%.2f", m.frames().median * 1e9 / m.point.x);
}

std::vector<Section> sections(const ReportOptions& options)
{
    const std::string size = " at " + options.size;
    return {
        {"pixels",
         "Pixels",
         "Stage 1.25, three objects under three lights, in squares of 128 x 128 to 8192 x 8192 pixels.",
         "pixels",
         {{"side", [](const Measured& m) { return std::to_string(m.point.size.width); }},
          {"ns a pixel", nanosecondsPerX}}},
        {"triangles",
         "Triangles",
         "A height field under one light" + size + ", in ever smaller triangles.",
         "triangles",
         {{"ns a triangle", nanosecondsPerX}}},
        {"lights",
         "Lights",
         "A floor of 64 pieces under point lights" + size +
             ": an additive pass for each piece and each light that reaches it; one pass whose fragment program loops "
             "over all lights; and the same, leaving out those that reach no pixel of a block. A light's range is the "
             "same, however many there are.",
         "lights",
         {{"draws", [](const Measured& m) { return std::to_string(m.any().draws); }}}},
        {"texture",
         "The side of a texture",
         "A ground plane to the horizon" + size +
             " with an RGBA8 texture, repeated 400 times: trilinear from its mip levels, and bilinear from the finest "
             "level alone, which asks for texels all over it. The first frame makes the levels.",
         "side",
         {{"levels built", [](const Measured& m) { return std::to_string(m.any().levelsBuilt); }}}},
    };
}

std::string sectionText(const Section& section, const Table& table)
{
    std::string head = "| | " + std::string(section.x) + " | ms | quartiles | first frame, ms | memory, MiB |";
    std::string rule = "|---|---|---|---|---|---|";
    for (const Column& column : section.columns) {
        head += " " + std::string(column.title) + " |";
        rule += "---|";
    }
    std::string rows;
    for (const Measured& m : table) {
        if (m.point.scaling != section.scaling) continue;
        const Quartiles q = m.frames();
        rows += "| " + m.point.curve + " | " + text("%.0f", m.point.x) + " | " + text("%.2f", q.median * 1e3) + " | " +
                text("%.2f", q.lower * 1e3) + " to " + text("%.2f", q.upper * 1e3) + " | " +
                text("%.2f", m.firstFrame() * 1e3) + " | " + text("%.0f", m.peakMebibytes()) + " |";
        for (const Column& column : section.columns) rows += " " + column.cell(m) + " |";
        rows += "\n";
    }
    return "## " + std::string(section.title) + "\n\n" + section.what + "\n\n" + head + "\n" + rule + "\n" + rows +
           "\n";
}

std::string threadsText(const Table& table, const ReportOptions& options)
{
    std::string rows;
    for (const Measured& m : table) {
        if (m.point.scaling != "threads") continue;
        const Quartiles q = m.frames(), times = speedUp(table, m);
        rows += "| " + m.point.curve + " | " + text("%.0f", m.point.x) + " | " + text("%.2f", q.median * 1e3) + " | " +
                text("%.2f", q.lower * 1e3) + " to " + text("%.2f", q.upper * 1e3) + " | " +
                text("%.0f", m.peakMebibytes()) + " | " + text("%.2f", times.median) + " (" +
                text("%.2f", times.lower) + " to " + text("%.2f", times.upper) + ") |\n";
    }
    return "## Threads\n\nThe scenes of `./relief bench` at " + options.size +
           ". Times as fast: the fastest frame of one thread's process to that of the other's, round by round; the "
           "median, and in brackets the quartiles.\n\n"
           "| scene | threads | ms | quartiles | memory, MiB | times as fast as one thread "
           "|\n|---|---|---|---|---|---|\n" +
           rows + "\n";
}

std::string document(const Table& table, const ReportOptions& options)
{
    std::string body =
        reportHead("How cost grows", options) + "- threads: " + std::to_string(Workers().count()) +
        ", where nothing else is said\n\n"
        "Every point is drawn by " +
        std::to_string(options.rounds) +
        " processes of its own; the points take turns. A process draws a first frame, and then nine "
        "more, or fewer once these have taken a second.\n\n"
        "- ms, quartiles: of all frames but the first ones\n"
        "- first frame: the median; it allocates memory and builds mip levels\n"
        "- memory: the most that a process had resident; program, mesh, textures and picture are in it\n\n"
        "![Time and memory against pixels, triangles, lights, texture sides and threads]"
        "(performance.svg)\n\n";
    for (const Section& section : sections(options)) body += sectionText(section, table);
    return body + threadsText(table, options);
}

Expected<void> reportPerformance(const ReportOptions& options)
{
    if (!options.countedProgram.empty()) return fail("report performance: it does not take --counted-program");
    const Expected<Size> size = parseSize(options.size);
    if (!size) return tl::unexpected(size.error());
    const Expected<void> canPlot = checkPlotting();
    if (!canPlot) return canPlot;
    const Expected<Table> table = measured(benchmarks::scalingPoints(*size, options.part), options.rounds);
    if (!table) return tl::unexpected(table.error());
    for (const Expected<void>& written : {writeReport(options, "performance.csv", csv(*table)),
                                          writeReport(options, "performance.md", document(*table, options)),
                                          plotReport(options, "performance", "performance", "")}) {
        if (!written) return written;
    }
    std::printf("%s/performance.md, .csv and .svg\n", options.output.c_str());
    return {};
}

}  // namespace

}  // namespace relief::samples

int main(int argc, char** argv)
{
    return relief::samples::runProgram(argc, argv,
                                       {.reportName = "performance", .report = relief::samples::reportPerformance});
}
