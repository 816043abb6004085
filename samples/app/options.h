// What the words of the command line come to: one struct for each command that takes more than a word or two.
#pragma once

#include <string>
#include <vector>

#include "common/input_files.h"
#include "relief/pipeline/limits.h"

namespace relief::samples {

// What a stage is rendered with.
struct RenderOptions
{
    std::string stage;
    std::string scene;  // of `render`: a .gltf or .glb file in place of a stage
    std::string size = "960x540";
    int threads = 0;
    int tileSize = kDefaultTileSize, samples = 1;  // of `render`, `view` and `hash`
    std::vector<std::string> settings;
    InputFiles files;
    std::string camera;  // as parseCamera() takes it; empty: the stage's
    bool showTangents = false;
    float tangentScale = 0.1f, tangentOffset = 0.01f;
    std::string show;      // of `render` and `view`: a view (common/inside.h); empty: the picture
    std::string compiler;  // of live stages: "g++" or "clang++"; empty: the fastest
};

// Which pixel's life `trace` tells, and in what form.
struct TraceOptions
{
    RenderOptions render;
    std::string pixel;  // "X,Y"
    int vertex = -1;    // in place of a pixel: of the mesh of draw `draw`
    int draw = 0;
    bool firstNan = false;  // in place of a pixel: where the first NaN or infinity appears
    std::string html;       // a file for a page; empty: text
    std::string against;    // another stage, for the first difference
    bool json = false;
    bool all = false;  // of the text: also what is folded in a page
};

// What `view` shows, and how.
struct ViewOptions
{
    RenderOptions render;
    int frames = 0;      // close after so many pictures; 0: when the user does
    float scale = 0.0f;  // of text and controls; 0: the display's
};

// What `bench --live` measures: the time from a save to the picture.
struct LiveBenchOptions
{
    bool chosen = false;
    std::vector<std::string> stages;  // by number, name or path; none: all of the book
    std::string size = "960x540", compiler;
    int threads = 0, saves = 20;
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

// What `import-environment` reads and writes.
struct ImportEnvironmentOptions
{
    std::string file, output;  // empty output: the file's name and "-prefiltered.hdr"
    int size = 128, samples = 1024, threads = 0;
};

// What `check` compares, and where what it finds goes.
struct CheckOptions
{
    std::string what;           // compare, folder, review or accept
    std::string first, second;  // compare: two pictures; folder: pictures and goldens; review: records; accept: a list
    std::string range, ranges;  // compare: what may differ; folder: a file with a line for each picture
    std::string failures = "golden_failures", goldens;
    std::string output, junit;
    bool update = false;
    int threads = 0;
};

// What `doctor` examines, and what it writes.
struct DoctorOptions
{
    std::string file, mesh, heights;            // the last two may be empty
    std::string fix, evidence, writtenHeights;  // pictures; empty: not written
    bool json = false;
};

// Whose files `grade` runs, with which limits, and where it writes what came out.
struct GradeOptions
{
    std::string folder, output;  // empty output: the folder's name and -grades
    int threads = 0;             // so many files at once; 0: one per processor
    double seconds = 10.0;       // of a processor, for each file
    int megabytes = 3072;        // of addresses
    bool withoutSandbox = false;
};

// What `report` measures, and where the files go.
struct ReportOptions
{
    std::string name, output = "docs/report";
    std::string size;               // empty: the report's own
    int rounds = 0;                 // 0: the report's own
    std::vector<std::string> only;  // of `error` and `stability`: these experiments or cases; none: all
    double part = 1.0;              // of `performance`: how far its scalings go, as a part of the whole way
    std::string countedProgram;     // empty: instructions are not counted
    std::string switchableProgram;  // of `leave-out`: the same of a build with RELIEF_SWITCHES; empty: not counted
    std::string tests;              // of `stability`: the test program
    std::string buildFolder;        // of `build`: a configured build; empty: this program's
    bool countOnly = false;         // of `error`: runs each variant between marks for valgrind, and writes nothing
};

}  // namespace relief::samples
