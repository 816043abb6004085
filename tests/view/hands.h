// A user with a mouse and a keyboard: the window's events, one after the other.
#pragma once

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>

#include <SDL.h>

#include <doctest/doctest.h>

#include "contents.h"
#include "temporary_folder.h"
#include "view/application.h"

struct Hands
{
    using Place = relief::samples::Interface::Place;

    explicit Hands(const std::string& stage, const std::string& size = "96x54",
                   const std::vector<std::string>& settings = {})
    {
        ::setenv("SDL_VIDEODRIVER", "dummy", 1);
        relief::samples::ViewOptions options;
        options.render.stage = stage;
        options.render.size = size;
        options.render.threads = 2;
        options.render.settings = settings;
        options.scale = 1.0f;
        auto opened = relief::samples::Application::open(options);
        REQUIRE_MESSAGE(opened, (opened ? "" : opened.error().message));
        application = std::move(*opened);
        SDL_SetWindowSize(SDL_GetWindowFromID(1), 1280, 800);  // the dummy display is smaller
        REQUIRE(until([this] { return viewer().picture().width > 0; }));
        settle();
    }

    relief::samples::Viewer& viewer() const { return *application->viewer; }
    relief::samples::Interface& interface() const { return *application->interface; }

    // Until nothing moves any more.
    void settle() const
    {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
        while (std::chrono::steady_clock::now() < end) {
            if (application->step()) continue;
            if (viewer().idle()) return;
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        FAIL("the window does not come to rest");
    }
    template <class Condition>
    bool until(const Condition& condition) const
    {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
        while (!condition() && std::chrono::steady_clock::now() < end) {
            if (!application->step()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        return condition();
    }

    bool has(const std::string& name) const { return interface().places.count(name) != 0; }
    Place place(const std::string& name) const
    {
        CAPTURE(name);
        REQUIRE(has(name));
        return interface().places.at(name);
    }

    void move(float x, float y) const
    {
        SDL_Event event = {};
        event.type = SDL_MOUSEMOTION;
        event.motion.x = static_cast<int>(x);
        event.motion.y = static_cast<int>(y);
        SDL_PushEvent(&event);
        settle();
    }
    void hold(bool down, float x, float y, Uint8 button = SDL_BUTTON_LEFT) const
    {
        SDL_Event event = {};
        event.type = down ? SDL_MOUSEBUTTONDOWN : SDL_MOUSEBUTTONUP;
        event.button.button = button;
        event.button.x = static_cast<int>(x);
        event.button.y = static_cast<int>(y);
        SDL_PushEvent(&event);
        settle();
    }
    // One event of the mouse on a control, and one frame: where the window will not come to rest.
    void push(SDL_EventType type, const std::string& name) const
    {
        REQUIRE(until([&] { return has(name); }));
        const Place p = place(name);
        SDL_Event event = {};
        event.type = type;
        if (type == SDL_MOUSEMOTION) {
            event.motion.x = static_cast<int>((p.left + p.right) / 2.0f);
            event.motion.y = static_cast<int>((p.top + p.bottom) / 2.0f);
        } else {
            event.button.button = SDL_BUTTON_LEFT;
            event.button.x = static_cast<int>((p.left + p.right) / 2.0f);
            event.button.y = static_cast<int>((p.top + p.bottom) / 2.0f);
        }
        SDL_PushEvent(&event);
        application->step();
    }
    // At a part of the control's width and height.
    void click(const std::string& name, float across = 0.5f, float down = 0.5f) const
    {
        const Place p = place(name);
        clickAt(p.left + across * (p.right - p.left), p.top + down * (p.bottom - p.top));
    }
    void clickAt(float x, float y) const
    {
        move(x, y);
        hold(true, x, y);
        hold(false, x, y);
    }
    void drag(const std::string& name, float x, float y, Uint8 button = SDL_BUTTON_LEFT) const
    {
        const Place p = place(name);
        const float fromX = (p.left + p.right) / 2.0f, fromY = (p.top + p.bottom) / 2.0f;
        move(fromX, fromY);
        hold(true, fromX, fromY, button);
        move(fromX + x / 2.0f, fromY + y / 2.0f);
        move(fromX + x, fromY + y);
        hold(false, fromX + x, fromY + y, button);
    }
    void choose(const std::string& list, const std::string& name) const
    {
        click(list);
        click(name);
    }
    void wheel(int clicks) const
    {
        SDL_Event event = {};
        event.type = SDL_MOUSEWHEEL;
        event.wheel.y = clicks;
        SDL_PushEvent(&event);
        settle();
    }
    void key(SDL_Keycode code, Uint16 held = 0, bool release = true) const
    {
        SDL_SetModState(static_cast<SDL_Keymod>(held));
        SDL_Event event = {};
        event.type = SDL_KEYDOWN;
        event.key.keysym.sym = code;
        event.key.keysym.scancode = SDL_GetScancodeFromKey(code);
        event.key.keysym.mod = held;
        SDL_PushEvent(&event);
        settle();
        if (!release) return;
        SDL_SetModState(KMOD_NONE);
        event.type = SDL_KEYUP;
        event.key.keysym.mod = 0;
        SDL_PushEvent(&event);
        settle();
    }
    void type(const std::string& text) const
    {
        for (const char c : text) {
            SDL_Event event = {};
            event.type = SDL_TEXTINPUT;
            event.text.text[0] = c;
            SDL_PushEvent(&event);
        }
        settle();
    }
    void drop(const std::string& file) const
    {
        SDL_Event event = {};
        event.type = SDL_DROPFILE;
        event.drop.file = SDL_strdup(file.c_str());
        SDL_PushEvent(&event);
        settle();
    }

    const relief::samples::Property& property(const std::string& name) const
    {
        for (const relief::samples::Property& p : viewer().properties()) {
            if (p.name == name) return p;
        }
        FAIL("no such property");
        return viewer().properties().front();
    }
    float value(const std::string& name) const { return viewer().value(property(name)).x; }

    std::unique_ptr<relief::samples::Application> application;
};
