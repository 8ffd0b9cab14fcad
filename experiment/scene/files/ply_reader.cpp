#include "experiment/scene/files/ply_reader.h"

#include <algorithm>
#include <array>
#include <limits>

#include <fmt/format.h>

#include "experiment/scene/files/ply_header.h"
#include "experiment/scene/files/ply_look.h"
#include "experiment/scene/files/ply_values.h"
#include "experiment/scene/files/triangle_labels.h"
#include "experiment/scene/making/face_cutting.h"

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

// Where a number can be no coordinate the vertex is NaN; one that a face uses is named in a second reading,
// by its row (`refused`).
template <class Values>
std::vector<PartLabel> read_vertices(Values& values, const PlyElement& element, std::uint64_t refused,
                                     RawMesh& mesh, PlyLook* look) {
    const PlyLookColumns columns = look ? PlyLookColumns::of(element) : PlyLookColumns();
    const bool has_colour = columns.colour[0] != none, has_place = columns.place[0] != none;
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
        glm::dvec3& position = mesh.positions[row];
        const auto coordinate = [&](PlyType type, char axis) {
            const double value = values.coordinate(type, axis);
            if (is_coordinate(value))
                return value;
            if (row == refused) {
                values.fail(
                    fmt::format("{} of vertex {} (counted from 0) is {}; coordinates must be finite and "
                                "fit a 32-bit float.",
                                axis, row, value));
            }
            return std::numeric_limits<double>::quiet_NaN();
        };
        glm::vec3 colour(0.0f);
        glm::vec2 place(0.0f);
        for (std::size_t i = 0; i < element.properties.size(); ++i) {
            const PlyProperty& property = element.properties[i];
            if (i == x) {
                position.x = coordinate(property.type, 'x');
            } else if (i == y) {
                position.y = coordinate(property.type, 'y');
            } else if (i == z) {
                position.z = coordinate(property.type, 'z');
            } else if (i == label) {
                labels[row] = label_in(values, property.type);
            } else if (const std::size_t channel = columns.channel(i); channel < 3) {
                colour[static_cast<int>(channel)] =
                    PlyLook::share_of(values.coordinate(property.type, 'c'), property.type);
            } else if (i == columns.place[0] || i == columns.place[1]) {
                const double value = values.coordinate(property.type, 'u');
                place[i == columns.place[0] ? 0 : 1] =
                    is_coordinate(value) ? static_cast<float>(value) : 0.0f;
            } else {
                skip_property(values, property);
            }
        }
        values.end_row();
        if (has_colour)
            look->set_vertex_colour(row, colour);
        if (has_place)
            look->set_vertex_place(row, place);
    }
    return labels;
}

template <class Values>
std::uint32_t vertex_in(Values& values, std::int64_t index, std::uint64_t vertex_count, std::uint64_t row,
                        std::string_view owner) {
    if (index < 0 || static_cast<std::uint64_t>(index) >= vertex_count) {
        values.fail(fmt::format("{} {} (counted from 0) uses vertex {}, but the vertices are 0 to {}.", owner,
                                row, index, vertex_count - 1));
    }
    return static_cast<std::uint32_t>(index);
}

template <class Values>
std::uint32_t corner_in(Values& values, PlyType type, std::uint64_t vertex_count, std::uint64_t row) {
    return vertex_in(values, values.integer(type), vertex_count, row, "face");
}

// What -1 becomes in a type without a sign.
std::int64_t restart_of(PlyType type) {
    switch (type) {
    case PlyType::uint8:
        return 0xff;
    case PlyType::uint16:
        return 0xffff;
    case PlyType::uint32:
        return 0xffffffff;
    default:
        return -1;
    }
}

template <class Values>
void read_polygon(Values& values, const PlyProperty& list, std::uint64_t vertex_count, std::uint64_t row,
                  FaceFans& into) {
    const std::int64_t corners = list_length(values, list);
    if (corners < 3) {
        values.fail(
            fmt::format("face {} (counted from 0) has {} corners; a face has at least 3.", row, corners));
    }
    into.begin_face();
    for (std::int64_t corner = 0; corner < corners; ++corner)
        into.add_corner(corner_in(values, list.type, vertex_count, row));
}

// Each corner after the second makes a triangle with the two before it, of which every other one is turned;
// -1 begins a new strip. Strips are joined by triangles with a corner twice, which are no surface.
template <class Values>
void read_strip(Values& values, const PlyProperty& list, std::uint64_t vertex_count, std::uint64_t row,
                RawMesh& mesh) {
    std::array<std::uint32_t, 3> last{};
    std::size_t corners = 0;
    for (std::int64_t left = list_length(values, list); left > 0; --left) {
        const std::int64_t index = values.integer(list.type);
        if (index == -1 || index == restart_of(list.type)) {
            corners = 0;
            continue;
        }
        last = {last[1], last[2], vertex_in(values, index, vertex_count, row, "strip")};
        ++corners;
        const auto [a, b, c] = last;
        if (corners < 3 || a == b || b == c || c == a)
            continue;
        mesh.triangles.push_back(corners % 2 == 1 ? glm::uvec3(a, b, c) : glm::uvec3(b, a, c));
    }
}

