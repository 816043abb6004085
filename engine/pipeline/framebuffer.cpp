#include "pipeline/framebuffer.h"

#include <cstring>
#include <string>

#include "pipeline/limits.h"

namespace relief {

Expected<Framebuffer> Framebuffer::create(int width, int height, ColorFormat format, DepthStorage depthStorage)
{
    if (width < 1 || height < 1 || width > kMaxTargetSize || height > kMaxTargetSize) {
        return fail("size " + std::to_string(width) + "x" + std::to_string(height) +
                    " is not possible: width and height must be 1 to " + std::to_string(kMaxTargetSize));
    }
    Framebuffer target;
    target.mWidth = width;
    target.mHeight = height;
    target.mFormat = format;
    target.mDepthStorage = depthStorage;
    const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    if (format == ColorFormat::rgba32f) {
        target.mColor32f.resize(pixels, glm::vec4(0.0f));
    } else {
        target.mColor8.resize(pixels);
    }
    if (depthStorage == DepthStorage::keep) target.mDepth.resize(pixels, 1.0f);
    return target;
}

bool Framebuffer::samePixels(const Framebuffer& other) const
{
    const auto same = [](auto a, auto b) {
        return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
    };
    return same(color8(), other.color8()) && same(color32f(), other.color32f()) && same(depth(), other.depth());
}

}  // namespace relief
