#include "experiment/study/fixation_maps.h"

#include <algorithm>
#include <array>

#include "experiment/statistics/map_similarity.h"
#include "experiment/study/study_maps.h"

namespace overt {

namespace {

/// Of a fixation's own peak: what is left out of its map. The heat kernel has faded to that beyond five
/// sigmas.
constexpr double faded = 1e-7;

/// How many times as many nodes as samples are worth choosing among.
constexpr double many_nodes = 1.5;

} // namespace

FixationMaps::FixationMaps(const StudyResults& results, int object, const ObjectSurface& surface)
    : surface_(surface) {
    const StudyObject& shown = results.objects[static_cast<std::size_t>(object)];
    Fixations fixations;
    for_each_counted_on(results, object, [&](const StudyFixation& fixation) {
        index_of_[&fixation] = static_cast<std::uint32_t>(fixations.size());
        fixations.push_back(&fixation);
    });
    const auto [least, widest] = sigma_range_mm(results, object);
    if (!surface.hats)
        smoother_ = std::make_unique<SurfaceSmoother>(*surface.geometry, widest);
    make_samples(least);
    make_maps(fixations);
    find_visible(shown, fixations);
    for (const std::uint32_t node : samples_->nodes()) {
        const auto triangles = surface.geometry->triangles_at(node);
        parts_.push_back(triangles.empty() ? PartIndex{0} : shown.mesh->triangle_parts[triangles.front()]);
    }
}

void FixationMaps::make_samples(double least_sigma_mm) {
    const SurfaceGeometry& geometry = *surface_.geometry;
    const double spacing_mm = least_sigma_mm / HatSmoother::hats_per_sigma;
    if (surface_.hats) {
        samples_ = std::make_unique<SurfaceSamples>(geometry, surface_.hats->hats());
    } else if (static_cast<double>(geometry.node_count()) >
               many_nodes * SurfaceHats::expected_count(geometry, spacing_mm)) {
        sparser_ = std::make_unique<SurfaceHats>(geometry, spacing_mm);
        samples_ = std::make_unique<SurfaceSamples>(geometry, *sparser_);
    } else {
        samples_ = std::make_unique<SurfaceSamples>(geometry);
    }
    areas_ = samples_->areas_mm2();
}

void FixationMaps::make_maps(std::span<const StudyFixation* const> fixations) {
    const SurfaceGeometry& geometry = *surface_.geometry;
    // Densities are asked for at the samples, and then at the corners of the fixations' triangles.
    const std::size_t samples = samples_->count();
    std::vector<std::uint32_t> nodes(samples_->nodes().begin(), samples_->nodes().end());
    std::map<std::uint32_t, std::size_t> number_of;
    std::vector<std::array<std::size_t, 3>> corners;
    for (const StudyFixation* fixation : fixations) {
        std::array<std::size_t, 3>& own = corners.emplace_back();
        for (int corner = 0; corner < 3; ++corner) {
            const std::uint32_t node = geometry.corners(*fixation->triangle)[corner];
            const auto [number, is_new] = number_of.try_emplace(node, nodes.size());
            if (is_new)
                nodes.push_back(node);
            own[static_cast<std::size_t>(corner)] = number->second;
        }
    }
    std::vector<double> areas = areas_;
    areas.resize(nodes.size(), 0.0);
    std::vector<std::uint32_t> vertex_of_node(geometry.node_count(), 0);
    for (std::uint32_t v = 0; v < geometry.vertex_count(); ++v)
        vertex_of_node[geometry.node_of(v)] = v;
    const auto keep = [&](const std::vector<double>& density) {
        Own& own = maps_.emplace_back();
        const double least =
            faded * (density.empty() ? 0.0 : *std::max_element(density.begin(), density.end()));
        for (std::uint32_t i = 0; i < samples; ++i) {
            if (density[i] > least)
                own.at_samples.push_back({i, static_cast<float>(density[i])});
        }
        for (std::uint32_t place = 0; place < fixations.size(); ++place) {
            const StudyFixation& there = *fixations[place];
            double value = 0.0;
            for (int corner = 0; corner < 3; ++corner)
                value +=
                    there.barycentric[corner] * density[corners[place][static_cast<std::size_t>(corner)]];
            if (value > least)
                own.at_fixations.push_back({place, static_cast<float>(value)});
        }
        own.at_samples.shrink_to_fit();
        own.at_fixations.shrink_to_fit();
    };
    // Some at a time: all of each takes far more memory than what is kept.
    constexpr std::size_t at_a_time = 256;
    maps_.reserve(fixations.size());
    for (std::size_t begin = 0; begin < fixations.size(); begin += at_a_time) {
        std::vector<std::vector<SurfaceWeight>> some;
        for (std::size_t i = begin; i < std::min(fixations.size(), begin + at_a_time); ++i)
            some.push_back({weight_of(*fixations[i], 1.0)});
        if (surface_.hats) {
            for (const std::vector<double>& density : surface_.hats->densities_at(some, nodes, areas))
                keep(density);
            continue;
        }
        for (const std::vector<double>& density : smoother_->densities(some)) {
            std::vector<double> chosen;
            chosen.reserve(nodes.size());
            for (const std::uint32_t node : nodes)
                chosen.push_back(density[vertex_of_node[node]]);
            keep(chosen);
        }
    }
}

void FixationMaps::find_visible(const StudyObject& object, std::span<const StudyFixation* const> fixations) {
    const SurfaceGeometry& geometry = *surface_.geometry;
    std::vector<char> is_visible(geometry.node_count(), 0);
    std::vector<double> exposure(geometry.node_count(), 0.0);
    for (std::uint32_t v = 0; v < geometry.vertex_count(); ++v) {
        const std::uint32_t node = geometry.node_of(v);
        if (object.seconds_visible[v] > 0.0f)
            is_visible[node] = 1;
        if (!object.exposure_density.empty())
            exposure[node] = static_cast<double>(object.exposure_density[v]);
    }
    visible_areas_ = samples_->areas_mm2(is_visible);
    for (const std::uint32_t node : samples_->nodes())
        exposure_.push_back(exposure[node]);
    for (const StudyFixation* fixation : fixations) {
        double value = 0.0;
        for (int corner = 0; corner < 3; ++corner)
            value += fixation->barycentric[corner] * exposure[geometry.corners(*fixation->triangle)[corner]];
        exposure_at_.push_back(value);
    }
    const double all = integral(exposure_, visible_areas_);
    if (!(all > 0.0))
        exposure_.clear();
    for (double& density : exposure_)
        density /= all;
    for (double& density : exposure_at_)
        density = all > 0.0 ? density / all : 0.0;
}

glm::dvec3 FixationMaps::position_mm(std::uint32_t sample) const {
    return surface_.geometry->node_positions_mm()[samples_->nodes()[sample]];
}

void FixationMaps::add_to(std::vector<double>& sum, const StudyFixation& fixation, double weight) const {
    for (const Entry& entry : maps_[index_of_.at(&fixation)].at_samples)
        sum[entry.index] += weight * static_cast<double>(entry.value);
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

std::vector<double> FixationMaps::sum_at(std::span<const StudyFixation* const> fixations,
                                         std::span<const StudyFixation* const> places) const {
    std::vector<double> at_all(maps_.size(), 0.0), found;
    for (const StudyFixation* fixation : fixations) {
        for (const Entry& entry : maps_[index_of_.at(fixation)].at_fixations)
            at_all[entry.index] += static_cast<double>(entry.value);
    }
    for (const StudyFixation* place : places)
        found.push_back(at_all[index_of_.at(place)]);
    return found;
}

std::vector<double> FixationMaps::at_samples(std::span<const double> by_node) const {
    std::vector<double> found;
    for (const std::uint32_t node : samples_->nodes())
        found.push_back(by_node[node]);
    return found;
}

std::vector<double> FixationMaps::at_places(std::span<const double> by_node,
                                            std::span<const StudyFixation* const> places) const {
    std::vector<double> found;
    for (const StudyFixation* place : places) {
        double value = 0.0;
        for (int corner = 0; corner < 3; ++corner)
            value += place->barycentric[corner] * by_node[geometry().corners(*place->triangle)[corner]];
        found.push_back(value);
    }
    return found;
}

std::vector<double> FixationMaps::exposure_at(std::span<const StudyFixation* const> places) const {
    std::vector<double> found;
    for (const StudyFixation* place : places)
        found.push_back(exposure_at_[index_of_.at(place)]);
    return found;
}

std::vector<std::vector<double>>
FixationMaps::at_vertices(std::span<const std::vector<SurfaceWeight>> weights) const {
    return surface_.hats ? surface_.hats->densities(weights) : smoother_->densities(weights);
}

ObjectFixationMaps fixation_maps(const StudyResults& results, const std::vector<ObjectSurface>& surfaces) {
    ObjectFixationMaps maps(surfaces.size());
    for (std::size_t i = 0; i < maps.size(); ++i) {
        if (surfaces[i].geometry && surfaces[i].scale &&
            sigma_range_mm(results, static_cast<int>(i)).second > 0.0)
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
