// The numbers that a glTF file's accessors stand for, out of its buffers: every offset is checked before it is used.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "relief/error.h"

namespace tinygltf {
class Model;
}

namespace relief {

// "meshes[0].primitives[0].indices: there is no accessor 7 among 4; export the file again".
tl::unexpected<Error> failMissing(const std::string& user, const char* what, int index, std::size_t among);

// Of an accessor. `user` is the field that names it, for messages: "meshes[0].primitives[1].attributes.NORMAL".
// Errors do not have the file's name.
class GltfAccessors
{
public:
    explicit GltfAccessors(const tinygltf::Model& model) : file(model) {}

    // How many elements accessor `index` has; an error where there is no such accessor.
    Expected<std::size_t> count(int index, const std::string& user) const;

    // Its elements, one after the other: floats as they are, integers as numbers or, where the accessor says
    // `normalized`, as 0 ... 1 or -1 ... 1. An error unless an element has `components`, 1 to 4, and all of them are
    // finite.
    Expected<std::vector<float>> floats(int index, int components, const std::string& user) const;

    // Its elements as indices below `limit`.
    Expected<std::vector<std::uint32_t>> indices(int index, std::size_t limit, const std::string& user) const;

    // The bytes of a buffer view.
    Expected<std::span<const std::uint8_t>> view(int index, const std::string& user) const;

private:
    struct Layout;
    Expected<Layout> layoutOf(int index, int components, const std::string& user) const;
    template <class Number, class Convert>
    Expected<std::vector<Number>> read(const Layout& layout, const Convert& convert) const;

    const tinygltf::Model& file;
};

}  // namespace relief
