/// The JSON of a glTF file, looked into with the place of each value, so that whatever is wrong can be said
/// at its place: a pointer such as /meshes/0/primitives/1/indices (RFC 6901).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "experiment/scene/files/mesh_source.h"

namespace overt {

/// A value of the JSON. The file and the JSON must outlive it. What is not as it has to be throws InputError.
class GltfValue {
  public:
    GltfValue(const MeshSource& source, const nlohmann::json& value, std::string pointer)
        : source_(&source), value_(&value), pointer_(std::move(pointer)) {}

    /// A member of an object; nothing if it is not there.
    std::optional<GltfValue> find(std::string_view key) const;
    /// A member that has to be there.
    GltfValue at(std::string_view key) const;
    /// An item of an array; fails at this value if there is none of that number.
    GltfValue item(std::size_t index) const;
    /// Of an array.
    std::size_t size() const;
    /// The members of an object, in the order of the alphabet.
    std::vector<std::string> keys() const;

    /// Finite.
    double number() const;
    double number_or(std::string_view key, double otherwise) const;
    /// From 0 to `most`.
    std::uint64_t whole(std::uint64_t most = most_whole) const;
    std::uint64_t whole_or(std::string_view key, std::uint64_t otherwise) const;
    bool truth_or(std::string_view key, bool otherwise) const;
    const std::string& text() const;
    /// Empty if it is not there.
    std::string text_or_empty(std::string_view key) const;
    bool is_text() const { return value_->is_string(); }

    const std::string& pointer() const { return pointer_; }
    const MeshSource& source() const { return *source_; }
    /// Throws InputError "PATH: POINTER: MESSAGE".
    [[noreturn]] void fail(std::string_view message) const;

    /// Whole numbers that a double of JSON holds exactly.
    static constexpr std::uint64_t most_whole = std::uint64_t{1} << 53;

  private:
    const MeshSource* source_;
    const nlohmann::json* value_;
    std::string pointer_;
};

/// A glTF file in its two parts.
struct GltfContent {
    nlohmann::json json;
    std::string_view binary; ///< of a .glb; empty without
    bool has_binary = false;
};

/// Takes a .glb apart, or a .gltf as it is, and reads its JSON. Throws InputError with the byte for what is
/// cut off, no JSON, or of another version than 2.
GltfContent read_gltf_content(const MeshSource& source);

/// The entry of a list of the file, such as "meshes", that `index` names. Throws InputError at `index` if
/// there is none.
GltfValue gltf_entry(const GltfValue& root, std::string_view list, const GltfValue& index);

} // namespace overt
