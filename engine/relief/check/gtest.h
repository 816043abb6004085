// Golden tests in GoogleTest. One file of the program has
//
//   int main(int argc, char** argv) { return relief::goldenMain(argc, argv, {.goldens = "goldens"}); }
//
// A golden is named Suite.Test.
#pragma once

#include <gtest/gtest.h>

#include "relief/check/test_program.h"

namespace relief {

namespace detail {

// Follows the run: which test it is in, and which tests had no turn.
struct GoldenListener : ::testing::EmptyTestEventListener
{
    static std::string nameOf(const ::testing::TestInfo& test)
    {
        return std::string(test.test_suite_name()) + "." + test.name();
    }
    void OnTestStart(const ::testing::TestInfo& test) override { goldenTests().test = {nameOf(test)}; }
    void OnTestEnd(const ::testing::TestInfo&) override { goldenTests().test.clear(); }
    void OnTestProgramEnd(const ::testing::UnitTest& program) override
    {
        for (int i = 0; i < program.total_test_suite_count(); ++i) {
            const ::testing::TestSuite& suite = *program.GetTestSuite(i);
            for (int k = 0; k < suite.total_test_count(); ++k) {
                const ::testing::TestInfo& test = *suite.GetTestInfo(k);
                const bool passed = test.should_run() && test.result()->Passed();
                if (!passed || test.is_in_another_shard()) goldenTests().run->failed(nameOf(test));
            }
        }
        goldenTests().isWhole = GTEST_FLAG_GET(filter) == "*";
    }
};

inline bool reportGolden(const Expected<void>& result, const char* file, int line)
{
    if (!result) ADD_FAILURE_AT(file, line) << result.error().message;
    return result.has_value();
}

}  // namespace detail

}  // namespace relief

#include "relief/check/expect_golden.h"

namespace relief {

// What main() returns. Takes --update, and all that GoogleTest takes.
inline int goldenMain(int argc, char** argv, GoldenOptions options)
{
    return detail::runGoldenTests(argc, argv, std::move(options), [](int count, char** words) {
        ::testing::InitGoogleTest(&count, words);
        ::testing::UnitTest::GetInstance()->listeners().Append(new detail::GoldenListener);  // which owns it
        return RUN_ALL_TESTS();
    });
}

}  // namespace relief
