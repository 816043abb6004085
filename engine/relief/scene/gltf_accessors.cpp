#include "relief/scene/gltf_accessors.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include "relief/bits.h"
#include "relief/little_endian.h"
#include "relief/memory.h"
#include "relief/scene/tinygltf.h"

namespace relief {
namespace {

std::string fieldOf(const char* array, int index)
{
    return std::string(array) + "[" + std::to_string(index) + "]";
}

template <class T>
const T* at(const std::vector<T>& all, int index)
{
    return index >= 0 && static_cast<std::size_t>(index) < all.size() ? &all[static_cast<std::size_t>(index)] : nullptr;
}

std::size_t sizeOf(int componentType)
{
    switch (componentType) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return 1;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return 2;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return 4;
        default:
            return 0;
    }
}

int componentsOf(int type)
{
    switch (type) {
        case TINYGLTF_TYPE_SCALAR:
            return 1;
        case TINYGLTF_TYPE_VEC2:
            return 2;
        case TINYGLTF_TYPE_VEC3:
            return 3;
        case TINYGLTF_TYPE_VEC4:
            return 4;
        default:
            return 0;
    }
}

// Of what counts elements and vertices.
bool isUnsigned(int componentType)
{
    return componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
           componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
           componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

// At most 4 bytes.
std::uint32_t wordAt(std::span<const std::uint8_t> bytes, std::size_t at, std::size_t size)
{
    return static_cast<std::uint32_t>(littleEndian(bytes, at, size));
}

// A component as a float (glTF 2.0, 3.6.2.2 for the normalized ones).
float floatOf(std::uint32_t word, int componentType, bool normalized)
{
    const auto scaled = [normalized](std::int64_t value, float largest) {
        const auto number = static_cast<float>(value);
        return normalized ? std::max(number / largest, -1.0f) : number;
    };
    switch (componentType) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return scaled(static_cast<std::int8_t>(word), 127.0f);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return scaled(word, 255.0f);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return scaled(static_cast<std::int16_t>(word), 32767.0f);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return scaled(word, 65535.0f);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return scaled(word, 4294967295.0f);
        default:
            return bitCast<float>(word);
    }
}

}  // namespace

// Elements in bytes: the first begins at `first`, the next `stride` later. Without bytes all are 0.
struct GltfAccessors::Layout
{
    struct Elements
    {
        std::span<const std::uint8_t> bytes;
        std::size_t stride, count;
    };
    std::string field;  // accessors[3]
    Elements elements;
    std::size_t components, componentSize;
    int componentType;
    bool normalized;

    // The sparse ones, which take the place of others.
    std::optional<Elements> places, values;
    std::size_t placeSize = 0;
};

tl::unexpected<Error> failMissing(const std::string& user, const char* what, int index, std::size_t among)
{
    return fail(user + ": there is no " + what + " " + std::to_string(index) + " among " + std::to_string(among) +
                "; export the file again");
}

Expected<std::size_t> GltfAccessors::count(int index, const std::string& user) const
{
    const tinygltf::Accessor* accessor = at(file.accessors, index);
    if (!accessor) return failMissing(user, "accessor", index, file.accessors.size());
    return accessor->count;
}

Expected<std::span<const std::uint8_t>> GltfAccessors::view(int index, const std::string& user) const
{
    const tinygltf::BufferView* view = at(file.bufferViews, index);
    if (!view) return failMissing(user, "buffer view", index, file.bufferViews.size());
    const std::string field = fieldOf("bufferViews", index);
    const tinygltf::Buffer* buffer = at(file.buffers, view->buffer);
    if (!buffer) return failMissing(field + ".buffer", "buffer", view->buffer, file.buffers.size());
    const std::size_t size = buffer->data.size();
    if (view->byteOffset > size || view->byteLength > size - view->byteOffset) {
        return fail(field + ": bytes " + std::to_string(view->byteOffset) + " to " +
                    std::to_string(view->byteOffset + view->byteLength) + " are not all among the " +
                    std::to_string(size) + " of " + fieldOf("buffers", view->buffer) + "; export the file again");
    }
    return std::span(buffer->data).subspan(view->byteOffset, view->byteLength);
}

namespace {

// `count` elements of `size` bytes within a view's bytes, or what is wrong.
Expected<std::span<const std::uint8_t>> within(std::span<const std::uint8_t> bytes, const std::string& field,
                                               std::size_t offset, std::size_t stride, std::size_t size,
                                               std::size_t count)
{
    const std::uint64_t last = count > 0 ? (std::uint64_t{count} - 1) * stride + size : 0;  // both are below 2^31
    if (offset <= bytes.size() && last <= bytes.size() - offset) return bytes.subspan(offset);
    return fail(field + ": " + std::to_string(count) + " elements from byte " + std::to_string(offset) + " take " +
                std::to_string(last) + " bytes of a buffer view that has " + std::to_string(bytes.size()) +
                "; export the file again");
}

}  // namespace

