#include "relief/pipeline/save.h"

#include "relief/lanes/environment.h"
#include "relief/pipeline/format.h"
#include "relief/texture/image.h"

namespace relief {

namespace {

// Red, green and blue of every pixel of the first kind that there is; empty where nothing is a float.
std::vector<float> floatsOf(const Framebuffer& target)
{
    const DefaultFloatingPoint environment;
    std::vector<float> numbers;
    for (const glm::vec4& c : target.color32f()) numbers.insert(numbers.end(), {c.x, c.y, c.z});
    if (!numbers.empty()) return numbers;
    for (const auto& c : target.color16f()) {
        for (int k = 0; k < 3; ++k) numbers.push_back(fromHalf(c[static_cast<std::size_t>(k)])[0]);
    }
    if (!numbers.empty()) return numbers;
    for (const float c : target.colorR32f()) numbers.insert(numbers.end(), 3, c);
    if (!numbers.empty()) return numbers;
    for (const float z : target.depth()) numbers.insert(numbers.end(), 3, z);
    return numbers;
}

}  // namespace

std::vector<std::uint8_t> bytesOf(const Framebuffer& target)
{
    std::vector<std::uint8_t> bytes;
    bytes.reserve(target.color8().size() * 4);
    for (const std::uint32_t pixel : target.color8()) {
        for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(pixel >> shift));
    }
    return bytes;
}

Expected<void> writePng(const std::string& path, const Framebuffer& target)
{
    if (target.color8().empty()) {
        return fail(path + ": the target has no 8-bit colours that are kept; give it rgba8 or rgba8Srgb, or write PFM");
    }
    return writePng(path, target.width(), target.height(), bytesOf(target));
}

Expected<void> writePfm(const std::string& path, const Framebuffer& target)
{
    const std::vector<float> numbers = floatsOf(target);
    if (numbers.empty()) return fail(path + ": the target keeps nothing in floats; write PNG, or keep its depth");
    return writePfm(path, target.width(), target.height(), numbers);
}

}  // namespace relief
