/// What a coordinate-encoded map is a map of: kept in its file, or in a JSON file beside it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "experiment/base/content_hash.h"
#include "experiment/scene/viewing.h"

namespace overt {

/// Whatever is not known is empty. Lengths are in `unit`.
struct MapDescription {
    std::string object;           ///< its id
    std::string unit;             ///< of the coordinates, in words
    std::optional<Bounds> bounds; ///< of the object; by which codes are made
    std::optional<int> scale;     ///< of codes: 65535 or 65536
    std::optional<Camera> camera; ///< up is +z
    std::optional<Degrees> angle; ///< turn about the vertical through the middle of the bounds
    std::optional<int> frame;     ///< of the animation
    std::optional<glm::ivec2> size_px;
    ContentHash mesh_sha256; ///< of the mesh's content, see Object::mesh_hash
    /// Of a map of what is seen through a body of clear glass (GlassSight); nothing of the front.
    std::optional<double> glass_index = {};
};

/// The sidecar of a map: the same path with the extension .json.
std::filesystem::path sidecar_of(const std::filesystem::path& map_file);

/// As JSON, with a few words on the convention for people; numbers with all their digits.
nlohmann::ordered_json to_json(const MapDescription& description);

/// Reads a sidecar; keys that it does not know are left alone. Nothing if there is no such file. Throws
/// InputError naming the file and the key if the file is no JSON, or a key has the wrong kind of value.
std::optional<MapDescription> read_sidecar(const std::filesystem::path& file);

/// Writes a sidecar at once or not at all. Throws RecordError.
void write_sidecar(const std::filesystem::path& file, const MapDescription& description);

} // namespace overt
