#include "relief/scene/gltf_text.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "relief/file.h"
#include "relief/little_endian.h"

namespace relief {
namespace {

// What has to be an integer, 0 or more, wherever it is no object and no array.
constexpr std::array<std::string_view, 20> kIntegers = {
    "buffer",        "bufferView", "byteLength", "byteOffset", "byteStride", "camera",  "children",
    "componentType", "count",      "index",      "indices",    "material",   "mesh",    "mode",
    "nodes",         "sampler",    "scene",      "skin",       "source",     "texCoord"};

// What has to be so many numbers: one, or a list.
struct Numbers
{
    std::string_view among, name;
    std::size_t count;
};
constexpr std::array<Numbers, 14> kNumbers = {{{"nodes", "translation", 3},
                                               {"nodes", "rotation", 4},
                                               {"nodes", "scale", 3},
                                               {"nodes", "matrix", 16},
                                               {"materials", "baseColorFactor", 4},
                                               {"materials", "emissiveFactor", 3},
                                               {"materials", "metallicFactor", 1},
                                               {"materials", "roughnessFactor", 1},
                                               {"materials", "alphaCutoff", 1},
                                               {"materials", "scale", 1},
                                               {"materials", "strength", 1},
                                               {"cameras", "yfov", 1},
                                               {"cameras", "znear", 1},
                                               {"cameras", "zfar", 1}}};

constexpr std::array<std::string_view, 5> kUnderstood = {"KHR_texture_transform", "KHR_materials_unlit",
                                                         "KHR_materials_emissive_strength", "KHR_mesh_quantization",
                                                         "KHR_lights_punctual"};

// What is a list in glTF 2.0 and an object in 1.0.
constexpr std::array<std::string_view, 4> kLists = {"accessors", "buffers", "meshes", "nodes"};

bool isAmong(std::string_view name, std::span<const std::string_view> names)
{
    return std::find(names.begin(), names.end(), name) != names.end();
}

// Walks through the JSON (nlohmann's SAX interface) and stops at the first problem.
struct Checker
{
    struct Level
    {
        bool isArray;
        std::size_t index = 0;  // of an array's element
        std::string key;        // of an object's
        bool isFree = false;    // within extras or extensions
    };
    std::vector<Level> levels;
    std::vector<GltfBuffer> buffers;
    std::uint64_t bufferBytes = 0;
    std::string problem;

    // "accessors[3].bufferView"
    std::string path() const
    {
        std::string text;
        for (const Level& level : levels) {
            if (level.isArray)
                text += "[" + std::to_string(level.index) + "]";
            else
                text += (text.empty() ? "" : ".") + level.key;
        }
        return text.empty() ? "the file" : text;
    }

    bool stop(const std::string& what)
    {
        if (problem.empty()) problem = path() + " " + what;
        return false;
    }

    // The key that the value at hand belongs to: an element of an array belongs to the array's.
    std::string_view key() const
    {
        const auto object = std::find_if(levels.rbegin(), levels.rend(), [](const Level& l) { return !l.isArray; });
        return object != levels.rend() ? std::string_view(object->key) : std::string_view();
    }
    bool isFree() const { return !levels.empty() && levels.back().isFree; }
    bool hasToBeInteger() const { return !isFree() && isAmong(key(), kIntegers); }

    // The buffer that the value at hand is of, where its key is this one.
    GltfBuffer* bufferOf(std::string_view name)
    {
        if (levels.size() != 3 || levels[0].key != "buffers" || key() != name) return nullptr;
        buffers.resize(std::max(buffers.size(), levels[1].index + 1));
        return &buffers[levels[1].index];
    }

    // What the value at hand has to be, if it is among these.
    const Numbers* numbers() const
    {
        if (levels.size() < 3 || isFree()) return nullptr;
        const auto* const found = std::find_if(kNumbers.begin(), kNumbers.end(), [this](const Numbers& its) {
            return its.among == levels[0].key && its.name == key();
        });
        return found == kNumbers.end() ? nullptr : found;
    }
    bool stopForNumbers(const Numbers& its)
    {
        return stop(its.count == 1 ? "is not a number; correct it"
                                   : "is not a list of " + std::to_string(its.count) + " numbers; correct it");
    }
    // A number stands alone, or in a list.
    bool number()
    {
        const Numbers* const its = numbers();
        return its == nullptr || (its->count > 1) == levels.back().isArray ? next() : stopForNumbers(*its);
    }

    bool next()
    {
        if (!levels.empty() && levels.back().isArray) ++levels.back().index;
        return true;
    }
    bool scalar()
    {
        if (hasToBeInteger()) return stop("is not an integer; export the file again");
        const Numbers* const its = numbers();
        return its == nullptr ? next() : stopForNumbers(*its);
    }

