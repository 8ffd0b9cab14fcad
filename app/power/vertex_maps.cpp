#include "app/power/vertex_maps.h"

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
}

std::vector<double> VertexMaps::sum_of(std::span<const StudyFixation* const> fixations) const {
    std::vector<double> at_vertex(maps_.size(), 0.0), sum(maps_.size(), 0.0);
    for (const StudyFixation* fixation : fixations) {
        for (const SurfaceWeight& weight : coarse_.moved(weight_of(*fixation, 1.0))) {
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
