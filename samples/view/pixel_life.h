// The life of a pixel of the window's picture, as a page: another process tells it, while the window goes on.
#pragma once

#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include "live/renderer.h"

namespace relief::samples {

class PixelLife
{
public:
    // Begins, with what the window shows; one that is under way is forgotten. An error where no process can be made.
    Expected<void> tell(const live::StageSource& source, const live::Look& look, int x, int y);

    // The page's path, or why there is none; once. Never waits.
    std::optional<Expected<std::string>> poll();

    // Call poll() when it is readable; -1: nothing is under way.
    int descriptor() const { return output ? ::fileno(output.get()) : -1; }

private:
    struct Close
    {
        void operator()(std::FILE* file) const { ::pclose(file); }
    };
    std::unique_ptr<std::FILE, Close> output;
    std::string printed, page;
};

}  // namespace relief::samples
