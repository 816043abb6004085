#include "relief/check/golden.h"

#include <system_error>
#include <variant>
#include <vector>

#include "relief/path.h"
#include "relief/pipeline/save.h"
#include "relief/texture/image.h"

namespace relief {

namespace {

// An empty path is the folder where the program runs.
Expected<void> makeFolder(const std::filesystem::path& folder)
{
    std::error_code error;
    if (!folder.empty()) std::filesystem::create_directories(folder, error);
    if (!error) return {};
    return fail(utf8Of(folder) + ": cannot make the folder (" + error.message() + "); choose another one");
}

std::string sizeOf(int width, int height)
{
    return std::to_string(width) + "x" + std::to_string(height);
}

// Writes a picture to `folder`, and says where, or why not.
std::string kept(const std::string& folder, const std::string& name, const Framebuffer& target,
                 std::span<const std::uint8_t> pixels)
{
    const std::string path = utf8Of(pathOf(folder) / pathOf(name));
    const Expected<void> written =
        makeFolder(pathOf(folder)).and_then([&] { return writePng(path, target.width(), target.height(), pixels); });
    return written ? "written: " + path : "not written: " + written.error().message;
}

}  // namespace

Expected<void> checkGolden(const Framebuffer& target, const std::string& golden, const std::string& failures)
{
    if (target.color8().empty()) return fail(golden + ": goldens are 8-bit pictures, the target is not");
    const std::string remedy =
        "; look at the new picture, and if it is right, make it the golden: updateGolden() does, or copy the file";
    const std::string stem = utf8Of(pathOf(golden).stem());
    const std::vector<std::uint8_t> actual = bytesOf(target);
    const auto keepActual = [&] { return kept(failures, stem + ".actual.png", target, actual); };

    const Expected<ImageFile> file = readImage(golden);
    const Image8* expected = file ? std::get_if<Image8>(&*file) : nullptr;
    if (expected == nullptr) {
        const std::string why = file ? golden + ": no 8-bit picture" : file.error().message;
        return fail("no golden: " + why + "; " + keepActual() + remedy);
    }
    if (expected->width != target.width() || expected->height != target.height()) {
        return fail(golden + ": is " + sizeOf(expected->width, expected->height) + ", the picture " +
                    sizeOf(target.width(), target.height()) + "; " + keepActual() + remedy);
    }
    const Comparison comparison = compare(target.width(), target.height(), actual, expected->pixels);
    if (comparison.same()) return {};
    return fail(golden + ": " + comparison.report() + keepActual() + "\n" +
                kept(failures, stem + ".difference.png", target, comparison.amplified) + remedy);
}

Expected<void> updateGolden(const Framebuffer& target, const std::string& golden)
{
    if (target.color8().empty()) return fail(golden + ": goldens are 8-bit pictures, the target is not");
    return makeFolder(pathOf(golden).parent_path()).and_then([&] { return writePng(golden, target); });
}

}  // namespace relief
