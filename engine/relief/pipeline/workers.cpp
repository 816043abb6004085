#include "relief/pipeline/workers.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <vector>

#include "relief/lanes/environment.h"
#include "relief/pipeline/limits.h"

#if !defined(RELIEF_NO_THREADS)
#include <condition_variable>
#include <mutex>
#include <system_error>
#include <thread>
#endif

namespace relief {

#if defined(RELIEF_NO_THREADS)

struct Workers::Pool
{
};

Workers::Workers(int) {}
int Workers::count() const
{
    return 1;
}

void Workers::run(int tasks, Job job)
{
    const DefaultFloatingPoint environment;
    for (int task = 0; task < tasks; ++task) job.call(job.context, task, 0);
}

#else

namespace {

// Waits for a condition by looking at it for some 50 us, which is how far apart the rounds of a frame are. Falling
// asleep and being woken costs as much, and more in a virtual machine. Gives way to other threads now and then. Whoever
// sees false has to sleep.
template <class Condition>
bool spinUntil(const Condition& condition)
{
    for (int i = 0; i < 1000; ++i) {
        if (condition()) return true;
        if (i % 16 == 15) std::this_thread::yield();
    }
    return false;
}

// A thread more; false where the system has no more of them. The ones that are there do the work.
template <class Function>
bool startThread(std::vector<std::thread>& threads, const Function& function)
{
#if defined(__cpp_exceptions)
    try {
        threads.emplace_back(function);
    } catch (const std::system_error&) {
        return false;
    }
#else
    threads.emplace_back(function);
#endif
    return true;
}

}  // namespace

struct Workers::Pool
{
    std::mutex mutex;
    std::condition_variable wake;
    std::condition_variable done;
    std::atomic<std::uint64_t> generation{0};  // of the job; a change wakes the workers
    std::atomic<int> busy{0};                  // workers that have not finished this job
    std::atomic<bool> stop{false};

    // Each worker begins with a run of tasks of its own, the same in every frame: what they write stays in its caches,
    // instead of moving from processor to processor. Whoever is done goes on with the others', from their ends: so what
    // it takes is nearly the same in every frame, too, and out of the owner's way.
    class alignas(64) Share
    {
    public:
        void set(int begin, int end)
        {
            ends.store(std::uint64_t{static_cast<std::uint32_t>(end)} << 32 | static_cast<std::uint32_t>(begin),
                       std::memory_order_relaxed);
        }

        // A task, or -1. Both ends are in one number, so that no task is given away twice.
        int takeFirst()
        {
            const std::uint64_t before = ends.fetch_add(1, std::memory_order_relaxed);
            return isEmpty(before) ? -1 : beginOf(before);
        }
        int takeLast()
        {
            const std::uint64_t before = ends.fetch_sub(std::uint64_t{1} << 32, std::memory_order_relaxed);
            return isEmpty(before) ? -1 : endOf(before) - 1;
        }

    private:
        static int beginOf(std::uint64_t both) { return static_cast<std::int32_t>(both); }
        static int endOf(std::uint64_t both) { return static_cast<std::int32_t>(both >> 32); }
        static bool isEmpty(std::uint64_t both) { return beginOf(both) >= endOf(both); }

        std::atomic<std::uint64_t> ends{0};  // [begin, end), the end in the upper half
    };

    Job job{};
    std::vector<Share> shares;  // one for each worker

    std::vector<std::thread> threads;

    void share(int tasks)
    {
        const auto count = static_cast<std::int64_t>(shares.size());
        for (std::int64_t i = 0; i < count; ++i) {
            shares[static_cast<std::size_t>(i)].set(static_cast<int>(tasks * i / count),
                                                    static_cast<int>(tasks * (i + 1) / count));
        }
    }

    void work(int worker)
    {
        const DefaultFloatingPoint environment;
        for (std::size_t i = 0; i < shares.size(); ++i) {
            Share& from = shares[(static_cast<std::size_t>(worker) + i) % shares.size()];
            for (int task; (task = i == 0 ? from.takeFirst() : from.takeLast()) >= 0;) {
                job.call(job.context, task, worker);
            }
        }
    }

    void loop(int worker)
    {
        std::uint64_t seen = 0;
        const auto called = [&] { return stop || generation != seen; };
        for (;;) {
            spinUntil(called);
            {
                std::unique_lock lock(mutex);
                wake.wait(lock, called);
                if (stop) return;
                seen = generation;
            }
            work(worker);
            if (--busy != 0) continue;
            const std::scoped_lock lock(mutex);  // the caller may be between looking and falling asleep
            done.notify_one();
        }
    }
};

Workers::Workers(int threads) : pool(std::make_unique<Pool>())
{
    if (threads <= 0) threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    threads = std::min(threads, kMaxThreads);
    pool->shares = std::vector<Pool::Share>(static_cast<std::size_t>(threads));
    for (int worker = 1; worker < threads; ++worker) {
        if (!startThread(pool->threads, [p = pool.get(), worker] { p->loop(worker); })) break;
    }
}

int Workers::count() const
{
    return static_cast<int>(pool->threads.size()) + 1;
}

void Workers::run(int tasks, Job job)
{
    Pool& p = *pool;
    if (tasks <= 0) return;
    p.job = job;
    p.share(tasks);
    if (tasks == 1 || p.threads.empty()) {
        p.work(0);
        return;
    }
    {
        const std::scoped_lock lock(p.mutex);
        p.busy = static_cast<int>(p.threads.size());
        ++p.generation;
    }
    p.wake.notify_all();
    p.work(0);
    const auto finished = [&] { return p.busy == 0; };
    if (spinUntil(finished)) return;
    std::unique_lock lock(p.mutex);
    p.done.wait(lock, finished);
}

#endif

Workers::~Workers()
{
#if !defined(RELIEF_NO_THREADS)
    if (pool == nullptr) return;
    {
        const std::scoped_lock lock(pool->mutex);
        pool->stop = true;
    }
    pool->wake.notify_all();
    for (std::thread& thread : pool->threads) thread.join();
#endif
}

Workers::Workers(Workers&&) noexcept = default;
Workers& Workers::operator=(Workers&& other) noexcept
{
    std::swap(pool, other.pool);
    return *this;
}

}  // namespace relief
