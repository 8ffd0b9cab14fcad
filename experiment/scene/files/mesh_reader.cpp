#include "experiment/scene/files/mesh_reader.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <iterator>
#include <set>
#include <span>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/memory_for.h"
#include "experiment/scene/files/freesurfer.h"
#include "experiment/scene/files/gltf_reader.h"
#include "experiment/scene/files/mesh_source.h"
#include "experiment/scene/files/obj_reader.h"
#include "experiment/scene/files/ply_reader.h"
#include "experiment/scene/files/stl_reader.h"
#include "experiment/scene/files/triangle_labels.h"

namespace overt {
namespace {

std::string lower_extension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    for (char& c : extension)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return extension;
}

struct UpAxisName {
    std::string_view name;
    UpAxis up;
};

constexpr std::array up_axis_names{UpAxisName{"x", UpAxis::x},        UpAxisName{"y", UpAxis::y},
                                   UpAxisName{"z", UpAxis::z},        UpAxisName{"-x", UpAxis::minus_x},
                                   UpAxisName{"-y", UpAxis::minus_y}, UpAxisName{"-z", UpAxis::minus_z}};

/// From the file's coordinates to the object's.
void turn_and_scale(std::vector<glm::dvec3>& places, const MeshImport& import) {
    if (!(import.scale > 0.0) || !std::isfinite(import.scale)) {
        throw InputError(fmt::format("the scale is {}; it must be a positive number.", import.scale));
    }
    if (import.up == UpAxis::z && import.scale == 1.0)
        return;
    const glm::dmat3 object_from_file = import.scale * z_up_from_file(import.up);
    for (glm::dvec3& place : places) {
        place = object_from_file * place;
        if (!is_coordinate(place.x) || !is_coordinate(place.y) || !is_coordinate(place.z)) {
            throw InputError(
                fmt::format("the scale {} makes coordinates too large for a 32-bit float.", import.scale));
        }
    }
}

/// Makes parts of what the triangles are made of, if that is not the same everywhere. Materials of one name
/// are one.
void divide_by_materials(RawMesh& raw) {
    raw.triangle_labels = {};
    raw.part_names = {};
    const std::vector<std::uint16_t>& materials = raw.triangle_materials;
    if (std::ranges::all_of(materials, [&](std::uint16_t index) { return index == materials.front(); }))
        return;
    std::map<std::string_view, PartLabel> first_of_name;
    std::vector<PartLabel> label_of(raw.material_names.size());
    for (std::size_t i = 0; i < label_of.size(); ++i)
        label_of[i] =
            first_of_name.try_emplace(raw.material_names[i], static_cast<PartLabel>(i)).first->second;
    raw.triangle_labels.reserve(materials.size());
    for (const std::uint16_t index : materials)
        raw.triangle_labels.push_back(label_of[index]);
    for (const PartLabel label : raw.triangle_labels)
        raw.part_names.try_emplace(label, raw.material_names[static_cast<std::size_t>(label)]);
}

/// What to do with a file of a format that is not read; empty for all others.
std::string_view remedy_for_format(const MeshSource& source, const std::string& extension) {
    constexpr std::string_view in_blender =
        "this format is not read; convert it to glTF (in Blender: File, Export, glTF 2.0, .glb).";
    const std::string_view bytes = source.bytes();
    constexpr std::array extensions{std::string_view(".fbx"),  std::string_view(".blend"),
                                    std::string_view(".usdz"), std::string_view(".usdc"),
                                    std::string_view(".usd"),  std::string_view(".usda"),
                                    std::string_view(".3mf"),  std::string_view(".dae")};
    const bool is_known = std::ranges::find(extensions, extension) != extensions.end() ||
                          bytes.starts_with("Kaydara FBX Binary") || bytes.starts_with("BLENDER") ||
                          bytes.starts_with("PXR-USDC") || bytes.starts_with("PK\x03\x04");
    return is_known ? in_blender : std::string_view();
}

/// Groups of a file that are more than parts can be are no reason to do without a region that is given.
void forget_too_many_parts(RawMesh& raw, MeshCleaningReport& report) {
    std::set<PartLabel> labels;
    for (std::size_t i = 0; i < raw.triangle_labels.size(); ++i) {
        // Neighbouring triangles mostly share their part.
        if (i == 0 || raw.triangle_labels[i] != raw.triangle_labels[i - 1])
            labels.insert(raw.triangle_labels[i]);
    }
    for (const auto& [label, name] : raw.part_names)
        labels.insert(label);
    if (labels.size() < max_mesh_parts)
        return;
    report.part_remarks.push_back(fmt::format(
        "The file divides the mesh into {} parts, more than can be told apart; they are left aside.",
        labels.size()));
    raw.triangle_labels = {};
    raw.part_names = {};
}

Bounds bounds_of(std::span<const glm::dvec3> places) {
    Bounds box{places.front(), places.front()};
    for (const glm::dvec3& place : places) {
        box.min = glm::min(box.min, place);
        box.max = glm::max(box.max, place);
    }
    return box;
}

/// By how much a 32-bit float would move the coordinates at most.
double rounding_of(std::span<const glm::dvec3> places) {
    double most = 0.0;
    for (const glm::dvec3& place : places) {
        const glm::dvec3 moved = glm::abs(glm::dvec3(glm::vec3(place)) - place);
        most = std::max({most, moved.x, moved.y, moved.z});
    }
    return most;
}

/// Of the coordinates, in steps of a power of ten about as large as the mesh.
glm::dvec3 round_middle(const Bounds& box) {
    const double step = std::pow(10.0, std::floor(std::log10(box.diagonal())));
    // Multiples of a tenth are rounded once if they are divided by ten.
    return step < 1.0 ? glm::round(box.centre() * std::round(1.0 / step)) / std::round(1.0 / step)
                      : glm::round(box.centre() / step) * step;
}

/// What a mesh loses by 32-bit coordinates it may lose: the millionth of its size.
constexpr double bearable_rounding = 1e-6;

/// Moves a mesh that lies far from its file's origin to one of its own, which the report then names.
void bring_near(std::vector<glm::dvec3>& places, MeshCleaningReport& report) {
    const Bounds box = bounds_of(places);
    const double rounding = rounding_of(places);
    if (!(rounding > bearable_rounding * box.diagonal()) || box.diagonal() == 0.0)
        return;
    report.rounding = rounding;
    report.origin = round_middle(box);
    for (glm::dvec3& place : places)
        place -= report.origin;
}

RawMesh read_opened(const std::filesystem::path& path, MeshWanted wanted) {
    const MeshSource source(path);
    const std::string extension = lower_extension(path);
    if (is_gltf(source) || is_gltf_name(path))
        return read_gltf(source, wanted);
    if (const std::string_view remedy = remedy_for_format(source, extension); !remedy.empty())
        source.fail(remedy);
    if (is_ply(source))
        return read_ply(source, wanted);
    if (is_freesurfer_surface(source))
        return read_freesurfer_surface(source);
    switch (stl_form(source)) {
    case StlForm::binary:
        return read_binary_stl(source);
    case StlForm::text:
        return read_text_stl(source);
    case StlForm::none:
        break;
    }
    if (extension == ".stl")
        return read_binary_stl(source);
    if (source.bytes().starts_with("\xFF\xFE") || source.bytes().starts_with("\xFE\xFF"))
        source.fail("this is text in UTF-16, which no mesh format is; save it as UTF-8 or ASCII.");
    if (extension == ".obj" || is_obj(source))
        return read_obj(source, wanted);
    if (extension == ".ply")
        source.fail("the file is called .ply but does not begin with the line 'ply'.");
    source.fail("this is no mesh in a known format (PLY, OBJ, STL or glTF); export it as one of them.");
}

} // namespace

