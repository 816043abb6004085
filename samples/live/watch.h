// A file that is being edited. Editors write it in place, write another one and rename it over, delete it first, or
// write it in pieces; what comes out here is the content, once for each time that it is another one.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "relief/error.h"

namespace relief::samples::live {

class Watch
{
public:
    using Clock = std::chrono::steady_clock;

    // With inotify on the file's folder; `polling`: by looking at its time and size instead, as where there is none.
    // A file is read when nothing was written for so long as `quiet` says.
    explicit Watch(std::string path, bool polling = false,
                   std::chrono::milliseconds quiet = std::chrono::milliseconds(10));
    ~Watch();
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;

    struct Change
    {
        std::string text;
        Clock::time_point noticed;  // the first sign of it
    };

    // The new content, if it is another one and nothing is being written. Never waits. A file
    // that is not there, or empty, is one that is still being written.
    std::optional<Change> poll();

    // Call poll() when this is readable (-1: never is), or after so many milliseconds.
    int descriptor() const { return inotify; }
    std::chrono::milliseconds patience() const;

    const std::string& path() const { return file; }

private:
    bool eventsSayChanged() const;
    bool statusChanged();

    std::string file, name;
    std::chrono::milliseconds quiet;
    int inotify = -1;
    std::string status;  // time, size and number of the file
    std::string content;
    bool dirty = false;
    Clock::time_point first, last, looked;
};

}  // namespace relief::samples::live
