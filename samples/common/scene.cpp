#include "common/scene.h"

#include <algorithm>
#include <sstream>

#include "common/assets.h"
#include "common/import_options.h"
#include "common/tangent_space_visualizer.h"
#include "mesh/spherical_uv.h"
#include "mesh/tangents.h"
#include "pipeline/workers.h"

namespace relief::samples {

namespace {

// The direction that a light at Unity's rotation (pitch, yaw, 0) shines towards is the turned forward vector; `dir`
// points back at the light.
glm::vec3 towardsLight(float pitch, float yaw)
{
    const glm::vec4 forward = rotationY(yaw) * (rotationX(pitch) * glm::vec4(0, 0, 1, 0));
    return {-forward.x, -forward.y, -forward.z};
}

sampler2D sampler(const std::shared_ptr<const Texture>& texture, const Texture& missing)
{
    return {.texture = texture ? texture.get() : &missing};
}

// Fails where the user gives a file that the stage does not read; gives the path to load, or nothing.
Expected<std::string> choose(const std::string& option, const std::string& input, const std::string& file)
{
    if (!file.empty() && input.empty()) {
        return fail("--" + option + " " + file + ": this stage reads no " + option + "; leave the option out");
    }
    if (file == kNone) return std::string();
    if (!file.empty()) return file;
    if (input.empty() || input == kNone) return std::string();
    return assetPath(input);
}

// A picture to be loaded, and where its texture goes.
struct Load
{
    std::string path;
    const ImportSettings& settings;
    std::shared_ptr<const Texture>& texture;
    Expected<void> result = {};
};

// A rotation by 90 degrees about X with exact zeros, so that the quad's normal is (0, 1, 0) to the last bit.
constexpr glm::mat4 kLying = {{1, 0, 0, 0}, {0, 0, 1, 0}, {0, -1, 0, 0}, {0, 0, 0, 1}};

// The shapes of "cube+sphere+quad": solids side by side and turned a little, a quad among them as their floor.
std::vector<Object> arranged(const std::string& names, float cubesTurnedBy)
{
    std::vector<std::string> solids;
    std::vector<Object> objects;
    std::stringstream list(names);
    for (std::string name; std::getline(list, name, '+');) solids.push_back(name);
    if (solids.size() == 1) return {{&primitive(solids[0]), glm::mat4(1.0f)}};
    const bool floor = solids.back() == "quad";
    if (floor) solids.pop_back();
    for (std::size_t i = 0; i < solids.size(); ++i) {
        const float x = (static_cast<float>(i) - static_cast<float>(solids.size() - 1) * 0.5f) * 1.35f;
        const float angle = solids[i] == "cube" ? cubesTurnedBy : 0.0f;
        objects.push_back({&primitive(solids[i]), translation({x, 0, 0}) * rotationY(angle)});
    }
    if (floor) objects.push_back({&primitive("quad"), translation({0, -0.5f, 0}) * kLying * scaling(glm::vec3(4.0f))});
    return objects;
}

}  // namespace

Expected<std::unique_ptr<LoadedInputs>> loadInputs(const Inputs& inputs, const InputFiles& files)
{
    auto loaded = std::make_unique<LoadedInputs>();
    if (!files.mesh.empty() && inputs.mesh.empty()) {
        return fail("--mesh " + files.mesh + ": this stage draws a fixed shape; leave the option out");
    }
    if (isPrimitive(files.mesh)) {
        loaded->objects = arranged(files.mesh, inputs.cubesTurnedBy);
    } else if (!files.mesh.empty()) {
        Expected<Mesh> mesh = readObj(files.mesh);
        if (!mesh) return tl::unexpected(mesh.error());
        loaded->usersMesh = fitted(std::move(*mesh));
        loaded->objects = {{&*loaded->usersMesh, glm::mat4(1.0f)}};
    } else {
        loaded->objects = arranged(inputs.mesh.empty() ? "quad" : inputs.mesh, inputs.cubesTurnedBy);
    }
    const ImportSettings albedo = {}, heights = {.colorSpace = ColorSpace::linear};
    const Expected<ImportSettings> normal = withOptions(inputs.normalImport, files.import);
    const Expected<ImportSettings> detailNormal = withOptions(inputs.detailNormalImport, files.import);
    if (!normal) return tl::unexpected(normal.error());
    if (!detailNormal) return tl::unexpected(detailNormal.error());
    std::vector<Load> loads;
    const auto wanted = [&](const char* option, const std::string& input, const std::string& file,
                            const ImportSettings& settings, std::shared_ptr<const Texture>& texture) -> Expected<void> {
        return choose(option, input, file).map([&](const std::string& path) {
            if (!path.empty()) loads.push_back({path, settings, texture});
        });
    };
    for (const Expected<void>& result : {
             wanted("albedo", inputs.albedo, files.albedo, albedo, loaded->albedo),
             wanted("height", inputs.height, files.height, heights, loaded->height),
             wanted("normal", inputs.normal, files.normal, *normal, loaded->normal),
             wanted("detail", inputs.detail, files.detail, inputs.detailImport, loaded->detail),
             wanted("detail-normal", inputs.detailNormal, files.detailNormal, *detailNormal, loaded->detailNormal),
         }) {
        if (!result) return tl::unexpected(result.error());
    }
    // A thread for each: decoding is a good part of the time to the first picture.
    const auto count = static_cast<int>(loads.size());
    Workers(std::max(count, 1)).run(count, [&](int i, int) {
        Load& load = loads[static_cast<std::size_t>(i)];
        load.result = importTexture(load.path, load.settings).map([&load](std::shared_ptr<const Texture> texture) {
            load.texture = std::move(texture);
        });
    });
    for (const Load& load : loads) {
        if (!load.result) return tl::unexpected(load.result.error());
    }
    return loaded;
}

void SceneLog::clear()
{
    for (const Mesh& mesh : kept) {
        uvs.erase(&mesh);
        tangents.erase(&mesh);
    }
    drawn.clear();
    notes.clear();
    passesLeftOut = 0;
    kept.clear();
    textures.clear();
}

Scene::Scene(Frame& target, SceneLog& sceneLog, int w, int h, const Camera& camera, const LoadedInputs& inputs,
             const std::vector<Property>& properties)
    : frame(target),
      width(w),
      height(h),
      objects(inputs.objects),
      mesh(*inputs.objects[0].mesh),
      worldSpaceCameraPos(broadcast(camera.position)),
      mainTex(sampler(inputs.albedo, Texture::white())),
      heightMap(sampler(inputs.height, Texture::grey())),
      normalMap(sampler(inputs.normal, Texture::flatNormal())),
      detailTex(sampler(inputs.detail, Texture::grey())),
      detailNormalMap(sampler(inputs.detailNormal, Texture::flatNormal())),
      heightMap_TexelSize(texelSize(heightMap)),
      log(sceneLog),
      usersMesh(inputs.usersMesh.has_value()),
      clipFromWorld(clipFromView(camera, static_cast<float>(w) / static_cast<float>(h)) * viewFromWorld(camera))
{
    cutStrip(0.0f, 1.0f);
    for (const Property& p : properties) values[p.name] = p.value;
    const auto angle = [this](const char* name) { return values.count(name) != 0 ? values.at(name).x : 0.0f; };
    light.color = float3(1.0f, 0.957f, 0.839f);  // Unity's default directional light, intensity 1
    light.dir = broadcast(towardsLight(angle("lightPitch"), angle("lightYaw")));
}

float4 Scene::vector(const std::string& name) const
{
    return broadcast(values.at(name));
}
Float Scene::number(const std::string& name) const
{
    return values.at(name).x;
}

ObjectTransform Scene::object(const glm::mat4& worldFromObject) const
{
    return {clipFromWorld, worldFromObject};
}

ObjectTransform Scene::lying() const
{
    return object(usersMesh ? glm::mat4(1.0f) : kLying);
}

const Mesh& Scene::keep(Mesh made) const
{
    return log.kept.emplace_back(std::move(made));
}

sampler2D Scene::samplerOf(const Texture& made) const
{
    log.textures.insert(&made);
    return {.texture = &made};
}

void Scene::note(const std::string& line) const
{
    log.notes.push_back(line);
}

void Scene::showTangents(const TangentSpaceVisualizer& visualizer) const
{
    const std::vector<SceneLog::Drawn> all = log.drawn;
    for (auto d = all.begin(); d != all.end(); ++d) {
        // Every pass of an object draws it again, but its tangent space is the same.
        const auto same = [&d](const SceneLog::Drawn& other) {
            return d->object.mesh == other.object.mesh && d->object.worldFromObject == other.object.worldFromObject &&
                   d->viewport.x == other.viewport.x && d->scissor.x0 == other.scissor.x0;
        };
        if (std::any_of(all.begin(), d, same)) continue;
        cut(d->viewport, d->scissor);
        visualizer.ShowTangentSpace(*this, *d->object.mesh, d->object.worldFromObject);
    }
}

// What comes before a draw: notes where the object stands, turns its front faces if its matrix mirrors it, and gives
// its mesh the uvs and tangents that the vertex program reads.
const Mesh& Scene::prepare(const Mesh& drawn, std::span<const Field> vertexData, const float4x4* worldFromObject) const
{
    bool mirrored = false;
    if (worldFromObject != nullptr) {
        const glm::mat4 matrix = firstLane(*worldFromObject);
        log.drawn.push_back({{&drawn, matrix}, log.viewport, log.scissor});
        mirrored = mirrorSign(matrix) < 0.0f;
    }
    frame.setFrontCounterClockwise(mirrored);
    const auto reads = [vertexData](std::string_view semantic) {
        return std::any_of(vertexData.begin(), vertexData.end(),
                           [semantic](const Field& field) { return semantic == field.name && field.index == 0; });
    };
    return reads("TANGENT") ? withTangents(drawn) : reads("TEXCOORD") ? withUvs(drawn) : drawn;
}

void Scene::leftOut(const std::string& name, const Object& object) const
{
    ++log.passesLeftOut;
    note("pass left out: " + name + " does not reach the " + object.mesh->name);
}

namespace {

// What `complete` makes of a mesh; the mesh itself if it cannot.
const Mesh& madeOnce(std::map<const Mesh*, std::unique_ptr<Mesh>>& made, const Mesh& mesh,
                     Expected<Mesh> (*complete)(Mesh))
{
    std::unique_ptr<Mesh>& result = made[&mesh];
    if (!result) result = std::make_unique<Mesh>(complete(mesh).value_or(mesh));
    return *result;
}

Expected<Mesh> withUvsAndTangents(Mesh mesh)
{
    if (!mesh.uvs.empty()) return withTangents(std::move(mesh));
    return withSphericalUvs(std::move(mesh)).and_then(withTangents);
}

}  // namespace

const Mesh& Scene::withUvs(const Mesh& plain) const
{
    return plain.uvs.empty() ? madeOnce(log.uvs, plain, withSphericalUvs) : plain;
}

const Mesh& Scene::withTangents(const Mesh& plain) const
{
    if (!plain.tangents.empty()) return plain;
    if (log.tangents.count(&plain) == 0) note("tangents computed for " + plain.name);
    return madeOnce(log.tangents, plain, withUvsAndTangents);
}

void Scene::cut(const Viewport& viewport, const Rectangle& scissor) const
{
    log.viewport = viewport;
    log.scissor = scissor;
    frame.setViewport(viewport);
    frame.setScissor(scissor);
}

void Scene::cutStrip(float from, float to) const
{
    const auto column = [this](float part) { return static_cast<int>(part * static_cast<float>(width) + 0.5f); };
    cut({0, 0, width, height}, {column(from), 0, column(to), height});
}

void Scene::cutCell(int column, int columns, int row, int rows) const
{
    const int left = column * width / columns, right = (column + 1) * width / columns;
    const int top = row * height / rows, bottom = (row + 1) * height / rows;
    cut({(left + right - width) / 2, (top + bottom - height) / 2, width, height}, {left, top, right, bottom});
}

std::vector<Property> joined(std::vector<Property> first, const std::vector<Property>& more)
{
    first.insert(first.end(), more.begin(), more.end());
    return first;
}

std::vector<Property> lightAngles(float pitch, float yaw)
{
    return {{"lightPitch", glm::vec4(pitch), -180.0f, 180.0f, 1, "the light's rotation about X, degrees"},
            {"lightYaw", glm::vec4(yaw), -180.0f, 180.0f, 1, "the light's rotation about Y, degrees"}};
}

std::vector<Property> litProperties(const std::vector<Property>& more)
{
    const std::vector<Property> material = {
        {"tint", glm::vec4(1.0f), 0.0f, 1.0f, 4, "colour that the albedo is multiplied by"},
        {"mainTex_ST", {1, 1, 0, 0}, -16.0f, 16.0f, 4, "tiling in x and y, offset in z and w"},
        {"metallic", glm::vec4(0.0f), 0.0f, 1.0f, 1, "0 dielectric, 1 metal"},
        {"smoothness", glm::vec4(0.1f), 0.0f, 1.0f, 1, "0 matte, 1 polished"},
    };
    return joined(joined(material, lightAngles(35.0f, -20.0f)), more);
}

Property bumpScaleProperty()
{
    return {"bumpScale", glm::vec4(5.0f), -32.0f, 32.0f, 1, "texels that the height map's whole range is high"};
}

Property mapScaleProperty(const std::string& name, float value)
{
    return {name, glm::vec4(value), -32.0f, 32.0f, 1, "the bumps' strength; 1: as the map was made"};
}

Property detailTilingProperty()
{
    return {"detailTex_ST", {3, 3, 0, 0}, -64.0f, 64.0f, 4, "tiling and offset of both detail textures"};
}

Property binormalPerFragmentProperty(float value)
{
    return {"binormalPerFragment", glm::vec4(value), 0.0f, 2.0f, 1, "0: per vertex, 1: per fragment, 2: both (1.24)"};
}

ImportSettings normalMapSettings(float bumpiness, bool fadeOutMips)
{
    return {.kind = ImportSettings::Kind::normalMap,
            .storage = ImportSettings::Storage::dxt5nm,
            .bumpiness = bumpiness,
            .fadeOutMips = fadeOutMips,
            .fadeFirst = 2,
            .fadeLast = 5};
}

Inputs detailedMarble(const std::string& mesh)
{
    return {.mesh = mesh,
            .albedo = "marble-albedo.png",
            .normal = "marble-heights.png",
            .detail = "marble-detail.png",
            .detailNormal = "marble-detail.png",
            .detailImport = {.fadeOutMips = true, .fadeFirst = 2, .fadeLast = 5},
            .detailNormalImport = normalMapSettings(0.1f, true)};
}

Inputs bare(const std::string& mesh)
{
    return {.mesh = mesh, .albedo = kNone, .normal = kNone, .detail = kNone, .detailNormal = kNone};
}

std::vector<Property> detailedProperties(const std::vector<Property>& more)
{
    return joined(litProperties({mapScaleProperty("bumpScale", 0.5f), detailTilingProperty(),
                                 mapScaleProperty("detailBumpScale", 0.5f)}),
                  more);
}

}  // namespace relief::samples
