#include "window.h"

#include <algorithm>
#include <array>
#include <vector>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb_easy_font.h>
#pragma GCC diagnostic pop

namespace relief::samples {

Window::~Window()
{
    if (texture != nullptr) SDL_DestroyTexture(texture);
    if (renderer != nullptr) SDL_DestroyRenderer(renderer);
    if (window != nullptr) SDL_DestroyWindow(window);
    SDL_Quit();
}

Expected<void> Window::open(int itsWidth, int itsHeight)
{
    width = itsWidth;
    height = itsHeight;
    if (SDL_Init(SDL_INIT_VIDEO) == 0) {
        window = SDL_CreateWindow("Relief", SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, width, height, 0);
    }
    if (window != nullptr) renderer = SDL_CreateRenderer(window, -1, 0);
    if (renderer != nullptr) {
        texture = SDL_CreateTexture(renderer, SDL_PIXELFORMAT_RGBA32, SDL_TEXTUREACCESS_STREAMING, width, height);
    }
    if (texture != nullptr) return {};
    return fail(std::string("view: cannot open a window (") + SDL_GetError() + "); `relief render` needs none");
}

// stb's letters are rectangles of whole pixels; drawn at twice their size, on black.
void Window::write(const std::string& text)
{
    constexpr int kScale = 2, kMargin = 8;
    // Four corners of a rectangle, 16 bytes each: x, y, z, colour.
    struct Corner
    {
        float x, y, z;
        std::uint32_t color;
    };
    std::vector<std::array<Corner, 4>> letters(std::min<std::size_t>(text.size() * 24 + 16, 50000));
    std::string copy = text;
    const int count = stb_easy_font_print(0.0f, 0.0f, copy.data(), nullptr, letters.data(),
                                          static_cast<int>(letters.size() * sizeof letters[0]));
    const int bottom = stb_easy_font_height(copy.data()) * kScale + 2 * kMargin;
    SDL_SetRenderDrawBlendMode(renderer, SDL_BLENDMODE_BLEND);
    SDL_SetRenderDrawColor(renderer, 0, 0, 0, 200);
    const SDL_Rect behind = {0, 0, width, std::min(bottom, height)};
    SDL_RenderFillRect(renderer, &behind);
    SDL_SetRenderDrawColor(renderer, 255, 230, 200, 255);
    for (int i = 0; i < count; ++i) {
        const auto& letter = letters[static_cast<std::size_t>(i)];
        const auto at = [](float v) { return static_cast<int>(v) * kScale; };
        const SDL_Rect part = {kMargin + at(letter[0].x), kMargin + at(letter[0].y), at(letter[2].x - letter[0].x),
                               at(letter[2].y - letter[0].y)};
        SDL_RenderFillRect(renderer, &part);
    }
}

void Window::show(std::span<const std::uint32_t> pixels, const std::string& text)
{
    SDL_SetRenderDrawColor(renderer, 0, 0, 0, 255);
    SDL_RenderClear(renderer);
    if (pixels.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
        SDL_UpdateTexture(texture, nullptr, pixels.data(), width * 4);
        SDL_RenderCopy(renderer, texture, nullptr, nullptr);
    }
    if (!text.empty()) write(text);
    SDL_RenderPresent(renderer);
}

}  // namespace relief::samples
