#include "live/watch.h"

#include <cstring>
#include <filesystem>

#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

#include "relief/file.h"

namespace relief::samples::live {

namespace {

using namespace std::chrono_literals;

constexpr auto kBackup = 500ms;  // inotify sees nothing behind links and on network drives
constexpr auto kPollEvery = 30ms;

}  // namespace

Watch::Watch(std::string path, bool polling, std::chrono::milliseconds itsQuiet)
    : file(std::move(path)), quiet(itsQuiet)
{
    const std::filesystem::path whole(file);
    name = whole.filename().string();
    if (!polling) inotify = ::inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
    const std::string folder = whole.has_parent_path() ? whole.parent_path().string() : ".";
    if (inotify >= 0 && ::inotify_add_watch(inotify, folder.c_str(),
                                            IN_MODIFY | IN_CLOSE_WRITE | IN_MOVED_TO | IN_CREATE | IN_ATTRIB) < 0) {
        ::close(inotify);
        inotify = -1;
    }
    statusChanged();
    content = readText(file).value_or("");
    looked = Clock::now();
}

Watch::~Watch()
{
    if (inotify >= 0) ::close(inotify);
}

bool Watch::eventsSayChanged() const
{
    bool changed = false;
    alignas(inotify_event) char buffer[4096];
    for (;;) {
        const ssize_t size = inotify >= 0 ? ::read(inotify, buffer, sizeof buffer) : 0;
        if (size <= 0) return changed;
        for (const char* at = buffer; at < buffer + size;) {
            inotify_event event;
            std::memcpy(&event, at, sizeof event);
            const char* const whose = at + sizeof event;
            changed = changed || (event.mask & IN_Q_OVERFLOW) != 0 || (event.len > 0 && name == whose);
            at += sizeof event + event.len;
        }
    }
}

bool Watch::statusChanged()
{
    struct stat now = {};
    std::string text = "none";
    if (::stat(file.c_str(), &now) == 0) {
        text = std::to_string(now.st_mtim.tv_sec) + "." + std::to_string(now.st_mtim.tv_nsec) + " " +
               std::to_string(now.st_size) + " " + std::to_string(now.st_ino);
    }
    const bool changed = text != status;
    status = std::move(text);
    return changed;
}

std::chrono::milliseconds Watch::patience() const
{
    if (dirty) return quiet;
    return inotify >= 0 ? kBackup : kPollEvery;
}

std::optional<Watch::Change> Watch::poll()
{
    const Clock::time_point now = Clock::now();
    bool sign = eventsSayChanged();
    if (now - looked >= (inotify >= 0 ? kBackup : kPollEvery)) {
        sign = statusChanged() || sign;
        looked = now;
    }
    if (sign) {
        if (!dirty) first = now;
        dirty = true;
        last = now;
    }
    if (!dirty || now - last < quiet) return std::nullopt;
    dirty = false;
    Expected<std::string> text = readText(file);
    if (!text || *text == content) return std::nullopt;
    content = *text;
    return Change{std::move(*text), first};
}

}  // namespace relief::samples::live
