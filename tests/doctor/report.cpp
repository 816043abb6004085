// The program of `report doctor`: how many made faults the doctor names on every map, what it says that is not so, and
// how long an examination takes.
#include <algorithm>
#include <chrono>
#include <cstdio>

#include "command_line.h"
#include "maps.h"
#include "report.h"

namespace {

using namespace doctor_trials;
using namespace relief::samples;

struct Row
{
    std::string name;
    std::vector<Fault> faults;
    int maps = 0, named = 0, others = 0;
};

struct Timing
{
    int side;
    double milliseconds;
};

Row examineAll(const std::vector<SoundMap>& maps, const MadeFault& fault)
{
    Row row{fault.name, fault.faults};
    for (const SoundMap& map : maps) {
        Given given;
        if (fault.givesHeights) given.heights = map.heights;
        const Verdict verdict = verdictOf(*diagnose(channelsOf(fault.make(map)), given), fault.faults);
        ++row.maps;
        row.named += verdict.named == static_cast<int>(fault.faults.size());
        row.others += verdict.others;
    }
    return row;
}

std::vector<Row> rowsOf(const std::vector<SoundMap>& maps)
{
    const MadeFault sound = {"none", {}, codesOf};
    std::vector<Row> rows = {examineAll(maps, sound)};
    for (const auto* list : {&singleFaults(), &doubleFaults()}) {
        for (const MadeFault& fault : *list) {
            showProgress(std::string("doctor: ") + fault.name);
            rows.push_back(examineAll(maps, fault));
        }
    }
    return rows;
}

// The map again and again beside itself, as large as asked.
Image8 tiled(const Image8& map, int side)
{
    Image8 large{side, side, {}};
    large.pixels.resize(static_cast<std::size_t>(side) * static_cast<std::size_t>(side) * 4);
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const std::size_t to =
                (static_cast<std::size_t>(y) * static_cast<std::size_t>(side) + static_cast<std::size_t>(x)) * 4;
            const auto from = (static_cast<std::size_t>(y % map.height) * static_cast<std::size_t>(map.width) +
                               static_cast<std::size_t>(x % map.width)) *
                              4;
            std::copy_n(&map.pixels[from], 4, &large.pixels[to]);
        }
    }
    return large;
}

std::vector<Timing> timingsOf(const SoundMap& map, int rounds)
{
    std::vector<Timing> timings;
    for (const int side : {128, 256, 512, 1024, 2048}) {
        showProgress("doctor: " + std::to_string(side) + "x" + std::to_string(side));
        const Channels channels = channelsOf(tiled(codesOf(map), side));
        std::vector<double> times;
        for (int round = 0; round < rounds; ++round) {
            const auto begin = std::chrono::steady_clock::now();
            const Expected<Diagnosis> diagnosis = diagnose(channels);
            const std::chrono::duration<double, std::milli> passed = std::chrono::steady_clock::now() - begin;
            if (diagnosis) times.push_back(passed.count());
        }
        std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2), times.end());
        timings.push_back({side, times[times.size() / 2]});
    }
    return timings;
}

std::string document(const std::vector<Row>& rows, const std::vector<Timing>& timings,
                     const std::vector<SoundMap>& maps, const ReportOptions& options)
{
    std::string text = reportHead("The doctor of normal maps", options);
    text += "\nEvery fault is made on " + std::to_string(maps.size()) + " sound maps (";
    for (const SoundMap& map : maps) text += (&map == maps.data() ? "" : ", ") + map.name;
    text +=
        "), which [tests/doctor/maps.cpp](../../tests/doctor/maps.cpp) makes from the pictures in assets/ and from "
        "seeds. *Named*: on how many maps all of the faults were named. *Others*: findings that are not so. How to use "
        "the command: [the doctor](../doctor.md).\n\n![Maps on which a fault was named, and the time of an "
        "examination](doctor.svg)\n\n| fault | named | others |\n|---|---|---|\n";
    int named = 0, single = 0;
    for (const Row& row : rows) {
        const bool isSound = row.faults.empty();
        text += "| " + row.name + " | " +
                (isSound ? "" : std::to_string(row.named) + " of " + std::to_string(row.maps)) + " | " +
                std::to_string(row.others) + " |\n";
        if (row.faults.size() == 1) {
            named += row.named;
            single += row.maps;
        }
    }
    char line[200];
    std::snprintf(line, sizeof line, "\nOf single faults %d of %d are named: %.1f %%.\n", named, single,
                  100.0 * named / single);
    text += line;
    text += "\n## What it takes\n\nMedian of " + std::to_string(options.rounds) +
            " examinations, one thread, heights included.\n\n| texels | ms | ns a texel |\n|---|---|---|\n";
    for (const Timing& t : timings) {
        std::snprintf(line, sizeof line, "| %dx%d | %.0f | %.0f |\n", t.side, t.side, t.milliseconds,
                      t.milliseconds * 1e6 / t.side / t.side);
        text += line;
    }
    return text +
           "\n## What cannot be known\n\nBumps or dents: a map with both axes mirrored is a sound map of the opposite "
           "heights. Which of two axes is mirrored: only the heights say it, and without them green is named. An "
           "average of normals that hardly differ is hardly shorter than 1, which is what the maps show on which it "
           "was not named. Colours that were lost (blocks, missing codes) do not come back.\n";
}

std::string csvOf(const std::vector<Row>& rows)
{
    std::string csv = "fault,maps,named,others\n";
    for (const Row& row : rows)
        csv += '"' + row.name + "\"," + std::to_string(row.maps) + "," + std::to_string(row.named) + "," +
               std::to_string(row.others) + "\n";
    return csv;
}

std::string csvOf(const std::vector<Timing>& timings)
{
    std::string csv = "side,milliseconds\n";
    char line[64];
    for (const Timing& t : timings) {
        std::snprintf(line, sizeof line, "%d,%.3f\n", t.side, t.milliseconds);
        csv += line;
    }
    return csv;
}

Expected<void> reportDoctor(const ReportOptions& options)
{
    if (const Expected<void> canPlot = checkPlotting(); !canPlot) return canPlot;
    const std::vector<SoundMap> maps = soundMaps(RELIEF_ASSET_FOLDER);
    const std::vector<Row> rows = rowsOf(maps);
    const std::vector<Timing> timings = timingsOf(maps[2], options.rounds);
    showProgress("");
    for (const Expected<void>& written :
         {writeReport(options, "doctor.csv", csvOf(rows)), writeReport(options, "doctor-times.csv", csvOf(timings)),
          writeReport(options, "doctor.md", document(rows, timings, maps, options)),
          plotReport(options, "doctor", "doctor", "")}) {
        if (!written) return written;
    }
    std::printf("%s/doctor.md and .csv\n", options.output.c_str());
    return {};
}

}  // namespace

int main(int argc, char** argv)
{
    return runProgram(argc, argv, {.reportName = "doctor", .report = reportDoctor});
}
