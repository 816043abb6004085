#include "common/scene.h"

#include <algorithm>
#include <sstream>

#include "common/assets.h"
#include "common/courtyard.h"
#include "common/import_options.h"
#include "common/tangent_space_visualizer.h"
#include "relief/mesh/spherical_uv.h"
#include "relief/mesh/tangents.h"
#include "relief/pipeline/workers.h"

namespace relief::samples {

namespace {

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

// What surrounds the stage: the user's picture, nothing, or what the samples stand in.
Expected<std::shared_ptr<const Environment>> chooseEnvironment(const std::string& input, const std::string& file)
{
    if (file.empty() && !input.empty()) return courtyard();
    const Expected<std::string> path = choose("environment", input, file);
    if (!path) return tl::unexpected(path.error());
    if (path->empty()) return nullptr;
    return readEnvironment(*path, 0).map(
        [](Environment&& read) { return std::make_shared<const Environment>(std::move(read)); });
}

// A picture to be loaded, and where its texture goes.
struct Load
{
    std::string path;
    ImportSettings settings;
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

Expected<std::unique_ptr<LoadedInputs>> loadInputs(const Inputs& inputs, const InputFiles& users)
{
    auto loaded = std::make_unique<LoadedInputs>();
    if (!users.mesh.empty() && inputs.mesh.empty()) {
        return fail("--mesh " + users.mesh + ": this stage draws a fixed shape; leave the option out");
    }
    if (inputs.mesh == kSceneOfFile) {
        if (users.mesh.empty()) return fail("this stage shows a scene of a file; name it with --mesh FILE.glb");
        Expected<std::shared_ptr<const LitScene>> scene = readLitScene(users.mesh);
        if (!scene) return tl::unexpected(scene.error());
        loaded->usersScene = std::move(*scene);
        loaded->objects = arranged("quad", 0.0f);  // nobody draws it
    } else if (isPrimitive(users.mesh)) {
        loaded->objects = arranged(users.mesh, inputs.cubesTurnedBy);
    } else if (!users.mesh.empty()) {
        Expected<Mesh> mesh = readObj(users.mesh);
        if (!mesh) return tl::unexpected(mesh.error());
        loaded->usersMesh = fitted(std::move(*mesh));
        loaded->objects = {{&*loaded->usersMesh, glm::mat4(1.0f)}};
    } else {
        loaded->objects = arranged(inputs.mesh.empty() ? "quad" : inputs.mesh, inputs.cubesTurnedBy);
    }
    const TextureSlot around = TextureSlot::environment;
    Expected<std::shared_ptr<const Environment>> environment =
        chooseEnvironment(inputs.textures[around].file, users.textures[around]);
    if (!environment) return tl::unexpected(environment.error());
    loaded->environment = std::move(*environment);
    std::vector<Load> loads;
    for (std::size_t slot = 0; slot < kTextureOptions.size(); ++slot) {
        if (slot == static_cast<std::size_t>(around)) continue;
        const auto& [file, settings] = inputs.textures[slot];
        const Expected<std::string> path = choose(kTextureOptions[slot], file, users.textures[slot]);
        if (!path) return tl::unexpected(path.error());
        if (path->empty()) continue;
        const bool isNormalMap = settings.kind == ImportSettings::Kind::normalMap;
        const Expected<ImportSettings> chosen =
            isNormalMap ? withOptions(settings, users.import) : Expected<ImportSettings>(settings);
        if (!chosen) return tl::unexpected(chosen.error());
        loads.push_back({*path, *chosen, loaded->textures[slot]});
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
    passes.clear();
    notes.clear();
    labels.clear();
    problem.clear();
    passesLeftOut = 0;
    kept.clear();
    targets.clear();
    rendered.clear();
    textures.clear();
}

Scene::Scene(Frame& target, SceneLog& sceneLog, int w, int h, const Camera& camera, const LoadedInputs& loaded,
             const std::vector<Property>& chosen)
    : frame(target),
      width(w),
      height(h),
      objects(loaded.objects),
      mesh(*loaded.objects[0].mesh),
      log(sceneLog),
      clipFromWorld(clipFromView(camera, static_cast<float>(w) / static_cast<float>(h)) * viewFromWorld(camera)),
      cameraPosition(camera.position),
      properties(chosen),
      inputs(loaded)
{
    cutStrip(0.0f, 1.0f);
}

Scene::Scene(const Scene& outer, Frame& target, const Framebuffer& pixels, const glm::mat4& clip)
    : frame(target),
      width(pixels.width()),
      height(pixels.height()),
      objects(outer.objects),
      mesh(outer.mesh),
      log(outer.log),
      clipFromWorld(clip),
      cameraPosition(outer.cameraPosition),
      properties(outer.properties),
      inputs(outer.inputs)
{
    cutStrip(0.0f, 1.0f);
}

Framebuffer& Scene::pass(Framebuffer made, const glm::mat4& clip, const std::function<void(const Scene&)>& record) const
{
    const std::size_t drawnBefore = log.drawn.size();
    const Viewport viewport = log.viewport;
    const Rectangle scissor = log.scissor;
    Framebuffer& target = log.targets.emplace_back(std::move(made));
    Frame ofPass(target, {frame.options().threads});
    ofPass.clear(glm::vec4(0.0f));
    record(Scene(*this, ofPass, target, clip));
    if (log.problem.empty()) log.problem = ofPass.problem();
    SceneLog::Pass its = {.target = &target};
    for (int draw = 0; draw < ofPass.drawCount(); ++draw) {
        its.draws.push_back(*factsOf(ofPass, draw));
        if (log.tellsDraws) its.ofDraws.push_back(*statisticsOf(ofPass, draw));
    }
    its.statistics = ofPass.run();
    log.passes.push_back(std::move(its));
    log.drawn.resize(drawnBefore);  // what lines are drawn over is the picture
    log.viewport = viewport;
    log.scissor = scissor;
    return target;
}

Framebuffer& Scene::pass(Framebuffer made, const std::function<void(const Scene&)>& record) const
{
    return pass(std::move(made), clipFromWorld, record);
}

sampler2D Scene::sampled(const Framebuffer& target, int attachment) const
{
    const Texture* texture = target.texture(attachment);
    if (texture == nullptr) {
        Expected<Texture> copy = textureOf(target, attachment);
        if (!copy) {
            log.problem = copy.error().message;
            return {};
        }
        texture = &log.rendered.emplace_back(std::move(*copy));
    }
    for (SceneLog::Pass& pass : log.passes) {
        if (pass.target == &target) pass.read |= 1u << attachment;
    }
    return {.texture = texture,
            .filter = Filter::bilinear,
            .u = AddressMode::clamp,
            .v = AddressMode::clamp,
            .mipmaps = false};
}

glm::vec4 Scene::value(const Declaration& declaration) const
{
    for (const Property& p : properties) {
        if (p.name == declaration.name) return p.value;
    }
    log.problem = std::string("uniform '") + declaration.name +
                  "' is of a struct that the stage does not list: add it to .uniforms = declared<...>()";
    return declaration.value;
}

sampler2D Scene::texture(TextureSlot slot, const char*, const ImportSettings&) const
{
    const Texture* const loaded = inputs.textures[slot].get();
    const bool normals = slot == TextureSlot::normal || slot == TextureSlot::detailNormal;
    const bool factor = slot == TextureSlot::albedo || slot == TextureSlot::mask;
    const Texture& missing = factor                          ? Texture::white()
                             : normals                       ? Texture::flatNormal()
                             : slot == TextureSlot::emission ? Texture::black()
                                                             : Texture::grey();
    return {.texture = loaded != nullptr ? loaded : &missing};
}

const Environment* Scene::environment() const
{
    return inputs.environment.get();
}

Uniforms Scene::uniforms(const glm::mat4& worldFromObject) const
{
    return {.source = this, .object = {clipFromWorld, worldFromObject}, .worldSpaceCameraPos = cameraPosition};
}

Object Scene::lying() const
{
    return {&mesh, inputs.usersMesh ? glm::mat4(1.0f) : kLying};
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

void Scene::labelColumns(std::initializer_list<std::string_view> words, int row, int rows) const
{
    int column = 0;
    for (const std::string_view word : words) {
        log.labels.push_back({std::string(word), cellAt(column, static_cast<int>(words.size()), row, rows), false});
        ++column;
    }
}

void Scene::label(std::string_view words) const
{
    log.labels.push_back({std::string(words), log.scissor, false});
}

void Scene::labelScale(std::string_view words) const
{
    log.labels.push_back({std::string(words), log.scissor, true});
}

void Scene::note(std::string_view line) const
{
    log.notes.emplace_back(line);
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
const Mesh& Scene::prepare(const Mesh& drawn, Fields vertexData, const float4x4* worldFromObject) const
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

void Scene::leftOut(std::string_view name, const Object& object) const
{
    ++log.passesLeftOut;
    note("pass left out: " + std::string(name) + " does not reach the " + object.mesh->name);
}

namespace {

// What `complete` makes of a mesh; the mesh itself if it cannot, and then there is a problem.
const Mesh& madeOnce(std::map<const Mesh*, std::unique_ptr<Mesh>>& made, const Mesh& mesh,
                     Expected<Mesh> (*complete)(Mesh), std::string& problem)
{
    std::unique_ptr<Mesh>& result = made[&mesh];
    if (result) return *result;
    Expected<Mesh> completed = complete(mesh);
    if (!completed && problem.empty()) problem = completed.error().message;
    result = std::make_unique<Mesh>(completed ? std::move(*completed) : mesh);
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
    return plain.uvs.empty() ? madeOnce(log.uvs, plain, withSphericalUvs, log.problem) : plain;
}

const Mesh& Scene::withTangents(const Mesh& plain) const
{
    if (!plain.tangents.empty()) return plain;
    if (log.tangents.count(&plain) == 0) note("tangents computed for " + plain.name);
    return madeOnce(log.tangents, plain, withUvsAndTangents, log.problem);
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

Rectangle Scene::cellAt(int column, int columns, int row, int rows) const
{
    return {column * width / columns, row * height / rows, (column + 1) * width / columns, (row + 1) * height / rows};
}

void Scene::cutCell(int column, int columns, int row, int rows) const
{
    const Rectangle cell = cellAt(column, columns, row, rows);
    cut({(cell.x0 + cell.x1 - width) / 2, (cell.y0 + cell.y1 - height) / 2, width, height}, cell);
}

}  // namespace relief::samples
