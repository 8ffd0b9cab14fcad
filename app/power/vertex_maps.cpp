#include "app/power/vertex_maps.h"

#include <set>

#include "experiment/study/study_maps.h"
#include "experiment/surface/surface_smoother.h"

namespace overt {

VertexMaps::VertexMaps(const Mesh& mesh, const ObjectScale& scale, const KernelWidth& sigma, int most_threads)
    : fine_(mesh, scale.mm_per_unit), coarse_(fine_, coarse_nodes, scale.shown_size) {
    const SurfaceGeometry geometry(coarse_.mesh());
    areas_ = geometry.vertex_areas_mm2();
    const double sigma_mm = overt::sigma_mm(sigma, scale, scale.axis_depth);
    const SurfaceSmoother smoother(geometry, sigma_mm);
    maps_.reserve(coarse_.vertex_count());
    // Some at a time: in double they take twice the memory.
    constexpr std::size_t at_a_time = 256;
    std::vector<std::vector<SurfaceWeight>> weights;
    for (std::uint32_t v = 0; v < coarse_.vertex_count(); ++v) {
        weights.push_back({{coarse_.place_of(v), 1.0, sigma_mm}});
        if (weights.size() < at_a_time && v + 1 < coarse_.vertex_count())
            continue;
        for (const std::vector<double>& density : smoother.densities(weights, most_threads))
            maps_.emplace_back(density.begin(), density.end());
        weights.clear();
    }
    find_neighbours();
}

void VertexMaps::find_neighbours() {
    std::vector<std::set<std::uint32_t>> beside(coarse_.vertex_count());
    for (const glm::uvec3& triangle : coarse_.mesh().triangles)
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                if (triangle[i] != triangle[j])
                    beside[triangle[i]].insert(triangle[j]);
    neighbours_begin_.push_back(0);
    for (const std::set<std::uint32_t>& of_vertex : beside) {
        neighbours_.insert(neighbours_.end(), of_vertex.begin(), of_vertex.end());
        neighbours_begin_.push_back(static_cast<std::uint32_t>(neighbours_.size()));
    }
}

std::vector<double> VertexMaps::sum_of(std::span<const StudyFixation* const> fixations) const {
    return weighted_sum(fixations, [](const StudyFixation&) { return 1.0; });
}

std::vector<double> VertexMaps::share_of_time(std::span<const StudyFixation* const> fixations) const {
    double seconds = 0.0;
    for (const StudyFixation* fixation : fixations)
        seconds += fixation->duration_s;
    return weighted_sum(fixations, [&](const StudyFixation& of) { return of.duration_s / seconds; });
}

template <class Weight>
std::vector<double> VertexMaps::weighted_sum(std::span<const StudyFixation* const> fixations,
                                             const Weight& weight_of_one) const {
    std::vector<double> at_vertex(maps_.size(), 0.0), sum(maps_.size(), 0.0);
    for (const StudyFixation* fixation : fixations) {
        for (const SurfaceWeight& weight : coarse_.moved(weight_of(*fixation, weight_of_one(*fixation)))) {
            const glm::uvec3& corners = coarse_.mesh().triangles[weight.place.triangle];
            for (int i = 0; i < 3; ++i)
                at_vertex[corners[i]] += weight.weight * weight.place.barycentric[i];
        }
    }
    for (std::size_t from = 0; from < maps_.size(); ++from) {
        if (at_vertex[from] == 0.0)
            continue;
        const std::vector<float>& map = maps_[from];
        for (std::size_t v = 0; v < sum.size(); ++v)
            sum[v] += at_vertex[from] * static_cast<double>(map[v]);
    }
    return sum;
}

} // namespace overt
