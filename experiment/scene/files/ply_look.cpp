#include "experiment/scene/files/ply_look.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/path_inside.h"
#include "experiment/base/safe_text.h"
#include "experiment/base/whole_file.h"
#include "experiment/scene/files/mesh_text.h"
#include "experiment/scene/files/picture_bytes.h"

namespace overt {
namespace {

constexpr float no_colour = std::numeric_limits<float>::quiet_NaN();

glm::vec3 linear_of_shares(glm::vec3 share) {
    glm::vec3 linear;
    for (int channel = 0; channel < 3; ++channel) {
        const auto code = static_cast<double>(std::clamp(share[channel], 0.0f, 1.0f));
        linear[channel] =
            static_cast<float>(code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4));
    }
    return linear;
}

template <class Value> void put(std::vector<Value>& values, std::size_t at, Value value, Value otherwise) {
    if (values.size() <= at)
        values.resize(at + 1, otherwise);
    values[at] = value;
}

} // namespace

PlyLookColumns PlyLookColumns::of(const PlyElement& element) {
    PlyLookColumns columns;
    constexpr std::array<std::array<std::string_view, 2>, 3> colours{
        {{"red", "diffuse_red"}, {"green", "diffuse_green"}, {"blue", "diffuse_blue"}}};
    for (std::size_t channel = 0; channel < 3; ++channel)
        columns.colour[channel] =
            find_property(element, {colours[channel][0], colours[channel][1]}, false).value_or(none);
    columns.place = {find_property(element, {"s", "u", "texture_u"}, false).value_or(none),
                     find_property(element, {"t", "v", "texture_v"}, false).value_or(none)};
    columns.corner_places = find_property(element, {"texcoord"}, true).value_or(none);
    columns.picture = find_property(element, {"texnumber"}, false).value_or(none);
    return columns;
}

std::size_t PlyLookColumns::channel(std::size_t property) const {
    return static_cast<std::size_t>(std::ranges::find(colour, property) - colour.begin());
}

float PlyLook::share_of(double code, PlyType type) {
    const double most = type == PlyType::uint8 ? 255.0 : type == PlyType::uint16 ? 65535.0 : 1.0;
    return std::isfinite(code) ? static_cast<float>(code / most) : 0.0f;
}

void PlyLook::set_vertex_colour(std::uint64_t vertex, glm::vec3 share) {
    put(vertex_colours_, vertex, linear_of_shares(share), glm::vec3(no_colour));
}

void PlyLook::set_vertex_place(std::uint64_t vertex, glm::vec2 uv) {
    put(vertex_places_, vertex, glm::vec2(uv.x, 1.0f - uv.y), glm::vec2(0.0f));
}

void PlyLook::set_face(std::size_t first, std::size_t triangles, const std::optional<glm::vec3>& colour,
                       const std::vector<float>& places, std::int64_t picture) {
    for (std::size_t triangle = first; triangle < triangles; ++triangle) {
        if (colour)
            put(triangle_colours_, triangle, linear_of_shares(*colour), glm::vec3(no_colour));
        if (picture > 0)
            put(triangle_pictures_, triangle,
                static_cast<std::uint16_t>(
                    std::min<std::int64_t>(picture, std::numeric_limits<std::uint16_t>::max())),
                std::uint16_t{0});
    }
    // Faces of more corners are cut anew: only those of a triangle are known to stay.
    if (places.size() != 6 || triangles != first + 1)
        return;
    CornerUvs corners;
    for (std::size_t corner = 0; corner < 3; ++corner)
        corners[corner] = {places[2 * corner], 1.0f - places[2 * corner + 1]};
    put(corner_places_, first, corners, CornerUvs{});
}

void PlyLook::finish(RawMesh& mesh, const MeshSource& source, const PlyHeader& header) const {
    SurfaceAppearance& look = mesh.appearance;
    const std::size_t triangles = mesh.triangles.size();
    if (!vertex_colours_.empty() || !triangle_colours_.empty()) {
        look.remarks.emplace_back("Its colours are read as sRGB.");
        look.colours.resize(triangles);
        for (std::size_t i = 0; i < triangles; ++i)
            for (int corner = 0; corner < 3; ++corner) {
                glm::vec3 colour(no_colour);
                if (i < triangle_colours_.size())
                    colour = triangle_colours_[i];
                if (const std::size_t vertex = mesh.triangles[i][corner];
                    std::isnan(colour.x) && vertex < vertex_colours_.size())
                    colour = vertex_colours_[vertex];
                look.colours[i][static_cast<std::size_t>(corner)] =
                    std::isnan(colour.x) ? glm::vec3(1.0f) : colour;
            }
    }
    const bool has_places = !vertex_places_.empty() || !corner_places_.empty();
    const std::filesystem::path folder = source.path().parent_path();
    std::vector<std::string> files;
    for (const std::string& name : header.picture_files) {
        if (!has_places)
            source.fail(fmt::format("it names the picture {}, but does not say where on it its corners lie.",
                                    MeshText::quoted(name)));
        if (const std::string why = why_no_file_inside(folder, name); !why.empty())
            source.fail(
                fmt::format("the picture {} {}: put it beside the mesh.", MeshText::quoted(name), why));
        FileMaterial& material = look.materials.emplace_back();
        material.name = printable_text(name);
        material.roughness = 1.0f;
        material.colour_picture.picture = static_cast<int>(look.pictures.size());
        constexpr std::size_t most_bytes = std::size_t{1} << 30;
        look.pictures.push_back(
            read_surface_picture(read_whole_file(folder / name, most_bytes), (folder / name).string(), name));
        files.push_back(printable_text(name));
    }
    if (!look.colours.empty() && look.materials.empty()) {
        // Colours alone say nothing of gloss: without any.
        FileMaterial& material = look.materials.emplace_back();
        material.roughness = 1.0f;
    }
    if (header.picture_files.empty())
        return;
    mesh.remarks.push_back(MeshText::files_beside(files));
    look.uvs[0].resize(triangles);
    for (std::size_t i = 0; i < triangles; ++i) {
        if (i < corner_places_.size()) {
            look.uvs[0][i] = corner_places_[i];
            continue;
        }
        for (int corner = 0; corner < 3; ++corner)
            if (const std::size_t vertex = mesh.triangles[i][corner]; vertex < vertex_places_.size())
                look.uvs[0][i][static_cast<std::size_t>(corner)] = vertex_places_[vertex];
    }
    if (!triangle_pictures_.empty()) {
        mesh.triangle_materials = triangle_pictures_;
        mesh.triangle_materials.resize(triangles, 0);
        for (const std::uint16_t number : mesh.triangle_materials)
            if (number >= look.materials.size())
                source.fail(
                    fmt::format("a face has the picture number {} (counted from 0), but the header names {}.",
                                number, look.materials.size()));
        for (const FileMaterial& material : look.materials)
            mesh.material_names.push_back(material.name);
    }
}

} // namespace overt
