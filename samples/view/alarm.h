// Wakes a window that waits for events when a session has something to say: a thread that polls descriptors and posts
// an event. So nothing runs while nothing happens.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace relief::samples {

class Alarm
{
public:
    Alarm();  // after SDL, and after whatever forks
    ~Alarm();
    Alarm(const Alarm&) = delete;
    Alarm& operator=(const Alarm&) = delete;

    // Posts one event (SDL_USEREVENT) when one of these is readable, or after so long. A later call replaces this one.
    void arm(std::vector<int> descriptors, std::chrono::milliseconds patience);

private:
    void run();

    std::mutex mutex;
    std::condition_variable told;
    std::vector<int> descriptors;
    std::chrono::milliseconds patience{0};
    bool armed = false, ending = false;
    int pipe[2] = {-1, -1};  // ends the thread's poll()
    std::thread thread;
};

}  // namespace relief::samples
