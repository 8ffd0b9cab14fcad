/// A primitive of a glTF file whose triangles and attributes are packed by Draco
/// (KHR_draco_mesh_compression).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "experiment/scene/files/gltf_accessor.h"
#include "experiment/scene/files/gltf_json.h"

namespace overt {

inline constexpr std::string_view draco_extension = "KHR_draco_mesh_compression";

class DracoPrimitive {
  public:
    /// Unpacks `bytes`, those of the buffer view that `packed`, the extension of a primitive, names. What
    /// they claim to be is held against what so many bytes can be, and against the `corners` that the file
    /// says, if it says any, before anything is allocated. Throws InputError at the place.
    DracoPrimitive(const GltfValue& packed, std::string_view bytes, std::optional<std::uint64_t> corners);
    ~DracoPrimitive();
    DracoPrimitive(DracoPrimitive&&) noexcept;

    std::size_t vertex_count() const;
    /// Three for each triangle.
    std::vector<std::uint32_t> corners() const;
    /// Whether an attribute, such as POSITION, is packed.
    bool has(std::string_view attribute) const;
    /// Of each vertex. `form`: what the accessor of the attribute says of it.
    GltfNumbers numbers(std::string_view attribute, const GltfAccessors::Form& form) const;

  private:
    struct Unpacked;
    GltfValue packed_;
    std::unique_ptr<Unpacked> unpacked_;
};

} // namespace overt
