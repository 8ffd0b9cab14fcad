#include "experiment/study/surface_distances.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiment/base/parallel.h"
#include "experiment/study/fixations/surface_ways.h"
#include "experiment/study/results/study_groups.h"
#include "experiment/surface/geodesic_field.h"

namespace overt {

SurfaceDistances::SurfaceDistances(const StudyResults& results, int object, const ObjectSurface& surface)
    : coarse_(*surface.geometry, coarse_nodes, surface.scale->shown_size) {
    const StudyObject& shown = results.objects[static_cast<std::size_t>(object)];
    const SurfaceGeometry& fine = *surface.geometry;
    const SurfaceGeometry geometry(coarse_.mesh());
    geometry.triangulation(); // once, before it is asked for on all processors
    std::map<std::uint32_t, std::size_t> source_of;
    for_each_counted_on(results, object, [&](const StudyFixation& fixation) {
        if (!fixation.triangle)
            return;
        int corner = 0;
        for (int other = 1; other < 3; ++other)
            corner = fixation.barycentric[other] > fixation.barycentric[corner] ? other : corner;
        const std::uint32_t vertex = coarse_.vertex_near(fine.corners(*fixation.triangle)[corner]);
        const auto found = source_of.try_emplace(vertex, sources_.size());
        if (found.second) {
            sources_.push_back(vertex);
            positions_mm_.push_back(fine.node_positions_mm()[coarse_.fine_node_of(vertex)]);
        }
        places_[&fixation] = {found.first->second,
                              fine.position_mm({*fixation.triangle, fixation.barycentric})};
    });
    const std::size_t vertices = coarse_.vertex_count();
    spacing_mm_ =
        std::sqrt(geometry.total_area_mm2() / static_cast<double>(std::max<std::size_t>(vertices, 1)));
    distances_.resize(sources_.size() * vertices);
    constexpr std::size_t of_one_field = 32; // a field keeps its memory from one source to the next
    parallel_for(static_cast<int>((sources_.size() + of_one_field - 1) / of_one_field), [&](int block) {
        GeodesicField field(geometry);
        const std::size_t begin = static_cast<std::size_t>(block) * of_one_field;
        for (std::size_t i = begin; i < std::min(begin + of_one_field, sources_.size()); ++i) {
            field.spread_from(coarse_.place_of(sources_[i]));
            for (std::uint32_t vertex = 0; vertex < vertices; ++vertex)
                distances_[i * vertices + vertex] =
                    static_cast<float>(field.to_node(geometry.node_of(vertex)));
        }
    });
    visible_mm2_.assign(vertices, 0.0);
    for (std::uint32_t vertex = 0; vertex < surface.areas_mm2.size(); ++vertex) {
        if (vertex < shown.seconds_visible.size() && shown.seconds_visible[vertex] > 0.0f)
            visible_mm2_[coarse_.vertex_near(fine.node_of(vertex))] += surface.areas_mm2[vertex];
    }
    for (std::size_t i = 0; i < sources_.size(); ++i) {
        for (const std::uint32_t to : sources_) {
            const double one = to_vertex(i, to);
            if (std::isfinite(one))
                extent_mm_ = std::max(extent_mm_, one);
        }
    }
}

double SurfaceDistances::between(const StudyFixation& a, const StudyFixation& b) const {
    const auto in_a = places_.find(&a), in_b = places_.find(&b);
    if (in_a == places_.end() || in_b == places_.end())
        return std::numeric_limits<double>::infinity();
    const auto& [source_a, place_a] = in_a->second;
    const auto& [source_b, place_b] = in_b->second;
    const double along = to_vertex(source_a, sources_[source_b]), apart = glm::distance(place_a, place_b);
    // Next to each other.
    if (along < 3.0 * spacing_mm_)
        return apart;
    const double straight = glm::distance(positions_mm_[source_a], positions_mm_[source_b]);
    // Across a gap, where the straight way says nothing of that along the surface, they are close in space.
    return straight > 3.0 * spacing_mm_ ? along * apart / straight : along;
}

double SurfaceDistances::covered(std::span<const StudyFixation* const> fixations, double reach_mm) const {
    double covered_mm2 = 0.0, all_mm2 = 0.0;
    std::vector<std::size_t> sources;
    for (const StudyFixation* fixation : fixations) {
        if (const auto found = places_.find(fixation); found != places_.end())
            sources.push_back(found->second.source);
    }
    for (std::uint32_t vertex = 0; vertex < visible_mm2_.size(); ++vertex) {
        all_mm2 += visible_mm2_[vertex];
        if (visible_mm2_[vertex] > 0.0 && std::ranges::any_of(sources, [&](std::size_t source) {
                return to_vertex(source, vertex) <= reach_mm;
            }))
            covered_mm2 += visible_mm2_[vertex];
    }
    return all_mm2 > 0.0 ? covered_mm2 / all_mm2 : 0.0;
}

} // namespace overt
