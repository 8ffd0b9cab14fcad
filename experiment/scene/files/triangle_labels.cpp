#include "experiment/scene/files/triangle_labels.h"

#include <algorithm>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "experiment/scene/files/mesh_text.h"

namespace overt {
namespace {

PartLabel middle_of(PartLabel a, PartLabel b, PartLabel c) {
    return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

PartLabel label_in(std::string_view word, const MeshText& text) {
    const std::optional<std::int64_t> label = MeshText::integer_in(word);
    if (!label || *label != static_cast<PartLabel>(*label))
        text.fail(
            fmt::format("{} is no label: a whole number of 32 bits is expected, for each triangle or for "
                        "each vertex of the mesh.",
                        MeshText::quoted(word)));
    return static_cast<PartLabel>(*label);
}

} // namespace

void label_by_corners(RawMesh& mesh, std::span<const PartLabel> labels) {
    mesh.triangle_labels.clear();
    mesh.triangle_labels.reserve(mesh.triangles.size());
    for (const glm::uvec3& triangle : mesh.triangles)
        mesh.triangle_labels.push_back(middle_of(labels[triangle.x], labels[triangle.y], labels[triangle.z]));
}

void label_by_file(RawMesh& mesh, const std::filesystem::path& file) {
    const MeshSource source(file);
    MeshText text(source);
    std::vector<PartLabel> labels;
    std::map<PartLabel, std::string> names;
    do {
        for (std::string_view word = text.next_in_line(); !word.empty(); word = text.next_in_line()) {
            if (word.front() != '#') {
                labels.push_back(label_in(word, text));
                continue;
            }
            if (word == "#" && text.next_in_line() == "part") {
                const PartLabel label = label_in(text.next_in_line(), text);
                names[label] = text.rest_of_line();
            }
            break;
        }
    } while (text.to_next_line());
    if (labels.size() == mesh.triangles.size())
        mesh.triangle_labels = std::move(labels);
    else if (labels.size() == mesh.positions.size())
        label_by_corners(mesh, labels);
    else
        source.fail(
            fmt::format("holds {} labels, but the mesh has {} triangles and {} vertices; give one for "
                        "each triangle or one for each vertex.",
                        labels.size(), mesh.triangles.size(), mesh.positions.size()));
    mesh.part_names = std::move(names);
}

} // namespace overt
