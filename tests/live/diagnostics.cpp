// What compilers print, in the learner's words.
#include <vector>

#include <doctest/doctest.h>

#include "live/compile.h"
#include "live/diagnostics.h"

namespace {

using namespace relief::samples::live;

}  // namespace

TEST_CASE("live: an error has the learner's line, with a mark below it")
{
    const auto found =
        parseDiagnostics("/a/s.cpp:2:5: error: 'albdo' was not declared in this scope; did you mean 'albedo'?\n",
                         "/a/s.cpp", "one\n\tx = albdo;\n");
    REQUIRE(found.size() == 1);
    CHECK(formatted(found) ==
          "s.cpp:2:5: 'albdo' is not declared here; did you mean 'albedo'?\n"
          "    2 | \tx = albdo;\n"
          "      | \t   ^\n");
}

TEST_CASE("live: the engine's own sentences come first, at the line that drew")
{
    const std::string text = "a\nb\nc\n";
    const std::string gnu =
        "/a/s.cpp:1:1: error: expected ';' before 'x'\n"
        "/engine/frame.h: In instantiation of 'void draw()':\n"
        "/a/s.cpp:3:15:   required from here\n"
        "/engine/program.h:200:19: error: static assertion failed: Interpolators must have exactly one SV_POSITION\n";
    const std::string clang =
        "/a/s.cpp:1:1: error: expected ';' after expression\n"
        "/engine/program.h:200:5: error: static_assert failed due to requirement 'hasOnePosition' \"Interpolators must "
        "have exactly one SV_POSITION\"\n"
        "/engine/frame.h:50:1: note: in instantiation of function template specialization 'x' requested here\n"
        "/a/s.cpp:3:15: note: in instantiation of function template specialization 'y' requested here\n";
    for (const std::string& output : {gnu, clang}) {
        const auto found = parseDiagnostics(output, "/a/s.cpp", text);
        REQUIRE(found.size() == 2);
        CHECK(found[0].fromCheck);
        CHECK(found[0].message == "Interpolators must have exactly one SV_POSITION");
        CHECK(found[0].line == 3);
        CHECK(found[0].source == "c");
        CHECK(found[1].message == "a ';' is missing before this");
        CHECK(found[1].line == 1);
    }
}

TEST_CASE("live: a header that is newer than what was built of it is named, with what to do")
{
    const std::string output =
        "fatal error: file '/r/samples/common/materials.h' has been modified since the precompiled header '/r/h.pch' "
        "was built: mtime changed (was 1, now 2)\nnote: please rebuild precompiled header '/r/h.pch'\n";
    const std::vector<Diagnostic> found = parseDiagnostics(output, "/r/a.cpp", "");
    REQUIRE(found.size() == 1);
    CHECK(found[0].message.starts_with("/r/samples/common/materials.h: has changed since Relief was built"));
}

TEST_CASE("live: types are called as in a stage")
{
    const auto found = parseDiagnostics(
        "/a/s.cpp:1:1: error: no viable conversion from 'LaneVector<relief::lanes16::Float, 3>' to "
        "'relief::lanes16::float4' (aka 'LaneVector<relief::lanes16::Float, 4>')\n",
        "/a/s.cpp", "x\n");
    REQUIRE(found.size() == 1);
    CHECK(found[0].message == "this is a float3, and a float4 is needed");
}

TEST_CASE("live: the stage's function is found by its look")
{
    CHECK(stageFunction("int x;\nStage my_stage()\n{\n}\n") == "my_stage");
    CHECK(stageFunction("    Stage no()\n").empty());
    CHECK(stageFunction("").empty());
}

TEST_CASE("live: programs are dealt out evenly, and not at all where two have one name")
{
    const Division six = divided({11, 12, 13, 14, 15, 16});
    CHECK(six.parts == std::min(mostParts(), 6u));
    std::vector<unsigned> counts(six.parts);
    for (const auto& [id, part] : six.owners) ++counts.at(part);
    for (const unsigned count : counts) CHECK(count >= 6 / six.parts);
    CHECK(divided({1, 2, 2}).parts == 1);
    CHECK(divided({1}).parts == 1);
}
