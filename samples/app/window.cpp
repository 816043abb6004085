#include "window.h"

#include <algorithm>
#include <array>

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

// stb's letters are rectangles of whole pixels; drawn at twice their size on black, each in a cell of its own, so that
// marks stand below what they mark.
void Window::write(const std::string& text)
{
    constexpr int kScale = 2, kMargin = 8, kCellWidth = 7, kCellHeight = 12;
    struct Corner  // stb's layout; a letter's rectangle has four
    {
        float x, y, z;
        std::uint32_t color;
    };
    std::array<std::array<Corner, 4>, 32> parts;
    const int rows = static_cast<int>(std::count(text.begin(), text.end(), '\n')) + 1;
    SDL_SetRenderDrawBlendMode(renderer, SDL_BLENDMODE_BLEND);
    SDL_SetRenderDrawColor(renderer, 0, 0, 0, 200);
    const SDL_Rect behind = {0, 0, width, std::min(rows * kCellHeight * kScale + 2 * kMargin, height)};
    SDL_RenderFillRect(renderer, &behind);
    SDL_SetRenderDrawColor(renderer, 255, 230, 200, 255);
    int column = 0, row = 0;
    for (const char c : text) {
        if (c == '\n') {
            column = 0;
            ++row;
            continue;
        }
        char letter[2] = {static_cast<unsigned char>(c) < 128 ? c : '?', '\0'};
        const int count = stb_easy_font_print(0.0f, 0.0f, letter, nullptr, parts.data(), sizeof parts);
        const int x = kMargin + column++ * kCellWidth * kScale, y = kMargin + row * kCellHeight * kScale;
        for (int i = 0; i < count; ++i) {
            const auto& part = parts[static_cast<std::size_t>(i)];
            const auto at = [](float v) { return static_cast<int>(v) * kScale; };
            const SDL_Rect rectangle = {x + at(part[0].x), y + at(part[0].y), at(part[2].x - part[0].x),
                                        at(part[2].y - part[0].y)};
            SDL_RenderFillRect(renderer, &rectangle);
        }
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
