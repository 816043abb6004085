#include "check/golden.h"

#include <variant>

#include "texture/image.h"

namespace relief {

namespace {

std::span<const std::uint8_t> bytesOf(const Framebuffer& target)
{
    return {reinterpret_cast<const std::uint8_t*>(target.color8().data()), target.color8().size_bytes()};
}

Expected<void> makeFolder(const std::filesystem::path& folder)
{
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) return fail(folder.string() + ": cannot make the folder (" + error.message() + ")");
    return {};
}

}  // namespace

Expected<void> checkGolden(const Framebuffer& target, const std::filesystem::path& golden,
                           const std::filesystem::path& failures)
{
    if (target.color8().empty()) return fail(golden.string() + ": goldens are 8-bit pictures, the target is not");
    const std::string remedy = "; look at the new picture, and if it is right: update_goldens";
    const auto keep = [&](const char* what, std::span<const std::uint8_t> pixels) -> Expected<void> {
        const Expected<void> made = makeFolder(failures);
        if (!made) return made;
        return writePng(failures / (golden.stem().string() + what), target.width(), target.height(), pixels);
    };

    const Expected<ImageFile> file = readImage(golden);
    const Image8* expected = file ? std::get_if<Image8>(&*file) : nullptr;
    if (expected == nullptr) {
        const std::string why = file ? golden.string() + ": no 8-bit picture" : file.error().message;
        const Expected<void> kept = keep(".actual.png", bytesOf(target));
        return fail("no golden: " + why + remedy + (kept ? "" : " (" + kept.error().message + ")"));
    }
    if (expected->width != target.width() || expected->height != target.height()) {
        return fail(golden.string() + ": is " + std::to_string(expected->width) + "x" +
                    std::to_string(expected->height) + ", the picture " + std::to_string(target.width()) + "x" +
                    std::to_string(target.height()) + remedy);
    }
    const Comparison comparison = compare(target.width(), target.height(), bytesOf(target), expected->pixels);
    if (comparison.same()) return {};
    const Expected<void> actual = keep(".actual.png", bytesOf(target));
    if (!actual) return actual;
    const Expected<void> difference = keep(".difference.png", comparison.amplified);
    if (!difference) return difference;
    return fail(golden.string() + ": " + comparison.report() +
                "written: " + (failures / (golden.stem().string() + ".actual.png, .difference.png")).string() + remedy);
}

Expected<void> updateGolden(const Framebuffer& target, const std::filesystem::path& golden)
{
    const Expected<void> made = makeFolder(golden.parent_path());
    if (!made) return made;
    return writePng(golden, target.width(), target.height(), bytesOf(target));
}

}  // namespace relief
