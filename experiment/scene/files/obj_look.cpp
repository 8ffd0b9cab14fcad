#include "experiment/scene/files/obj_look.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/path_inside.h"
#include "experiment/base/safe_text.h"

namespace overt {
namespace {

/// Linear light of a share of sRGB's codes.
float linear_of_share(float share) {
    const auto code = static_cast<double>(std::clamp(share, 0.0f, 1.0f));
    return static_cast<float>(code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4));
}

/// The library's name in a line, which may be several, or one with blanks.
std::vector<std::string> names_in(std::string_view line, const std::filesystem::path& folder) {
    std::string whole(line);
    whole.erase(0, whole.find_first_not_of(" \t"));
    whole.erase(whole.find_last_not_of(" \t") + 1);
    std::ranges::replace(whole, '\\', '/');
    if (is_file_inside(folder, whole))
        return {whole};
    std::vector<std::string> names;
    std::size_t at = 0;
    while ((at = whole.find_first_not_of(" \t", at)) != std::string::npos) {
        const std::size_t end = std::min(whole.find_first_of(" \t", at), whole.size());
        names.push_back(whole.substr(at, end - at));
        at = end;
    }
    const bool are_there =
        std::ranges::all_of(names, [&](const std::string& name) { return is_file_inside(folder, name); });
    return are_there && !names.empty() ? names : std::vector<std::string>{whole};
}

} // namespace

void ObjLook::add_vertex_colour(std::size_t vertex, glm::vec3 srgb) {
    if (colours_.size() <= vertex)
        colours_.resize(vertex + 1, glm::vec3(std::numeric_limits<float>::quiet_NaN()));
    colours_[vertex] = {linear_of_share(srgb.x), linear_of_share(srgb.y), linear_of_share(srgb.z)};
}

void ObjLook::add_libraries(std::string_view names) {
    if (is_wanted_)
        libraries_.emplace_back(std::string(names), text_.place());
}

void ObjLook::use_material(std::string_view line) {
    std::string name(line);
    name.erase(0, name.find_first_not_of(" \t"));
    name.erase(name.find_last_not_of(" \t") + 1);
    const auto [found, is_new] = numbers_.try_emplace(name, static_cast<std::uint16_t>(names_.size()));
    if (is_new) {
        if (names_.size() == std::numeric_limits<std::uint16_t>::max())
            text_.fail("more materials than 65,535 cannot be told apart.");
        names_.push_back(name);
    }
    material_ = found->second;
}

void ObjLook::begin_face() {
    if (is_wanted_)
        faces_.push_back({0, corners_.size()});
}

void ObjLook::add_corner(std::uint32_t vertex, std::string_view word) {
    if (!is_wanted_)
        return;
    Corner corner{vertex, -1};
    const std::size_t slash = word.find('/');
    if (slash != std::string_view::npos) {
        const std::string_view rest = word.substr(slash + 1), number = rest.substr(0, rest.find('/'));
        if (!number.empty()) {
            const std::optional<std::int64_t> index = MeshText::integer_in(number);
            const auto count = static_cast<std::int64_t>(places_.size());
            const std::int64_t place = !index ? -1 : *index < 0 ? count + *index : *index - 1;
            if (place < 0)
                text_.fail(
                    fmt::format("this corner lies at {}, which is no place on a picture (vt) of the {} that "
                                "were read so far.",
                                MeshText::quoted(number), count));
            corner.place = place;
            if (place > highest_place_) {
                highest_place_ = place;
                highest_at_ = text_.place();
            }
        }
    }
    corners_.push_back(corner);
}

void ObjLook::end_face(std::size_t first, std::size_t triangles) {
    if (is_wanted_)
        faces_.back().first_triangle = first;
    if (!material_ && !names_.empty())
        use_material("no material");
    if (material_) {
        // Faces before the first `usemtl` are of none.
        if (triangle_materials_.size() < first) {
            const std::uint16_t used = *material_;
            use_material("no material");
            triangle_materials_.resize(first, *material_);
            material_ = used;
        }
        triangle_materials_.resize(triangles, *material_);
    }
}

