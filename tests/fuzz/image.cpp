// Any bytes as an image file: an error, or as many pixels as the picture's size says.
#include "relief/texture/image.h"

#include <cstdlib>

#include "file_in_memory.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const FileInMemory file(data, size);
    const relief::Expected<relief::ImageFile> image = relief::readImage(file.path());
    if (!image) {
        if (image.error().message.find('\n') != std::string::npos) std::abort();  // an error is one line
        return 0;
    }
    std::visit(
        [](const auto& picture) {
            const std::size_t expected =
                static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height) * 4;
            if (picture.width < 1 || picture.height < 1 || picture.pixels.size() != expected) std::abort();
        },
        *image);
    return 0;
}
