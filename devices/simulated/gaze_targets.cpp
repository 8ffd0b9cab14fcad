#include "devices/simulated/gaze_targets.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "experiment/scene/areas.h"

namespace overt {

namespace {

constexpr double plinth_weight = 0.1;
constexpr int most_tries = 500;      ///< to find a place that is seen at every angle
constexpr double least_facing = 0.2; ///< cosine of the most oblique angle that is looked at

struct Corners {
    glm::dvec3 a, b, c;
    glm::dvec3 normal_times_area() const { return 0.5 * glm::cross(b - a, c - a); }
};

Corners corners_of(const Mesh& mesh, std::uint32_t triangle) {
    const glm::uvec3 t = mesh.triangles[triangle];
    return {glm::dvec3(mesh.positions[t.x]), glm::dvec3(mesh.positions[t.y]),
            glm::dvec3(mesh.positions[t.z])};
}

glm::dvec3 turned_back(glm::dvec3 world_point, const TurntablePose& pose) {
    return to_object({world_point, {0.0, 1.0, 0.0}}, pose).origin;
}

} // namespace

GazeTargets::GazeTargets(const ObservedObject& object, const ObservedScene& scene)
    : mesh_(object.mesh), scene_(object.scene), caster_(*object.mesh), regions_(scene.areas.size() + 1) {
    const Areas areas(mesh_->part_names);
    std::vector<std::size_t> region_of_part(mesh_->part_names.size(), elsewhere());
    for (std::size_t part = 0; part < region_of_part.size(); ++part) {
        for (std::size_t area = scene.areas.size(); area-- > 0;) {
            const auto own = areas.find(scene.areas[area]);
            if (own && areas.holds(*own, static_cast<PartIndex>(part)))
                region_of_part[part] = area;
        }
    }
    for (std::uint32_t i = 0; i < mesh_->triangles.size(); ++i) {
        const std::string_view part = mesh_->part_names[mesh_->triangle_parts[i]];
        const double area = glm::length(corners_of(*mesh_, i).normal_times_area());
        const double weight = part == "plinth" ? plinth_weight * area : area;
        regions_[region_of_part[mesh_->triangle_parts[i]]].add(i, weight);
    }
    find_middle();
    for (const Animation& motion : scene.animations) {
        std::vector<glm::dvec3>& eyes = eyes_.emplace_back();
        for (int step = 0; step < motion.steps_per_period(); ++step)
            eyes.push_back(turned_back(scene_.view.camera.eye(),
                                       scene_.pose_at(motion.object_in(motion.frame_at_step(step)))));
    }
    for (std::size_t effect = 0; effect < scene.effects.size(); ++effect) {
        RandomStream random(effect, "spot of an effect");
        const std::size_t region = random.uniform() < 0.5 ? 0 : elsewhere();
        SurfacePoint middle;
        for (int tries = 0; tries < most_tries; ++tries) {
            middle = draw(random, region);
            bool is_seen = true;
            for (std::size_t motion = 0; motion < eyes_.size(); ++motion) {
                for (std::size_t step = 0; step < eyes_[motion].size() && is_seen; ++step)
                    is_seen = is_visible(middle, static_cast<int>(motion), static_cast<int>(step));
            }
            if (is_seen)
                break;
        }
        spots_.push_back(spot_about(middle));
    }
}

GazeTargets::Spot GazeTargets::spot_about(const SurfacePoint& middle) const {
    Spot spot{middle, spot_radius * mesh_->bounds().extent().z, {}};
    const glm::dvec3 facing = corners_of(*mesh_, middle.triangle).normal_times_area();
    for (std::uint32_t i = 0; i < mesh_->triangles.size(); ++i) {
        const Corners corners = corners_of(*mesh_, i);
        const glm::dvec3 normal = corners.normal_times_area(),
                         centre = (corners.a + corners.b + corners.c) / 3.0;
        const double reach = std::max({glm::distance(centre, corners.a), glm::distance(centre, corners.b),
                                       glm::distance(centre, corners.c)});
        if (glm::distance(centre, middle.position) <= spot.radius + reach && glm::dot(normal, facing) > 0.0)
            spot.triangles.add(i, glm::length(normal));
    }
    return spot;
}

void GazeTargets::find_middle() {
    double all = 0.0, squares = 0.0;
    glm::dvec3 sum(0.0);
    const auto for_each = [&](const auto& visit) {
        for (const WeightedTriangles& region : regions_) {
            double before = 0.0;
            for (std::size_t i = 0; i < region.triangles.size(); ++i) {
                const Corners corners = corners_of(*mesh_, region.triangles[i]);
                visit((corners.a + corners.b + corners.c) / 3.0, region.cumulative[i] - before);
                before = region.cumulative[i];
            }
        }
    };
    for_each([&](const glm::dvec3& centre, double weight) {
        sum += weight * centre;
        all += weight;
    });
    if (!(all > 0.0))
        return;
    middle_ = sum / all;
    double most = 0.0;
    for_each([&](const glm::dvec3& centre, double weight) {
        const glm::dvec3 off = centre - middle_;
        squares += weight * glm::dot(off, off);
        most = std::max(most, glm::dot(off, off));
    });
    if (!(squares > 0.0))
        return;
    usual_square_ = squares / all;
    most_square_ = most / usual_square_;
}

const GazeTargets::WeightedTriangles& GazeTargets::region_or_other(std::size_t region) const noexcept {
    if (regions_[region].triangles.empty())
        region = elsewhere();
    if (regions_[region].triangles.empty())
        region = 0;
    while (regions_[region].triangles.empty()) // the mesh has triangles
        ++region;
    return regions_[region];
}

SurfacePoint GazeTargets::draw(RandomStream& random, std::size_t region, double spread) const noexcept {
    const WeightedTriangles& from = region_or_other(region);
    SurfacePoint point = draw_from(random, from);
    if (spread == 0.0)
        return point;
    // Points by area, each taken with the probability that the spread gives it.
    for (int tries = 0; tries < most_tries; ++tries) {
        const glm::dvec3 off = point.position - middle_;
        const double square = glm::dot(off, off) / usual_square_;
        if (random.uniform() < std::exp(spread * (spread > 0.0 ? square - most_square_ : square)))
            break;
        point = draw_from(random, from);
    }
    return point;
}

SurfacePoint GazeTargets::draw_from_spot(RandomStream& random, int effect) const noexcept {
    const Spot& spot = spots_[static_cast<std::size_t>(effect)];
    for (int tries = 0; tries < most_tries; ++tries) {
        const SurfacePoint point = draw_from(random, spot.triangles);
        if (glm::distance(point.position, spot.middle.position) <= spot.radius)
            return point;
    }
    return spot.middle;
}

SurfacePoint GazeTargets::draw_from(RandomStream& random, const WeightedTriangles& from) const noexcept {
    const double place = random.uniform(0.0, from.cumulative.back());
    const auto found = std::upper_bound(from.cumulative.begin(), from.cumulative.end() - 1, place);
    SurfacePoint point;
    point.triangle = from.triangles[static_cast<std::size_t>(found - from.cumulative.begin())];
    point.part = mesh_->triangle_parts[point.triangle];
    // The square root makes all of the triangle's area equally probable.
    const double root = std::sqrt(random.uniform()), share = random.uniform();
    point.barycentric = {1.0 - root, root * (1.0 - share), root * share};
    const Corners corners = corners_of(*mesh_, point.triangle);
    point.position =
        point.barycentric.x * corners.a + point.barycentric.y * corners.b + point.barycentric.z * corners.c;
    return point;
}

bool GazeTargets::is_visible(const SurfacePoint& point, int motion, int step) const noexcept {
    const std::vector<glm::dvec3>& eyes = eyes_[static_cast<std::size_t>(motion)];
    const glm::dvec3& eye = eyes[static_cast<std::size_t>(step) % eyes.size()];
    const glm::dvec3 normal = corners_of(*mesh_, point.triangle).normal_times_area();
    const glm::dvec3 to_eye = eye - point.position;
    const double facing = std::abs(glm::dot(normal, to_eye)) / (glm::length(normal) * glm::length(to_eye));
    return facing >= least_facing && !caster_.is_hidden(point.position, eye);
}

std::optional<SurfacePoint> GazeTargets::surface_at(glm::dvec2 image_point_px,
                                                    const ObjectPose& angle) const noexcept {
    const Ray ray = scene_.view.ray_through(image_point_px);
    const TurntablePose pose = scene_.pose_at(angle);
    const Ray object_ray = to_object(ray, pose);
    const std::optional<RayHit> hit = caster_.first_hit(object_ray);
    if (!hit)
        return std::nullopt;
    const glm::dvec3 normal = corners_of(*mesh_, hit->triangle).normal_times_area();
    const double cosine = std::abs(glm::dot(normal, object_ray.direction)) / glm::length(normal);
    SurfacePoint point;
    point.position = hit->position;
    point.triangle = hit->triangle;
    point.barycentric = hit->barycentric;
    point.part = mesh_->triangle_parts[hit->triangle];
    point.depth = scene_.view.depth_of(ray.origin + hit->distance * ray.direction);
    point.incidence = to_degrees({std::acos(std::min(cosine, 1.0))});
    return point;
}

glm::dmat4 GazeTargets::world_from_object(const ObjectPose& angle) const noexcept {
    return scene_.pose_at(angle).world_from_object();
}

glm::dvec2 GazeTargets::project(glm::dvec3 object_point, const glm::dmat4& world_from_object) const noexcept {
    return scene_.view.project(glm::dvec3(world_from_object * glm::dvec4(object_point, 1.0)));
}

double GazeTargets::other_eye_right_px(glm::dvec3 object_point,
                                       const glm::dmat4& world_from_object) const noexcept {
    return scene_.view.other_eye_right_px(glm::dvec3(world_from_object * glm::dvec4(object_point, 1.0)));
}

} // namespace overt
