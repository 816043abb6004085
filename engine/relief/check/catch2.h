// Golden tests in Catch2, version 3 or 2. One file of the program defines RELIEF_CHECK_MAIN before it includes this,
// and has
//
//   int main(int argc, char** argv) { return relief::goldenMain(argc, argv, {.goldens = "goldens"}); }
//
// A golden is named after its test case and the sections that it stands in.
#pragma once

#if __has_include(<catch2/catch_test_macros.hpp>)
#include <catch2/catch_test_macros.hpp>
#if defined(RELIEF_CHECK_MAIN)
#include <catch2/catch_session.hpp>
#include <catch2/catch_test_case_info.hpp>
#include <catch2/catch_test_spec.hpp>
#include <catch2/interfaces/catch_interfaces_config.hpp>
#include <catch2/internal/catch_test_case_registry_impl.hpp>
#include <catch2/reporters/catch_reporter_event_listener.hpp>
#include <catch2/reporters/catch_reporter_registrars.hpp>
#endif
#else
#if defined(RELIEF_CHECK_MAIN) && !defined(CATCH_CONFIG_RUNNER)
#define CATCH_CONFIG_RUNNER
#endif
#include <catch2/catch.hpp>
#endif

#include <set>
#include <string>

#include "relief/check/test_program.h"

namespace relief {

namespace detail {

#if defined(RELIEF_CHECK_MAIN)
#if defined(CATCH_VERSION_MAJOR) && CATCH_VERSION_MAJOR < 3
using CatchListener = Catch::TestEventListenerBase;
inline const Catch::TestCaseInfo& infoOf(const Catch::TestCaseStats& test)
{
    return test.testInfo;
}
#else
using CatchListener = Catch::EventListenerBase;
inline const Catch::TestCaseInfo& infoOf(const Catch::TestCaseStats& test)
{
    return *test.testInfo;
}
#endif

// Follows the run: which test and sections it is in, and which tests had no turn.
struct GoldenListener : CatchListener
{
    using CatchListener::CatchListener;

    void testCaseStarting(const Catch::TestCaseInfo& test) override { started.insert(test.name); }
    void testCaseEnded(const Catch::TestCaseStats& test) override
    {
        if (!test.totals.assertions.allOk()) goldenTests().run->failed(infoOf(test).name);
        goldenTests().test.clear();
    }
    // The first one is the test itself.
    void sectionStarting(const Catch::SectionInfo& section) override { goldenTests().test.push_back(section.name); }
    void sectionEnded(const Catch::SectionStats&) override
    {
        if (!goldenTests().test.empty()) goldenTests().test.pop_back();
    }
    void testRunEnded(const Catch::TestRunStats& run) override
    {
        for (const auto& test : Catch::getAllTestCasesSorted(*m_config)) {
            if (started.count(test.getTestCaseInfo().name) == 0) goldenTests().run->failed(test.getTestCaseInfo().name);
        }
        goldenTests().isWhole = !run.aborting && !m_config->hasTestFilters() && m_config->getSectionsToRun().empty();
    }

    std::set<std::string> started;
};

CATCH_REGISTER_LISTENER(GoldenListener)
#endif

inline bool reportGolden(const Expected<void>& result, const char* file, int line)
{
    const std::string message = result ? "" : result.error().message;
    Catch::AssertionHandler handler("expectGolden", Catch::SourceLineInfo(file, static_cast<std::size_t>(line)),
                                    Catch::StringRef(), Catch::ResultDisposition::ContinueOnFailure);
    handler.handleMessage(result ? Catch::ResultWas::Ok : Catch::ResultWas::ExplicitFailure, std::string(message));
    handler.complete();
    return result.has_value();
}

}  // namespace detail

}  // namespace relief

#include "relief/check/expect_golden.h"

namespace relief {

#if defined(RELIEF_CHECK_MAIN)
// What main() returns. Takes --update, and all that Catch2 takes.
inline int goldenMain(int argc, char** argv, GoldenOptions options)
{
    return detail::runGoldenTests(argc, argv, std::move(options),
                                  [](int count, char** words) { return Catch::Session().run(count, words); });
}
#endif

}  // namespace relief
