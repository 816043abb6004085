// `exercise` and `check-exercise` as a learner types them: exit codes, and what they say of the same file as it is
// given, solved, and wrong in several ways.
#include <algorithm>
#include <fstream>

#include <doctest/doctest.h>

#include "along_v.h"
#include "contents.h"
#include "live_command.h"

namespace {

using namespace relief;
using namespace relief::samples::grader;

constexpr const char* kFile = "exercises/1.08a_along_v.cpp";

// What check-exercise says of such a file.
Outcome check(const TemporaryFolder& folder, const std::string& from, const std::string& to)
{
    folder.write("1.08a.cpp", answerWith(from, to));
    return runCommand(folder, "check-exercise 1.08a.cpp");
}

}  // namespace

TEST_CASE("exercises: a file is written once, and the list says what is begun and solved")
{
    const TemporaryFolder folder;
    CHECK(contains(runCommand(folder, "exercise").out, "  1.08a  derive   Along v "));
    const Outcome written = runCommand(folder, "exercise 1.08a");
    CHECK(written.code == 0);
    CHECK(written.out == std::string(kFile) + "\n");
    CHECK(folder.fileCount() == 3);  // the folder, and what the command printed
    const Outcome again = runCommand(folder, "exercise 1.08a");
    CHECK(again.code == 2);
    CHECK(contains(again.err, "is there already"));
    CHECK(contains(runCommand(folder, "exercise").out, "begun"));
    const Outcome asGiven = runCommand(folder, std::string("check-exercise ") + kFile);
    CHECK(asGiven.code == 1);
    CHECK(contains(asGiven.out, "as it was given"));
    folder.write(kFile, answerWith("// your turn", "// your turn"));
    const Outcome solved = runCommand(folder, std::string("check-exercise ") + kFile);
    CHECK(solved.code == 0);
    CHECK(contains(solved.out, "Solved, bit for bit."));
    CHECK(contains(solved.out, "answer/README.md"));
    CHECK(contains(runCommand(folder, "exercise").out, "\n1 of "));
    CHECK(contents(folder / "exercises/solved.txt") == "1.08a\n");
}

TEST_CASE("exercises: what is wrong is said, and where to read")
{
    const TemporaryFolder folder;
    const Outcome sign = check(folder, "(v1 - v2)", "(v2 - v1)");
    CHECK(sign.code == 1);
    CHECK(
        sign.out ==
        "Your v slope has the wrong sign: bumps are dents. Your picture is, bit for bit, what that gives. See 1.08.\n");
    const Outcome both = check(folder, "(v1 - v2) * bumpScale", "(v2 - v1)");
    CHECK(contains(both.out, "Two things: Your v slope has the wrong sign"));
    CHECK(contains(both.out, "not scaled by bumpScale"));
    const Outcome near = check(folder, "(v1 - v2) * bumpScale", "(v2 - v1) * bumpScale * 1.02f");
    CHECK(near.code == 1);
    CHECK_MESSAGE(contains(near.out, "wrong sign: bumps are dents. Your picture is nearest"), near.out);
    const Outcome order = check(folder, "(v1 - v2) * bumpScale", "v1 * bumpScale - v2 * bumpScale");
    CHECK(order.code == 0);
    CHECK_MESSAGE(contains(order.out, "Solved, to 1 code of 255"), order.out);
    const Outcome unknown = check(folder, "(v1 - v2) * bumpScale", "sin(v1 * 40.0f)");
    CHECK(unknown.code == 1);
    CHECK_MESSAGE(contains(unknown.out, "none of the"), unknown.out);
}

TEST_CASE("exercises: what gives no picture is said in words")
{
    const TemporaryFolder folder;
    const Outcome typo = check(folder, "const Float v1", "const Float w1");
    CHECK(typo.code == 1);
    CHECK(contains(typo.out, "1.08a.cpp:"));
    CHECK(contains(typo.out, "'v1' is not declared here"));
    CHECK(contains(typo.out, "Not compiled"));
    const Outcome wrongStruct = check(folder, "    SV_POSITION position;\n", "    float4 position;\n");
    CHECK(wrongStruct.code == 1);
    CHECK_MESSAGE(contains(wrongStruct.out, "SV_POSITION"), wrongStruct.out);
    const Outcome crash = check(folder, "const float2 dv", "*static_cast<volatile int*>(nullptr) = 1; const float2 dv");
    CHECK(crash.code == 1);
    CHECK_MESSAGE(contains(crash.out, "crashed"), crash.out);
}

TEST_CASE("exercises: a word that is none is one line and exit code 2")
{
    const TemporaryFolder folder;
    folder.write("mine.cpp", "// nothing\n");
    const std::pair<const char*, const char*> all[] = {{"exercise 9.99z", "there is no exercise '9.99z'"},
                                                       {"check-exercise 1.08a", "name your file"},
                                                       {"check-exercise gone.cpp", "there is no such file"},
                                                       {"check-exercise mine.cpp", "does not say which exercise"}};
    for (const auto& refused : all) {
        CAPTURE(refused.first);
        const Outcome outcome = runCommand(folder, refused.first);
        CHECK(outcome.code == 2);
        CHECK(contains(outcome.err, refused.second));
        CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    }
}
