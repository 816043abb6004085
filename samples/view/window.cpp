#include "view/window.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <SDL.h>

#include <backends/imgui_impl_sdl.h>
#include <imgui.h>

#include "view/imgui_renderer.h"
#include "view/pixels.h"
#include "view/style.h"

namespace relief::samples {

Picture::~Picture()
{
    if (mine != nullptr) SDL_DestroyTexture(mine);
}

Picture::Picture(Picture&& other) noexcept
    : mine(std::exchange(other.mine, nullptr)), width(other.width), height(other.height)
{
}

Picture& Picture::operator=(Picture&& other) noexcept
{
    std::swap(mine, other.mine);
    width = other.width;
    height = other.height;
    return *this;
}

void Picture::update(Window& window, const Pixels& pixels, bool smooth)
{
    if (pixels.empty()) return;
    window.redraw();
    if (mine == nullptr || width != pixels.width || height != pixels.height) {
        if (mine != nullptr) SDL_DestroyTexture(mine);
        width = pixels.width;
        height = pixels.height;
        mine = SDL_CreateTexture(window.renderer, SDL_PIXELFORMAT_RGBA32, SDL_TEXTUREACCESS_STATIC, width, height);
        if (mine == nullptr) return;
        SDL_SetTextureBlendMode(mine, SDL_BLENDMODE_NONE);
    }
    SDL_SetTextureScaleMode(mine, smooth ? SDL_ScaleModeLinear : SDL_ScaleModeNearest);
    SDL_UpdateTexture(mine, nullptr, pixels.colors.data(), width * 4);
}

Window::~Window()
{
    if (hasInterface) {
        ImGui_ImplSDL2_Shutdown();
        ImGui::DestroyContext();
    }
    whole = {};
    if (letters != nullptr) SDL_DestroyTexture(letters);
    if (renderer != nullptr) SDL_DestroyRenderer(renderer);
    if (window != nullptr) SDL_DestroyWindow(window);
    SDL_Quit();
}

Expected<void> Window::open(int width, int height, float scale)
{
    SDL_SetHint(SDL_HINT_FRAMEBUFFER_ACCELERATION, "0");  // it would load OpenGL, which takes longer than all the rest
    SDL_SetHint(SDL_HINT_MOUSE_FOCUS_CLICKTHROUGH, "1");
    SDL_SetHint(SDL_HINT_VIDEO_ALLOW_SCREENSAVER, "1");
    if (SDL_Init(SDL_INIT_VIDEO) == 0) {
        // Where there is no display SDL draws into nothing, which helps who asked for it.
        if (SDL_GetCurrentVideoDriver() == std::string("offscreen") && SDL_getenv("SDL_VIDEODRIVER") == nullptr) {
            return fail("view: there is no display; `relief render --watch` needs none");
        }
        itsScale = scale > 0.0f ? scale : displayScale();
        SDL_Rect room = {};
        SDL_GetDisplayUsableBounds(0, &room);
        const auto side = [this](int points, int most) {
            const int wanted = static_cast<int>(std::lround(static_cast<float>(points) * itsScale));
            return most > 0 ? std::min(wanted, most) : wanted;
        };
        window = SDL_CreateWindow("Relief", SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, side(width, room.w),
                                  side(height, room.h), SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI);
    }
    if (window != nullptr) renderer = SDL_CreateRenderer(window, -1, SDL_RENDERER_SOFTWARE);
    if (renderer != nullptr) {
        if (scale <= 0.0f) itsScale = std::max(itsScale, pixelsPerPoint());
        SDL_SetWindowMinimumSize(window, 480, 320);
        return {};
    }
    return fail(std::string("view: cannot open a window (") + SDL_GetError() + "); `relief render` needs none");
}

// In steps of a half: displays say how large they are, and many are wrong by a little.
float Window::displayScale() const
{
    float dots = 96.0f;
    if (SDL_GetDisplayDPI(0, &dots, nullptr, nullptr) != 0 || !(dots > 0.0f)) dots = 96.0f;
    return std::clamp(std::floor(dots / 96.0f * 2.0f + 0.1f) / 2.0f, 1.0f, 3.0f);
}

float Window::pixelsPerPoint() const
{
    int points = 0, pixels = 0;
    SDL_GetWindowSize(window, &points, nullptr);
    SDL_GetRendererOutputSize(renderer, &pixels, nullptr);
    return points > 0 && pixels > 0 ? static_cast<float>(pixels) / static_cast<float>(points) : 1.0f;
}

void Window::setTitle(const std::string& newTitle)
{
    if (newTitle == title) return;
    title = newTitle;
    SDL_SetWindowTitle(window, title.c_str());
}

void Window::toggleFullScreen()
{
    const bool full = (SDL_GetWindowFlags(window) & SDL_WINDOW_FULLSCREEN_DESKTOP) != 0;
    SDL_SetWindowFullscreen(window, full ? 0 : SDL_WINDOW_FULLSCREEN_DESKTOP);
}

void Window::beginInterface()
{
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.ConfigInputTextCursorBlink = false;  // it would draw twice a second
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    ImGui_ImplSDL2_InitForSDLRenderer(window);
    hasInterface = true;
    setScale(itsScale);
}

void Window::setScale(float scale)
{
    itsScale = scale;
    applyStyle(itsScale);
    fonts = loadFonts(itsScale);
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    unsigned char* bytes = nullptr;
    int width = 0, height = 0;
    atlas.GetTexDataAsRGBA32(&bytes, &width, &height);
    if (letters != nullptr) SDL_DestroyTexture(letters);
    letters = SDL_CreateTexture(renderer, SDL_PIXELFORMAT_RGBA32, SDL_TEXTUREACCESS_STATIC, width, height);
    SDL_UpdateTexture(letters, nullptr, bytes, width * 4);
    SDL_SetTextureBlendMode(letters, SDL_BLENDMODE_BLEND);
    SDL_SetTextureScaleMode(letters, SDL_ScaleModeLinear);
    atlas.SetTexID(letters);
    redraw();
}

void Window::take(const SDL_Event& event)
{
    ImGui_ImplSDL2_ProcessEvent(&event);
    const auto button = [](int number) {
        return number == SDL_BUTTON_LEFT ? 0 : number == SDL_BUTTON_RIGHT ? 1 : number == SDL_BUTTON_MIDDLE ? 2 : -1;
    };
    const auto move = [this](int x, int y) {
        mouseX = static_cast<float>(x) * pixelsPerPoint();
        mouseY = static_cast<float>(y) * pixelsPerPoint();
    };
    if (event.type == SDL_MOUSEMOTION) move(event.motion.x, event.motion.y);
    if (event.type == SDL_WINDOWEVENT) redraw();  // shown again, or of another size
    if (event.type == SDL_WINDOWEVENT && event.window.event == SDL_WINDOWEVENT_LEAVE) mouseX = mouseY = -1e6f;
    if (event.type != SDL_MOUSEBUTTONDOWN && event.type != SDL_MOUSEBUTTONUP) return;
    move(event.button.x, event.button.y);
    const int index = button(event.button.button);
    if (index < 0) return;
    down[index] = event.type == SDL_MOUSEBUTTONDOWN;
    pressed[index] = pressed[index] || down[index];
}

void Window::beginFrame()
{
    ImGui_ImplSDL2_NewFrame();
    ImGuiIO& io = ImGui::GetIO();
    int width = 0, height = 0;
    SDL_GetRendererOutputSize(renderer, &width, &height);
    io.DisplaySize = ImVec2(static_cast<float>(width), static_cast<float>(height));
    io.DisplayFramebufferScale = ImVec2(1.0f, 1.0f);
    io.MousePos = ImVec2(mouseX, mouseY);
    for (int i = 0; i < 3; ++i) io.MouseDown[i] = down[i] || std::exchange(pressed[i], false);
    ImGui::NewFrame();
}

void Window::endFrame()
{
    ImGui::Render();
    std::vector<unsigned char> now = interfaceBytes(*ImGui::GetDrawData());
    if (now == lastFrame) return;
    lastFrame = std::move(now);
    SDL_SetRenderDrawColor(renderer, 18, 19, 21, 255);
    SDL_RenderClear(renderer);
    drawInterface(renderer, *ImGui::GetDrawData());
    SDL_RenderPresent(renderer);
}

void Window::show(const Pixels& picture)
{
    whole.update(*this, picture, true);
    SDL_RenderClear(renderer);
    if (whole.texture() != nullptr) SDL_RenderCopy(renderer, whole.texture(), nullptr, nullptr);
    SDL_RenderPresent(renderer);
}

Pixels Window::contents() const
{
    Pixels drawn;
    SDL_GetRendererOutputSize(renderer, &drawn.width, &drawn.height);
    drawn.colors.resize(static_cast<std::size_t>(drawn.width) * static_cast<std::size_t>(drawn.height));
    SDL_RenderReadPixels(renderer, nullptr, SDL_PIXELFORMAT_RGBA32, drawn.colors.data(), drawn.width * 4);
    return drawn;
}

}  // namespace relief::samples
