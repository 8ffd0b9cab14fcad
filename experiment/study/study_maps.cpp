#include "experiment/study/study_maps.h"

#include <algorithm>
#include <numeric>
#include <set>

#include "experiment/base/parallel.h"
#include "experiment/surface/euclidean_kernel.h"
#include "experiment/surface/voxel_density.h"

namespace overt {

DensityMaker::DensityMaker(const ObjectSurface& surface, const Mesh& mesh, const StudyOptions& options,
                           double widest_sigma_mm)
    : surface_(surface), mesh_(mesh), kernel_(options.kernel) {
    if (kernel_ == MapKernel::geodesic && !surface.hats)
        smoother_ = std::make_unique<SurfaceSmoother>(*surface.geometry, widest_sigma_mm);
}

std::vector<std::vector<double>>
DensityMaker::densities(std::span<const std::vector<SurfaceWeight>> maps) const {
    if (kernel_ == MapKernel::geodesic)
        return surface_.hats ? surface_.hats->densities(maps) : smoother_->densities(maps);
    std::vector<std::vector<double>> made(maps.size());
    if (kernel_ == MapKernel::voxel) {
        for (std::size_t i = 0; i < maps.size(); ++i)
            made[i] = in_voxels(maps[i]);
        return made;
    }
    const EuclideanKernel kernel(*surface_.geometry);
    parallel_for(static_cast<int>(maps.size()), [&](int i) {
        const auto map = static_cast<std::size_t>(i);
        made[map] = kernel.density(maps[map]);
    });
    return made;
}

std::vector<double> DensityMaker::in_voxels(std::span<const SurfaceWeight> weights) const {
    std::vector<double> density(mesh_.positions.size(), 0.0);
    double all = 0.0, sigma_mm = 0.0;
    for (const SurfaceWeight& weight : weights) {
        all += weight.weight;
        sigma_mm += weight.weight * weight.sigma_mm;
    }
    if (!(all > 0.0))
        return density;
    // The grid has one kernel: the mean over the fixations.
    const double mm_per_unit = surface_.scale->mm_per_unit;
    VoxelDensity voxels(mesh_.bounds(), sigma_mm / all / mm_per_unit);
    for (const SurfaceWeight& weight : weights)
        voxels.add(surface_.geometry->position_mm(weight.place) / mm_per_unit, weight.weight);
    voxels.blur();
    double on_surface = 0.0;
    for (std::size_t v = 0; v < density.size(); ++v) {
        density[v] = voxels.at(glm::dvec3(mesh_.positions[v]));
        on_surface += density[v] * surface_.areas_mm2[v];
    }
    // Per volume it is no density of the surface: scaled so that the surface holds the weights.
    for (double& value : density)
        value *= on_surface > 0.0 ? all / on_surface : 0.0;
    return density;
}

SurfaceWeight weight_of(const StudyFixation& fixation, double weight) {
    return {{*fixation.triangle, fixation.barycentric}, weight, fixation.sigma_mm};
}

std::vector<int> objects_of(const StudyResults& results, const StudyGroup& group) {
    std::set<int> found;
    for (const int trial : group.trials)
        found.insert(results.trials[static_cast<std::size_t>(trial)].object);
    return {found.begin(), found.end()};
}

std::vector<const StudyFixation*> fixations_on(const StudyResults& results, std::span<const int> trials,
                                               int object) {
    std::vector<const StudyFixation*> found;
    for (const int trial : trials) {
        if (results.trials[static_cast<std::size_t>(trial)].object == object)
            for_each_counted(results, trial,
                             [&](const StudyFixation& fixation) { found.push_back(&fixation); });
    }
    return found;
}

std::pair<double, double> sigma_range_mm(const StudyResults& results, int object) {
    double least = 0.0, widest = 0.0;
    for_each_counted_on(results, object, [&](const StudyFixation& fixation) {
        least = widest > 0.0 ? std::min(least, fixation.sigma_mm) : fixation.sigma_mm;
        widest = std::max(widest, fixation.sigma_mm);
    });
    return {least, widest};
}

namespace {

/// Seconds to the milliseconds of maps by duration.
double weight_in(MapWeighting weighting, const StudyFixation& fixation) {
    return weighting == MapWeighting::duration ? 1e3 * fixation.duration_s : 1.0;
}

} // namespace

std::vector<float> exposure_density(const StudyResults& results, int of, const ObjectSurface& surface,
                                    const DensityMaker& maker, const StudyOptions& options) {
    const StudyObject& object = results.objects[static_cast<std::size_t>(of)];
    const auto [least, widest] = sigma_range_mm(results, of);
    const double all = std::accumulate(surface.pixel_seconds.begin(), surface.pixel_seconds.end(), 0.0);
    if (!(all > 0.0))
        return {};
    // The depth as it stands in the middle of its swing.
    const View view{object.camera, object.screen.image_px};
    std::vector<bool> is_done(surface.pixel_seconds.size(), false);
    std::vector<std::vector<SurfaceWeight>> weights(1);
    for (std::uint32_t t = 0; t < object.mesh->triangles.size(); ++t) {
        for (int corner = 0; corner < 3; ++corner) {
            const std::uint32_t v = object.mesh->triangles[t][corner];
            if (is_done[v] || !(surface.pixel_seconds[v] > 0.0))
                continue;
            is_done[v] = true;
            glm::dvec3 barycentric{0.0};
            barycentric[corner] = 1.0;
            const double sigma =
                sigma_mm(options.sigma, *surface.scale, view.depth_of(glm::dvec3(object.mesh->positions[v])));
            weights[0].push_back(
                {{t, barycentric}, surface.pixel_seconds[v] / all, std::clamp(sigma, least, widest)});
        }
    }
    const std::vector<double> density = maker.densities(weights).front();
    return {density.begin(), density.end()};
}

namespace {

StudyMap map_of(const StudyResults& results, int group, int object, MapWeighting weighting) {
    StudyMap map;
    map.group = group;
    map.object = object;
    map.weighting = weighting;
    std::vector<int> own;
    for (const int trial : results.groups[static_cast<std::size_t>(group)].trials) {
        if (results.trials[static_cast<std::size_t>(trial)].object == object)
            own.push_back(trial);
    }
    map.trials = static_cast<int>(own.size());
    map.observers = static_cast<int>(by_observer(results, own).size());
    return map;
}

void finish_map(StudyMap& map, const std::vector<double>& density, std::span<const double> areas) {
    map.density.resize(density.size());
    for (std::size_t v = 0; v < density.size(); ++v) {
        const double value = density[v] / map.trials;
        map.density[v] = static_cast<float>(value);
        map.total += value * areas[v];
        map.area_mm2 += areas[v];
        map.peak = std::max(map.peak, value);
    }
    map.mean = map.area_mm2 > 0.0 ? map.total / map.area_mm2 : 0.0;
}

} // namespace

std::vector<StudyMap> maps_on(const StudyResults& results, int object, const ObjectSurface& surface,
                              const DensityMaker* maker) {
    const StudyObject& shown = results.objects[static_cast<std::size_t>(object)];
    std::vector<StudyMap> maps;
    std::vector<std::vector<SurfaceWeight>> weights;
    for (int group = 0; group < static_cast<int>(results.groups.size()); ++group) {
        const StudyGroup& of = results.groups[static_cast<std::size_t>(group)];
        const std::vector<int> shown_there = objects_of(results, of);
        if (!std::binary_search(shown_there.begin(), shown_there.end(), object))
            continue;
        const std::vector<const StudyFixation*> fixations = fixations_on(results, of.trials, object);
        for (const MapWeighting weighting : {MapWeighting::duration, MapWeighting::count}) {
            StudyMap& map = maps.emplace_back(map_of(results, group, object, weighting));
            map.fixations = static_cast<int>(fixations.size());
            std::vector<SurfaceWeight>& own = weights.emplace_back();
            if (!maker) {
                map.absent = shown.mesh ? "no fixation was counted on this object" : "the object has no mesh";
                if (!surface.scale)
                    map.absent = "the camera or the screen is not known";
                continue;
            }
            if (fixations.empty())
                map.absent = "no fixation was counted";
            for (const StudyFixation* fixation : fixations) {
                own.push_back(weight_of(*fixation, weight_in(weighting, *fixation)));
                const bool is_first = own.size() == 1;
                map.least_sigma_mm =
                    is_first ? fixation->sigma_mm : std::min(map.least_sigma_mm, fixation->sigma_mm);
                map.most_sigma_mm = std::max(map.most_sigma_mm, fixation->sigma_mm);
            }
        }
    }
    if (maker) {
        const std::vector<std::vector<double>> densities = maker->densities(weights);
        for (std::size_t i = 0; i < maps.size(); ++i) {
            if (maps[i].absent.empty())
                finish_map(maps[i], densities[i], surface.areas_mm2);
        }
    }
    return maps;
}

} // namespace overt
