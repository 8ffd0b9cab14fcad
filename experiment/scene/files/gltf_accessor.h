/// Numbers of a glTF file's buffers, as its accessors describe them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <string_view>
#include <vector>

#include "experiment/scene/files/gltf_buffers.h"

namespace overt {

/// Elements of one to four numbers each, one after another.
struct GltfNumbers {
    std::size_t components = 0;
    std::vector<float> values;
    bool is_normalised = false; ///< were whole numbers that stand for 0 … 1 or -1 … 1

    std::size_t count() const { return values.size() / components; }
    const float* operator[](std::size_t element) const { return &values[element * components]; }
};

/// Reads accessors. What contradicts itself throws InputError at its place; nothing is asked for that the
/// buffers could not hold.
class GltfAccessors {
  public:
    /// Both must outlive it.
    GltfAccessors(const GltfValue& root, GltfBuffers& buffers) : root_(root), buffers_(&buffers) {}

    /// What an accessor says of its numbers, wherever they lie.
    struct Form {
        std::size_t components = 0, count = 0;
        double most = 0.0; ///< what stands for 1 if they are normalised; 0: floats
        bool is_normalised = false;
        /// The number that is meant by one that is stored; the lowest of a type with a sign is -1, too.
        double value_of(double stored) const {
            return is_normalised ? std::max(stored / most, -1.0) : stored;
        }
    };
    /// Of the accessor that `index` names, which has elements of one of the `types` ("VEC3").
    Form form(const GltfValue& index, std::initializer_list<std::string_view> types) const;

    /// Of the accessor that `index` names, which has elements of one of the `types` ("VEC3"). Whole numbers
    /// that are normalised become 0 … 1 or -1 … 1; numbers that are not finite are refused.
    GltfNumbers numbers(const GltfValue& index, std::initializer_list<std::string_view> types);

    /// Of the accessor of indices that `index` names, each below `most`.
    std::vector<std::uint32_t> indices(const GltfValue& index, std::size_t most);

    /// How many elements it says that it has.
    std::size_t count(const GltfValue& index) const;

  private:
    GltfValue root_;
    GltfBuffers* buffers_;
};

} // namespace overt
