#include "experiment/scene/viewing.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "experiment/base/error.h"

namespace overt {

namespace {

constexpr glm::dvec3 up{0.0, 0.0, 1.0};

struct CameraAxes {
    glm::dvec3 right, upward, forward;
};

CameraAxes axes_of(const Camera& camera) {
    const glm::dvec3 forward = glm::normalize(camera.target - camera.position);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, up));
    return {right, glm::cross(right, forward), forward};
}

/// Half the image's height, seen at distance 1.
double half_height_at_unit_distance(const Camera& camera) {
    return std::tan(0.5 * to_radians(camera.vertical_fov).value);
}

/// How far the image of a camera aside is shifted, seen at distance 1.
double slant_of(const Camera& camera) {
    return camera.aside == 0.0 ? 0.0 : camera.aside / glm::distance(camera.position, camera.target);
}

} // namespace

glm::dmat4 TurntablePose::world_from_object() const {
    const double angle_rad = to_radians(object.angle).value;
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), angle_rad, up);
    const glm::dmat4 from_axis = glm::translate(glm::dmat4(1.0), -axis_point);
    if (object.is_turn())
        return glm::translate(glm::dmat4(1.0), axis_point) * turn * from_axis;
    return glm::translate(glm::dmat4(1.0), axis_point + object.shift) * glm::mat4_cast(object.tilt) * turn *
           from_axis;
}

glm::dvec3 Camera::eye() const { return aside == 0.0 ? position : position + aside * axes_of(*this).right; }

glm::dmat4 View::view_from_world() const {
    const glm::dmat4 from_middle = glm::lookAt(camera.position, camera.target, up);
    return camera.aside == 0.0
               ? from_middle
               : glm::translate(glm::dmat4(1.0), glm::dvec3(-camera.aside, 0.0, 0.0)) * from_middle;
}

double View::px_at_unit_depth() const { return image_px.y / (2.0 * half_height_at_unit_distance(camera)); }

glm::dvec2 View::straight_ahead_px() const {
    const glm::dvec2 middle = 0.5 * glm::dvec2(image_px);
    return camera.aside == 0.0 ? middle : middle + glm::dvec2(px_at_unit_depth() * slant_of(camera), 0.0);
}

glm::dmat4 View::clip_from_view(double near, double far) const {
    const double aspect = static_cast<double>(image_px.x) / image_px.y;
    glm::dmat4 clip = glm::perspective(to_radians(camera.vertical_fov).value, aspect, near, far);
    if (camera.aside != 0.0)
        clip[2][0] = -clip[0][0] * slant_of(camera);
    return clip;
}

Ray View::ray_through(glm::dvec2 image_point_px) const {
    const CameraAxes axes = axes_of(camera);
    const double scale = 2.0 * half_height_at_unit_distance(camera) / image_px.y;
    const glm::dvec2 offset = (image_point_px - straight_ahead_px()) * scale;
    return {camera.eye(), glm::normalize(axes.forward + offset.x * axes.right - offset.y * axes.upward)};
}

glm::dvec2 View::project(glm::dvec3 world_point) const {
    const CameraAxes axes = axes_of(camera);
    const glm::dvec3 from_camera = world_point - camera.eye();
    const double depth = glm::dot(from_camera, axes.forward);
    const double scale = image_px.y / (2.0 * half_height_at_unit_distance(camera) * depth);
    return straight_ahead_px() +
           scale * glm::dvec2(glm::dot(from_camera, axes.right), -glm::dot(from_camera, axes.upward));
}

double View::other_eye_right_px(glm::dvec3 world_point) const {
    return camera.aside == 0.0
               ? 0.0
               : 2.0 * px_at_unit_depth() * (camera.aside / depth_of(world_point) - slant_of(camera));
}

double View::depth_of(glm::dvec3 world_point) const {
    return glm::dot(world_point - camera.position, axes_of(camera).forward);
}

