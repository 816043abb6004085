// A class: every learner's files, run and diagnosed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "grader/diagnosis.h"
#include "grader/submission.h"

namespace relief::samples::grader {

struct Graded
{
    std::string learner, file, id, title;  // the file relative to the folder; id and title empty: not known
    std::string verdict;                   // a word or two: "solved", "mistake", "not compiled", ...
    std::string sentence;                  // for the learner
    std::string gap;                       // what stands in the gaps, without spaces and comments
    std::vector<std::string> twins;        // learners with the same text in the gap
    std::optional<Diagnosis> diagnosis;    // where there is a picture
    std::optional<Image8> picture;
    double seconds = 0.0;
    bool isSolved = false;
};

// Shorter gaps than this are the same by chance. In characters that are no spaces and no comments.
inline constexpr std::size_t kLeastShared = 60;

// index.html with pictures beside it, grades.json and grades.csv.
Expected<void> writeGrades(const std::string& folder, const std::vector<Graded>& all,
                           const std::vector<Exercise>& exercises);

// Text of other people's, for a terminal or a table: one line, nothing but what can be printed.
std::string printable(const std::string& text);

}  // namespace relief::samples::grader
