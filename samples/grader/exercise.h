// An exercise: a stage with a gap, and what is known of wrong ways to fill it. It is a folder of samples/exercises:
//
//     1.08a_along_v/exercise.md         the task, hints, what stands in the gap at first, and the mistakes
//     1.08a_along_v/answer/answer.cpp   a stage, whose lines between the marks are what the learner writes
//     1.08a_along_v/answer/README.md    why
//     1.08a_along_v/goal.png, catalogue.txt, catalogue.png    what update_exercises makes of it (catalogue.h)
//     1.08a_along_v/start.txt           the learner's file, made by it, too: for the book's pages
//
// A mistake is a list of replacements within the lines of the gap: so the answer with a mistake in it is a text again,
// which can be compiled and drawn.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "relief/error.h"

namespace relief::samples::grader {

// What stands before and after a gap, in an answer and in a learner's file.
inline constexpr const char* kGapBegins = "// your turn";
inline constexpr const char* kGapEnds = "// end of your turn";

struct Replacement
{
    std::string from, to;
};

struct Mistake
{
    std::string name;      // "sign"
    std::string sentence;  // "Your v slope has the wrong sign", without a full stop
    std::string see;       // "See 1.08.", or empty
    std::vector<Replacement> changes;
};

// Of an open exercise: what has to be true of the picture (conditions.h).
struct Condition
{
    std::string measure;   // "mean", ...
    std::string relation;  // "<=" or ">="
    double number = 0.0;   // what the measure is held to,
    bool ofStart = false;  // as a part of what it is in the picture of the file as it was given
    std::string meaning;   // "A wet surface is darker"
};

struct Exercise
{
    std::string id;      // "1.08a"
    std::string title;   // "Along v"
    std::string stem;    // "1.08a_along_v"
    std::string folder;  // its path
    std::string stage;   // that it is about: "1.08"
    std::string kind;    // "fix", "derive", "predict" or "open"
    std::string task;    // paragraphs, as they stand
    std::vector<std::string> hints;
    std::vector<std::string> starts;  // of each gap: its lines at first
    std::vector<Mistake> also;        // other right answers
    std::vector<Mistake> mistakes;
    std::vector<Condition> conditions;  // of an open one
    std::string answer;                 // the text of answer.cpp

    bool isOpen() const { return kind == "open"; }
};

// One text of an exercise that is drawn for the catalogue.
struct Variant
{
    std::string name;                      // "answer", "start", a mistake's name, or two with + between them
    std::string text;                      // of the whole file
    std::vector<const Mistake*> mistakes;  // none, one or two
    bool isRight = false;
};

// All exercises, in the order of their ids. An error names the file that is not one, and what is wrong with it.
Expected<std::vector<Exercise>> allExercises();

// The exercise in this folder.
Expected<Exercise> readExercise(const std::string& folder);

// By id (1.08a, also 1.8a) or stem. An error names the nearest ones.
Expected<const Exercise*> findExercise(const std::vector<Exercise>& all, const std::string& name);

// The answer, the file as it is given, other right answers, every mistake, and all pairs of mistakes that change
// different places. An error where a replacement's text does not stand in the gap exactly once.
Expected<std::vector<Variant>> variantsOf(const Exercise& exercise);

// Where, in a text with marks, the lines of its gaps are: from, to.
struct Span
{
    std::size_t begin = 0, end = 0;
};
std::vector<Span> gapsOf(const std::string& text);

// Where in the answer a replacement changes something: without what both its texts begin and end with. Nothing where
// its text does not stand in a gap exactly once.
std::optional<Span> changedSpan(const Exercise& exercise, const Replacement& change);

// The learner's file: the answer with what stands in the gap at first, and a head with the task. `path` is the file's,
// as it is typed.
std::string learnersText(const Exercise& exercise, const std::string& path);

// The id in the head of a learner's file ("// Exercise 1.08a ..."), or in its name; empty: none.
std::string exerciseIdOf(const std::string& path, const std::string& text);

}  // namespace relief::samples::grader
