// Uniforms: what a program reads that is the same for all of a draw. Each is declared where it is used, as a field with
// its name, default, range and meaning, and gets its value by that name:
//
//     struct MyFragmentProgram : Uniforms
//     {
//         float4 tint = rgba("tint", glm::vec4(1.0f), "colour that the albedo is multiplied by");
//         Float bumpScale = number("bumpScale", 0.5f, {-32, 32}, "the bumps' strength");
//         sampler2D normalMap = normals("marble-heights.png");
//         ...
//
// The user changes them by --set bumpScale=2 or in the window, and the textures by --normal FILE. A stage lists the
// structs that declare any (declared(), below): what they declare is what can be set.
#pragma once

#include <initializer_list>
#include <string>
#include <type_traits>
#include <vector>

#include "common/input_files.h"
#include "relief/relief.h"
#include "relief/shading/lights.h"
#include "relief/shading/object_transform.h"
#include "relief/texture/import.h"

namespace relief::samples {

struct Environment;

struct Range
{
    float minimum = 0.0f, maximum = 1.0f;
};

// A uniform that the user may change. Ranges and defaults are the tutorials'.
struct Property
{
    enum class Kind : char
    {
        number,
        vector,
        color,   // linear
        toggle,  // 0 or 1
        choice   // 0, 1, ...: one of `choices`
    };

    std::string name;
    Kind kind = Kind::number;
    int components = 1;
    glm::vec4 value{0.0f};                 // those components
    float minimum = 0.0f, maximum = 1.0f;  // of each
    std::string meaning;
    std::vector<std::string> choices;

    bool isWhole() const { return kind == Kind::toggle || kind == Kind::choice; }
    bool operator==(const Property&) const = default;
};

// What a stage reads from files. A texture's name is that of a file in assets/; empty: the stage has no such input;
// kNone: it has one, but nothing is in it by default. The import settings are those of Unity's inspector.
inline constexpr const char* kNone = "none";
inline constexpr float kCubesTurnedBy = 35.0f;

struct Inputs
{
    struct TextureInput
    {
        std::string file;
        ImportSettings settings;
    };

    std::string mesh;  // "quad", "cube", "sphere", "terrain"; several with + between them stand side by side
    float cubesTurnedBy = kCubesTurnedBy;  // degrees about Y, where there are several shapes
    PerTexture<TextureInput> textures;
};

// A detail texture that is gone from afar: its levels fade to grey, from 2 to 5.
inline constexpr ImportSettings kFadedOut = {.fadeOutMips = true, .fadeFirst = 2, .fadeLast = 5};

// A normal map as DXT5nm: of a grey picture's heights, or of a picture of normals.
ImportSettings normalMapSettings(float bumpiness, bool fadeOutMips = false);

// What some structs of uniforms declare.
struct Declared
{
    std::vector<Property> properties;  // in the order of their fields
    Inputs inputs;                     // without a mesh
};

// A property as its field declares it.
struct Declaration
{
    const char* name;
    Property::Kind kind;
    int components;
    glm::vec4 value;
    Range range;
    const char* meaning;
    std::initializer_list<const char*> choices = {};
};

// Where the values come from.
class UniformSource
{
public:
    virtual glm::vec4 value(const Declaration& declaration) const = 0;
    virtual sampler2D texture(TextureSlot slot, const char* file, const ImportSettings& settings) const = 0;
    virtual const Environment* environment() const = 0;  // null: none

protected:
    ~UniformSource() = default;
};

// What programs derive from. A Uniforms, as a Scene makes it, turns into any struct that is derived from it:
// `MyFragmentProgram fragment = s.uniforms(worldFromObject)`.
struct Uniforms
{
    const UniformSource* source;
    ObjectTransform object;  // of what is drawn
    float3 worldSpaceCameraPos;

    // Fields that this initialises are float (Float), bool, int, and float2 to float4.
    float number(const char* name, float value, Range range, const char* meaning) const;
    bool toggle(const char* name, bool value, const char* meaning) const;
    int choice(const char* name, int value, std::initializer_list<const char*> choices, const char* meaning) const;
    glm::vec3 vector(const char* name, const glm::vec3& value, Range range, const char* meaning) const;
    glm::vec4 vector(const char* name, const glm::vec4& value, Range range, const char* meaning) const;
    glm::vec3 rgb(const char* name, const glm::vec3& value, const char* meaning) const;
    glm::vec4 rgba(const char* name, const glm::vec4& value, const char* meaning) const;

    // Textures: the default's name in assets/, or kNone. --albedo, --height, --normal, --detail, --detail-normal,
    // --mask,
    // --emission.
    sampler2D albedo(const char* file) const;
    sampler2D heights(const char* file) const;
    sampler2D normals(const char* file, const ImportSettings& settings = normalMapSettings(0.05f)) const;
    sampler2D detail(const char* file, const ImportSettings& settings = {}) const;
    sampler2D detailNormals(const char* file, const ImportSettings& settings = normalMapSettings(0.1f)) const;

    // Of a material: metallic in red, occlusion in green, where detail is in blue, smoothness in alpha.
    sampler2D mask(const char* file) const;
    sampler2D emission(const char* file) const;

    // What surrounds the scene: as it is, with levels that are averages; as surfaces mirror it, with levels by
    // roughness (shading/environment.h); and as it lights matte ones. The courtyard (courtyard.h), or --environment.
    samplerCUBE radiance() const;
    samplerCUBE reflections() const;
    SphericalHarmonics irradiance() const;

    // Unity's default directional light, and two properties that turn it: lightPitch and lightYaw, in degrees.
    UnityLight sun(float pitch, float yaw) const;

    template <class Derived>
    requires(std::is_base_of_v<Uniforms, Derived> && !std::is_same_v<Uniforms, Derived>) operator Derived() const
    {
        return Derived{*this};
    }
};

namespace detail {

template <class Struct>
void declare(const Uniforms& uniforms)
{
    [[maybe_unused]] const Struct made = uniforms;
}

template <class... Structs>
inline constexpr void (*kDeclare[])(const Uniforms&) = {declare<Structs>...};

}  // namespace detail

// Structs of uniforms whose types are forgotten.
struct UniformStructs
{
    void (*const* declare)(const Uniforms&) = nullptr;
    std::size_t count = 0;

    // What they declare. Of a name that is declared twice, the last declaration counts, in the first one's place: a
    // struct may change a default of its base.
    Declared list() const;
};

template <class... Structs>
constexpr UniformStructs declared()
{
    return {detail::kDeclare<Structs...>, sizeof...(Structs)};
}

}  // namespace relief::samples
