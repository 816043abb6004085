// The commands of the program, one function each. They print their results; an error comes back as one line, which
// main() prints to stderr with exit code 2.
#pragma once

#include <string>
#include <vector>

#include "common/render.h"

namespace relief::samples {

// What a stage is rendered with.
struct RenderOptions
{
    std::string stage;
    std::string size = "960x540";
    int threads = 0;
    std::vector<std::string> settings;
    InputFiles files;
    std::string camera;  // "X,Y,Z"; empty: the stage's
    bool showTangents = false;
    float tangentScale = 0.1f, tangentOffset = 0.01f;
};

struct Size
{
    int width, height;
};

// What `bench --stage` measures. --set and the files go to every stage.
struct BenchOptions
{
    RenderOptions render = {.threads = 1};
    std::vector<std::string> stages;
    int rounds = 15;
    int frames = 0;  // more than 0: draw as many and measure nothing
    bool instructions = false;
    std::string countedProgram;
};

// What `bench --peer` measures, and beside whom.
struct PeerOptions
{
    std::string peer;
    std::vector<std::string> scenes;  // by name; none: all
    std::string size = "1920x1080";
    int threads = 0, pairs = 9;
    std::string alone;  // "relief" or "mesa": that one draws one frame of a scene, and nothing is measured
};

// "WIDTHxHEIGHT", 1 to 16384 each.
Expected<Size> parseSize(const std::string& text);

// What `report` measures, and where the files go.
struct ReportOptions
{
    std::string name, output = "docs/report";
    std::string size;               // empty: the report's own
    int rounds = 0;                 // 0: the report's own
    std::vector<std::string> only;  // of `error` and `stability`: these experiments or cases; none: all
    double part = 1.0;              // of `performance`: how far its scalings go, as a part of the whole way
    std::string countedProgram;     // empty: instructions are not counted
    std::string switchableProgram;  // of `leave-out`: a relief of a build with RELIEF_SWITCHES; empty: not counted
    std::string tests;              // of `stability`: the test program
    bool countOnly = false;         // of `error`: runs each variant between marks for valgrind, and writes nothing
};

Expected<void> list(bool json);
Expected<void> render(const RenderOptions& options, const std::string& output);
Expected<void> hash(const RenderOptions& options, int tileSize);
Expected<void> signature(const RenderOptions& options, const std::string& binormal);
Expected<void> explain(const RenderOptions& options, bool json);
Expected<void> gallery(const std::string& folder, int threads);
Expected<void> view(const RenderOptions& options, int frames);
Expected<void> bench(const std::vector<std::string>& arguments);
Expected<void> benchStages(const BenchOptions& options);
Expected<void> benchPeer(const PeerOptions& options);
Expected<void> report(const ReportOptions& options);

// The stage that the options name, with their settings and files.
Expected<PreparedStage> prepare(const RenderOptions& options);

// Renders into 8-bit sRGB colours and writes a PNG.
Expected<Statistics> renderToFile(const PreparedStage& stage, Size size, int threads, const std::string& path);

}  // namespace relief::samples