RawMesh read_mesh_file(const std::filesystem::path& path, MeshWanted wanted) {
    return with_memory_for(path, [&] { return read_opened(path, wanted); });
}

bool is_gltf_name(const std::filesystem::path& path) {
    const std::string extension = lower_extension(path);
    return extension == ".gltf" || extension == ".glb";
}

UpAxis up_axis_named(std::string_view name) {
    for (const UpAxisName& known : up_axis_names) {
        if (known.name == name)
            return known.up;
    }
    throw InputError(
        fmt::format("'{}' is no axis; the axis that points up is one of x, y, z, -x, -y, -z.", name));
}

glm::dmat3 z_up_from_file(UpAxis up) {
    // The columns are where the file's x, y and z axes go.
    const glm::dvec3 x(1.0, 0.0, 0.0), y(0.0, 1.0, 0.0), z(0.0, 0.0, 1.0);
    switch (up) {
    case UpAxis::x:
        return {z, y, -x};
    case UpAxis::y:
        return {x, z, -y};
    case UpAxis::z:
        break;
    case UpAxis::minus_x:
        return {-z, y, x};
    case UpAxis::minus_y:
        return {-x, -z, -y};
    case UpAxis::minus_z:
        return {-x, y, -z};
    }
    return {x, y, z};
}

Mesh import_mesh(const std::filesystem::path& path, const MeshImport& import, MeshCleaningReport& report,
                 SurfaceAppearance* appearance) {
    RawMesh raw = read_mesh_file(path, appearance ? MeshWanted::appearance : MeshWanted::shape);
    if (import.parts_by_material.value_or(is_gltf_name(path) && !raw.are_areas_labelled))
        divide_by_materials(raw);
    if (!import.labels.empty())
        label_by_file(raw, import.labels, path);
    try {
        MeshCleaningReport of_file;
        of_file.vertices_read = raw.positions.size();
        of_file.crossing_faces = raw.crossing_faces;
        of_file.part_remarks = std::move(raw.remarks);
        if (appearance) {
            *appearance = std::move(raw.appearance);
            // Names of materials that nothing is known of are of no use to a look.
            if (appearance->materials.size() == raw.material_names.size())
                appearance->triangle_materials = std::move(raw.triangle_materials);
        }
        const UnusedVertices unused = drop_unused_vertices(raw);
        std::vector<glm::dvec3> places = std::move(raw.positions);
        raw.positions = {};
        if ((!import.regions.empty() || is_gltf_name(path)) && import.labels.empty())
            forget_too_many_parts(raw, of_file);
        Mesh mesh = mesh_with_labelled_parts(std::move(raw));
        if (!import.regions.empty())
            std::ranges::move(label_parts(mesh, import.regions, places),
                              std::back_inserter(of_file.part_remarks));
        turn_and_scale(places, import);
        bring_near(places, of_file);
        mesh.positions.assign(places.begin(), places.end());
        places = {};
        std::vector<CornersFrom> from;
        report =
            clean_mesh(mesh, import.weld_tolerance * mesh.bounds().diagonal(), appearance ? &from : nullptr);
        if (appearance)
            *appearance = rearranged(std::move(*appearance), from);
        report.vertices_read = of_file.vertices_read;
        report.crossing_faces = of_file.crossing_faces;
        report.unreferenced_vertices_dropped += unused.with_place;
        report.vertices_without_place = unused.without_place;
        report.part_remarks = std::move(of_file.part_remarks);
        report.origin = of_file.origin;
        report.rounding = of_file.rounding;
        if (mesh.triangles.empty())
            throw InputError("the mesh has no area: every face is a point or a line.");
        return mesh;
    } catch (const AreaError& error) {
        throw AreaError(path.string(), error);
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", path.string(), error.what()));
    }
}

} // namespace overt
