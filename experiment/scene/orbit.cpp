#include "experiment/scene/orbit.h"

#include <algorithm>
#include <cmath>

namespace overt {

namespace {

constexpr double deg_per_px = 0.5;
constexpr double zoom_per_step = 0.9;

/// Just outside of the cylinder and height that the turning object sweeps.
constexpr double least_clearance = 1.02;

} // namespace

void Orbit::drag(glm::dvec2 by_px) {
    turn_deg = std::remainder(turn_deg + deg_per_px * by_px.x, 360.0);
    elevation_deg = std::clamp(elevation_deg + deg_per_px * by_px.y, -85.0, 85.0);
}

void Orbit::zoom(double steps) {
    distance = std::clamp(distance * std::pow(zoom_per_step, steps), 0.1, 10.0);
}

SceneView seen_from(const SceneView& scene, const Orbit& orbit) {
    SceneView seen = scene;
    Camera& camera = seen.view.camera;
    const glm::dvec3 away = camera.position - camera.target;
    const double level = std::hypot(away.x, away.y);
    const double elevation =
        std::clamp(std::atan2(away.z, level) + to_radians(Degrees{orbit.elevation_deg}).value, -1.5, 1.5);
    const glm::dvec2 heading = level > 0.0 ? glm::dvec2(away) / level : glm::dvec2(0.0, -1.0);
    const glm::dvec3 half = 0.5 * (scene.bounds.max - scene.bounds.min);
    const double distance =
        std::max(orbit.distance * glm::length(away),
                 least_clearance * glm::length(half) + glm::length(camera.target - scene.bounds.centre()));
    camera.position =
        camera.target + distance * glm::dvec3(std::cos(elevation) * heading, std::sin(elevation));
    return seen;
}

} // namespace overt
