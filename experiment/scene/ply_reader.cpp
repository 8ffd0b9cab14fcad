#include "experiment/scene/ply_reader.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "experiment/scene/ply_header.h"
#include "experiment/scene/ply_values.h"
#include "experiment/scene/triangle_labels.h"

namespace overt {
namespace {

constexpr std::size_t none = static_cast<std::size_t>(-1);

std::size_t label_property(const PlyElement& element) {
    const auto found = find_property(element, {"part", "part_id", "label"}, false);
    return found && is_integer(element.properties[*found].type) ? *found : none;
}

template <class Values> std::int64_t list_length(Values& values, const PlyProperty& property) {
    const std::int64_t length = values.integer(*property.count_type);
    if (length < 0) {
        values.fail(fmt::format("the list {} has the impossible length {}.", property.name, length));
    }
    return length;
}

template <class Values> void skip_property(Values& values, const PlyProperty& property) {
    values.skip(property.type, property.count_type ? list_length(values, property) : 1);
}

template <class Values> PartLabel label_in(Values& values, PlyType type) {
    const std::int64_t label = values.integer(type);
    if (label < std::numeric_limits<PartLabel>::min() || label > std::numeric_limits<PartLabel>::max()) {
        values.fail(fmt::format("the part label {} does not fit 32 bits with sign.", label));
    }
    return static_cast<PartLabel>(label);
}

template <class Values>
std::vector<PartLabel> read_vertices(Values& values, const PlyElement& element, RawMesh& mesh) {
    const std::size_t x = find_property(element, {"x"}, false).value();
    const std::size_t y = find_property(element, {"y"}, false).value();
    const std::size_t z = find_property(element, {"z"}, false).value();
    const std::size_t label = label_property(element);
    std::vector<PartLabel> labels;
    mesh.positions.resize(element.count);
    if (label != none)
        labels.resize(element.count);
    for (std::uint64_t row = 0; row < element.count; ++row) {
        values.begin_row(row);
        glm::vec3& position = mesh.positions[row];
        for (std::size_t i = 0; i < element.properties.size(); ++i) {
            const PlyProperty& property = element.properties[i];
            if (i == x) {
                position.x = values.coordinate(property.type, 'x');
            } else if (i == y) {
                position.y = values.coordinate(property.type, 'y');
            } else if (i == z) {
                position.z = values.coordinate(property.type, 'z');
            } else if (i == label) {
                labels[row] = label_in(values, property.type);
            } else {
                skip_property(values, property);
            }
        }
        values.end_row();
    }
    return labels;
}

template <class Values>
std::uint32_t corner_in(Values& values, PlyType type, std::uint64_t vertex_count, std::uint64_t row) {
    const std::int64_t index = values.integer(type);
    if (index < 0 || static_cast<std::uint64_t>(index) >= vertex_count) {
        values.fail(fmt::format("face {} (counted from 0) uses vertex {}, but the vertices are 0 to {}.", row,
                                index, vertex_count - 1));
    }
    return static_cast<std::uint32_t>(index);
}

template <class Values>
void read_polygon(Values& values, const PlyProperty& list, std::uint64_t vertex_count, std::uint64_t row,
                  RawMesh& mesh) {
    const std::int64_t corners = list_length(values, list);
    if (corners < 3) {
        values.fail(
            fmt::format("face {} (counted from 0) has {} corners; a face has at least 3.", row, corners));
    }
    const std::uint32_t first = corner_in(values, list.type, vertex_count, row);
    std::uint32_t previous = corner_in(values, list.type, vertex_count, row);
    for (std::int64_t corner = 2; corner < corners; ++corner) {
        const std::uint32_t next = corner_in(values, list.type, vertex_count, row);
        mesh.triangles.emplace_back(first, previous, next);
        previous = next;
    }
}

template <class Values>
void read_faces(Values& values, const PlyElement& element, std::uint64_t vertex_count, RawMesh& mesh) {
    const std::size_t corners = find_property(element, {"vertex_indices", "vertex_index"}, true).value();
    const std::size_t label = label_property(element);
    const PlyProperty& list = element.properties[corners];
    // Triangles are the rule; a file too short for that many has fewer.
    const std::uint64_t reserved = std::min(element.count, values.room_for(list.type) / 3);
    mesh.triangles.reserve(reserved);
    if (label != none)
        mesh.triangle_labels.reserve(reserved);
    for (std::uint64_t row = 0; row < element.count; ++row) {
        values.begin_row(row);
        PartLabel face_label = 0;
        for (std::size_t i = 0; i < element.properties.size(); ++i) {
            const PlyProperty& property = element.properties[i];
            if (i == corners) {
                read_polygon(values, property, vertex_count, row, mesh);
            } else if (i == label) {
                face_label = label_in(values, property.type);
            } else {
                skip_property(values, property);
            }
        }
        values.end_row();
        if (label != none)
            mesh.triangle_labels.resize(mesh.triangles.size(), face_label);
    }
}

template <class Values> void skip_element(Values& values, const PlyElement& element) {
    if (element.properties.empty())
        return;
    for (std::uint64_t row = 0; row < element.count; ++row) {
        values.begin_row(row);
        for (const PlyProperty& property : element.properties)
            skip_property(values, property);
        values.end_row();
    }
}

template <class Values> RawMesh read_body(Values values, const PlyHeader& header) {
    RawMesh mesh;
    std::vector<PartLabel> vertex_labels;
    const std::uint64_t vertex_count = header.find("vertex")->count;
    for (const PlyElement& element : header.elements) {
        values.begin_element(element);
        if (element.name == "vertex") {
            vertex_labels = read_vertices(values, element, mesh);
        } else if (element.name == "face") {
            read_faces(values, element, vertex_count, mesh);
        } else {
            skip_element(values, element);
        }
    }
    values.end();
    if (mesh.triangle_labels.empty() && !vertex_labels.empty())
        label_by_corners(mesh, vertex_labels);
    if (!mesh.triangle_labels.empty())
        mesh.part_names = header.part_names;
    return mesh;
}

} // namespace

bool is_ply(const MeshSource& source) {
    const std::string_view bytes = source.bytes();
    return bytes.starts_with("ply") && (bytes.size() == 3 || bytes[3] == '\n' || bytes[3] == '\r');
}

RawMesh read_ply(const MeshSource& source) {
    const PlyHeader header = read_ply_header(source);
    if (header.format == PlyFormat::text)
        return read_body(PlyText(source, header), header);
    return read_body(PlyBinary(source, header), header);
}

} // namespace overt
