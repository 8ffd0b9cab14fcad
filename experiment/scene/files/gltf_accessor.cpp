#include "experiment/scene/files/gltf_accessor.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/scene/mesh.h"

namespace overt {
namespace {

/// Elements without bytes in the file are zeros; so many of them at most are made on its word alone.
constexpr std::size_t most_zeros = std::size_t{1} << 22;

struct ComponentType {
    std::uint64_t code;
    std::size_t bytes;
    bool is_index, is_signed;
    double most; ///< what stands for 1 if normalised; 0: a float
};
constexpr ComponentType component_types[] = {
    {5120, 1, false, true, 127.0},   {5121, 1, true, false, 255.0},        {5122, 2, false, true, 32767.0},
    {5123, 2, true, false, 65535.0}, {5125, 4, true, false, 4294967295.0}, {5126, 4, false, true, 0.0}};

const ComponentType& component_type(const GltfValue& code) {
    const std::uint64_t number = code.whole();
    for (const ComponentType& type : component_types)
        if (type.code == number)
            return type;
    code.fail(fmt::format("there is no type of numbers {}.", number));
}

std::size_t components_of(const GltfValue& type) {
    constexpr std::pair<std::string_view, std::size_t> known[] = {
        {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}};
    for (const auto& [name, components] : known)
        if (type.text() == name)
            return components;
    type.fail("a mesh has elements of the types SCALAR, VEC2, VEC3 and VEC4.");
}

double number_at(const char* bytes, const ComponentType& type) {
    constexpr std::endian order = std::endian::little;
    switch (type.code) {
    case 5120:
        return stored_value<std::int8_t>(bytes, order);
    case 5121:
        return stored_value<std::uint8_t>(bytes, order);
    case 5122:
        return stored_value<std::int16_t>(bytes, order);
    case 5123:
        return stored_value<std::uint16_t>(bytes, order);
    case 5125:
        return stored_value<std::uint32_t>(bytes, order);
    default:
        return static_cast<double>(stored_value<float>(bytes, order));
    }
}

/// Where elements lie, known to be there.
struct Elements {
    const char* first = nullptr;
    std::size_t stride = 0;

