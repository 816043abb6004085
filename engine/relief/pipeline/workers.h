// A pool of threads that works through numbered tasks. Which thread takes which task is open; results must not depend
// on it. With RELIEF_NO_THREADS the same interface runs everything on the calling thread.
#pragma once

#include <memory>

namespace relief {

class Workers
{
public:
    // A task gets its number and the number of the worker that runs it (0 ... count() - 1).
    struct Job
    {
        void (*call)(const void* context, int task, int worker);
        const void* context;
    };

    // `threads` includes the calling thread; 0 means one per processor, and at most
    // kMaxThreads (limits.h), or as many as the system gives, are started.
    explicit Workers(int threads = 0);
    ~Workers();
    Workers(Workers&&) noexcept;
    Workers& operator=(Workers&&) noexcept;

    int count() const;

    // Runs function(task, worker) for task = 0 ... tasks - 1 and returns when all are done.
    template <class Function>
    void run(int tasks, const Function& function)
    {
        run(tasks, Job{[](const void* f, int task, int worker) { (*static_cast<const Function*>(f))(task, worker); },
                       &function});
    }

private:
    void run(int tasks, Job job);

    struct Pool;
    std::unique_ptr<Pool> pool;
};

}  // namespace relief
