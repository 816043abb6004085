#include "common/assets.h"

#include <cstdlib>
#include <filesystem>
#include <variant>

#include "mesh/primitives.h"
#include "texture/image.h"

namespace relief::samples {

Expected<std::string> assetPath(const std::string& name)
{
    const char* chosen = std::getenv("RELIEF_ASSETS");
    const std::filesystem::path path = std::filesystem::path(chosen != nullptr ? chosen : RELIEF_ASSET_FOLDER) / name;
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) {
        return fail(path.string() +
                    ": the sample's own file is missing; restore assets/ (git checkout assets) or set "
                    "RELIEF_ASSETS to a folder that has it");
    }
    return path.string();
}

Expected<Texture> loadTexture(const std::string& path, ColorSpace meaning)
{
    const Expected<ImageFile> file = readImage(path);
    if (!file) return tl::unexpected(file.error());
    if (const auto* image = std::get_if<Image8>(&*file)) {
        return Texture::fromRgba8(image->width, image->height, image->pixels, meaning);
    }
    if (const auto* image = std::get_if<Image16>(&*file)) {
        return Texture::fromRgba16(image->width, image->height, image->pixels, meaning);
    }
    const auto& image = std::get<ImageFloat>(*file);
    return Texture::fromRgbaFloat(image.width, image.height, image.pixels);
}

Mesh primitive(const std::string& name)
{
    if (name == "cube") return makeCube();
    if (name == "sphere") return makeSphere(48, 24);
    if (name == "terrain") return makeTerrain(64, 64);
    return makeQuad();
}

Mesh fitted(Mesh mesh)
{
    if (mesh.positions.empty()) return mesh;
    glm::vec3 low = mesh.positions[0], high = low;
    for (const glm::vec3& p : mesh.positions) {
        for (int i = 0; i < 3; ++i) {
            low[i] = p[i] < low[i] ? p[i] : low[i];
            high[i] = p[i] > high[i] ? p[i] : high[i];
        }
    }
    float extent = 0.0f;
    for (int i = 0; i < 3; ++i) extent = high[i] - low[i] > extent ? high[i] - low[i] : extent;
    const float scale = extent > 0.0f ? 1.0f / extent : 1.0f;
    for (glm::vec3& p : mesh.positions) p = (p - low * 0.5f - high * 0.5f) * scale;
    if (mesh.uvs.empty()) {
        for (const glm::vec3& p : mesh.positions) mesh.uvs.emplace_back(p.x + 0.5f, p.z + 0.5f);
    }
    return mesh;
}

}  // namespace relief::samples
