#include "app/stimuli/painted_areas.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/error.h"
#include "experiment/scene/areas.h"
#include "experiment/scene/files/mesh_reader.h"

namespace overt {

namespace {

constexpr std::size_t most_areas = 99;

void expect_area_name(const std::string& name) {
    const auto is_plain = [](unsigned char letter) {
        return letter >= ' ' && letter != '#' && letter != static_cast<unsigned char>(between_areas);
    };
    if (name.empty() || name == rest_part || name.front() == ' ' || name.back() == ' ' ||
        !std::ranges::all_of(name, is_plain))
        throw InputError(fmt::format("--area \"{}\": a name of letters and digits is expected, without # and "
                                     "{}, and not \"{}\", which is what no area takes",
                                     name, between_areas, rest_part));
}

std::vector<std::string> names_with(const Mesh& mesh, const std::vector<std::string>& more) {
    std::vector<std::string> names;
    const auto add = [&](const std::string& name) {
        if (name != rest_part && std::ranges::find(names, name) == names.end())
            names.push_back(name);
    };
    for (const std::string& name : mesh.part_names)
        add(name);
    for (const std::string& name : more) {
        expect_area_name(name);
        add(name);
    }
    if (names.empty())
        throw InputError("nothing says which areas are to be painted: name them by --area NAMES");
    if (names.size() > most_areas)
        throw InputError(fmt::format("{} areas are more than {}", names.size(), most_areas));
    return names;
}

std::vector<AreaPainting::Paint> paints_of(const Mesh& mesh, const std::vector<std::string>& names) {
    std::vector<AreaPainting::Paint> paints;
    for (const PartIndex part : mesh.triangle_parts) {
        const auto at = std::ranges::find(names, mesh.part_names[part]);
        paints.push_back(at == names.end() ? AreaPainting::Paint{0}
                                           : static_cast<AreaPainting::Paint>(at - names.begin() + 1));
    }
    return paints;
}

} // namespace

glm::vec3 colour_of_paint(AreaPainting::Paint paint) {
    constexpr std::array<glm::vec3, 7> colours{glm::vec3(0.90f, 0.35f, 0.05f), glm::vec3(0.10f, 0.45f, 0.85f),
                                               glm::vec3(0.05f, 0.55f, 0.25f), glm::vec3(0.95f, 0.85f, 0.10f),
                                               glm::vec3(0.75f, 0.25f, 0.50f), glm::vec3(0.35f, 0.75f, 0.95f),
                                               glm::vec3(0.75f, 0.10f, 0.05f)};
    return colours[(paint - 1u) % colours.size()];
}

PaintedAreas::PaintedAreas(const Mesh& mesh, const std::vector<std::string>& more)
    : names(names_with(mesh, more)), painting(mesh, paints_of(mesh, names)) {}

AreaPainting::Paint PaintedAreas::paint_of(const std::string& name) const {
    const auto at = std::ranges::find(names, name);
    if (at == names.end())
        throw InputError(fmt::format("there is no area \"{}\": there {} {}", name,
                                     names.size() == 1 ? "is" : "are", fmt::join(names, ", ")));
    return static_cast<AreaPainting::Paint>(at - names.begin() + 1);
}

std::string PaintedAreas::shares() const {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i)
        text += fmt::format("{} {:.1f} %, ", names[i],
                            100.0 * painting.share(static_cast<AreaPainting::Paint>(i + 1)));
    return text + fmt::format("the rest {:.1f} % of the surface", 100.0 * painting.share(0));
}

std::string labels_text(const PaintedAreas& areas, const Object& object, const ObjectSettings& settings) {
    const RawMesh raw = read_mesh_file(settings.mesh);
    const glm::dmat3 object_from_file =
        mm_of_unit(settings.unit) * settings.scale * z_up_from_file(up_axis_named(settings.up));
    const Mesh& mesh = object.mesh;
    const NearestSites sites(mesh);
    std::string text = fmt::format("# areas of {}, a number for each triangle of the file\n# part 0 {}\n",
                                   settings.mesh.filename().string(), rest_part);
    for (std::size_t i = 0; i < areas.names.size(); ++i)
        text += fmt::format("# part {} {}\n", i + 1, areas.names[i]);
    for (const glm::uvec3& triangle : raw.triangles) {
        const glm::dvec3 middle =
            (raw.positions[triangle.x] + raw.positions[triangle.y] + raw.positions[triangle.z]) / 3.0;
        const SurfaceSite site = sites.nearest(object_from_file * middle - object.origin);
        text += fmt::format("{}\n", areas.painting.paints()[site.triangle]);
    }
    return text;
}

} // namespace overt
