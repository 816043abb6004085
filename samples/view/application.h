// The window, its viewer and its controls, put together: what `view` runs, and what tests run step by step.
#pragma once

#include <memory>

#include "view/alarm.h"
#include "view/interface.h"

namespace relief::samples {

class Application
{
public:
    static Expected<std::unique_ptr<Application>> open(const ViewOptions& options);

    // Takes all events, hears from the sessions, and draws if anything changed. False: nothing changed.
    bool step();

    // Until there is an event, or a session has news.
    void wait();

    bool running() const { return interface->running; }

    std::unique_ptr<live::Maker> maker;
    std::unique_ptr<Viewer> viewer;
    Window window;
    std::unique_ptr<Interface> interface;
    int redraws = 0;  // frames that are drawn although nothing happens: controls need some to come to rest

private:
    Application() = default;
    std::unique_ptr<Alarm> alarm;
};

}  // namespace relief::samples