    const char* operator[](std::size_t element) const { return first + element * stride; }
};

/// `count` elements of `bytes` from `offset` on in a view. Fails at `whose` if they are not all in it.
Elements elements_in(const GltfBuffers::View& view, std::size_t offset, std::size_t count, std::size_t bytes,
                     const GltfValue& whose) {
    const std::size_t stride = view.stride == 0 ? bytes : view.stride;
    if (stride < bytes)
        whose.fail(
            fmt::format("its elements have {} bytes, but its buffer view has one every {}.", bytes, stride));
    const std::size_t there = view.bytes.size();
    // Divided, since a product of what a file says might wrap.
    if (offset > there || bytes > there - offset || count - 1 > (there - offset - bytes) / stride)
        whose.fail(
            fmt::format("{} elements of {} bytes from byte {} do not lie in its buffer view, which has {}.",
                        count, bytes, offset, there));
    return {view.bytes.data() + offset, stride};
}

std::size_t count_of(const GltfValue& accessor) {
    const GltfValue count = accessor.at("count");
    const std::size_t number = count.whole();
    if (number == 0)
        count.fail("an accessor has at least one element.");
    if (number > 4 * max_mesh_vertices)
        count.fail("these are too many elements.");
    return number;
}

/// What a sparse accessor has otherwise: numbers of elements, rising, and the elements themselves.
struct SparseElements {
    std::size_t count = 0;
    Elements indices, values;
    const ComponentType* index_type = nullptr;
};

std::optional<SparseElements> sparse_of(const GltfValue& accessor, GltfBuffers& buffers, std::size_t count,
                                        std::size_t bytes) {
    const std::optional<GltfValue> sparse = accessor.find("sparse");
    if (!sparse)
        return std::nullopt;
    SparseElements elements;
    elements.count = sparse->at("count").whole();
    if (elements.count == 0 || elements.count > count)
        sparse->at("count").fail(fmt::format("an accessor of {} elements has 1 to {} others.", count, count));
    const GltfValue indices = sparse->at("indices"), values = sparse->at("values");
    elements.index_type = &component_type(indices.at("componentType"));
    if (!elements.index_type->is_index)
        indices.at("componentType").fail("indices have 8, 16 or 32 bits without a sign.");
    elements.indices = elements_in(buffers.view(indices.at("bufferView")), indices.whole_or("byteOffset", 0),
                                   elements.count, elements.index_type->bytes, indices);
    elements.values = elements_in(buffers.view(values.at("bufferView")), values.whole_or("byteOffset", 0),
                                  elements.count, bytes, values);
    double before = -1.0;
    for (std::size_t i = 0; i < elements.count; ++i) {
        const double index = number_at(elements.indices[i], *elements.index_type);
        if (index <= before || index >= static_cast<double>(count))
            indices.fail(fmt::format("index {} of the sparse elements is {}; they rise, and are below {}.", i,
                                     index, count));
        before = index;
    }
    return elements;
}

} // namespace

std::size_t GltfAccessors::count(const GltfValue& index) const {
    return count_of(gltf_entry(root_, "accessors", index));
}

GltfAccessors::Form GltfAccessors::form(const GltfValue& index,
                                        std::initializer_list<std::string_view> types) const {
    const GltfValue accessor = gltf_entry(root_, "accessors", index);
    const GltfValue type_name = accessor.at("type");
    if (std::ranges::find(types, std::string_view(type_name.text())) == types.end())
        index.fail(fmt::format("names an accessor of the type {}; {} is needed here.", type_name.text(),
                               fmt::join(types, " or ")));
    const ComponentType& type = component_type(accessor.at("componentType"));
    if (type.code == 5125)
        accessor.at("componentType").fail("a corner's attribute has no whole numbers of 32 bits.");
    Form form{components_of(type_name), count_of(accessor), type.most,
              accessor.truth_or("normalized", false)};
    if (form.is_normalised && type.most == 0.0)
        accessor.at("normalized").fail("floats are not normalised.");
    return form;
}

GltfNumbers GltfAccessors::numbers(const GltfValue& index, std::initializer_list<std::string_view> types) {
    const Form of = form(index, types);
    const std::size_t components = of.components, count = of.count;
    const GltfValue accessor = gltf_entry(root_, "accessors", index);
    const ComponentType& type = component_type(accessor.at("componentType"));
    const std::size_t bytes = components * type.bytes;

    GltfNumbers numbers{components, {}, of.is_normalised};
    const auto take = [&](const char* from, std::size_t element) {
        for (std::size_t i = 0; i < components; ++i) {
            const double value = of.value_of(number_at(from + i * type.bytes, type));
            if (!std::isfinite(value))
                accessor.fail(
                    fmt::format("number {} of element {} (counted from 0) is not finite.", i, element));
            numbers.values[element * components + i] = static_cast<float>(value);
        }
    };
    if (const std::optional<GltfValue> view = accessor.find("bufferView")) {
        const Elements elements =
            elements_in(buffers_->view(*view), accessor.whole_or("byteOffset", 0), count, bytes, accessor);
        numbers.values.resize(count * components);
        for (std::size_t element = 0; element < count; ++element)
            take(elements[element], element);
    } else {
        if (count > most_zeros)
            accessor.fail(fmt::format("it has {} elements and no \"bufferView\" in which they lie.", count));
        numbers.values.resize(count * components);
    }
    if (const auto sparse = sparse_of(accessor, *buffers_, count, bytes)) {
        for (std::size_t i = 0; i < sparse->count; ++i)
            take(sparse->values[i],
                 static_cast<std::size_t>(number_at(sparse->indices[i], *sparse->index_type)));
    }
    return numbers;
}

std::vector<std::uint32_t> GltfAccessors::indices(const GltfValue& index, std::size_t most) {
    const GltfValue accessor = gltf_entry(root_, "accessors", index);
    const ComponentType& type = component_type(accessor.at("componentType"));
    if (!type.is_index || accessor.at("type").text() != "SCALAR")
        accessor.fail("indices are SCALAR, of 8, 16 or 32 bits without a sign.");
    const std::size_t count = count_of(accessor);
    const auto checked = [&](const char* from, std::size_t element) {
        const double value = number_at(from, type);
        if (value == type.most)
            accessor.fail(
                fmt::format("index {} (counted from 0) is {}, which glTF does not allow.", element, value));
        if (value >= static_cast<double>(most))
            accessor.fail(fmt::format("index {} (counted from 0) is {}, but the vertices are 0 to {}.",
                                      element, value, most - 1));
        return static_cast<std::uint32_t>(value);
    };
    std::vector<std::uint32_t> indices;
    if (const std::optional<GltfValue> view = accessor.find("bufferView")) {
        const Elements elements = elements_in(buffers_->view(*view), accessor.whole_or("byteOffset", 0),
                                              count, type.bytes, accessor);
        indices.reserve(count);
        for (std::size_t element = 0; element < count; ++element)
            indices.push_back(checked(elements[element], element));
    } else {
        if (count > most_zeros)
            accessor.fail(fmt::format("it has {} elements and no \"bufferView\" in which they lie.", count));
        indices.assign(count, 0);
    }
    if (const auto sparse = sparse_of(accessor, *buffers_, count, type.bytes)) {
        for (std::size_t i = 0; i < sparse->count; ++i) {
            const auto element = static_cast<std::size_t>(number_at(sparse->indices[i], *sparse->index_type));
            indices[element] = checked(sparse->values[i], element);
        }
    }
    return indices;
}

} // namespace overt
