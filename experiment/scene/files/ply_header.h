/// The header of a PLY file: which elements follow, how often, and how each of their properties is stored.
/// Format: Greg Turk, "The PLY Polygon File Format" (1994).
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/scene/files/mesh_source.h"
#include "experiment/scene/making/raw_mesh.h"

namespace overt {

enum class PlyFormat : std::uint8_t { text, little_endian, big_endian };

/// Types of stored values. The 64-bit integers are not Turk's, but some programs write them.
enum class PlyType : std::uint8_t {
    int8,
    uint8,
    int16,
    uint16,
    int32,
    uint32,
    int64,
    uint64,
    float32,
    float64
};

/// Bytes of one value in a binary file.
std::size_t size_of(PlyType type);
bool is_integer(PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::float32;
    std::optional<PlyType> count_type; ///< of a list: how its length is stored; nullopt for a single value
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    PlyFormat format = PlyFormat::text;
    std::vector<PlyElement> elements;
    std::map<PartLabel, std::string> part_names; ///< from lines `comment part LABEL NAME`
    std::vector<std::string> picture_files;      ///< from lines `comment TextureFile NAME`
    std::size_t body_offset = 0;                 ///< byte after the header
    std::size_t body_line = 1;                   ///< line after the header

    /// The element of that name, or null.
    const PlyElement* find(std::string_view element_name) const;
};

/// Index of the element's first property that has one of the names and is a list (or is not); nullopt if
/// there is none.
std::optional<std::size_t> find_property(const PlyElement& element,
                                         std::initializer_list<std::string_view> names, bool is_list);

/// The list that holds the corners of a face or strip: `vertex_indices` or `vertex_index`.
std::optional<std::size_t> find_corner_list(const PlyElement& element);

/// Reads the header. Throws InputError with line and column if it is damaged, or lacks what a triangle mesh
/// needs: an element `vertex` with x, y and z, and an element `face` or `tristrips` with a list
/// `vertex_indices` or `vertex_index`.
PlyHeader read_ply_header(const MeshSource& source);

} // namespace overt
