#include "experiment/study/fixation_maps.h"

#include <algorithm>
#include <set>

#include "experiment/statistics/map_similarity.h"
#include "experiment/study/study_maps.h"

namespace overt {

FixationMaps::FixationMaps(const StudyResults& results, int object, const ObjectSurface& surface)
    : surface_(surface), areas_(surface.coarse_geometry->vertex_areas_mm2()) {
    const StudyObject& shown = results.objects[static_cast<std::size_t>(object)];
    const Mesh& mesh = surface.coarse->mesh();
    std::vector<std::vector<SurfaceWeight>> weights;
    for_each_counted_on(results, object, [&](const StudyFixation& fixation) {
        const auto moved = surface.coarse->moved(weight_of(fixation, 1.0));
        index_of_[&fixation] = weights.size();
        std::vector<Place>& places = places_.emplace_back();
        for (const SurfaceWeight& weight : moved) {
            for (int corner = 0; corner < 3; ++corner) {
                const double share = weight.weight * weight.place.barycentric[corner];
                if (share > 0.0)
                    places.push_back({mesh.triangles[weight.place.triangle][corner], share});
            }
        }
        if (surface.hats)
            weights.push_back({weight_of(fixation, 1.0)});
        else
            weights.emplace_back(moved.begin(), moved.end());
    });
    std::vector<std::uint32_t> nodes;
    std::unique_ptr<SurfaceSmoother> smoother;
    if (surface.hats) {
        for (std::uint32_t v = 0; v < areas_.size(); ++v)
            nodes.push_back(surface.coarse->fine_node_of(v));
    } else {
        const double widest = sigma_range_mm(results, object).second;
        smoother = std::make_unique<SurfaceSmoother>(*surface.coarse_geometry, widest);
    }
    maps_.reserve(weights.size());
    // Some at a time: in double they take twice the memory.
    constexpr std::size_t at_a_time = 256;
    for (std::size_t begin = 0; begin < weights.size(); begin += at_a_time) {
        const auto some = std::span(weights).subspan(begin, std::min(at_a_time, weights.size() - begin));
        for (const std::vector<double>& density :
             surface.hats ? surface.hats->densities_at(some, nodes, areas_) : smoother->densities(some))
            maps_.emplace_back(density.begin(), density.end());
    }
    find_visible(shown);
    find_neighbours();
    for (std::uint32_t v = 0; v < areas_.size(); ++v) {
        const auto triangles = surface.geometry->triangles_at(surface.coarse->fine_node_of(v));
        parts_.push_back(triangles.empty() ? PartIndex{0} : shown.mesh->triangle_parts[triangles.front()]);
    }
}

void FixationMaps::find_visible(const StudyObject& object) {
    const SurfaceGeometry& fine = *surface_.geometry;
    std::vector<float> seconds(fine.node_count(), 0.0f), exposure(fine.node_count(), 0.0f);
    for (std::uint32_t v = 0; v < fine.vertex_count(); ++v) {
        float& of_node = seconds[fine.node_of(v)];
        of_node = std::max(of_node, object.seconds_visible[v]);
        if (!object.exposure_density.empty())
            exposure[fine.node_of(v)] = object.exposure_density[v];
    }
    visible_areas_ = areas_;
    for (std::uint32_t v = 0; v < areas_.size(); ++v) {
        const std::uint32_t node = surface_.coarse->fine_node_of(v);
        if (seconds[node] <= 0.0f)
            visible_areas_[v] = 0.0;
        exposure_.push_back(exposure[node]);
    }
    const double all = integral(exposure_, visible_areas_);
    if (!(all > 0.0))
        exposure_.clear();
    for (double& density : exposure_)
        density /= all;
}

void FixationMaps::find_neighbours() {
    std::vector<std::set<std::uint32_t>> neighbours(areas_.size());
    for (const glm::uvec3& t : surface_.coarse->mesh().triangles) {
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t a = t[k], b = t[(k + 1) % 3];
            neighbours[a].insert(b);
            neighbours[b].insert(a);
        }
    }
    neighbours_begin_.push_back(0);
    for (const std::set<std::uint32_t>& own : neighbours) {
        neighbours_.insert(neighbours_.end(), own.begin(), own.end());
        neighbours_begin_.push_back(static_cast<std::uint32_t>(neighbours_.size()));
    }
}

void FixationMaps::add_to(std::vector<double>& sum, const StudyFixation& fixation, double weight) const {
    const std::vector<float>& map = maps_[index_of_.at(&fixation)];
    for (std::size_t v = 0; v < sum.size(); ++v)
        sum[v] += weight * static_cast<double>(map[v]);
}

std::vector<double> FixationMaps::sum_of(std::span<const StudyFixation* const> fixations) const {
    std::vector<double> sum(areas_.size(), 0.0);
    for (const StudyFixation* fixation : fixations)
        add_to(sum, *fixation, 1.0);
    return sum;
}

std::vector<double> FixationMaps::durations_of(std::span<const StudyFixation* const> fixations) const {
    std::vector<double> sum(areas_.size(), 0.0);
    for (const StudyFixation* fixation : fixations)
        add_to(sum, *fixation, fixation->duration_s);
    return sum;
}

double FixationMaps::at(std::span<const double> map, const StudyFixation& fixation) const {
    double value = 0.0;
    for (const Place& place : places_[index_of_.at(&fixation)])
        value += place.share * map[place.vertex];
    return value;
}

ObjectFixationMaps fixation_maps(const StudyResults& results, const std::vector<ObjectSurface>& surfaces) {
    ObjectFixationMaps maps(surfaces.size());
    for (std::size_t i = 0; i < maps.size(); ++i) {
        if (surfaces[i].coarse && sigma_range_mm(results, static_cast<int>(i)).second > 0.0)
            maps[i] = std::make_unique<FixationMaps>(results, static_cast<int>(i), surfaces[i]);
    }
    return maps;
}

std::vector<std::string> columns_beside_compared(const StudyOptions& options) {
    std::vector<std::string> others;
    for (const std::string& column : options.by) {
        if (column != options.compare && column != "object")
            others.push_back(column);
    }
    return others;
}

} // namespace overt
