// A glTF file in the making: data goes into one buffer, the rest is JSON.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

struct GltfFile
{
    nlohmann::json json = {{"asset", {{"version", "2.0"}}}};
    std::string bytes;

    // The number of a new buffer view with this data.
    int view(const void* data, std::size_t size)
    {
        bytes.resize((bytes.size() + 3) / 4 * 4);
        json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", size}});
        bytes.append(static_cast<const char*>(data), size);
        return static_cast<int>(json["bufferViews"].size()) - 1;
    }
    int view(const std::string& data) { return view(data.data(), data.size()); }

    // The number of a new accessor. `type` is "VEC3" or its like.
    template <class T>
    int accessor(const std::string& type, const std::vector<T>& numbers, bool normalized = false)
    {
        constexpr bool isSigned = T(-1) < T(0);
        constexpr int componentType = sizeof(T) == 1   ? (isSigned ? 5120 : 5121)
                                      : sizeof(T) == 2 ? (isSigned ? 5122 : 5123)
                                      : isSigned       ? 5126
                                                       : 5125;
        const std::size_t components = type == "SCALAR" ? 1 : static_cast<std::size_t>(type.back() - '0');
        nlohmann::json made = {{"bufferView", view(numbers.data(), numbers.size() * sizeof(T))},
                               {"componentType", componentType},
                               {"count", numbers.size() / components},
                               {"type", type}};
        if (normalized) made["normalized"] = true;
        json["accessors"].push_back(made);
        return static_cast<int>(json["accessors"].size()) - 1;
    }

    // A square of the xy plane, 2 x 2, that faces +z, with its picture upright; it and a node with it become number 0.
    static GltfFile square(bool withNormals = true)
    {
        GltfFile file;
        nlohmann::json attributes;
        attributes["POSITION"] = file.accessor<float>("VEC3", {-1, -1, 0, 1, -1, 0, -1, 1, 0, 1, 1, 0});
        if (withNormals) attributes["NORMAL"] = file.accessor<float>("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
        attributes["TEXCOORD_0"] = file.accessor<float>("VEC2", {0, 1, 1, 1, 0, 0, 1, 0});
        const int indices = file.accessor<std::uint16_t>("SCALAR", {0, 1, 2, 2, 1, 3});
        file.json["meshes"] = {{{"primitives", {{{"attributes", attributes}, {"indices", indices}}}}}};
        file.json["nodes"] = {{{"mesh", 0}}};
        return file;
    }
    nlohmann::json& primitive() { return json["meshes"][0]["primitives"][0]; }

    // The first primitive's material, which the JSON does not have before.
    void setMaterial(const nlohmann::json& material)
    {
        json["materials"] = nlohmann::json::array({material});  // clang takes {material} for a copy
        primitive()["material"] = 0;
    }

    // As a .glb file.
    std::string glb() const
    {
        nlohmann::json whole = json;
        std::string binary = bytes;
        binary.resize((binary.size() + 3) / 4 * 4);
        if (!whole.contains("buffers") && !bytes.empty()) whole["buffers"] = {{{"byteLength", bytes.size()}}};
        std::string text = whole.dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        std::string file = "glTF" + word(2) + word(20 + text.size() + (binary.empty() ? 0 : 8 + binary.size()));
        file += word(text.size()) + "JSON" + text;
        if (!binary.empty()) file += word(binary.size()) + std::string("BIN\0", 4) + binary;
        return file;
    }

    // As a .gltf file whose buffer is a file of this name.
    std::string gltf(const std::string& bufferUri) const
    {
        nlohmann::json whole = json;
        whole["buffers"] = {{{"byteLength", bytes.size()}, {"uri", bufferUri}}};
        return whole.dump();
    }

    static std::string word(std::size_t value)
    {
        std::string text;
        for (int i = 0; i < 4; ++i) text += static_cast<char>(value >> (8 * i) & 0xff);
        return text;
    }
    static std::string base64(const std::string& data)
    {
        const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        std::string text;
        for (std::size_t i = 0; i < data.size(); i += 3) {
            std::uint32_t three = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                three = three << 8 | (i + k < data.size() ? static_cast<std::uint8_t>(data[i + k]) : 0u);
            }
            for (std::size_t k = 0; k < 4; ++k) {
                text += i + k <= data.size() ? digits[three >> (18 - 6 * k) & 63] : '=';
            }
        }
        return text;
    }
};
