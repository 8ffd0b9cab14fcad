#include "experiment/scene/files/vertex_values.h"

#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "experiment/scene/files/ply_header.h"
#include "experiment/scene/files/ply_reader.h"
#include "experiment/scene/files/ply_values.h"

namespace overt {

namespace {

std::optional<std::size_t> value_property(const PlyElement& vertices) {
    constexpr std::array<std::string_view, 6> names{"saliency", "density", "value",
                                                    "quality",  "scalar",  "intensity"};
    for (const std::string_view name : names) {
        if (const auto found = find_property(vertices, {name}, false))
            return found;
    }
    for (std::size_t i = 0; i < vertices.properties.size(); ++i) {
        if (vertices.properties[i].name.starts_with("scalar_") && !vertices.properties[i].count_type)
            return i;
    }
    return std::nullopt;
}

template <class Values>
VertexValues values_of(Values values, const PlyHeader& header, const PlyElement& vertices,
                       std::size_t which) {
    VertexValues found;
    found.property = vertices.properties[which].name;
    for (const PlyElement& element : header.elements) {
        const bool is_vertex = &element == &vertices;
        if (element.properties.empty())
            continue;
        values.begin_element(element);
        for (std::uint64_t row = 0; row < element.count; ++row) {
            values.begin_row(row);
            glm::dvec3 position(0.0);
            for (std::size_t i = 0; i < element.properties.size(); ++i) {
                const PlyProperty& property = element.properties[i];
                if (property.count_type) {
                    values.skip(property.type, values.integer(*property.count_type));
                    continue;
                }
                const bool is_place = is_vertex && property.name.size() == 1 && property.name[0] >= 'x' &&
                                      property.name[0] <= 'z';
                if (!is_place && (!is_vertex || i != which)) {
                    values.skip(property.type);
                    continue;
                }
                const double value = values.coordinate(property.type, is_place ? property.name[0] : 'v');
                if (is_place)
                    position[property.name[0] - 'x'] = value;
                else if (std::isfinite(value))
                    found.values.push_back(value);
                else
                    values.fail(fmt::format("{} of vertex {} (counted from 0) is {}; it must be a number.",
                                            property.name, row, value));
            }
            values.end_row();
            if (is_vertex)
                found.positions.push_back(position);
        }
        if (is_vertex)
            break; // what follows are faces
    }
    return found;
}

} // namespace

VertexValues read_vertex_values(const std::filesystem::path& path) {
    const MeshSource source(path);
    if (!is_ply(source))
        source.fail("is no PLY file: give a PLY mesh that has a number at each vertex.");
    const PlyHeader header = read_ply_header(source);
    const PlyElement& vertices = *header.find("vertex");
    const std::optional<std::size_t> which = value_property(vertices);
    if (!which) {
        std::string names;
        for (const PlyProperty& property : vertices.properties)
            names += (names.empty() ? "" : ", ") + property.name;
        source.fail(
            fmt::format("its vertices have {}, but no property saliency, density, value, quality, scalar or "
                        "intensity: call the model's number one of these.",
                        names));
    }
    return header.format == PlyFormat::text ? values_of(PlyText(source, header), header, vertices, *which)
                                            : values_of(PlyBinary(source, header), header, vertices, *which);
}

} // namespace overt
