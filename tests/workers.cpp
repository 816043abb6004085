// The pool of threads: every task runs once, the pool can be used again, and all of them compute alike.
#include "relief/pipeline/workers.h"

#include <atomic>
#include <cfenv>
#include <memory>
#include <utility>

#include "pipeline_fixture.h"

using namespace fixture;

TEST_CASE("workers: every task runs exactly once, by a worker with a valid number (S-1005)")
{
    for (const int threads : {0, 1, 2, 3, 8, 40}) {
        Workers workers(threads);
        CHECK(workers.count() >= 1);
#if !defined(RELIEF_NO_THREADS)
        if (threads > 0) CHECK(workers.count() == threads);
#endif
        for (const int tasks : {0, -3, 1, 2, 7, 1000}) {
            std::vector<std::atomic<int>> ran(static_cast<std::size_t>(std::max(tasks, 0)));
            std::atomic<int> badWorker = 0;
            workers.run(tasks, [&](int task, int worker) {
                ++ran[static_cast<std::size_t>(task)];
                badWorker += worker < 0 || worker >= workers.count();
            });
            int wrong = 0;
            for (const std::atomic<int>& count : ran) wrong += count != 1;
            measured("tasks not run once", wrong, 0);
            CHECK(badWorker == 0);
        }
    }
}

TEST_CASE("workers: two tasks never share a worker's number at the same time")
{
    Workers workers(4);
    std::vector<std::atomic<int>> busy(static_cast<std::size_t>(workers.count()));
    std::atomic<int> clashes = 0;
    workers.run(2000, [&](int, int worker) {
        clashes += busy[static_cast<std::size_t>(worker)].fetch_add(1) != 0;
        busy[static_cast<std::size_t>(worker)].fetch_sub(1);
    });
    CHECK(clashes == 0);
}

TEST_CASE("workers: many short jobs one after the other (S-1003)")
{
    Workers workers(3);
    long long sum = 0;
    const int jobs = trials(5000, 5000);
    for (int job = 0; job < jobs; ++job) {
        // What one job wrote, without any lock, the next one may read: run() returns when all is done.
        int results[5] = {};
        workers.run(5, [&](int task, int) { results[task] = task + job; });
        for (const int result : results) sum += result;
    }
    CHECK(sum == 10LL * jobs + 5LL * jobs * (jobs - 1) / 2);
}

TEST_CASE("workers: a pool can be moved, and destroyed without ever having run")
{
    Workers first(3);
    Workers second(std::move(first));
    std::atomic<int> ran = 0;
    second.run(10, [&](int, int) { ++ran; });
    CHECK(ran == 10);
    Workers third(2);
    third = std::move(second);
    third.run(10, [&](int, int) { ++ran; });
    CHECK(ran == 20);
    for (int i = 0; i < trials(200); ++i) Workers unused(5);
}

TEST_CASE("workers: tasks round to nearest and keep subnormals, and the caller's mode is given back (S-1008)")
{
    // Computed at run time: volatile keeps the compiler from doing it in its own mode.
    const auto third = [] {
        volatile float one = 1.0f, three = 3.0f;
        return one / three;
    };
    const auto tiny = [] {
        volatile float a = 1e-30f, b = 1e-10f;
        return a * b;
    };
    const float nearest = third(), subnormal = tiny();
    REQUIRE(subnormal > 0.0f);
    for (const int threads : {1, 3}) {
        for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
            std::atomic<int> wrong = 0;
            REQUIRE(std::fesetround(mode) == 0);
#if defined(__SSE2__)
            _mm_setcsr(_mm_getcsr() | 0x8040u);  // flush results to zero, take subnormals for zero
            const unsigned before = _mm_getcsr() & ~0x3fu;
#endif
            Workers workers(threads);  // new threads inherit the mode
            workers.run(50, [&](int, int) { wrong += third() != nearest || tiny() != subnormal; });
            const int roundingAfter = std::fegetround();
#if defined(__SSE2__)
            const unsigned after = _mm_getcsr() & ~0x3fu;
            _mm_setcsr(0x1f80u);
#endif
            std::fesetround(FE_TONEAREST);
            measured("tasks with another mode", wrong.load(), 0);
            CHECK(roundingAfter == mode);
#if defined(__SSE2__)
            CHECK(after == before);
#endif
        }
    }
}
