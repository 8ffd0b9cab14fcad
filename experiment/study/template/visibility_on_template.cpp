#include "experiment/study/template/visibility_on_template.h"

#include "experiment/base/parallel.h"

namespace overt {

namespace {

/// A corner of the surface for each vertex that has one.
std::vector<std::optional<SurfaceSite>> vertex_sites(const Mesh& mesh) {
    std::vector<std::optional<SurfaceSite>> sites(mesh.positions.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (int corner = 0; corner < 3; ++corner) {
            std::optional<SurfaceSite>& site = sites[mesh.triangles[t][corner]];
            if (site)
                continue;
            site = SurfaceSite{t, glm::dvec3(0.0)};
            site->barycentric[corner] = 1.0;
        }
    }
    return sites;
}

double seconds_at(const StudyObject& object, const SurfaceSite& site) {
    double seconds = 0.0;
    for (int corner = 0; corner < 3; ++corner)
        seconds += site.barycentric[corner] *
                   static_cast<double>(object.seconds_visible[object.mesh->triangles[site.triangle][corner]]);
    return seconds;
}

} // namespace

VisibilityOnTemplate::VisibilityOnTemplate(const Mesh& onto)
    : onto_(onto), onto_sites_(vertex_sites(onto)), laid_{std::vector<float>(onto.positions.size(), 0.0f),
                                                          std::vector<double>(onto.positions.size(), 0.0),
                                                          std::vector<double>(onto.part_names.size(), 0.0)} {}

void VisibilityOnTemplate::add(const StudyObject& object, std::span<const double> pixel_seconds,
                               const SurfaceBridge* across, double share) {
    parallel_for(static_cast<int>(onto_sites_.size()), [&](int v) {
        const auto vertex = static_cast<std::size_t>(v);
        if (const std::optional<SurfaceSite>& site = onto_sites_[vertex])
            laid_.seconds_visible[vertex] +=
                static_cast<float>(share * seconds_at(object, across ? across->from_template(*site) : *site));
    });
    const std::vector<std::optional<SurfaceSite>> own = vertex_sites(*object.mesh);
    std::vector<SurfaceSite> brought(own.size());
    parallel_for(static_cast<int>(own.size()), [&](int v) {
        const auto vertex = static_cast<std::size_t>(v);
        if (own[vertex] && pixel_seconds[vertex] > 0.0)
            brought[vertex] = across ? across->onto_template(*own[vertex]).site : *own[vertex];
    });
    for (std::size_t v = 0; v < own.size(); ++v) {
        if (!own[v] || !(pixel_seconds[v] > 0.0))
            continue;
        const SurfaceSite& site = brought[v];
        laid_.part_pixel_seconds[onto_.triangle_parts[site.triangle]] += share * pixel_seconds[v];
        for (int corner = 0; corner < 3; ++corner)
            laid_.pixel_seconds[onto_.triangles[site.triangle][corner]] +=
                share * site.barycentric[corner] * pixel_seconds[v];
    }
}

} // namespace overt
