// Exercise 1.08a, and its answer with other words in it.
#pragma once

#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "grader/exercise.h"

inline const relief::samples::grader::Exercise& alongV()
{
    static const std::vector<relief::samples::grader::Exercise> all = relief::samples::grader::allExercises().value();
    return *findExercise(all, "1.08a").value();
}

inline std::string answerWith(const std::string& from, const std::string& to, const std::string& head = "")
{
    std::string text = head + alongV().answer;
    REQUIRE(text.find(from) != std::string::npos);
    return text.replace(text.find(from), from.size(), to);
}
