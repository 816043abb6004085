// Every experiment agrees with its reference values, all its variants run, and none has an error that is no number.
// Fewer samples than `relief report error` takes.
#include <cmath>

#include <doctest/doctest.h>

#include "experiments/experiments.h"

using namespace relief::experiments;

namespace {

void checkExperiments(std::size_t part, std::size_t parts)
{
    const std::vector<Entry>& all = experiments();
    for (std::size_t i = part; i < all.size(); i += parts) {
        const Experiment e = all[i].make({.full = false});
        CAPTURE(e.id);
        CHECK(e.id == all[i].id);
        for (const Check& check : e.checks) {
            CAPTURE(check.what);
            CAPTURE(check.expected);
            const double measured = check.measured();
            CAPTURE(measured);
            CHECK(check.holds(measured));
        }
        Rows rows;
        for (const Variant& v : e.variants) {
            CAPTURE(v.name);
            CAPTURE(v.parameter);
            v.work.run();
            if (v.streaming.run) v.streaming.run();
            CHECK(v.work.items > 0.0);
            const Outcome outcome = v.outcome();
            CHECK(!std::isnan(outcome.error.max));
            CHECK(outcome.error.rms <= outcome.error.max * 1.000001);
            CHECK(outcome.error.count > 0);
            if (!rows.all.empty()) CHECK(outcome.facts.size() == rows.all[0].outcome.facts.size());
            rows.all.push_back({.name = v.name, .parameter = v.parameter, .outcome = outcome});
        }
        CHECK(!e.finding(rows).empty());
    }
}

}  // namespace

TEST_CASE("experiments: their numbers are in order and occur once")
{
    std::string before;
    for (const Entry& entry : experiments()) {
        CHECK(std::string(entry.id) > before);
        before = entry.id;
    }
}

// In four parts, for as many processors.
TEST_CASE("experiments: reference values hold, part 1 of 4")
{
    checkExperiments(0, 4);
}
TEST_CASE("experiments: reference values hold, part 2 of 4")
{
    checkExperiments(1, 4);
}
TEST_CASE("experiments: reference values hold, part 3 of 4")
{
    checkExperiments(2, 4);
}
TEST_CASE("experiments: reference values hold, part 4 of 4")
{
    checkExperiments(3, 4);
}
