// A trace in words: a tree of short sentences, which becomes text, a page, or the first difference of two.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "relief/trace/pixel_trace.h"
#include "relief/trace/vertex_trace.h"
#include "trace/traced_stage.h"

namespace relief::samples::trace {

using relief::trace::PixelTrace;

// What a trace is of: where its lines are looked up, and how one gets it again.
struct Subject
{
    std::string stage;               // "1.25 Lit scene"
    std::string command;             // that makes this trace
    std::string file;                // of its events
    std::vector<std::string> lines;  // of that file

    Subject(const TracedStage& its, std::string itsCommand);
    std::string line(const ::relief::trace::Site& site) const;  // without blanks around it; empty for other files
};

// A value in the quad's four pixels, and its differences in the pixel's row and column.
struct Quad
{
    std::array<std::string, 4> values;  // upper left, upper right, lower left, lower right
    std::string ddx, ddy;               // empty for what is no number
    int pixel = 0;                      // the one that is followed
};

struct Node
{
    std::string label, value;
    int line = 0;       // of the source, where a value has one
    std::string place;  // "file:line" of a function that was called
    std::vector<Node> children;
    std::optional<Quad> quad;                       // where the four are not the same
    std::string code;                               // the source's line
    std::optional<std::array<float, 3>> color;      // a linear colour to show
    std::optional<std::array<float, 3>> direction;  // a direction to show
    bool isInvalid = false;                         // has a NaN or an infinity
    bool isFolded = false;                          // of interest only when asked for
};

// What stands before its value: "62  i.normal".
std::string titleOf(const Node& node);

Node tell(const PixelTrace& trace, const Subject& subject);
Node tell(const ::relief::trace::VertexTrace& trace, const Subject& subject);

// Without what is folded, or with all of it.
std::string toText(const Node& node, bool all);

// One file that works offline. `picture`: all of it, row 0 on top, R, G, B, A from the lowest byte up.
Expected<std::string> toHtml(const PixelTrace& trace, const Subject& subject, std::span<const std::uint32_t> picture);

// The schema is in docs/life_of_a_pixel.md.
std::string toJson(const PixelTrace& trace, const Subject& subject, bool inOneLine = false);

std::string errorToJson(const std::string& message);  // a line

// The first place where two traces differ, in words: the way to it, and what each has there. Where in its source a
// value stands is no difference. Empty: they do not differ.
std::string firstDifference(const Node& a, const Node& b);

}  // namespace relief::samples::trace
