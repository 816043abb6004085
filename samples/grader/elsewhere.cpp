// Where no stage is compiled while the program runs (live/elsewhere.cpp), nothing can be checked.
#include "grader/commands.h"
#include "grader/goal.h"
#include "grader/submission.h"

#include <cstdlib>

namespace relief::samples {

namespace {

tl::unexpected<Error> needsLinux()
{
    return fail("exercises take Linux and a clone of Relief's sources, where ./relief compiles them");
}

}  // namespace

Expected<void> exercise(const std::string&)
{
    return needsLinux();
}
Expected<int> checkExercise(const std::string&)
{
    return needsLinux();
}
Expected<int> grade(const GradeOptions&)
{
    return needsLinux();
}
std::optional<live::StageSource> grader::goalOf(const live::StageSource&)
{
    return std::nullopt;
}
void grader::renderSubmission(const std::string&)
{
    std::exit(2);
}

}  // namespace relief::samples
