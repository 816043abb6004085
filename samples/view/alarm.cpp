#include "view/alarm.h"

#include <algorithm>

#include <SDL.h>
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

namespace relief::samples {

Alarm::Alarm()
{
    if (::pipe(pipe) == 0) {
        for (const int end : pipe) {
            ::fcntl(end, F_SETFL, O_NONBLOCK);
            ::fcntl(end, F_SETFD, FD_CLOEXEC);
        }
    }
    thread = std::thread([this] { run(); });
}

Alarm::~Alarm()
{
    {
        const std::lock_guard lock(mutex);
        ending = true;
    }
    arm({}, {});
    thread.join();
    for (const int end : pipe) ::close(end);
}

void Alarm::arm(std::vector<int> newDescriptors, std::chrono::milliseconds newPatience)
{
    const std::lock_guard lock(mutex);
    descriptors = std::move(newDescriptors);
    patience = newPatience;
    armed = true;
    [[maybe_unused]] const ssize_t sent = ::write(pipe[1], "", 1);  // before run() may go on: it drains this
    told.notify_one();
}

void Alarm::run()
{
    std::unique_lock lock(mutex);
    for (;;) {
        told.wait(lock, [this] { return armed || ending; });
        if (ending) return;
        armed = false;
        char drained[64];
        while (::read(pipe[0], drained, sizeof drained) > 0) continue;
        std::vector<pollfd> waits = {{pipe[0], POLLIN, 0}};
        for (const int descriptor : descriptors) waits.push_back({descriptor, POLLIN, 0});
        const auto longest = static_cast<int>(std::min(patience, std::chrono::milliseconds(60000)).count());
        lock.unlock();
        ::poll(waits.data(), static_cast<nfds_t>(waits.size()), longest);
        if (waits[0].revents == 0) {
            SDL_Event event = {};
            event.type = SDL_USEREVENT;
            SDL_PushEvent(&event);
        }
        lock.lock();
    }
}

}  // namespace relief::samples
