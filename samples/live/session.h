// A stage whose picture follows its file. One thread, no window: whoever has a window calls update() in its loop and
// shows what is there.
//
//     file saved -> watch -> compile -> renderer's process -> picture
//
// Whatever goes wrong, the last good picture stays, and problem() says what it is.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "live/compile.h"
#include "live/renderer.h"
#include "live/watch.h"

namespace relief::samples::live {

// Milliseconds from a save to its picture.
struct Times
{
    double notice = 0.0;   // from the first sign of a change until it is quiet and read
    double compile = 0.0;  // all parts
    double link = 0.0;
    double load = 0.0;  // a process, the object, and what the stage reads
    double draw = 0.0;  // the frame, and its way here
    double total() const { return notice + compile + link + load + draw; }
};

struct Picture
{
    int version = 0;  // of the file; 0: nothing was drawn yet
    Drawn drawn;
    std::vector<std::uint32_t> pixels;  // R, G, B, A from the lowest byte up; row 0 is the top row
};

// What is wrong with the file as it is now.
struct Problem
{
    std::vector<Diagnostic> diagnostics;  // the first one first; never empty
    bool isRefusal = false;               // not the file: a setting or an input of the Look
    std::string text() const { return formatted(diagnostics); }
};

class Session
{
public:
    // What may have changed; call the functions below.
    struct News
    {
        bool picture = false, stage = false, problem = false, compiling = false;
        bool any() const { return picture || stage || problem || compiling; }
    };

    // Begins to compile, and returns at once. Forks: before this process has threads or a window. An error where the
    // file, a compiler or a process is missing. The maker can be shared by several sessions, and outlives them.
    // `compiler`: "g++" or "clang++"; empty: the fastest.
    static Expected<std::unique_ptr<Session>> open(const StageSource& source, const Look& look, Maker& maker,
                                                   const std::string& compiler = "");

    // Draws with other settings, as soon as what is being drawn is done; of several only the last.
    void look(const Look& look);
    const Look& look() const { return wanted; }

    // Does what is to be done now; waits up to `patience` for something to do.
    News update(std::chrono::milliseconds patience = std::chrono::milliseconds(0));

    // For a poll() of one's own, of at most so long; then update().
    std::vector<int> descriptors() const;
    std::chrono::milliseconds patience() const;

    const Picture& picture() const { return shown; }
    const Description* stage() const { return description ? &*description : nullptr; }  // of the picture's version
    const Problem* problem() const { return trouble ? &*trouble : nullptr; }
    bool compiling() const { return compile != nullptr; }

    // Whether all that was saved and asked for is there, or has a problem.
    bool idle() const { return !compile && !(incoming && incoming->drawing()) && !(current && current->drawing()); }

    const Times& times() const { return lastTimes; }  // of the last version that was shown
    const StageSource& source() const { return itsSource; }

private:
    Session(const StageSource& source, const Look& look, Maker& maker, const Toolchain& toolchain,
            PrivateFolder folder);
    void save(std::string text, Watch::Clock::time_point noticed);
    void begin();
    void compiled(Compiled result, News& news);
    void hear(std::unique_ptr<Renderer>& renderer, News& news);
    void lost(std::unique_ptr<Renderer>& renderer, const Failure& failure, News& news);
    void show(const Renderer& renderer, const Drawn& drawn);
    void complain(std::vector<Diagnostic> diagnostics, News& news);

    StageSource itsSource;
    Look wanted;
    Maker& maker;
    const Toolchain& toolchain;
    PrivateFolder folder;
    Watch watch;

    std::string text;  // that is compiled, or was last
    int version = 0;   // of that text
    Division division = {.parts = mostParts(), .owners = {}};
    std::unique_ptr<Compile> compile;
    std::unique_ptr<Renderer> incoming;  // the newest version, until its first picture
    std::unique_ptr<Renderer> current;
    std::unique_ptr<Renderer> previous;  // comes back if the current one crashes
    int currentVersion = 0, previousVersion = 0;
    bool waiting = false;  // a Look that nobody draws yet
    std::string lastGood;  // the object that was last shown

    Picture shown;
    std::optional<Description> description, previousDescription, incomingDescription;
    std::optional<Problem> trouble;
    bool strict = true;
    bool replaying = false;
    Times lastTimes, newTimes;
    Watch::Clock::time_point stamp;
};

}  // namespace relief::samples::live