Expected<GltfAccessors::Layout> GltfAccessors::layoutOf(int index, int components, const std::string& user) const
{
    const tinygltf::Accessor* accessor = at(file.accessors, index);
    if (!accessor) return failMissing(user, "accessor", index, file.accessors.size());
    Layout layout{};
    layout.field = fieldOf("accessors", index);
    layout.components = static_cast<std::size_t>(components);
    layout.componentType = accessor->componentType;
    layout.componentSize = sizeOf(accessor->componentType);
    layout.normalized = accessor->normalized;
    if (layout.componentSize == 0) {
        return fail(layout.field + ".componentType: there is no type " + std::to_string(accessor->componentType) +
                    "; export the file again");
    }
    if (componentsOf(accessor->type) != components) {
        return fail(layout.field + ".type: " + user + " takes " + std::to_string(components) +
                    " components; export the file again");
    }
    const std::size_t size = layout.components * layout.componentSize;
    layout.elements = {{}, size, accessor->count};
    if (accessor->bufferView >= 0) {
        const auto bytes = view(accessor->bufferView, layout.field + ".bufferView");
        if (!bytes) return tl::unexpected(bytes.error());
        if (const std::size_t stride = at(file.bufferViews, accessor->bufferView)->byteStride; stride > 0) {
            if (stride < size) {
                return fail(fieldOf("bufferViews", accessor->bufferView) + ".byteStride: " + std::to_string(stride) +
                            " is less than the " + std::to_string(size) +
                            " bytes of an element; export the file again");
            }
            layout.elements.stride = stride;
        }
        const auto elements =
            within(*bytes, layout.field, accessor->byteOffset, layout.elements.stride, size, accessor->count);
        if (!elements) return tl::unexpected(elements.error());
        layout.elements.bytes = *elements;
    }
    if (!accessor->sparse.isSparse) return layout;

    const auto& sparse = accessor->sparse;
    const auto sparseCount = static_cast<std::size_t>(sparse.count);
    const std::string field = layout.field + ".sparse";
    if (!isUnsigned(sparse.indices.componentType))
        return fail(field + ".indices.componentType: is no unsigned integer; export the file again");
    layout.placeSize = sizeOf(sparse.indices.componentType);
    const auto read = [&](const char* name, int itsView, int offset,
                          std::size_t itsSize) -> Expected<Layout::Elements> {
        const auto bytes = view(itsView, field + name + ".bufferView");
        if (!bytes) return tl::unexpected(bytes.error());
        const auto elements =
            within(*bytes, field + name, static_cast<std::size_t>(offset), itsSize, itsSize, sparseCount);
        if (!elements) return tl::unexpected(elements.error());
        return Layout::Elements{*elements, itsSize, sparseCount};
    };
    const auto places = read(".indices", sparse.indices.bufferView, sparse.indices.byteOffset, layout.placeSize);
    if (!places) return tl::unexpected(places.error());
    const auto values = read(".values", sparse.values.bufferView, sparse.values.byteOffset, size);
    if (!values) return tl::unexpected(values.error());
    layout.places = *places;
    layout.values = *values;
    return layout;
}

template <class Number, class Convert>
Expected<std::vector<Number>> GltfAccessors::read(const Layout& layout, const Convert& convert) const
{
    const std::size_t components = layout.components;
    if (!fitsInMemory(layout.elements.count * components * sizeof(Number))) {
        return fail(layout.field + ": " + std::to_string(layout.elements.count) +
                    " elements do not fit into memory; simplify the scene");
    }
    std::vector<Number> numbers(layout.elements.count * components);
    const auto take = [&](const Layout::Elements& from, std::size_t element, std::size_t to) {
        for (std::size_t c = 0; c < components; ++c) {
            numbers[to * components + c] =
                convert(wordAt(from.bytes, element * from.stride + c * layout.componentSize, layout.componentSize));
        }
    };
    if (!layout.elements.bytes.empty()) {
        for (std::size_t i = 0; i < layout.elements.count; ++i) take(layout.elements, i, i);
    }
    if (!layout.places) return numbers;
    for (std::size_t i = 0; i < layout.places->count; ++i) {
        const std::uint32_t place = wordAt(layout.places->bytes, i * layout.placeSize, layout.placeSize);
        if (place >= layout.elements.count) {
            return fail(layout.field + ".sparse.indices: there is no element " + std::to_string(place) + " among " +
                        std::to_string(layout.elements.count) + "; export the file again");
        }
        take(*layout.values, i, place);
    }
    return numbers;
}

Expected<std::vector<float>> GltfAccessors::floats(int index, int components, const std::string& user) const
{
    const Expected<Layout> layout = layoutOf(index, components, user);
    if (!layout) return tl::unexpected(layout.error());
    Expected<std::vector<float>> numbers = read<float>(
        *layout, [&](std::uint32_t word) { return floatOf(word, layout->componentType, layout->normalized); });
    if (!numbers) return numbers;
    const auto bad = std::find_if(numbers->begin(), numbers->end(), [](float x) { return !std::isfinite(x); });
    if (bad == numbers->end()) return numbers;
    return fail(layout->field + ": element " + std::to_string((bad - numbers->begin()) / components) + " (" + user +
                ") is not finite; repair the file");
}

Expected<std::vector<std::uint32_t>> GltfAccessors::indices(int index, std::size_t limit, const std::string& user) const
{
    const Expected<Layout> layout = layoutOf(index, 1, user);
    if (!layout) return tl::unexpected(layout.error());
    if (!isUnsigned(layout->componentType)) {
        return fail(layout->field + ".componentType: " + user + " takes unsigned integers; export the file again");
    }
    Expected<std::vector<std::uint32_t>> numbers =
        read<std::uint32_t>(*layout, [](std::uint32_t word) { return word; });
    if (!numbers) return numbers;
    const auto bad = std::find_if(numbers->begin(), numbers->end(), [limit](std::uint32_t i) { return i >= limit; });
    if (bad == numbers->end()) return numbers;
    return fail(user + ": there is no vertex " + std::to_string(*bad) + " among " + std::to_string(limit) +
                "; repair the file");
}

}  // namespace relief
