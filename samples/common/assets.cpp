#include "common/assets.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <map>

#include "relief/mesh/bounds.h"
#include "relief/mesh/primitives.h"

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

namespace {

const std::map<std::string, Mesh>& primitives()
{
    static const std::map<std::string, Mesh> all = {{"quad", makeQuad()},
                                                    {"cube", makeCube()},
                                                    {"sphere", makeSphere(48, 24)},
                                                    {"low-sphere", makeSphere(12, 6)},
                                                    {"terrain", makeTerrain(64, 64)}};
    return all;
}

}  // namespace

bool isPrimitive(const std::string& name)
{
    return primitives().count(name) != 0;
}

const Mesh& primitive(const std::string& name)
{
    return primitives().at(isPrimitive(name) ? name : "quad");
}

Mesh fitted(Mesh mesh)
{
    const Bounds bounds = boundsOf(mesh);
    // By halves, since what is far apart may be further than floats go.
    float extent = 0.0f;
    for (int i = 0; i < 3; ++i) extent = std::max(extent, bounds.high[i] * 0.5f - bounds.low[i] * 0.5f);
    const float scale = extent > 0.0f ? std::min(1.0f / extent, std::numeric_limits<float>::max()) : 2.0f;
    for (glm::vec3& p : mesh.positions) p = (p * 0.5f - bounds.low * 0.25f - bounds.high * 0.25f) * scale;
    return mesh;
}

}  // namespace relief::samples
