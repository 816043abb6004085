#include "command_line.h"

#include <algorithm>
#include <cstdio>

#include <CLI/CLI.hpp>

#include "relief/leave_out.h"
#include "relief/pipeline/limits.h"
#include "report_options.h"

namespace relief::samples {

namespace {

// A command of another program.
tl::unexpected<Error> elsewhere(const std::string& command)
{
    return fail(command + ": this program does not do it; `./relief " + command +
                "` builds and runs the one that does");
}

void addPictureOptions(CLI::App& command, RenderOptions& options)
{
    command.add_option("--size", options.size, "Picture size in pixels")->type_name("WxH")->capture_default_str();
    command.add_option("--threads", options.threads, "Threads; 0: one per processor")->check(CLI::Range(0, 256));
    command.add_option("--set", options.settings, "A property, as name=value; may be repeated")
        ->type_name("NAME=VALUE");
    command
        .add_option("--mesh", options.files.mesh,
                    "An OBJ file in place of the stage's mesh, or quad, cube, sphere, low-sphere, terrain")
        ->type_name("FILE");
    static constexpr PerTexture<const char*> kMeanings = {
        {"A picture (sRGB) in place of the albedo", "A height map", "A normal map (+Y), or its heights in grey",
         "A detail albedo (sRGB)", "A detail normal map (+Y), or its heights",
         "Metallic in red, occlusion in green, detail in blue, smoothness in alpha",
         "Light that the surface gives (sRGB)",
         "What surrounds the scene: a picture that import-environment wrote or takes"}};
    for (std::size_t i = 0; i < kTextureOptions.size(); ++i) {
        command.add_option(std::string("--") + kTextureOptions[i], options.files.textures[i], kMeanings[i])
            ->type_name("FILE");
    }
    command
        .add_option("--import", options.files.import,
                    "How normal maps are imported; may be repeated: storage=rgb|dxt5nm|dxt5, bumpiness=0.05, "
                    "filter=smooth|sobel, heights=automatic|yes|no, fade=on|off")
        ->type_name("NAME=VALUE");
    command
        .add_option("--camera", options.camera,
                    "Where the camera stands; it looks at the origin, or at a point that follows: X,Y,Z,X,Y,Z. A "
                    "seventh number is the field of view in degrees, two more are the near and the far plane")
        ->type_name("X,Y,Z");
    command.add_flag("--show-tangents", options.showTangents, "Normals green, tangents red, binormals blue, as lines");
    command.add_option("--tangent-scale", options.tangentScale, "How long those lines are")
        ->check(CLI::Range(0.0f, 10.0f))
        ->capture_default_str();
    command.add_option("--tangent-offset", options.tangentOffset, "How far from the surface they begin")
        ->check(CLI::Range(0.0f, 10.0f))
        ->capture_default_str();
}

void addDoctorOptions(CLI::App& command, DoctorOptions& options)
{
    command.add_option("file", options.file, "A picture: PNG, JPEG, TGA, BMP, HDR or PFM")->required();
    command
        .add_option("--height", options.heights,
                    "The heights that it was made of: which way its axes go, and how strong it is")
        ->type_name("FILE");
    command
        .add_option("--mesh", options.mesh, "An OBJ or glTF file that it is for: whether its tangents go with its uv")
        ->type_name("FILE");
    command.add_option("--fix", options.fix, "Writes the cured map")->type_name("OUT.png");
    command
        .add_option("--evidence", options.evidence,
                    "Writes a picture: the map, cured, the lengths of its vectors (green: 1), the heights")
        ->type_name("OUT.png");
    command.add_option("--write-heights", options.writtenHeights, "Writes the heights that would give the map")
        ->type_name("OUT.png");
    command.add_flag("--json", options.json, "As JSON");
}

void addCheckCommands(CLI::App& check, CheckOptions& options)
{
    check.require_subcommand(1);
    const auto add = [&](const char* name, const char* meaning) {
        CLI::App* const command = check.add_subcommand(name, meaning);
        command->callback([&options, name] { options.what = name; });
        return command;
    };
    const auto addJunit = [&](CLI::App& command) {
        command.add_option("--junit", options.junit, "Writes what CI services show: JUnit's XML")
            ->type_name("FILE.xml");
    };

    CLI::App* command = add("compare", "Compares two pictures: exit code 0 the same, 1 different, 2 no pictures");
    command->add_option("actual", options.first, "A PNG, JPEG, TGA, BMP, HDR or PFM file")->required();
    command->add_option("golden", options.second, "What it should be")->required();
    command
        ->add_option("--range", options.range,
                     "What must differ, as it was measured: pixels=40-60,largest=1-2,window8x8=3; default: nothing")
        ->type_name("RANGE");
    command->add_option("-o,--output", options.output, "Writes the difference, enlarged, where there is one")
        ->type_name("FILE.png");

    command = add("folder", "Compares all pictures of two folders: exit code 0 the same, 1 different, 2 no folders");
    command->add_option("actual", options.first, "The folder of new pictures")->required();
    command->add_option("golden", options.second, "The folder of goldens, with files of the same names")->required();
    command
        ->add_option("--ranges", options.ranges,
                     "Which pictures must differ, and how much: lines such as a/b.png pixels=40-60 largest=1-2")
        ->type_name("FILE");
    command->add_option("--failures", options.failures, "Where records and differences go")->capture_default_str();
    command->add_flag(
        "--update", options.update,
        "Makes the pictures that differ the goldens, and lists them; the exit code is still 1. Refused where "
        "the environment has CI set");
    command->add_option("--threads", options.threads, "Threads; 0: one per processor")->check(CLI::Range(0, 256));
    addJunit(*command);

    command = add("review", "Makes a page of what failed, to accept or reject: one HTML file, which needs no network");
    command->add_option("failures", options.failures, "The folder that the tests left")->capture_default_str();
    command->add_option("-o,--output", options.output, "The page; default: review.html")->type_name("FILE.html");
    addJunit(*command);

    command = add("accept", "Makes pictures the goldens, as the list says that the review page saved");
    command->add_option("list", options.first, "The list")->required();
    command->add_option("--failures", options.second, "The folder that the tests left; default: the one of the page");
    command->add_option("--goldens", options.goldens, "The folder of the goldens, where the tests ran elsewhere");
}

void addGradeOptions(CLI::App& command, GradeOptions& options)
{
    command
        .add_option(
            "folder", options.folder,
            "Where the files are: a folder for each learner, or files that are named after learner and exercise, "
            "ada_1.08a.cpp")
        ->required();
    command
        .add_option("--output", options.output,
                    "The folder for index.html, grades.json and grades.csv; default: the folder's name and -grades")
        ->type_name("DIR");
    command.add_option("--threads", options.threads, "So many files at once; 0: one per processor")
        ->check(CLI::Range(0, 256));
    command.add_option("--seconds", options.seconds, "Of a processor for each file; three times as many by the clock")
        ->check(CLI::Range(0.1, 3600.0))
        ->capture_default_str();
    command.add_option("--megabytes", options.megabytes, "Of memory for each file")
        ->check(CLI::Range(256, 1 << 20))
        ->capture_default_str();
    command.add_flag("--without-sandbox", options.withoutSandbox,
                     "Runs files with your own rights, and within limits: only if you trust every one");
}

void addCompilerOption(CLI::App& command, std::string& compiler)
{
    command.add_option("--compiler", compiler, "That compiles stages while the program runs; default: the fastest")
        ->check(CLI::IsMember({"g++", "clang++"}));
}

void addTargetOptions(CLI::App& command, RenderOptions& options)
{
    command.add_option("--tile", options.tileSize, "Tile size in pixels")->check(CLI::IsMember({16, 32, 64, 128}));
    command.add_option("--samples", options.samples, "Samples a pixel, for smooth edges")
        ->check(CLI::IsMember({1, 2, 4, 8}));
}

void addShowOption(CLI::App& command, std::string& show)
{
    command
        .add_option("--show", show,
                    "What lies behind the picture, with a scale: depth, normal, mip, overdraw, TEXCOORD0.x ...; `list` "
                    "prints what the stage has")
        ->type_name("VIEW");
}

CLI::Option* addInputOptions(CLI::App& command, RenderOptions& options)
{
    CLI::Option* const stage =
        command
            .add_option("stage", options.stage,
                        "A stage, by number (1.07) or name (07_central_difference), or a file with one of your own "
                        "(my_shader.cpp)")
            ->required();
    addPictureOptions(command, options);
    return stage;
}

// All but --stage are of no use without it; --peer takes size and threads too.
void addBenchOptions(CLI::App& command, BenchOptions& options, PeerOptions& peerOptions, LiveBenchOptions& liveOptions)
{
    addPictureOptions(command, options.render);
    command.add_option("--rounds", options.rounds, "How often each stage has its turn")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
    CLI::Option* const frames = command
                                    .add_option("--frames", options.frames,
                                                "Draws as many frames of each stage, prints how many pixels one "
                                                "shades, and measures nothing")
                                    ->check(CLI::Range(1, 1000000));
    command.add_flag("--instructions", options.instructions, "Counts instructions too, with valgrind: takes a while")
        ->excludes(frames);
    command
        .add_option("--counted-program", options.countedProgram,
                    "The program that they are counted in; ./relief builds one")
        ->type_name("FILE");
    for (CLI::Option* const option : command.get_options()) {
        if (option != command.get_help_ptr()) option->group("With --stage");
    }
    CLI::Option* const stage =
        command
            .add_option(
                "--stage", options.stages,
                "Measures stages, by number, name or file, on one thread unless told otherwise; may be repeated: "
                "they take turns, and each is compared with the first")
            ->allow_extra_args(false);
    CLI::Option* const live =
        command
            .add_flag("--live", liveOptions.chosen,
                      "Measures the time from a save of a stage's file to its picture in the window, for the stages "
                      "that follow, or all; takes --size, --threads")
            ->excludes(stage);
    command.add_option("--saves", liveOptions.saves, "With --live: how often each stage is saved")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str()
        ->needs(live);
    addCompilerOption(command, liveOptions.compiler);
    command.get_option("--compiler")->needs(live);
    CLI::Option* const peer =
        command
            .add_option("--peer", peerOptions.peer,
                        "Draws the test scenes in turn with another rasterizer, mesa (its llvmpipe), and says how much "
                        "faster Relief is and how far the pictures agree; takes --size (1920x1080 unless told "
                        "otherwise) and --threads (all)")
            ->check(CLI::IsMember({"mesa"}))
            ->excludes(stage)
            ->excludes(live);
    command.add_option("--scene", peerOptions.scenes, "With --peer: one of the test scenes alone; may be repeated")
        ->allow_extra_args(false)
        ->needs(peer);
    command.add_option("--pairs", peerOptions.pairs, "With --peer: how often each of the two has its turn")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str()
        ->needs(peer);
    command.add_option("--alone", peerOptions.alone, "What first_frame starts: draws one frame of a scene")
        ->check(CLI::IsMember({"relief", "mesa"}))
        ->needs(peer)
        ->group("");
}

// The first option given that is none of `known`; empty if there is none.
std::string otherOption(const CLI::App& command, const std::vector<std::string>& known)
{
    for (const CLI::Option* const option : command.get_options()) {
        if (option->count() > 0 && std::find(known.begin(), known.end(), option->get_name()) == known.end()) {
            return option->get_name();
        }
    }
    return "";
}

Expected<void> renderWith(const CLI::App& command, const RenderOptions& options, const std::string& output, bool watch,
                          const Program& program)
{
    if (options.scene.empty() == options.stage.empty()) {
        return fail("render: name a stage, or a scene with --scene FILE.glb; `relief list` shows the stages");
    }
    auto* const function = watch                   ? program.renderAtEverySave
                           : options.scene.empty() ? program.render
                                                   : program.renderScene;
    const std::string other = otherOption(
        command, {"--scene", "--environment", "--size", "--threads", "--camera", "--output", "--tile", "--samples"});
    if (!options.scene.empty() && !other.empty()) return fail(other + ": render --scene does not take it");
    return function != nullptr ? function(options, output) : elsewhere("render");
}

Expected<void> benchWith(const CLI::App& command, const BenchOptions& options, PeerOptions peerOptions,
                         LiveBenchOptions liveOptions, const Program& program)
{
    const std::vector<std::string> others = command.remaining();
    const auto unknown = [&](const std::string& what) {
        return fail(what + ": unknown option " + others[0] + "; see `relief bench --help`");
    };
    if (!peerOptions.peer.empty()) {
        const std::string other =
            otherOption(command, {"--peer", "--scene", "--pairs", "--alone", "--size", "--threads"});
        if (!others.empty()) return unknown("bench --peer");
        if (!other.empty()) return fail(other + ": bench --peer does not take it; see `relief bench --help`");
        if (command.count("--size") > 0) peerOptions.size = options.render.size;
        if (command.count("--threads") > 0) peerOptions.threads = options.render.threads;
        return program.benchPeer ? program.benchPeer(peerOptions) : elsewhere("bench --peer mesa");
    }
    if (liveOptions.chosen) {
        const std::string other = otherOption(command, {"--live", "--saves", "--compiler", "--size", "--threads"});
        if (!other.empty()) return fail(other + ": bench --live does not take it; see `relief bench --help`");
        for (const std::string& word : others) {
            if (word.starts_with("-")) return unknown("bench --live");
        }
        liveOptions.stages = others;
        if (command.count("--size") > 0) liveOptions.size = options.render.size;
        if (command.count("--threads") > 0) liveOptions.threads = options.render.threads;
        return program.benchLive ? program.benchLive(liveOptions) : elsewhere("bench --live");
    }
    if (!options.stages.empty()) {
        if (!others.empty()) return unknown("bench --stage");
        return program.benchStages ? program.benchStages(options) : elsewhere("bench --stage");
    }
    const std::string other = otherOption(command, {});
    if (!other.empty()) return fail(other + ": bench takes it with --stage only");
    return program.bench ? program.bench(others) : elsewhere("bench");
}

void addReportOptions(CLI::App& command, ReportOptions& options)
{
    command
        .add_option("name", options.name,
                    "triplanar: what each way to map normals costs, beside its error; performance: how cost grows "
                    "with pixels, triangles, threads, lights and textures; error: every approximation's error "
                    "beside its run time; stability: what extreme inputs do, measured against bounds; leave-out: "
                    "what each stage did not need, and what that saved; build: what compiling costs; exercises: what "
                    "is said of wrong answers; doctor: what is said of faults in normal maps")
        ->required();
    command.add_option("--output", options.output, "The folder")->capture_default_str()->type_name("DIR");
    command
        .add_option("--size", options.size,
                    "Picture size in pixels; 960x540 for triplanar, 1920x1080 for performance unless told otherwise")
        ->type_name("WxH");
    command
        .add_option("--rounds", options.rounds,
                    "How often each stage or scene has its turn; 31 for triplanar, 5 for performance unless told "
                    "otherwise; of build: how often each file is compiled; of exercises: how many wrong answers")
        ->check(CLI::Range(1, 100000));
    command
        .add_option("--part", options.part,
                    "Of performance: leaves out what is larger than this part of the largest picture, mesh, texture "
                    "and number of lights")
        ->check(CLI::Range(1e-9, 1.0));
    command
        .add_option("--only", options.only,
                    "Of error and stability: one experiment or case alone, E-01 or S-301; of build: stage, header, "
                    "engine, tests or another kind; may be repeated")
        ->type_name("ID")
        ->allow_extra_args(false);
    command.add_flag("--count-only", options.countOnly, "What valgrind runs to count instructions")->group("");
    command
        .add_option("--counted-program", options.countedProgram,
                    "Of triplanar, error and leave-out: the program that instructions are counted in; ./relief builds "
                    "one")
        ->type_name("FILE");
    command
        .add_option("--switchable-program", options.switchableProgram,
                    "Of leave-out: one in which what is left out can be put back; ./relief builds one")
        ->type_name("FILE");
    command.add_option("--tests", options.tests, "Of stability: the test program; ./relief builds it")
        ->type_name("FILE");
    command
        .add_option("--build", options.buildFolder,
                    "Of build: the folder of the configured build that is measured; ./relief configures one")
        ->type_name("DIR");
}

void addImportEnvironmentOptions(CLI::App& command, ImportEnvironmentOptions& options)
{
    command
        .add_option("file", options.file,
                    "A picture of all directions: a cross (4:3 or 3:4), six faces in a strip (6:1 or 1:6; +x, -x, +y, "
                    "-y, +z, -z), or longitude and latitude (2:1); HDR, PFM, or 8 or 16 bits of sRGB")
        ->required();
    command
        .add_option("-o,--output", options.output,
                    "The file, .hdr or .pfm; default: the picture's name and -prefiltered.hdr")
        ->type_name("FILE");
    command.add_option("--size", options.size, "The side of the finest level's faces, in texels")
        ->check(CLI::Range(8, 2048))
        ->capture_default_str();
    command.add_option("--samples", options.samples, "Directions for each texel")
        ->check(CLI::Range(2, 65536))
        ->capture_default_str();
    command.add_option("--threads", options.threads, "Threads; 0: one per processor")->check(CLI::Range(0, 256));
}

Expected<void> reportWith(const ReportOptions& options, const Program& program)
{
    const Expected<ReportOptions> complete = completeReport(options);
    if (!complete) return tl::unexpected(complete.error());
    if (program.report == nullptr || options.name != program.reportName) return elsewhere("report " + options.name);
    return program.report(*complete);
}

}  // namespace

int runProgram(int argc, char** argv, const Program& program)
{
    if (const Expected<void> checked = leavesOut::checkGeneric(leavesOut::generic()); !checked) {
        std::fprintf(stderr, "relief: %s\n", checked.error().message.c_str());
        return 2;
    }
    CLI::App app("Relief: a software rasterizer that one can read, step through and trust.", "relief");
    app.require_subcommand(0, 1);
    Expected<void> result;
    RenderOptions options;
    bool json = false;
    std::string output, binormal;
    // Runs what the program has for a command.
    const auto run = [&result](const char* name, auto function, const auto&... arguments) {
        result = function != nullptr ? function(arguments...) : elsewhere(name);
    };

    int code = 0;
    // The same for what has an exit code of its own.
    const auto judge = [&](const char* name, auto function, const auto&... arguments) {
        const Expected<int> judged = function != nullptr ? function(arguments...) : elsewhere(name);
        if (judged) code = *judged;
        if (!judged) result = tl::unexpected(judged.error());
    };

    CLI::App* command = app.add_subcommand("list", "Shows all stages");
    command->add_flag("--json", json, "As JSON, with the properties of each");
    command->callback([&] { run("list", program.list, json); });

    command = app.add_subcommand("render", "Renders a stage, or a scene of a glTF file, to a PNG file");
    addInputOptions(*command, options)->required(false);
    command
        ->add_option("--scene", options.scene,
                     "A .gltf or .glb file in place of a stage; takes --environment, --size, --threads, --camera, "
                     "--tile, --samples")
        ->type_name("FILE");
    command->add_option("-o,--output", output, "The file; default: the stage's name")->type_name("FILE.png");
    bool watch = false;
    addShowOption(*command, options.show);
    addTargetOptions(*command, options);
    command->add_flag("--watch", watch, "Writes the picture again whenever the stage's file is saved");
    addCompilerOption(*command, options.compiler);
    command->callback([&, command] { result = renderWith(*command, options, output, watch, program); });

    command = app.add_subcommand("new", "Writes a stage of your own, complete and with comments, into one file");
    std::string newFile, from;
    command->add_option("file", newFile, "The file, such as my_shader.cpp")->required()->type_name("FILE.cpp");
    command->add_option("--from", from, "A stage to begin with, by number, name or file")->type_name("STAGE");
    command->callback([&] { run("new", program.newStage, newFile, from); });

    command = app.add_subcommand("gallery", "Renders every stage, and a page that shows them");
    std::string folder = "gallery";
    command->add_option("--out", folder, "The folder")->capture_default_str()->type_name("DIR");
    command->add_option("--threads", options.threads, "Threads; 0: one per processor")->check(CLI::Range(0, 256));
    std::string shard = "1/1";
    command->add_option("--shard", shard, "The second of eight parts of the stages: 2/8; all of them give the whole")
        ->type_name("I/N");
    command->callback([&] { run("gallery", program.gallery, folder, shard, options.threads); });

    command = app.add_subcommand("view",
                                 "Shows a stage in a window, and again whenever its file is saved, or a file: a .gltf "
                                 "or .glb scene, or a normal map with what is wrong with it");
    ViewOptions viewOptions;
    addInputOptions(*command, viewOptions.render);
    addShowOption(*command, viewOptions.render.show);
    addTargetOptions(*command, viewOptions.render);
    addCompilerOption(*command, viewOptions.render.compiler);
    command->add_option("--frames", viewOptions.frames, "Close after this many frames; 0: when the user does")
        ->check(CLI::Range(0, 1000000));
    command->add_option("--scale", viewOptions.scale, "How large text and controls are; default: the display's")
        ->check(CLI::Range(0.5f, 4.0f));
    command->callback([&] { run("view", program.view, viewOptions); });

    command = app.add_subcommand("hash", "Prints the hash of a stage's float colour and depth");
    addInputOptions(*command, options);
    addTargetOptions(*command, options);
    command->callback([&] { run("hash", program.hash, options); });

    command = app.add_subcommand("signature", "Prints what a stage's vertex programs hand to its fragment programs");
    command->add_option("stage", options.stage, "A stage, by number, name or file")->required();
    command->add_option("--set", options.settings, "A property, as name=value; may be repeated");
    command->add_option("--binormal", binormal, "For stages with both variants: where the binormal is computed")
        ->check(CLI::IsMember({"vertex", "fragment"}));
    command->callback([&] { run("signature", program.signature, options, binormal); });

    command = app.add_subcommand("explain", "Prints what drawing a stage took, and what was left out");
    addInputOptions(*command, options);
    command->add_flag("--json", json, "As JSON");
    command->callback([&] { run("explain", program.explain, options, json); });

    command = app.add_subcommand("trace", "Tells the life of one pixel: from the triangles around it to its byte");
    TraceOptions traceOptions;
    addInputOptions(*command, traceOptions.render);
    addTargetOptions(*command, traceOptions.render);
    CLI::Option_group* const what = command->add_option_group("one of");
    what->add_option("--pixel", traceOptions.pixel,
                     "Which pixel, counted from the upper left: 480,270. -: from standard input, one a line, each "
                     "answered by a line of JSON")
        ->type_name("X,Y");
    what->add_option("--vertex", traceOptions.vertex, "A vertex of the mesh instead: its vertex program, line by line")
        ->check(CLI::NonNegativeNumber);
    what->add_flag("--first-nan", traceOptions.firstNan,
                   "The first pixel, line and name instead where a NaN or an infinity appears");
    what->require_option(1);
    command->add_option("--draw", traceOptions.draw, "With --vertex: of which draw; 0: the first")
        ->check(CLI::NonNegativeNumber);
    command->add_flag("--all", traceOptions.all,
                      "Also the functions that the shader calls, and triangles that just miss");
    CLI::Option* const asJson = command->add_flag("--json", traceOptions.json, "As JSON");
    CLI::Option* const asPage =
        command->add_option("--html", traceOptions.html, "As a page, in one file that works offline")
            ->type_name("FILE.html")
            ->excludes(asJson);
    command
        ->add_option("--against", traceOptions.against,
                     "Another stage: the first value that differs there; committed: this stage as git has it")
        ->type_name("STAGE")
        ->excludes(asJson)
        ->excludes(asPage);
    command->callback([&] { run("trace", program.trace, traceOptions); });

    command = app.add_subcommand("bench",
                                 "Measures how fast frames are: of test scenes (with options of Google Benchmark), of "
                                 "stages with --stage, beside another rasterizer with --peer, or from a save to the "
                                 "picture with --live");
    BenchOptions benchOptions;
    PeerOptions peerOptions;
    LiveBenchOptions liveOptions;
    addBenchOptions(*command, benchOptions, peerOptions, liveOptions);
    command->allow_extras();
    command->callback([&, command] { result = benchWith(*command, benchOptions, peerOptions, liveOptions, program); });

    command = app.add_subcommand("import-environment",
                                 "Prefilters a picture of all directions for reflections by roughness, into one file");
    ImportEnvironmentOptions environmentOptions;
    addImportEnvironmentOptions(*command, environmentOptions);
    command->callback([&] { run("import-environment", program.importEnvironment, environmentOptions); });

    command = app.add_subcommand("check", "Golden tests: compares pictures of any program, and reviews what differs");
    CheckOptions checkOptions;
    addCheckCommands(*command, checkOptions);
    command->callback([&] { judge("check", program.check, checkOptions); });

    command = app.add_subcommand("exercise", "Lists the exercises, or writes one's file into the folder exercises");
    std::string exerciseName, exerciseFile;
    command->add_option("name", exerciseName, "An exercise, by number, such as 1.08a; without: lists all");
    command->callback([&] { run("exercise", program.exercise, exerciseName); });

    command = app.add_subcommand("check-exercise",
                                 "Says whether your file solves its exercise, and if not, which mistake gives its "
                                 "picture: exit code 0 solved, 1 not");
    command->add_option("file", exerciseFile, "Your file")->required()->type_name("FILE.cpp");
    command->callback([&] { judge("check-exercise", program.checkExercise, exerciseFile); });

    command = app.add_subcommand("grade",
                                 "Checks the files of a whole class, each in a sandbox: exit code 0 if all are "
                                 "solved, 1 if not");
    GradeOptions gradeOptions;
    addGradeOptions(*command, gradeOptions);
    command->callback([&] { judge("grade", program.grade, gradeOptions); });

    command = app.add_subcommand("render-submission", "What grade starts in a sandbox")->group("");
    std::string submission;
    command->add_option("file", submission)->required();
    command->callback([&] {
        if (program.renderSubmission != nullptr) program.renderSubmission(submission);
        result = elsewhere("grade");
    });

    command = app.add_subcommand("doctor", "Says what a normal map or height map is, and what is wrong with it");
    DoctorOptions doctorOptions;
    addDoctorOptions(*command, doctorOptions);
    command->callback([&] { judge("doctor", program.doctor, doctorOptions); });

    command = app.add_subcommand("report", "Measures what a chapter claims, and writes it down: text, table and plot");
    ReportOptions reportOptions;
    addReportOptions(*command, reportOptions);
    command->callback([&] { result = reportWith(reportOptions, program); });

    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp& help) {
        return app.exit(help);
    } catch (const CLI::ParseError& error) {
        std::fprintf(stderr, "relief: %s; see --help\n", error.what());
        return 2;
    }
    if (argc < 2) std::fputs(app.help().c_str(), stdout);
    if (!result) {
        std::fprintf(stderr, "relief: %s\n", result.error().message.c_str());
        return 2;
    }
    return code;
}

}  // namespace relief::samples
