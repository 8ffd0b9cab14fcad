#include "experiment/scene/mesh_reader.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/memory_for.h"
#include "experiment/scene/mesh_source.h"
#include "experiment/scene/obj_reader.h"
#include "experiment/scene/ply_reader.h"
#include "experiment/scene/stl_reader.h"
#include "experiment/scene/triangle_labels.h"

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

void turn_and_scale(Mesh& mesh, const MeshImport& import) {
    if (!(import.scale > 0.0) || !std::isfinite(import.scale)) {
        throw InputError(fmt::format("the scale is {}; it must be a positive number.", import.scale));
    }
    if (import.up == UpAxis::z && import.scale == 1.0)
        return;
    const glm::dmat3 object_from_file = import.scale * z_up_from_file(import.up);
    for (glm::vec3& position : mesh.positions) {
        position = glm::vec3(object_from_file * glm::dvec3(position));
        if (!std::isfinite(position.x) || !std::isfinite(position.y) || !std::isfinite(position.z)) {
            throw InputError(
                fmt::format("the scale {} makes coordinates too large for a 32-bit float.", import.scale));
        }
    }
}

RawMesh read_opened(const std::filesystem::path& path) {
    const MeshSource source(path);
    const std::string extension = lower_extension(path);
    if (is_ply(source))
        return read_ply(source);
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
    if (extension == ".obj" || is_obj(source))
        return read_obj(source);
    if (extension == ".ply")
        source.fail("the file is called .ply but does not begin with the line 'ply'.");
    source.fail("this is no mesh in a known format (PLY, OBJ or STL); export it as one of them.");
}

} // namespace

RawMesh read_mesh_file(const std::filesystem::path& path) {
    return with_memory_for(path, [&] { return read_opened(path); });
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

Mesh import_mesh(const std::filesystem::path& path, const MeshImport& import, MeshCleaningReport& report) {
    RawMesh raw = read_mesh_file(path);
    if (!import.labels.empty())
        label_by_file(raw, import.labels);
    try {
        if (!import.regions.empty())
            raw.triangle_labels = {};
        if (!import.regions.empty())
            raw.part_names = {};
        Mesh mesh = mesh_with_labelled_parts(std::move(raw));
        if (!import.regions.empty())
            label_parts(mesh, import.regions, import.rest_name);
        turn_and_scale(mesh, import);
        report = clean_mesh(mesh, import.weld_tolerance);
        if (mesh.triangles.empty())
            throw InputError("the mesh has no area: every face is a point or a line.");
        return mesh;
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", path.string(), error.what()));
    }
}

} // namespace overt
