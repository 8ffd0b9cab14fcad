#include "experiment/maps/map_check.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/parallel.h"

namespace overt {

namespace {

/// Share of the diagonal by which the distances of neighbouring pixels may differ on one surface.
constexpr double deepest_step = 0.01;

using Hits = std::vector<std::optional<RayHit>>;

Hits hits_of_centres(const RayCaster& rays, const SceneView& scene, const ObjectPose& angle) {
    const glm::ivec2 size = scene.view.image_px;
    std::vector<Ray> lines(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
    parallel_for(size.y, [&](int y) {
        for (int x = 0; x < size.x; ++x) {
            lines[static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x) +
                  static_cast<std::size_t>(x)] =
                to_object(scene.view.ray_through({x + 0.5, y + 0.5}), scene.pose_at(angle));
        }
    });
    Hits hits(lines.size());
    rays.first_hits(lines, hits);
    return hits;
}

bool is_interior(const Hits& hits, glm::ivec2 size, int x, int y, double deepest) {
    if (x == 0 || y == 0 || x == size.x - 1 || y == size.y - 1)
        return false;
    const auto centre = hits.begin() + static_cast<std::ptrdiff_t>(y) * size.x + x;
    for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
            const auto& neighbour = *(centre + dy * size.x + dx);
            if (!neighbour || std::abs(neighbour->distance - (*centre)->distance) > deepest)
                return false;
        }
    }
    return true;
}

/// An LSB is the extent of the bounding box on an axis divided by this, whatever the factor of the codes.
constexpr double lsb_per_extent = 65536.0;

double worst_axis_lsb(const glm::dvec3& difference, const Bounds& bounds) {
    double worst = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double extent = bounds.max[axis] - bounds.min[axis];
        if (extent > 0.0)
            worst = std::max(worst, std::abs(difference[axis]) * lsb_per_extent / extent);
    }
    return worst;
}

MapErrors errors_of(std::vector<double>& lsb) {
    if (lsb.empty())
        return {};
    MapErrors errors;
    for (const double error : lsb)
        errors.mean_lsb += error / static_cast<double>(lsb.size());
    const auto rank = lsb.begin() + static_cast<std::ptrdiff_t>(0.999 * static_cast<double>(lsb.size() - 1));
    std::nth_element(lsb.begin(), rank, lsb.end());
    errors.p99_9_lsb = *rank;
    errors.max_lsb = *std::max_element(rank, lsb.end());
    return errors;
}

/// An upper bound of a place's distance from the surface: along rays that begin a little before it, in the
/// directions of the axes and of sight.
double distance_from_surface(const RayCaster& rays, glm::dvec3 place, glm::dvec3 sight, double diagonal) {
    const double before = 1e-3 * diagonal;
    double nearest = diagonal;
    for (const glm::dvec3& direction :
         {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1), sight}) {
        for (const double sign : {-1.0, 1.0}) {
            const auto hit = rays.first_hit({place - before * sign * direction, sign * direction});
            if (hit)
                nearest = std::min(nearest, std::abs(hit->distance - before));
        }
    }
    return nearest;
}

/// What is left of a place by rounding each of its coordinates to a whole number of `scale` steps of the box;
/// in LSB. Reckoned without the codec, whose own faults it must not share.
double rounding_lsb(glm::dvec3 place, const Bounds& bounds, int scale) {
    const glm::dvec3 extent = bounds.max - bounds.min;
    double worst = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        if (!(extent[axis] > 0.0))
            continue;
        const double codes = scale * (place[axis] - bounds.min[axis]) / extent[axis];
        const double nearest = std::min(std::round(codes), 65535.0);
        worst = std::max(worst, std::abs(nearest - codes) * lsb_per_extent / scale);
    }
    return worst;
}

/// What the check of some rows finds; errors in LSB.
struct Findings {
    std::vector<double> as_float, as_codes, rounding;
    int covered = 0, differs = 0;
    double farthest = 0.0;
};

} // namespace

