// A window: SDL2 opens it and draws triangles into it, without OpenGL; Dear ImGui's frame begins and ends here. All
// places are in pixels of the display, however many of them its points have.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "relief/error.h"

struct ImFont;
struct SDL_Renderer;
struct SDL_Texture;
struct SDL_Window;
union SDL_Event;

namespace relief::samples {

struct Pixels;
class Window;

// A picture that the window can draw.
class Picture
{
public:
    Picture() = default;
    ~Picture();
    Picture(Picture&& other) noexcept;
    Picture& operator=(Picture&& other) noexcept;

    void update(Window& window, const Pixels& pixels, bool smooth);
    SDL_Texture* texture() const { return mine; }

private:
    SDL_Texture* mine = nullptr;
    int width = 0, height = 0;
};

// The letters of a window; those of `code` all have one width.
struct Fonts
{
    ImFont *text = nullptr, *title = nullptr, *code = nullptr;
};

class Window
{
public:
    Window() = default;
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    // `scale` is that of text and controls, and of the window; 0: the display's.
    Expected<void> open(int width, int height, float scale = 1.0f);
    void setTitle(const std::string& title);
    void toggleFullScreen();

    // Dear ImGui, for what beginFrame() and endFrame() draw; letters and controls at the window's scale, or another
    // one.
    void beginInterface();
    void setScale(float scale);
    float scale() const { return itsScale; }

    void take(const SDL_Event& event);  // for the controls
    void beginFrame();
    void endFrame();                      // draws, unless the last frame looks the same
    void redraw() { lastFrame.clear(); }  // the next frame is drawn in any case

    // Shows this picture alone, over the whole window.
    void show(const Pixels& picture);

    Pixels contents() const;  // what was drawn last

    SDL_Renderer* renderer = nullptr;
    Fonts fonts;

private:
    float displayScale() const;
    float pixelsPerPoint() const;

    SDL_Window* window = nullptr;
    SDL_Texture* letters = nullptr;
    Picture whole;
    std::vector<unsigned char> lastFrame;  // what it drew
    bool hasInterface = false;
    float itsScale = 1.0f;
    std::string title;

    // The mouse as events say, so that a click that begins and ends between two frames is one.
    float mouseX = 0.0f, mouseY = 0.0f;
    bool down[3] = {}, pressed[3] = {};
};

}  // namespace relief::samples
