// Imports of files: one object for one import, whoever asks, and one line for everything that is wrong.
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "contents.h"
#include "import_fixture.h"
#include "temporary_folder.h"

#if !defined(RELIEF_NO_THREADS)
#include <thread>
#endif

using namespace import_fixture;

namespace {

// One line that says what is wrong and has the words that name the field.
void checkRefused(const Expected<Texture>& texture, const std::string& words)
{
    REQUIRE(!texture);
    CAPTURE(texture.error().message);
    CHECK(texture.error().message.find(words) != std::string::npos);
    CHECK(texture.error().message.find(';') != std::string::npos);
    CHECK(texture.error().message.find('\n') == std::string::npos);
}

}  // namespace

TEST_CASE("import: the same import is the same texture, another one is not")
{
    const TemporaryFolder folder;
    const std::string path = (folder / "heights.png").string();
    std::filesystem::copy_file(kHeights, path);
    const auto first = *importTexture(path, normalMap());
    CHECK(*importTexture(path, normalMap()) == first);
    CHECK(*importTexture(path, normalMap(Storage::dxt5)) != first);
    CHECK(*importTexture(path, normalMap(Storage::rgb, 0.1f)) != first);
    CHECK(first->levelsBuilt() == 0);

    // Nobody holds this one, and yet it is found; until 8 others came.
    std::weak_ptr<const Texture> dropped = *importTexture(path, normalMap(Storage::dxt5nm));
    for (int i = 0; i < 20; ++i) CHECK(*importTexture(path, normalMap()) == first);  // one is one, however often
    CHECK(!dropped.expired());
    for (int i = 0; i < 8; ++i)
        CHECK(importTexture(path, normalMap(Storage::rgb, 0.2f + 0.01f * static_cast<float>(i))));
    CHECK(dropped.expired());
    CHECK(*importTexture(path, normalMap()) == first);  // held, and so not forgotten

    std::filesystem::copy_file(kAlbedo, path, std::filesystem::copy_options::overwrite_existing);
    CHECK(*importTexture(path, normalMap()) != first);
}

TEST_CASE("import: what is wrong is one line that names the file, the field and the remedy")
{
    const Image8 picture = onlyColour(4, 4, 1, 2, 3, 4);
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), -1.0f, 16.5f, std::numeric_limits<float>::infinity()}) {
        checkRefused(importTexture(picture, normalMap(Storage::rgb, bad)), "bumpiness");
        const auto texture = importTexture(kHeights, normalMap(Storage::rgb, bad));
        REQUIRE(!texture);
        CHECK(texture.error().message.starts_with(kHeights + ": bumpiness is "));
    }
    for (const auto& [first, last] : {std::pair{-1, 3}, {4, 3}, {0, kMaxMipLevels}}) {
        checkRefused(importTexture(picture, {.fadeFirst = first, .fadeLast = last}), "fadeFirst");
    }
    checkRefused(importTexture(picture, {.storage = Storage::dxt5nm}), "dxt5nm");
    const ImageFloat bright{1, 1, {2.0f, 2.0f, 2.0f, 1.0f}};
    checkRefused(importTexture(bright, {.storage = Storage::dxt5}), "dxt5");
    CHECK(importTexture(bright, normalMap(Storage::dxt5)));
    checkRefused(importTexture(Image8{2, 2, {1, 2, 3, 4}}, {}), "2x2");

    const TemporaryFolder folder;
    const std::string missing = (folder / "none.png").string();
    const std::string bytes = contents(kHeights);
    const std::string half = folder.write("half.png", bytes.substr(0, bytes.size() / 2)).string();
    for (const std::string& path : {missing, half, folder.path.string()}) {
        const auto texture = importTexture(path, normalMap());
        REQUIRE(!texture);
        CHECK(texture.error().message.starts_with(path + ": "));
        CHECK(texture.error().message.find('\n') == std::string::npos);
    }
}

#if !defined(RELIEF_NO_THREADS)
TEST_CASE("import: threads that import and sample at once get one texture, complete")
{
    const TemporaryFolder folder;
    const std::string path = (folder / "heights.png").string();
    std::filesystem::copy_file(kHeights, path);
    const Texture reference = *importTexture(pictureOf(kHeights), normalMap(Storage::dxt5));
    std::vector<std::shared_ptr<const Texture>> textures(4);
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < textures.size(); ++t) {
        threads.emplace_back([&, t] {
            textures[t] = *importTexture(path, normalMap(Storage::dxt5));
            textures[t]->level(static_cast<int>(2 * t));
        });
    }
    for (std::thread& thread : threads) thread.join();
    for (const auto& texture : textures) CHECK(texture == textures[0]);
    for (int k = 0; k < reference.levelCount(); ++k) CHECK(sameLevel(textures[0]->level(k), reference.level(k)));
}
#endif