MapCheck check_map(const CoordinateImage& map, const RayCaster& rays, const SceneView& scene,
                   const ObjectPose& angle, int scale) {
    const glm::ivec2 size = scene.view.image_px;
    if (map.size_px != size) {
        throw InputError(fmt::format("a map of {} x {} pixels cannot be checked against a picture of {} x {}",
                                     map.size_px.x, map.size_px.y, size.x, size.y));
    }
    const Hits hits = hits_of_centres(rays, scene, angle);
    const double diagonal = scene.bounds.diagonal();
    const CoordinateCodec codec(scene.bounds, scale);
    std::vector<Findings> of_row(static_cast<std::size_t>(size.y));
    parallel_for(size.y, [&](int y) {
        Findings& row = of_row[static_cast<std::size_t>(y)];
        for (int x = 0; x < size.x; ++x) {
            const auto& hit = hits[static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x) +
                                   static_cast<std::size_t>(x)];
            const glm::dvec3 place(map.at(x, y));
            row.covered += hit.has_value();
            row.differs += hit.has_value() != map.covers(x, y);
            if (!map.covers(x, y))
                continue;
            const double apart = hit ? glm::distance(place, hit->position) : diagonal;
            if (apart > row.farthest * diagonal && apart > 1e-7 * diagonal) {
                const Ray sight = to_object(scene.view.ray_through({x + 0.5, y + 0.5}), scene.pose_at(angle));
                const double off = distance_from_surface(rays, place, sight.direction, diagonal);
                row.farthest = std::max(row.farthest, std::min(off, apart) / diagonal);
            } else {
                row.farthest = std::max(row.farthest, apart / diagonal);
            }
            if (!hit || !is_interior(hits, size, x, y, deepest_step * diagonal))
                continue;
            row.as_float.push_back(worst_axis_lsb(place - hit->position, scene.bounds));
            row.as_codes.push_back(
                worst_axis_lsb(codec.decode(codec.encode(place)) - hit->position, scene.bounds));
            row.rounding.push_back(rounding_lsb(hit->position, scene.bounds, scale));
        }
    });
    Findings all;
    for (const Findings& row : of_row) {
        all.as_float.insert(all.as_float.end(), row.as_float.begin(), row.as_float.end());
        all.as_codes.insert(all.as_codes.end(), row.as_codes.begin(), row.as_codes.end());
        all.rounding.insert(all.rounding.end(), row.rounding.begin(), row.rounding.end());
        all.covered += row.covered;
        all.differs += row.differs;
        all.farthest = std::max(all.farthest, row.farthest);
    }
    MapCheck check;
    check.covered_px = all.covered;
    check.coverage_differs_px = all.differs;
    check.interior_px = static_cast<int>(all.as_float.size());
    check.as_float = errors_of(all.as_float);
    check.as_codes = errors_of(all.as_codes);
    check.rounding_mean_lsb = errors_of(all.rounding).mean_lsb;
    check.excess_lsb = check.as_codes.mean_lsb - check.rounding_mean_lsb;
    check.farthest_off_surface = all.farthest;
    return check;
}

MapCheck worst_of(const MapCheck& one, const MapCheck& other) {
    const auto worst = [](const MapErrors& a, const MapErrors& b) {
        return MapErrors{std::max(a.mean_lsb, b.mean_lsb), std::max(a.p99_9_lsb, b.p99_9_lsb),
                         std::max(a.max_lsb, b.max_lsb)};
    };
    MapCheck check;
    check.covered_px = one.covered_px + other.covered_px;
    check.coverage_differs_px = std::max(one.coverage_differs_px, other.coverage_differs_px);
    check.interior_px = one.interior_px + other.interior_px;
    check.as_float = worst(one.as_float, other.as_float);
    check.as_codes = worst(one.as_codes, other.as_codes);
    check.rounding_mean_lsb = std::max(one.rounding_mean_lsb, other.rounding_mean_lsb);
    check.excess_lsb = std::max(one.excess_lsb, other.excess_lsb);
    check.farthest_off_surface = std::max(one.farthest_off_surface, other.farthest_off_surface);
    return check;
}

} // namespace overt
