#include "common/uniforms.h"

#include <algorithm>

#include "common/camera.h"
#include "common/read_environment.h"

namespace relief::samples {

namespace {

// The direction that a light at Unity's rotation (pitch, yaw, 0) shines towards is the turned forward vector; `dir`
// points back at the light.
glm::vec3 towardsLight(float pitch, float yaw)
{
    const glm::vec4 forward = rotationY(yaw) * (rotationX(pitch) * glm::vec4(0, 0, 1, 0));
    return {-forward.x, -forward.y, -forward.z};
}

// Lists what is asked for, and gives the defaults.
class Listing final : public UniformSource
{
public:
    explicit Listing(Declared& list) : declared(list) {}

    glm::vec4 value(const Declaration& d) const override
    {
        const Property property = {.name = d.name,
                                   .kind = d.kind,
                                   .components = d.components,
                                   .value = d.value,
                                   .minimum = d.range.minimum,
                                   .maximum = d.range.maximum,
                                   .meaning = d.meaning,
                                   .choices = {d.choices.begin(), d.choices.end()}};
        std::vector<Property>& all = declared.properties;
        const auto same = std::find_if(all.begin(), all.end(), [&d](const Property& p) { return p.name == d.name; });
        if (same == all.end()) {
            all.push_back(property);
        } else {
            *same = property;
        }
        return d.value;
    }
    sampler2D texture(TextureSlot slot, const char* file, const ImportSettings& settings) const override
    {
        declared.inputs.textures[slot] = {file, settings};
        return {};
    }
    const Environment* environment() const override
    {
        declared.inputs.textures[TextureSlot::environment] = {"courtyard", {}};
        return nullptr;
    }

private:
    Declared& declared;
};

}  // namespace

ImportSettings normalMapSettings(float bumpiness, bool fadeOutMips)
{
    return {.kind = ImportSettings::Kind::normalMap,
            .storage = ImportSettings::Storage::dxt5nm,
            .bumpiness = bumpiness,
            .fadeOutMips = fadeOutMips,
            .fadeFirst = kFadedOut.fadeFirst,
            .fadeLast = kFadedOut.fadeLast};
}

Declared UniformStructs::list() const
{
    Declared declared;
    const Listing listing(declared);
    for (std::size_t i = 0; i < count; ++i) declare[i]({.source = &listing, .object = {}, .worldSpaceCameraPos = {}});
    return declared;
}

float Uniforms::number(const char* name, float value, Range range, const char* meaning) const
{
    return source->value({name, Property::Kind::number, 1, glm::vec4(value), range, meaning}).x;
}
bool Uniforms::toggle(const char* name, bool value, const char* meaning) const
{
    const glm::vec4 number(value ? 1.0f : 0.0f);
    return source->value({name, Property::Kind::toggle, 1, number, {0, 1}, meaning}).x != 0.0f;
}
int Uniforms::choice(const char* name, int value, std::initializer_list<const char*> choices, const char* meaning) const
{
    const glm::vec4 number(static_cast<float>(value));
    const Range range = {0.0f, static_cast<float>(choices.size()) - 1.0f};
    return static_cast<int>(source->value({name, Property::Kind::choice, 1, number, range, meaning, choices}).x);
}
glm::vec3 Uniforms::vector(const char* name, const glm::vec3& value, Range range, const char* meaning) const
{
    return glm::vec3(source->value({name, Property::Kind::vector, 3, glm::vec4(value, 0.0f), range, meaning}));
}
glm::vec4 Uniforms::vector(const char* name, const glm::vec4& value, Range range, const char* meaning) const
{
    return source->value({name, Property::Kind::vector, 4, value, range, meaning});
}
glm::vec3 Uniforms::rgb(const char* name, const glm::vec3& value, const char* meaning) const
{
    return glm::vec3(source->value({name, Property::Kind::color, 3, glm::vec4(value, 0.0f), {0, 1}, meaning}));
}
glm::vec4 Uniforms::rgba(const char* name, const glm::vec4& value, const char* meaning) const
{
    return source->value({name, Property::Kind::color, 4, value, {0, 1}, meaning});
}

sampler2D Uniforms::albedo(const char* file) const
{
    return source->texture(TextureSlot::albedo, file, {});
}
sampler2D Uniforms::heights(const char* file) const
{
    return source->texture(TextureSlot::height, file, {.colorSpace = ColorSpace::linear});
}
sampler2D Uniforms::normals(const char* file, const ImportSettings& settings) const
{
    return source->texture(TextureSlot::normal, file, settings);
}
sampler2D Uniforms::detail(const char* file, const ImportSettings& settings) const
{
    return source->texture(TextureSlot::detail, file, settings);
}
sampler2D Uniforms::detailNormals(const char* file, const ImportSettings& settings) const
{
    return source->texture(TextureSlot::detailNormal, file, settings);
}

sampler2D Uniforms::mask(const char* file) const
{
    return source->texture(TextureSlot::mask, file, {.colorSpace = ColorSpace::linear});
}
sampler2D Uniforms::emission(const char* file) const
{
    return source->texture(TextureSlot::emission, file, {});
}

samplerCUBE Uniforms::radiance() const
{
    const Environment* environment = source->environment();
    return {.texture = environment != nullptr ? &environment->radiance : nullptr};
}
samplerCUBE Uniforms::reflections() const
{
    const Environment* environment = source->environment();
    return {.texture = environment != nullptr ? &environment->mirrored : nullptr};
}
SphericalHarmonics Uniforms::irradiance() const
{
    const Environment* environment = source->environment();
    return environment != nullptr ? environment->irradiance
                                  : gradientSurroundings(glm::vec3(1.0f), glm::vec3(1.0f), glm::vec3(1.0f));
}

UnityLight Uniforms::sun(float pitch, float yaw) const
{
    const float x = number("lightPitch", pitch, {-180, 180}, "the light's rotation about X, degrees");
    const float y = number("lightYaw", yaw, {-180, 180}, "the light's rotation about Y, degrees");
    return {.color = float3(1.0f, 0.957f, 0.839f),  // intensity 1
            .dir = broadcast(towardsLight(x, y))};
}

}  // namespace relief::samples
