// The life of one pixel after the other of the window's picture, line by line. Another process tells it (`trace --pixel
// -`): it compiles the stage once, a second or two, and answers each further pixel within a frame's time.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "live/renderer.h"
#include "view/child.h"

namespace relief::samples {

// A value of a line of the fragment program, in the four pixels of the quad.
struct PixelStep
{
    int line = 0;
    std::string file, code, function, name;
    std::array<std::string, 4> values;  // upper left, upper right, lower left, lower right
    bool isInvalid = false;             // has a NaN or an infinity in the pixel
};

struct PixelLife
{
    int x = 0, y = 0;
    std::string summary;  // what covers it, and which triangle was the last to be drawn
    std::vector<PixelStep> steps;
    int inQuad() const { return (x & 1) + 2 * (y & 1); }
};

class PixelTeller
{
public:
    // Wants a pixel of what is shown: `version` is another number whenever that may be another picture. One wish is
    // kept, the last; none of a pixel that is known.
    void ask(const live::StageSource& source, const live::Look& look, int version, int x, int y);

    // Takes what came; true if there is news. Never waits.
    bool poll();
    bool isTelling() const { return waits || wish; }

    // One that was told, null: not yet; and why the last one was not, in a line.
    const PixelLife* told(int x, int y) const;
    const std::string& problem() const { return complaint; }

    int descriptor() const { return waits ? process.stream() : -1; }  // call poll() when it is readable

private:
    using Point = std::pair<int, int>;  // x, y
    void start(const std::string& command);
    void stop();
    void send();
    void take(const std::string& line);

    std::string running;  // the command, and the version that it was started for
    Child process;
    bool waits = false;
    std::optional<Point> wish, asked;
    std::string received, complaint;
    std::map<Point, PixelLife> lives;  // of what is running
};

}  // namespace relief::samples
