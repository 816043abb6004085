// What the right answer of an exercise and every known mistake look like: a hash of each, and a small picture. Made by
// update_exercises, which draws them all; the tests draw them again.
#pragma once

#include <string>
#include <vector>

#include "grader/exercise.h"
#include "grader/picture.h"

namespace relief::samples::grader {

struct Entry
{
    std::string name;  // of the variant
    std::string hash;  // 16 digits
    Image8 small;
};

struct Catalogue
{
    std::vector<Entry> entries;  // the answer first, then the file as it is given
    Image8 goal;                 // the answer's picture
};

// catalogue.txt (a line "hash name" each), catalogue.png (the small pictures, one below the other) and goal.png.
Expected<Catalogue> readCatalogue(const Exercise& exercise);
Expected<void> writeCatalogue(const Exercise& exercise, const Catalogue& catalogue);
bool same(const Catalogue& first, const Catalogue& second);

// Draws every variant: compiles them in one go, and loads them into this program. A pair whose picture is another
// entry's is left out: one of its mistakes hides the other. An error where two other pictures are the same, or where a
// mistake does not show: less than kLeastSeen codes away in fewer than kLeastPixels pixels.
inline constexpr int kLeastSeen = 4, kLeastPixels = 100;
Expected<Catalogue> drawCatalogue(const Exercise& exercise);

// The variants as one file: each in a namespace of its own, all of them in the list `relief_variants`.
std::string allInOne(const Exercise& exercise, const std::vector<Variant>& variants);

}  // namespace relief::samples::grader
