#include "common/scene.h"

#include <filesystem>

#include "common/assets.h"

namespace relief::samples {

namespace {

// The direction that a light at Unity's rotation (pitch, yaw, 0) shines towards is the turned forward vector; `dir`
// points back at the light.
glm::vec3 towardsLight(float pitch, float yaw)
{
    const glm::vec4 forward = rotationY(yaw) * (rotationX(pitch) * glm::vec4(0, 0, 1, 0));
    return {-forward.x, -forward.y, -forward.z};
}

sampler2D sampler(const std::optional<Texture>& texture, const Texture& missing)
{
    return {.texture = texture ? &*texture : &missing};
}

// Fails where the user gives a file that the stage does not read; gives the path to load, or nothing.
Expected<std::string> choose(const std::string& option, const std::string& input, const std::string& file)
{
    if (!file.empty() && input.empty()) {
        return fail("--" + option + " " + file + ": this stage reads no " + option + "; leave the option out");
    }
    if (!file.empty()) return file;
    if (input.empty() || input == kNone) return std::string();
    return assetPath(input);
}

Expected<void> load(const std::string& option, const std::string& input, const std::string& file, ColorSpace meaning,
                    std::optional<Texture>& texture)
{
    const Expected<std::string> path = choose(option, input, file);
    if (!path) return tl::unexpected(path.error());
    if (path->empty()) return {};
    Expected<Texture> loaded = loadTexture(*path, meaning);
    if (!loaded) return tl::unexpected(loaded.error());
    texture.emplace(std::move(*loaded));
    return {};
}

}  // namespace

Expected<std::unique_ptr<LoadedInputs>> loadInputs(const Inputs& inputs, const InputFiles& files)
{
    auto loaded = std::make_unique<LoadedInputs>();
    if (!files.mesh.empty() && inputs.mesh.empty()) {
        return fail("--mesh " + files.mesh + ": this stage draws a fixed shape; leave the option out");
    }
    if (!files.mesh.empty()) {
        Expected<Mesh> mesh = readObj(files.mesh);
        if (!mesh) return tl::unexpected(mesh.error());
        loaded->mesh = fitted(std::move(*mesh));
        loaded->usersMesh = true;
    } else {
        loaded->mesh = primitive(inputs.mesh);
    }
    const Expected<void> results[] = {
        load("albedo", inputs.albedo, files.albedo, ColorSpace::srgb, loaded->albedo),
        load("height", inputs.height, files.height, ColorSpace::linear, loaded->height),
        load("normal", inputs.normal, files.normal, ColorSpace::linear, loaded->normal),
        load("detail", inputs.detail, files.detail, ColorSpace::srgb, loaded->detail),
    };
    for (const Expected<void>& result : results) {
        if (!result) return tl::unexpected(result.error());
    }
    return loaded;
}

Scene::Scene(Frame& target, int w, int h, const Camera& camera, const LoadedInputs& inputs,
             const std::vector<Property>& properties)
    : frame(target),
      width(w),
      height(h),
      mesh(inputs.mesh),
      worldSpaceCameraPos(broadcast(camera.position)),
      mainTex(sampler(inputs.albedo, Texture::white())),
      heightMap(sampler(inputs.height, Texture::grey())),
      normalMap(sampler(inputs.normal, Texture::flatNormal())),
      detailTex(sampler(inputs.detail, Texture::grey())),
      heightMap_TexelSize(texelSize(heightMap)),
      usersMesh(inputs.usersMesh),
      clipFromWorld(clipFromView(camera, static_cast<float>(w) / static_cast<float>(h)) * viewFromWorld(camera))
{
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
    // A rotation by 90 degrees about X with exact zeros, so that the quad's normal is (0, 1, 0) to the last bit.
    const glm::mat4 laid = {{1, 0, 0, 0}, {0, 0, 1, 0}, {0, -1, 0, 0}, {0, 0, 0, 1}};
    return object(usersMesh ? glm::mat4(1.0f) : laid);
}

void Scene::cutStrip(float from, float to) const
{
    const auto column = [this](float part) { return static_cast<int>(part * static_cast<float>(width) + 0.5f); };
    frame.setScissor({column(from), 0, column(to), height});
}

std::vector<Property> litProperties(std::vector<Property> more)
{
    std::vector<Property> all = {
        {"tint", glm::vec4(1.0f), 0.0f, 1.0f, 4, "colour that the albedo is multiplied by"},
        {"mainTex_ST", {1, 1, 0, 0}, -16.0f, 16.0f, 4, "tiling in x and y, offset in z and w"},
        {"metallic", glm::vec4(0.0f), 0.0f, 1.0f, 1, "0 dielectric, 1 metal"},
        {"smoothness", glm::vec4(0.1f), 0.0f, 1.0f, 1, "0 matte, 1 polished"},
        {"lightPitch", glm::vec4(35.0f), -180.0f, 180.0f, 1, "the light's rotation about X, degrees"},
        {"lightYaw", glm::vec4(-20.0f), -180.0f, 180.0f, 1, "the light's rotation about Y, degrees"},
    };
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

Property bumpScaleProperty()
{
    return {"bumpScale", glm::vec4(5.0f), -32.0f, 32.0f, 1, "texels that the height map's whole range is high"};
}

}  // namespace relief::samples
