#include "experiment/study/template/surface_bridge.h"

#include <set>
#include <utility>

namespace overt {

namespace {

/// The areas of a part that another object has, too, each followed by a line's end.
std::vector<std::string> shared_areas(const StudyObject& of, const StudyObject& other) {
    std::vector<std::string> found;
    for (std::size_t part = 0; part < of.part_names.size(); ++part) {
        std::set<std::string> areas;
        for (std::size_t area = 0; area < of.areas.size(); ++area)
            if (of.areas.holds(area, static_cast<PartIndex>(part)) && other.areas.has(of.areas.names()[area]))
                areas.insert(of.areas.names()[area]);
        std::string& together = found.emplace_back();
        for (const std::string& area : areas)
            together += area + "\n";
    }
    return found;
}

} // namespace

SurfaceBridge::Side SurfaceBridge::side(const StudyObject& of, const StudyObject& other,
                                        const Mesh& mesh) const {
    Side made{&mesh, shared_areas(of, other), {}, std::nullopt};
    std::set<std::string> there;
    for (const PartIndex part : mesh.triangle_parts)
        there.insert(made.areas_of_part[part]);
    for (const std::string& areas : there)
        made.of_areas.emplace(areas, NearestSites(mesh, [&](std::uint32_t triangle) {
                                  return made.areas_of_part[mesh.triangle_parts[triangle]] == areas;
                              }));
    std::set<std::string> asked;
    for (const PartIndex part : other.mesh->triangle_parts)
        asked.insert(shared_areas(other, of)[part]);
    for (const std::string& areas : asked)
        if (!there.contains(areas) && !made.of_all)
            made.of_all.emplace(mesh);
    return made;
}

const NearestSites& SurfaceBridge::sites(const Side& side, const std::string& areas) {
    const auto found = side.of_areas.find(areas);
    return found == side.of_areas.end() ? *side.of_all : found->second;
}

SurfaceBridge::SurfaceBridge(const StudyObject& object, const StudyObject& onto, LandmarkWarp warp)
    : object_(object), onto_(onto), warp_(std::move(warp)), warped_(*object.mesh) {
    for (glm::vec3& position : warped_.positions)
        position = glm::vec3(warp_(glm::dvec3(position) * *object_.mm_per_unit) / *onto_.mm_per_unit);
    template_side_ = side(onto_, object_, *onto_.mesh);
    object_side_ = side(object_, onto_, warped_);
}

SurfaceBridge::Laid SurfaceBridge::onto_template(const SurfaceSite& place,
                                                 std::optional<PartIndex> part) const {
    const glm::dvec3 warped =
        warp_(position_of(*object_.mesh, place) * *object_.mm_per_unit) / *onto_.mm_per_unit;
    const PartIndex own = part.value_or(object_.mesh->triangle_parts[place.triangle]);
    const SurfaceSite site = sites(template_side_, object_side_.areas_of_part[own]).nearest(warped);
    return {site, glm::distance(position_of(*onto_.mesh, site), warped) * *onto_.mm_per_unit};
}

SurfaceSite SurfaceBridge::from_template(const SurfaceSite& place) const {
    const PartIndex part = onto_.mesh->triangle_parts[place.triangle];
    return sites(object_side_, template_side_.areas_of_part[part]).nearest(position_of(*onto_.mesh, place));
}

glm::dvec3 SurfaceBridge::warped_normal(std::uint32_t triangle) const {
    const glm::uvec3& t = warped_.triangles[triangle];
    const glm::dvec3 a(warped_.positions[t.x]), b(warped_.positions[t.y]), c(warped_.positions[t.z]);
    return glm::cross(b - a, c - a);
}

} // namespace overt