Ray to_object(const Ray& world_ray, const TurntablePose& pose) {
    const glm::dmat4 object_from_world =
        pose.object.is_turn()
            ? TurntablePose{pose.axis_point, {{-pose.object.angle.value}}}.world_from_object()
            : glm::inverse(pose.world_from_object());
    return {glm::dvec3(object_from_world * glm::dvec4(world_ray.origin, 1.0)),
            glm::dvec3(object_from_world * glm::dvec4(world_ray.direction, 0.0))};
}

Camera fit_camera(const Mesh& mesh, Degrees vertical_fov, glm::ivec2 image_px, Degrees amplitude,
                  double margin) {
    OVERT_EXPECTS(margin >= 0.0 && margin <= 0.45);
    const glm::dvec3 centre = mesh.bounds().centre();
    const double half_height = std::tan(0.5 * to_radians(vertical_fov).value) * (1.0 - 2.0 * margin);
    const double half_width = half_height * image_px.x / image_px.y;
    const double amplitude_rad = std::min(std::abs(to_radians(amplitude).value), std::numbers::pi);

    // A point at angle phi and radius r about the axis passes every angle phi ± amplitude. Seen from (0, -d,
    // 0) it needs |x| <= half_width (d + y) and |z| <= half_height (d + y) at each of them, which is a lower
    // bound on d. The bounds are extreme at the ends of the arc or at their stationary points, which lie at
    // fixed angles.
    const auto needed_distance = [&](double radius, double phi, double height) {
        const double x = radius * std::cos(phi), y = radius * std::sin(phi);
        return std::max(std::abs(x) / half_width, std::abs(height) / half_height) - y;
    };
    const double side = std::atan(half_width); // where |x|/w - y is stationary: tan = -w from the x axis
    const double stationary[] = {-side, -std::numbers::pi + side, -0.5 * std::numbers::pi};
    double distance = 0.0;
    for (const glm::vec3& position : mesh.positions) {
        const glm::dvec3 from_axis = glm::dvec3(position) - centre;
        const double radius = std::hypot(from_axis.x, from_axis.y);
        const double phi = std::atan2(from_axis.y, from_axis.x);
        distance = std::max({distance, needed_distance(radius, phi - amplitude_rad, from_axis.z),
                             needed_distance(radius, phi + amplitude_rad, from_axis.z)});
        for (const double angle : stationary) {
            const double away = std::remainder(angle - phi, 2.0 * std::numbers::pi);
            if (std::abs(away) <= amplitude_rad) {
                distance = std::max(distance, needed_distance(radius, angle, from_axis.z));
            }
        }
    }
    return {centre - glm::dvec3(0.0, distance, 0.0), centre, vertical_fov};
}

DepthRange depth_range(const Bounds& bounds, const View& view, const ObjectPose& object) {
    // The turning object stays inside a cylinder about its axis; its points lie within this distance of the
    // centre.
    const glm::dvec3 half = 0.5 * bounds.extent();
    const double radius = glm::length(half);
    const glm::dvec3 centre = bounds.centre() + object.shift;
    const double depth = view.depth_of(centre);
    const double near = depth - radius, far = depth + radius;
    const glm::dvec3 from_axis = view.camera.eye() - centre;
    const bool inside_cylinder =
        std::hypot(from_axis.x, from_axis.y) <= std::hypot(half.x, half.y) && std::abs(from_axis.z) <= half.z;
    const bool inside_sweep = object.is_turn() ? inside_cylinder : glm::length(from_axis) <= radius;
    if (inside_sweep) {
        throw InputError(fmt::format("the camera at ({:.6g}, {:.6g}, {:.6g}) stands inside the space that "
                                     "the turning object sweeps: move "
                                     "it away or leave camera position out, and it is fitted",
                                     view.camera.position.x, view.camera.position.y, view.camera.position.z));
    }
    if (far <= 0.0)
        throw InputError("the object lies behind the camera: turn the camera's target towards it");
    const double widened = 1e-3 * radius;
    return {std::max(near - widened, 1e-3 * far), far + widened};
}

} // namespace overt
