// The learner's code never runs in the process that has the window. One process is made early, by a fork, while this
// one has a single thread and no window: it has the engine and what stages read, but nobody's code. For each version of
// a stage it forks another one, which loads the object and draws it when it is asked to. That one may crash or never
// come back.
//
//     this process  --make-->  maker  --fork-->  renderer of version 1, of version 2, ...
//          \___________________draw / drawn______________/          a picture each, in memory that both see
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <sys/types.h>

#include "common/stage.h"
#include "live/toolchain.h"
#include "relief/pipeline/statistics.h"

namespace relief::samples::live {

// What is to be drawn: all that a user can change.
struct Look
{
    int width = 960, height = 540;
    std::optional<Camera> camera;       // none: the stage's
    std::vector<std::string> settings;  // "name=value", as of --set
    InputFiles files;
    int threads = 0, tileSize = 64, samples = 1;
    bool showTangents = false;
    float tangentScale = 0.1f, tangentOffset = 0.01f;
    std::string show;   // a view of the frame, by name (common/inside.h); empty: its picture
    bool hash = false;  // of the float colours and depths too: draws twice

    // A setting or view that the stage does not know, or a setting out of its range, is an error, or else left out:
    // after a new version, whose properties may be others.
    bool strict = true;
};

// A view that the frame has, for Look::show.
struct ViewName
{
    std::string name, meaning;
    bool operator==(const ViewName&) const = default;
};

// A stage as another process knows it: everything but what it draws.
struct Description
{
    std::string title, news;
    std::vector<Property> properties;
    Inputs inputs;
    Camera camera;
    std::vector<std::uint64_t> programs;
    std::vector<ViewName> views;  // of the last picture: which there are may follow from settings and files
};

struct Drawn
{
    double milliseconds = 0.0;  // of the frame alone
    Statistics statistics;
    std::uint64_t hash = 0;
    int width = 0, height = 0;
    Camera camera;  // that was looked through: the Look's, the stage's, or one for a mesh of the user's
};

// What became of a renderer that gives no more pictures.
struct Failure
{
    std::string what;  // "it divides by zero", ...
    int line = 0;      // of the learner's file; 0: not known
};

class Renderer
{
public:
    using Clock = std::chrono::steady_clock;

    ~Renderer();  // ends the process
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    void draw(const Look& look);

    // What came back since; never waits.
    struct News
    {
        std::optional<Description> loaded;
        std::optional<Drawn> drawn;
        std::vector<ViewName> views;         // of what was drawn
        std::optional<std::string> refused;  // one line; the renderer goes on
        std::optional<Failure> failure;      // it is gone
    };
    News poll();

    int descriptor() const { return socket; }
    bool drawing() const { return asked; }
    std::chrono::milliseconds patience() const;  // call poll() after so long, for the watchdog

    // Row by row, R, G, B, A from the lowest byte up. Of the last `drawn`, until draw().
    std::span<const std::uint32_t> pixels() const;

    const std::string& object() const { return file; }

private:
    friend class Maker;
    Renderer() = default;
    Failure failure(const std::string& what, std::span<const std::uintptr_t> counters) const;
    Failure stuck();
    bool isStuck() const;
    double processorSeconds() const;

    std::string file;  // the object
    std::string source;
    pid_t process = -1;
    int socket = -1, memory = -1;
    std::uintptr_t base = 0;  // where the object lies in that process
    std::uint32_t* picture = nullptr;
    std::size_t size = 0;  // of the memory, in bytes
    Look last;
    bool asked = false, begun = false;
    Clock::time_point since;  // of the last word
    double processorSince = 0.0;
    double millisecondsPerPixel = 0.0;
};

// The process that makes renderers.
class Maker
{
public:
    // Call it before this process has a second thread or a window.
    static Expected<std::unique_ptr<Maker>> start();
    ~Maker();
    Maker(const Maker&) = delete;
    Maker& operator=(const Maker&) = delete;

    Expected<std::unique_ptr<Renderer>> make(const std::string& object, const StageSource& source);

    // Loads what a stage reads, for all renderers that are made later; `bakes`: the baked sphere too (stage 1.23).
    // Comes back at once.
    void preload(const Inputs& inputs, const InputFiles& files, bool bakes);

private:
    Maker() = default;
    std::string preloaded;  // the last message about it
    int socket = -1;
    pid_t process = -1;
};

}  // namespace relief::samples::live