    bool null() { return scalar(); }
    bool boolean(bool) { return scalar(); }
    bool number_float(double, const std::string&) { return hasToBeInteger() ? scalar() : number(); }
    bool string(std::string& text)
    {
        if (levels.size() == 2 && levels[0].key == "extensionsRequired" && !isUnderstood(text)) {
            return stop("requires " + text + ", which is not supported; export the file without it");
        }
        if (GltfBuffer* const buffer = bufferOf("uri")) buffer->uri = text;
        const bool isAlphaMode = levels.size() == 3 && levels[0].key == "materials" && key() == "alphaMode";
        if (isAlphaMode && text != "OPAQUE" && text != "MASK" && text != "BLEND") {
            return stop("is not OPAQUE, MASK or BLEND; correct it");
        }
        return scalar();
    }
    bool binary(std::vector<std::uint8_t>&) { return scalar(); }
    bool number_integer(std::int64_t value)
    {
        return hasToBeInteger() && value < 0 ? stop("is negative; export the file again") : number();
    }
    bool number_unsigned(std::uint64_t value)
    {
        if (hasToBeInteger() && value > 0x7fffffffu) return stop("is larger than 2147483647; export the file again");
        if (GltfBuffer* const buffer = bufferOf("byteLength")) bufferBytes += buffer->byteLength = value;
        if (bufferBytes > kMaxFileBytes) return stop("makes the buffers larger than 1 GiB; split the file");
        return number();
    }

    bool start(bool isArray)
    {
        if (levels.size() >= static_cast<std::size_t>(kMaxJsonDepth)) {
            problem = "the JSON is nested more than " + std::to_string(kMaxJsonDepth) + " deep; export the file again";
            return false;
        }
        levels.push_back({.isArray = isArray, .index = 0, .key = "", .isFree = isFree()});
        return true;
    }
    bool end()
    {
        levels.pop_back();
        return next();
    }
    bool start_object(std::size_t)
    {
        if (levels.size() == 1 && isAmong(key(), kLists)) return stop("is no list, as in glTF 1.0; convert it to 2.0");
        const Numbers* const its = numbers();
        return its == nullptr ? start(false) : stopForNumbers(*its);
    }
    bool start_array(std::size_t)
    {
        const Numbers* const its = numbers();
        return its == nullptr || (its->count > 1 && !levels.back().isArray) ? start(true) : stopForNumbers(*its);
    }
    bool end_object() { return end(); }
    bool end_array()
    {
        const std::size_t count = levels.back().index;
        const Numbers* const its = numbers();
        levels.pop_back();
        return its == nullptr || count == its->count ? next() : stopForNumbers(*its);
    }
    bool key(std::string& name)
    {
        levels.back().key = name;
        levels.back().isFree =
            name == "extras" || name == "extensions" || (levels.size() > 1 && levels[levels.size() - 2].isFree);
        return true;
    }

    template <class Exception>
    bool parse_error(std::size_t position, const std::string&, const Exception&)
    {
        problem = "is no JSON from byte " + std::to_string(position) + " on; copy or export it again";
        return false;
    }
};

}  // namespace

bool isUnderstood(std::string_view extension)
{
    return isAmong(extension, kUnderstood);
}

Expected<GltfText> gltfText(std::span<const std::uint8_t> file)
{
    const std::string_view whole(reinterpret_cast<const char*>(file.data()), file.size());
    if (!whole.starts_with("glTF")) return GltfText{whole, false};
    const auto wordAt = [&file](std::size_t at) { return littleEndian(file, at, 4); };
    const auto truncated = [&](std::uint64_t expected) {
        return fail("is truncated (" + std::to_string(file.size()) + " of " + std::to_string(expected) +
                    " bytes); copy or export it again");
    };
    if (file.size() < 20) return truncated(20);
    if (const std::uint64_t version = wordAt(4); version != 2) {
        return fail("is a .glb of version " + std::to_string(version) + "; convert it to version 2");
    }
    const std::uint64_t length = wordAt(8), jsonLength = wordAt(12);
    if (length > file.size()) return truncated(length);
    const bool isJson = wordAt(16) == 0x4e4f534a;
    if (!isJson || jsonLength == 0 || 20 + jsonLength > length) {
        return fail("is damaged (its first chunk is not JSON within the file); copy or export it again");
    }
    if (20 + jsonLength + 8 <= length) {
        const std::uint64_t binary = wordAt(static_cast<std::size_t>(20 + jsonLength));
        if (28 + jsonLength + binary > length) {
            return fail("is damaged (its second chunk does not fit into the file); copy or export it again");
        }
    }
    return GltfText{whole.substr(20, static_cast<std::size_t>(jsonLength)), true};
}

Expected<std::vector<GltfBuffer>> checkGltfText(std::string_view json)
{
    Checker checker;
    if (nlohmann::json::sax_parse(json, &checker)) return std::move(checker.buffers);
    return fail(checker.problem);
}

}  // namespace relief
