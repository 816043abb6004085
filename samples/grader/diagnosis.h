// What a picture says of the file that drew it: whether it is the goal, and if not, which mistake gives it.
#pragma once

#include <string>
#include <vector>

#include "grader/catalogue.h"

namespace relief::samples::grader {

struct Diagnosis
{
    enum class Kind
    {
        solved,      // bit for bit
        nearly,      // solved, but for kCodes of 255 at most: the same sum in another order
        open,        // solved: all conditions hold
        exact,       // a known mistake, or two, bit for bit
        near,        // a known mistake, or two, but for little
        start,       // the file as it was given
        conditions,  // of an open exercise: some do not hold
        unknown
    };
    Kind kind = Kind::unknown;
    std::string entry;     // of the catalogue: which mistake; of `unknown` the nearest
    Distance fromGoal;     // over the whole picture
    double nearest = 0.0;  // of `near` and `unknown`: mean codes from that entry, over the small picture,
    double next = 0.0;     // and from the second nearest
    std::string sentence;  // for the learner, one paragraph

    bool isSolved() const { return kind == Kind::solved || kind == Kind::nearly || kind == Kind::open; }
};

// "solved", "nearly", ... for tables.
const char* wordOf(Diagnosis::Kind kind);

// As far as pictures may be apart that are called solved.
inline constexpr int kCodes = 2;

// A mistake is only named where its picture is that near, and that much nearer than any other entry's; and where the
// next one is farther than kTie, since small pictures of two mistakes can be the same.
inline constexpr double kNear = 2.0, kMargin = 4.0, kTie = 0.1;

Diagnosis diagnose(const Exercise& exercise, const Catalogue& catalogue, const Framebuffer& picture);

// The same from the picture's hash, 16 digits, and its codes, kWidth by kHeight.
Diagnosis diagnose(const Exercise& exercise, const Catalogue& catalogue, const std::string& hash, const Image8& codes);

// The conditions of an open exercise that a picture does not meet, with what was measured. Both are small pictures.
std::vector<std::string> unmet(const Exercise& exercise, const Image8& picture, const Image8& start);

}  // namespace relief::samples::grader