// Faces, or strips of triangles.
template <class Values>
void read_faces(Values& values, const PlyElement& element, std::uint64_t vertex_count, RawMesh& mesh,
                FaceFans& fans, PlyLook* look) {
    const PlyLookColumns columns = look ? PlyLookColumns::of(element) : PlyLookColumns();
    const bool has_colour = columns.colour[0] != none;
    std::vector<float> places;
    const bool is_strips = element.name == "tristrips";
    const std::size_t corners = find_corner_list(element).value();
    const std::size_t label = label_property(element);
    const PlyProperty& list = element.properties[corners];
    if (!is_strips) {
        // Triangles are the rule; a file too short for that many has fewer.
        const std::uint64_t reserved = std::min(element.count, values.room_for(list.type) / 3);
        mesh.triangles.reserve(mesh.triangles.size() + reserved);
        if (label != none)
            mesh.triangle_labels.reserve(mesh.triangle_labels.size() + reserved);
    }
    const bool others_labelled = !mesh.triangle_labels.empty();
    const bool is_labelled = label != none || others_labelled;
    if (is_labelled)
        mesh.triangle_labels.resize(mesh.triangles.size());
    for (std::uint64_t row = 0; row < element.count; ++row) {
        values.begin_row(row);
        PartLabel face_label = 0;
        const std::size_t first_triangle = mesh.triangles.size();
        glm::vec3 colour(0.0f);
        std::int64_t picture = 0;
        places.clear();
        for (std::size_t i = 0; i < element.properties.size(); ++i) {
            const PlyProperty& property = element.properties[i];
            if (i == corners && is_strips) {
                read_strip(values, property, vertex_count, row, mesh);
            } else if (i == corners) {
                read_polygon(values, property, vertex_count, row, fans);
            } else if (i == label) {
                face_label = label_in(values, property.type);
            } else if (const std::size_t channel = columns.channel(i); channel < 3) {
                colour[static_cast<int>(channel)] =
                    PlyLook::share_of(values.coordinate(property.type, 'c'), property.type);
            } else if (i == columns.corner_places) {
                for (std::int64_t left = list_length(values, property); left > 0; --left) {
                    const double value = values.coordinate(property.type, 'u');
                    places.push_back(is_coordinate(value) ? static_cast<float>(value) : 0.0f);
                }
            } else if (i == columns.picture && is_integer(property.type)) {
                picture = values.integer(property.type);
            } else {
                skip_property(values, property);
            }
        }
        values.end_row();
        if (is_labelled)
            mesh.triangle_labels.resize(mesh.triangles.size(), face_label);
        if (look)
            look->set_face(first_triangle, mesh.triangles.size(),
                           has_colour ? std::optional(colour) : std::nullopt, places, picture);
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

template <class Values>
RawMesh read_body(Values values, const PlyHeader& header, std::uint64_t refused, PlyLook* look) {
    RawMesh mesh;
    FaceFans fans(mesh);
    std::vector<PartLabel> vertex_labels;
    const std::uint64_t vertex_count = header.find("vertex")->count;
    for (const PlyElement& element : header.elements) {
        values.begin_element(element);
        if (element.name == "vertex") {
            vertex_labels = read_vertices(values, element, refused, mesh, look);
        } else if ((element.name == "face" || element.name == "tristrips") && element.count > 0) {
            read_faces(values, element, vertex_count, mesh, fans, look);
        } else {
            skip_element(values, element);
        }
    }
    values.end();
    if (first_used_without_place(mesh))
        return mesh;
    fans.cut();
    if (mesh.triangle_labels.empty() && !vertex_labels.empty())
        label_by_corners(mesh, vertex_labels);
    if (!mesh.triangle_labels.empty())
        mesh.part_names = header.part_names;
    return mesh;
}

template <class Values>
RawMesh read_whole_body(const MeshSource& source, const PlyHeader& header, MeshWanted wanted) {
    PlyLook look;
    const bool wants_look = wanted == MeshWanted::appearance;
    constexpr auto nobody = std::numeric_limits<std::uint64_t>::max();
    RawMesh mesh = read_body(Values(source, header), header, nobody, wants_look ? &look : nullptr);
    if (mesh.triangles.empty())
        source.fail("the strips of this PLY file have no triangles; a surface is needed.");
    if (const auto vertex = first_used_without_place(mesh))
        return read_body(Values(source, header), header, *vertex, nullptr);
    if (wants_look)
        look.finish(mesh, source, header);
    return mesh;
}

} // namespace

bool is_ply(const MeshSource& source) {
    const std::string_view bytes = source.bytes();
    return bytes.starts_with("ply") && (bytes.size() == 3 || bytes[3] == '\n' || bytes[3] == '\r');
}

RawMesh read_ply(const MeshSource& source, MeshWanted wanted) {
    const PlyHeader header = read_ply_header(source);
    if (header.format == PlyFormat::text)
        return read_whole_body<PlyText>(source, header, wanted);
    return read_whole_body<PlyBinary>(source, header, wanted);
}

} // namespace overt
