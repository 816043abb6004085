// A window that shows pixels and text over them. SDL2.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include <SDL.h>

#include "error.h"

namespace relief::samples {

class Window
{
public:
    Window() = default;
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    Expected<void> open(int width, int height);
    void setTitle(const std::string& title) { SDL_SetWindowTitle(window, title.c_str()); }

    // A whole picture of the window's size; nothing if there are no pixels. `text` over it, line by line.
    void show(std::span<const std::uint32_t> pixels, const std::string& text);

private:
    void write(const std::string& text);

    SDL_Window* window = nullptr;
    SDL_Renderer* renderer = nullptr;
    SDL_Texture* texture = nullptr;
    int width = 0, height = 0;
};

}  // namespace relief::samples
