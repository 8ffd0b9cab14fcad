#include "experiment/scene/files/triangle_labels.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/scene/files/colour_labels.h"
#include "experiment/scene/files/freesurfer.h"
#include "experiment/scene/files/mesh_reader.h"
#include "experiment/scene/files/mesh_text.h"

namespace overt {
namespace {

PartLabel label_in(std::string_view word, const MeshText& text) {
    const std::optional<std::int64_t> label = MeshText::integer_in(word);
    if (!label || *label != static_cast<PartLabel>(*label))
        text.fail(
            fmt::format("{} is no label: a whole number of 32 bits is expected, for each triangle or for "
                        "each vertex of the mesh.",
                        MeshText::quoted(word)));
    return static_cast<PartLabel>(*label);
}

/// What the lines of an id map say that begin with #.
struct LabelLines {
    std::map<PartLabel, std::string> names;
    std::vector<PartColour> colours;
    std::filesystem::path painted; ///< a copy of the mesh with the colours; empty: the mesh's own
};

glm::ivec3 colour_in(std::string_view word, MeshText& text) {
    if (word.starts_with('#')) {
        std::uint32_t code = 0;
        const auto [end, error] = std::from_chars(word.data() + 1, word.data() + word.size(), code, 16);
        if (word.size() != 7 || error != std::errc() || end != word.data() + word.size())
            text.fail(fmt::format("{} is no colour: #RRGGBB is expected, such as #ff8000.",
                                  MeshText::quoted(word)));
        return {static_cast<int>(code >> 16), static_cast<int>(code >> 8 & 255),
                static_cast<int>(code & 255)};
    }
    glm::ivec3 colour;
    for (int channel = 0; channel < 3; ++channel) {
        if (channel > 0)
            word = text.next_in_line();
        const std::optional<std::int64_t> code = MeshText::integer_in(word);
        if (!code || *code < 0 || *code > 255)
            text.fail(fmt::format("{} is no code of a colour: #RRGGBB, or three whole numbers from 0 to 255.",
                                  MeshText::quoted(word)));
        colour[channel] = static_cast<int>(*code);
    }
    return colour;
}

void take_line(MeshText& text, LabelLines& lines, const std::filesystem::path& folder) {
    const std::string_view word = text.next_in_line();
    if (word == "part") {
        const PartLabel label = label_in(text.next_in_line(), text);
        lines.names[label] = text.rest_of_line();
    } else if (word == "colour" || word == "color") {
        const glm::ivec3 code = colour_in(text.next_in_line(), text);
        lines.colours.push_back({code, std::string(text.rest_of_line())});
        if (lines.colours.back().part.empty())
            text.fail("the name of the part that has this colour is missing.");
    } else if (word == "colours" || word == "colors") {
        const std::filesystem::path name(text.rest_of_line());
        if (name.is_absolute() || std::ranges::find(name, "..") != name.end())
            text.fail("names a file outside of its folder; put the painted copy beside it.");
        if (!name.empty())
            lines.painted = folder / name;
    }
}

/// The mesh as a file shows it, with how its surface looks.
void label_by_paint(RawMesh& mesh, const LabelLines& lines, const MeshSource& source,
                    const std::filesystem::path& mesh_file) {
    const std::filesystem::path painted = lines.painted.empty() ? mesh_file : lines.painted;
    RawMesh shown = read_mesh_file(painted, MeshWanted::appearance);
    if (shown.triangles.size() != mesh.triangles.size())
        source.fail(fmt::format("{} has {} triangles, and the mesh has {}: paint the mesh itself, or a copy.",
                                painted.string(), shown.triangles.size(), mesh.triangles.size()));
    if (shown.appearance.materials.size() == shown.material_names.size())
        shown.appearance.triangle_materials = std::move(shown.triangle_materials);
    try {
        label_by_colours(mesh, shown.appearance, lines.colours);
    } catch (const InputError& error) {
        source.fail(fmt::format("{}: {}", painted.filename().string(), error.what()));
    }
}

} // namespace

PartLabel middle_label(PartLabel a, PartLabel b, PartLabel c) {
    return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

void label_by_corners(RawMesh& mesh, std::span<const PartLabel> labels) {
    mesh.triangle_labels.clear();
    mesh.triangle_labels.reserve(mesh.triangles.size());
    for (const glm::uvec3& triangle : mesh.triangles)
        mesh.triangle_labels.push_back(
            middle_label(labels[triangle.x], labels[triangle.y], labels[triangle.z]));
}

void label_by_file(RawMesh& mesh, const std::filesystem::path& file, const std::filesystem::path& mesh_file) {
    if (file.extension() == ".annot")
        return label_by_annotation(mesh, file);
    if (file.extension() == ".label")
        return label_by_region(mesh, file);
    const MeshSource source(file);
    MeshText text(source);
    std::vector<PartLabel> labels;
    LabelLines lines;
    do {
        for (std::string_view word = text.next_in_line(); !word.empty(); word = text.next_in_line()) {
            if (word.front() != '#') {
                labels.push_back(label_in(word, text));
                continue;
            }
            if (word == "#")
                take_line(text, lines, file.parent_path());
            break;
        }
    } while (text.to_next_line());
    if (!lines.colours.empty()) {
        if (!labels.empty())
            source.fail("has colours of parts, and numbers, too; one of them says where parts are.");
        return label_by_paint(mesh, lines, source, mesh_file);
    }
    if (labels.empty() && !lines.names.empty() && !mesh.triangle_labels.empty()) {
        mesh.part_names = std::move(lines.names);
        return;
    }
    if (labels.size() == mesh.triangles.size())
        mesh.triangle_labels = std::move(labels);
    else if (labels.size() == mesh.positions.size())
        label_by_corners(mesh, labels);
    else
        source.fail(
            fmt::format("holds {} labels, but the mesh has {} triangles and {} vertices; give one for "
                        "each triangle or one for each vertex.",
                        labels.size(), mesh.triangles.size(), mesh.positions.size()));
    mesh.part_names = std::move(lines.names);
}

} // namespace overt
