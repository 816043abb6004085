// Golden tests in doctest. One file of the program defines RELIEF_CHECK_MAIN before it includes this, and has
//
//   int main(int argc, char** argv) { return relief::goldenMain(argc, argv, {.goldens = "goldens"}); }
//
// A golden is named after its test case and the subcases that it stands in.
#pragma once

#include <cstring>

#if defined(RELIEF_CHECK_MAIN) && !defined(DOCTEST_CONFIG_IMPLEMENT)
#define DOCTEST_CONFIG_IMPLEMENT
#endif
#include <doctest/doctest.h>

#include "relief/check/test_program.h"

namespace relief {

namespace detail {

// Follows the run: which test and subcases it is in, and which tests had no turn.
struct GoldenReporter : doctest::IReporter
{
    explicit GoldenReporter(const doctest::ContextOptions&) {}

    void test_case_start(const doctest::TestCaseData& test) override
    {
        ++seen;
        name = test.m_name;
        goldenTests().test = {name};
    }
    void test_case_reenter(const doctest::TestCaseData&) override { goldenTests().test = {name}; }
    void test_case_end(const doctest::CurrentTestCaseStats& test) override
    {
        if (!test.testCaseSuccess) goldenTests().run->failed(name);
        goldenTests().test.clear();
    }
    void subcase_start(const doctest::SubcaseSignature& subcase) override
    {
        goldenTests().test.push_back(subcase.m_name.c_str());
    }
    void subcase_end() override
    {
        if (goldenTests().test.size() > 1) goldenTests().test.pop_back();
    }
    void test_case_skipped(const doctest::TestCaseData& test) override
    {
        ++seen;
        isFiltered = isFiltered || !test.m_skip;
        goldenTests().run->failed(test.m_name);
    }
    void test_run_end(const doctest::TestRunStats& run) override
    {
        goldenTests().isWhole = !isFiltered && seen == run.numTestCases;
    }
    void report_query(const doctest::QueryData&) override {}
    void test_run_start() override {}
    void test_case_exception(const doctest::TestCaseException&) override {}
    void log_assert(const doctest::AssertData&) override {}
    void log_message(const doctest::MessageData&) override {}

    unsigned seen = 0;
    bool isFiltered = false;
    std::string name;
};

inline bool reportGolden(const Expected<void>& result, const char* file, int line)
{
    if (!result) DOCTEST_ADD_FAIL_CHECK_AT(file, line, result.error().message);
    return result.has_value();
}

}  // namespace detail

}  // namespace relief

#include "relief/check/expect_golden.h"

namespace relief {

#if defined(RELIEF_CHECK_MAIN)
// What main() returns. Takes --update, and all that doctest takes.
inline int goldenMain(int argc, char** argv, GoldenOptions options)
{
    doctest::registerReporter<detail::GoldenReporter>("relief", 0, false);
    return detail::runGoldenTests(argc, argv, std::move(options), [](int count, char** words) {
        doctest::Context context(count, words);
        const int code = context.run();
        for (int i = 1; i < count; ++i) {  // a filter of subcases leaves no trace in the run
            if (std::strstr(words[i], "subcase") != nullptr || std::strstr(words[i], "sc=") != nullptr ||
                std::strstr(words[i], "sce=") != nullptr)
                detail::goldenTests().isWhole = false;
        }
        return code;
    });
}
#endif

}  // namespace relief