void ObjLook::finish(RawMesh& mesh, const MeshSource& source) {
    mesh.triangle_materials = std::move(triangle_materials_);
    for (const std::string& name : names_)
        mesh.material_names.push_back(printable_text(name));
    if (!is_wanted_)
        return;
    if (highest_place_ >= static_cast<std::int64_t>(places_.size()))
        source.fail_at(
            highest_at_.line, highest_at_.column,
            fmt::format("this corner lies at place {} of a picture (vt), but the file has only {}.",
                        highest_place_ + 1, places_.size()));
    give_materials(mesh, source);
    give_uvs(mesh);
    give_colours(mesh);
}

void ObjLook::give_materials(RawMesh& mesh, const MeshSource& source) {
    SurfaceAppearance& look = mesh.appearance;
    if (libraries_.empty())
        return;
    MtlLibrary library(look);
    const std::filesystem::path folder = source.path().parent_path();
    for (const auto& [line, place] : libraries_)
        for (const std::string& name : names_in(line, folder)) {
            if (const std::string why = why_no_file_inside(folder, name); !why.empty())
                source.fail_at(
                    place.line, place.column,
                    fmt::format("the materials {} {}: put the file beside the mesh, or take the line out.",
                                MeshText::quoted(name), why));
            library.read(folder / name);
        }
    mesh.remarks.push_back(MeshText::files_beside(library.files()));
    for (const std::string& name : names_) {
        const FileMaterial* const found = library.find(name);
        if (!found && name != "no material")
            source.fail(fmt::format("its faces are of the material {}, which none of its .mtl files has.",
                                    MeshText::quoted(name)));
        FileMaterial unsaid;
        unsaid.name = name;
        unsaid.roughness = 1.0f;
        look.materials.push_back(found ? *found : unsaid);
    }
}

void ObjLook::give_uvs(RawMesh& mesh) const {
    const bool has_picture = std::ranges::any_of(mesh.appearance.materials, [](const FileMaterial& material) {
        return material.colour_picture.picture >= 0 || material.normal_picture.picture >= 0;
    });
    if (!has_picture)
        return;
    std::vector<CornerUvs>& uvs = mesh.appearance.uvs[0];
    uvs.resize(mesh.triangles.size());
    for (std::size_t i = 0; i < faces_.size(); ++i) {
        const bool is_last = i + 1 == faces_.size();
        const std::span corners = std::span(corners_).subspan(
            faces_[i].first_corner,
            (is_last ? corners_.size() : faces_[i + 1].first_corner) - faces_[i].first_corner);
        const std::size_t end = is_last ? mesh.triangles.size() : faces_[i + 1].first_triangle;
        for (std::size_t triangle = faces_[i].first_triangle; triangle < end; ++triangle)
            for (int corner = 0; corner < 3; ++corner) {
                const auto found =
                    std::ranges::find(corners, mesh.triangles[triangle][corner], &Corner::vertex);
                if (found != corners.end() && found->place >= 0)
                    uvs[triangle][static_cast<std::size_t>(corner)] =
                        places_[static_cast<std::size_t>(found->place)];
            }
    }
}

void ObjLook::give_colours(RawMesh& mesh) const {
    if (colours_.empty())
        return;
    if (mesh.appearance.materials.empty())
        mesh.appearance.materials.emplace_back().roughness = 1.0f; // colours alone say nothing of gloss
    mesh.appearance.remarks.emplace_back("The colours of its vertices are read as sRGB.");
    mesh.appearance.colours.reserve(mesh.triangles.size());
    for (const glm::uvec3& triangle : mesh.triangles) {
        CornerColours& corners = mesh.appearance.colours.emplace_back();
        for (int corner = 0; corner < 3; ++corner) {
            const std::size_t vertex = triangle[corner];
            const bool has_colour = vertex < colours_.size() && !std::isnan(colours_[vertex].x);
            corners[static_cast<std::size_t>(corner)] = has_colour ? colours_[vertex] : glm::vec3(1.0f);
        }
    }
}

} // namespace overt
