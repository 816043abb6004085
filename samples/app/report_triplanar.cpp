// report triplanar: what each way to map normals from three sides costs, beside its error; what the blend weights cost;
// and whether the tutorial's claims about cost hold on this machine.
#include <algorithm>
#include <cstdlib>

#include "command_line.h"
#include "common/assets.h"
#include "common/triplanar_methods.h"
#include "cost.h"
#include "report.h"

namespace relief::samples {

namespace {

constexpr float kTilts[] = {0.0f, 30.0f, 45.0f, 54.7356f};  // the last: a cube's corner, where the three planes meet
constexpr float kSlopes[] = {0.1f, 0.5f, 1.0f};
constexpr float kShownTilt = 45.0f, kShownSlope = 0.5f;  // of the first table and the plot

// What is drawn: a sphere as high as the picture, seen from where the three planes meet.
constexpr const char* kMesh = "sphere";
constexpr const char* kCamera = "0.88,0.88,-0.88";

struct Subject
{
    std::string stage, name;
    std::vector<std::string> settings;
};

struct Measured
{
    Subject subject;
    Cost cost;
    std::optional<double> instructions;
};
using Table = std::vector<Measured>;

// The names are those of triplanarErrors(). Mesh tangents have no error that could be computed: it depends on the mesh.
const std::vector<Subject> kMethods = {
    {"4.02", "mesh tangents", {"show=1"}},
    {"4.03", "swizzle", {}},
    {"4.04", "UDN", {}},
    {"4.05", "whiteout", {}},
    {"4.06", "GPU Gems 3", {"show=1"}},
    {"4.07", "RNM", {}},
    {"4.08", "cotangent frame", {}},
    {"4.10", "cross products", {}},
};

const char* const kWeights[] = {"linear",  "0.2 off",    "0.2 off times 7", "power 4",           "power 8",
                                "power n", "asymmetric", "height",          "0.65 off unguarded"};

std::vector<Subject> weights(bool alone)
{
    std::vector<Subject> all;
    for (const char* name : kWeights) {
        all.push_back({"4.11", name, {"weights=" + std::to_string(all.size() + 1)}});
        if (alone) all.back().settings.push_back("asColors=1");
    }
    return all;
}

// The same bricks for every stage, also for one that shows bumps only.
Expected<RenderOptions> renderOptions(const Subject& subject, const ReportOptions& options)
{
    const Expected<std::string> albedo = assetPath("bricks-albedo.png");
    if (!albedo) return tl::unexpected(albedo.error());
    RenderOptions all = {.stage = subject.stage, .size = options.size, .threads = 1, .settings = subject.settings};
    all.camera = kCamera;
    all.files.mesh = kMesh;
    all.files.textures[TextureSlot::albedo] = *albedo;
    return all;
}

Expected<Table> measured(const std::string& what, const std::vector<Subject>& subjects, const ReportOptions& options)
{
    const Expected<Size> size = parseSize(options.size);
    if (!size) return tl::unexpected(size.error());
    Table table;
    std::vector<PreparedStage> stages;
    for (const Subject& subject : subjects) {
        const Expected<RenderOptions> each = renderOptions(subject, options);
        if (!each) return tl::unexpected(each.error());
        Expected<PreparedStage> stage = prepare(*each);
        if (!stage) return tl::unexpected(stage.error());
        stages.push_back(std::move(*stage));
        table.push_back({subject, {}, {}});
        if (options.countedProgram.empty()) continue;
        showProgress(what + ": counting the instructions of " + subject.name);
        const Expected<double> counted = instructionsPerFragment(options.countedProgram, *each);
        if (!counted) return tl::unexpected(counted.error());
        table.back().instructions = *counted;
    }
    const Expected<std::vector<Cost>> costs = measure(stages, *size, 1, options.rounds, [&](int round) {
        showProgress(what + ": round " + std::to_string(round + 1) + " of " + std::to_string(options.rounds));
    });
    if (!costs) return tl::unexpected(costs.error());
    for (std::size_t i = 0; i < table.size(); ++i) table[i].cost = (*costs)[i];
    return table;
}

const Measured& row(const Table& table, const std::string& name)
{
    return *std::find_if(table.begin(), table.end(), [&](const Measured& m) { return m.subject.name == name; });
}

std::string instructionsOf(const Measured& m)
{
    return m.instructions ? text("%.1f", *m.instructions) : "not counted";
}

std::string ratioText(const Measured& m, const Measured& reference)
{
    const Quartiles q = ratio(m.cost, reference.cost);
    return text("%.3f", q.median) + " (" + text("%.3f", q.lower) + " to " + text("%.3f", q.upper) + ")";
}

// --- the tables ---

std::string costCells(const Measured& m, const Measured& reference)
{
    return "| " + m.subject.stage + " | " + m.subject.name + " | " + text("%.2f", m.cost.fetchesPerFragment()) + " | " +
           instructionsOf(m) + " | " + text("%.2f", m.cost.nanosecondsPerFragment()) + " | " + ratioText(m, reference) +
           " |";
}

std::string errorCells(const triplanar::MethodError* error)
{
    std::string cells;
    for (int truth = 0; truth < 3; ++truth) {
        cells += error == nullptr
                     ? " |"
                     : " " + text("%.2f", error->maximum[truth]) + " / " + text("%.2f", error->rms[truth]) + " |";
    }
    return cells;
}

const triplanar::MethodError* errorOf(const std::vector<triplanar::MethodError>& errors, const std::string& method)
{
    const auto found =
        std::find_if(errors.begin(), errors.end(), [&](const auto& error) { return error.method == method; });
    return found == errors.end() ? nullptr : &*found;
}

std::string methodsTable(const Table& methods)
{
    const std::vector<triplanar::MethodError> errors = triplanar::triplanarErrors(kShownTilt, kShownSlope);
    std::string table =
        "| stage | method | fetches | instructions | ns | time to whiteout's | G1 | G2 | G3 |\n"
        "|---|---|---|---|---|---|---|---|---|\n";
    for (const Measured& m : methods) {
        table += costCells(m, row(methods, "whiteout")) + errorCells(errorOf(errors, m.subject.name)) + "\n";
    }
    return table;
}

std::string weightsTable(const Table& table)
{
    std::string lines =
        "| stage | weights | fetches | instructions | ns | time to that of 0.2 off |\n|---|---|---|---|---|---|\n";
    for (const Measured& m : table) lines += costCells(m, row(table, "0.2 off")) + "\n";
    return lines;
}

std::string errorTable()
{
    std::string table = "| tilt | slope | method | G1 | G2 | G3 |\n|---|---|---|---|---|---|\n";
    for (const float tilt : kTilts) {
        for (const float slope : kSlopes) {
            for (const triplanar::MethodError& error : triplanar::triplanarErrors(tilt, slope)) {
                table += "| " + text("%g", tilt) + " | " + text("%g", slope) + " | " + error.method + " |" +
                         errorCells(&error) + "\n";
            }
        }
    }
    return table;
}

std::string csvCells(const std::string& kind, const Measured& m, const Measured& reference)
{
    const Quartiles q = ratio(m.cost, reference.cost);
    return kind + "," + m.subject.stage + "," + m.subject.name + "," + std::to_string(m.cost.statistics.pixelsShaded) +
           "," + text("%.4f", m.cost.fetchesPerFragment()) + "," + instructionsOf(m) + "," +
           text("%.3f", m.cost.nanosecondsPerFragment()) + "," + text("%.4f", q.median) + "," + text("%.4f", q.lower) +
           "," + text("%.4f", q.upper);
}

// A method has a line for each tilt and slope.
std::string csv(const Table& methods, const Table& textured, const Table& alone)
{
    std::string lines =
        "table,stage,name,fragments,fetches,instructions,ns,ratio,ratio_lower,ratio_upper,tilt,slope,max_G1,rms_G1,"
        "max_G2,rms_G2,max_G3,rms_G3\n";
    const std::string noError = ",,,,,,,,\n";
    for (const Measured& m : methods) {
        const std::string cost = csvCells("methods", m, row(methods, "whiteout"));
        bool any = false;
        for (const float tilt : kTilts) {
            for (const float slope : kSlopes) {
                const std::vector<triplanar::MethodError> errors = triplanar::triplanarErrors(tilt, slope);
                const triplanar::MethodError* const error = errorOf(errors, m.subject.name);
                if (error == nullptr) continue;
                any = true;
                lines += cost + "," + text("%g", tilt) + "," + text("%g", slope);
                for (int truth = 0; truth < 3; ++truth)
                    lines += "," + text("%.4f", error->maximum[truth]) + "," + text("%.4f", error->rms[truth]);
                lines += "\n";
            }
        }
        if (!any) lines += cost + noError;
    }
    for (const Measured& m : textured) lines += csvCells("weights", m, row(textured, "0.2 off")) + noError;
    for (const Measured& m : alone) lines += csvCells("weights alone", m, row(alone, "0.2 off")) + noError;
    return lines;
}

// --- the findings ---

enum class Expectation
{
    cheaper,     // for three quarters of the rounds at least
    asCheap,     // the median within 2 % or below
    aBitDearer,  // the median above 1, by at most 10 %
    muchDearer   // by more
};

const char* verdict(bool claimHolds)
{
    return claimHolds ? "holds" : "does not";
}

std::string verdict(Expectation expectation, const Quartiles& q)
{
    switch (expectation) {
        case Expectation::cheaper:
            return q.lower <= 1.0 && q.upper >= 1.0 && q.lower < q.upper ? "too close to tell" : verdict(q.upper < 1.0);
        case Expectation::asCheap:
            return verdict(q.median <= 1.02);
        case Expectation::aBitDearer:
            return verdict(q.median > 1.0 && q.median <= 1.1);
        case Expectation::muchDearer:
            break;
    }
    return verdict(q.median > 1.1);
}

std::string numbers(const Measured& m, const Measured& reference)
{
    return " | " + text("%.2f", m.cost.nanosecondsPerFragment()) + " : " +
           text("%.2f", reference.cost.nanosecondsPerFragment()) + " | " + ratioText(m, reference) + " | " +
           instructionsOf(m) + " : " + instructionsOf(reference) + " |\n";
}

std::string comparison(const std::string& claim, Expectation expectation, const Measured& m, const Measured& reference)
{
    std::string byInstructions = "not counted";
    if (m.instructions && reference.instructions) {
        const double r = *m.instructions / *reference.instructions;
        byInstructions = verdict(expectation, {r, r, r});
    }
    return "| " + claim + " | " + verdict(expectation, ratio(m.cost, reference.cost)) + " | " + byInstructions +
           numbers(m, reference);
}

struct Difference
{
    int pixels = 0, largest = 0;  // in codes of 8 bits
};

Expected<Difference> difference(const Subject& one, const Subject& other, const ReportOptions& options)
{
    const Expected<Size> size = parseSize(options.size);
    if (!size) return tl::unexpected(size.error());
    std::vector<std::uint32_t> pixels[2];
    for (int i = 0; i < 2; ++i) {
        const Expected<RenderOptions> each = renderOptions(i == 0 ? one : other, options);
        if (!each) return tl::unexpected(each.error());
        const Expected<PreparedStage> stage = prepare(*each);
        if (!stage) return tl::unexpected(stage.error());
        Expected<Framebuffer> target = Framebuffer::create(size->width, size->height, Format::rgba8Srgb);
        if (!target) return tl::unexpected(target.error());
        Frame frame(*target, {.threads = 1});
        stage->record(frame, size->width, size->height);
        frame.run();
        pixels[i].assign(target->color8().begin(), target->color8().end());
    }
    Difference result;
    for (std::size_t p = 0; p < pixels[0].size(); ++p) {
        if (pixels[0][p] == pixels[1][p]) continue;
        ++result.pixels;
        for (int shift = 0; shift < 32; shift += 8) {
            const auto code = [&](int i) { return static_cast<int>(pixels[i][p] >> shift & 255u); };
            result.largest = std::max(result.largest, std::abs(code(0) - code(1)));
        }
    }
    return result;
}

// The factor goes away when the weights are divided by their sum. Its cost is that of the same code with it and
// without.
Expected<std::string> factorFinding(const Table& textured, const Table& alone, const ReportOptions& options)
{
    const Expected<Difference> d =
        difference(row(textured, "0.2 off").subject, row(textured, "0.2 off times 7").subject, options);
    if (!d) return tl::unexpected(d.error());
    const Measured &with = row(alone, "0.2 off times 7"), &without = row(alone, "0.65 off unguarded");
    return "| 2: the factor 7 is of no use: with it and without, no pixel differs by more than 1 code of 255 (" +
           std::to_string(d->pixels) + " differ, by at most " + std::to_string(d->largest) +
           "); beside it the weights alone, with it : without (0.65 in place of 0.2) | " + verdict(d->largest <= 1) +
           " | " + verdict(d->largest <= 1) + numbers(with, without);
}

Expected<std::string> findings(const Table& methods, const Table& textured, const Table& alone,
                               const ReportOptions& options)
{
    using enum Expectation;
    const Expected<std::string> factor = factorFinding(textured, alone, options);
    if (!factor) return factor;
    const auto method = [&](const std::string& claim, Expectation expectation, const char* one, const char* other) {
        return comparison(claim, expectation, row(methods, one), row(methods, other));
    };
    const auto weight = [&](const std::string& claim, Expectation expectation, const char* one, const char* other) {
        return comparison(claim + ", weights alone", expectation, row(alone, one), row(alone, other)) +
               comparison(claim + ", whole shader", expectation, row(textured, one), row(textured, other));
    };
    std::string table =
        "| claim | by time | by instructions | ns, this : that | time, this to that | instructions, this : that "
        "|\n|---|---|---|---|---|---|\n";
    table += method("1: GPU Gems 3 is cheaper than whiteout", cheaper, "GPU Gems 3", "whiteout");
    table += method("1: UDN is cheaper than whiteout", cheaper, "UDN", "whiteout");
    table += *factor;
    table += weight("3: power 4 is as cheap as the subtraction", asCheap, "power 4", "0.2 off");
    table += method("4: RNM is a little dearer than whiteout", aBitDearer, "RNM", "whiteout");
    for (const char* name : {"swizzle", "whiteout", "RNM"}) {
        table += method(std::string("5: ") + name + " is cheaper than mesh tangents", cheaper, name, "mesh tangents");
    }
    table += weight("6: power 8 is only a bit dearer than power 4", aBitDearer, "power 8", "power 4");
    table += weight("6: a variable power is much dearer than power 4", muchDearer, "power n", "power 4");
    return table;
}

std::string preamble(const Table& methods, const ReportOptions& options)
{
    return reportHead("Triplanar normal mapping: cost and error", options) + "\nDrawn at " + options.size +
           " on one thread: a sphere with bricks, as high as the picture, from where the three planes meet (--mesh " +
           kMesh + " --camera " + kCamera + "), " + std::to_string(methods[0].cost.statistics.pixelsShaded) +
           " fragments.\n"
           "Every number per fragment is a whole frame's, divided by its fragments: vertices, raster and clearing are "
           "in it.\n\n"
           "- fetches: texture samples; those of helper lanes count\n"
           "- instructions: " +
           (options.countedProgram.empty()
                ? std::string("not counted; `./relief report triplanar` counts them")
                : std::string("counted by valgrind in a second build (`cmake --preset counted`: g++, x86-64-v3, 8 "
                              "lanes), the same on every run")) +
           "\n- ns: the median of " + std::to_string(options.rounds) +
           " rounds, in which the stages take turns; in each turn the fastest of three frames\n"
           "- time to another's: the median of the rounds' ratios, and in brackets their quartiles\n"
           "- G1, G2, G3: degrees to three truths, largest / root of the mean square, over 64 directions of the slope "
           "times 64 of the bump\n\n"
           "| | truth |\n|---|---|\n"
           "| G1 | the surface is moved along the projection axis |\n"
           "| G2 | the surface is moved along its own normal, by heights that the projection stretches |\n"
           "| G3 | the bump's normal is turned onto the surface, without stretch |\n\n";
}

Expected<void> reportTriplanar(const ReportOptions& options)
{
    const Expected<void> canPlot = checkPlotting();
    if (!canPlot) return canPlot;
    const Expected<Table> methods = measured("methods", kMethods, options);
    if (!methods) return tl::unexpected(methods.error());
    const Expected<Table> textured = measured("weights", weights(false), options);
    if (!textured) return tl::unexpected(textured.error());
    const Expected<Table> alone = measured("weights alone", weights(true), options);
    if (!alone) return tl::unexpected(alone.error());
    const Expected<std::string> found = findings(*methods, *textured, *alone, options);
    showProgress("");
    if (!found) return tl::unexpected(found.error());

    const std::string document =
        preamble(*methods, options) +
        "## Methods\n\nErrors at a tilt of 45 degrees, for bumps of slope 0.5. Mesh "
        "tangents have no bound.\n\n" +
        methodsTable(*methods) +
        "\n![Error against time and against instructions](triplanar.svg)\n\n## Blend weights (4.11)\n\n" +
        weightsTable(*textured) + "\nThe weights alone, shown as colours, without textures and light:\n\n" +
        weightsTable(*alone) +
        "\n## The tutorial's claims\n\nOn this processor. Cheaper: in three quarters of the rounds at least; too close "
        "to tell: neither cheaper nor dearer in three quarters. As cheap: at most 2 % "
        "dearer. "
        "A little or a bit: at most 10 %. Much: more.\n\n" +
        *found +
        "\n## Errors\n\nTilt in degrees; slope of the bumps; largest / root of the mean square, in degrees.\n\n" +
        errorTable();
    for (const Expected<void>& written :
         {writeReport(options, "triplanar.csv", csv(*methods, *textured, *alone)),
          writeReport(options, "triplanar.md", document),
          plotReport(options, "triplanar", "triplanar", options.countedProgram.empty() ? "counted=0" : "counted=1")}) {
        if (!written) return written;
    }
    std::printf("%s/triplanar.md, .csv and .svg\n", options.output.c_str());
    return {};
}

}  // namespace

}  // namespace relief::samples

int main(int argc, char** argv)
{
    return relief::samples::runProgram(argc, argv,
                                       {.reportName = "triplanar", .report = relief::samples::reportTriplanar});
}
