#include "experiment/scene/sculptures/clay.h"

#include <limits>

#include "experiment/scene/sculptures/quadratic_curve.h"

namespace overt {

Clay& Clay::add(Shape shape, double blend_mm) {
    ball_ = ball_.radius < 0.0 ? shape.ball : enclosing_ball(ball_, shape.ball);
    strokes_.push_back({Kind::add, std::move(shape.distance), {}, shape.ball, blend_mm});
    return *this;
}

Clay& Clay::add(const Clay& clay, double blend_mm) { return add(clay.shape(), blend_mm); }

Clay& Clay::carve(Shape shape, double blend_mm) {
    strokes_.push_back({Kind::carve, std::move(shape.distance), {}, shape.ball, blend_mm});
    return *this;
}

Clay& Clay::emboss(Relief relief) {
    strokes_.push_back({Kind::emboss, {}, std::move(relief.height), relief.ball, 0.0});
    return *this;
}

double Clay::distance(const glm::dvec3& point) const {
    double distance = std::numeric_limits<double>::max();
    for (const Stroke& stroke : strokes_) {
        const double least = stroke.ball.distance(point);
        switch (stroke.kind) {
        case Kind::add:
            if (least < distance + stroke.blend_mm)
                distance = smooth_union(distance, std::max(least, stroke.distance(point)), stroke.blend_mm);
            break;
        case Kind::carve:
            if (-least > distance - stroke.blend_mm)
                distance =
                    smooth_intersection(distance, -std::max(least, stroke.distance(point)), stroke.blend_mm);
            break;
        case Kind::emboss:
            if (least < 0.0)
                distance -= stroke.height(point, distance);
            break;
        }
    }
    return distance;
}

glm::dvec3 Clay::normal(const glm::dvec3& point) const {
    constexpr double step = 0.05;
    const auto across = [&](const glm::dvec3& offset) {
        return distance(point + offset) - distance(point - offset);
    };
    return glm::normalize(glm::dvec3(across({step, 0, 0}), across({0, step, 0}), across({0, 0, step})));
}

glm::dvec3 Clay::foot(const glm::dvec3& point) const {
    glm::dvec3 foot = point;
    for (int i = 0; i < 8; ++i)
        foot -= normal(foot) * distance(foot);
    return foot;
}

Shape Clay::shape() const {
    return {[copy = *this](const glm::dvec3& point) { return copy.distance(point); }, ball_};
}

Shape Placement::place(Shape local) const {
    const Ball ball{to_world(local.ball.centre), local.ball.radius * scale};
    return {[placement = *this, distance = std::move(local.distance)](const glm::dvec3& point) {
                return placement.scale * distance(placement.to_local(point));
            },
            ball};
}

Shape sphere(const glm::dvec3& centre, double radius) {
    const Ball ball{centre, radius};
    return {[ball](const glm::dvec3& point) { return ball.distance(point); }, ball};
}

Shape ellipsoid(const glm::dvec3& centre, const glm::dvec3& half_axes, const glm::dmat3& axes) {
    return {[=](const glm::dvec3& point) { return ellipsoid_distance((point - centre) * axes, half_axes); },
            {centre, std::max({half_axes.x, half_axes.y, half_axes.z})}};
}

Shape bar(const glm::dvec3& a, const glm::dvec3& b, double radius_a, double radius_b) {
    const Ball ball_a{a, radius_a};
    const Ball ball_b{b, radius_b};
    return {[=](const glm::dvec3& point) { return round_cone_distance(point, ball_a, ball_b); },
            enclosing_ball(ball_a, ball_b)};
}

Shape block(const glm::dvec3& centre, const glm::dvec3& half_size, double rounding) {
    return {
        [=](const glm::dvec3& point) { return rounded_box_distance(point - centre, half_size, rounding); },
        {centre, glm::length(half_size)}};
}

Shape cord(const glm::dvec3& a, const glm::dvec3& control, const glm::dvec3& b, const glm::dvec3& radii) {
    const QuadraticCurve curve{a, control, b};
    const double thickest = std::max({radii.x, radii.y, radii.z});
    const glm::dvec3 middle = curve.at(0.5);
    const Ball ball = enclosing_ball({middle, thickest}, enclosing_ball({a, thickest}, {b, thickest}));
    const double slack = 0.25 * glm::distance(control, 0.5 * (a + b));
    return {[=](const glm::dvec3& point) {
                const double t = curve.nearest(point);
                const double radius =
                    radii.x * (1.0 - t) * (1.0 - t) + 2.0 * radii.y * t * (1.0 - t) + radii.z * t * t;
                return glm::distance(point, curve.at(t)) - radius;
            },
            {ball.centre, ball.radius + slack}};
}

Shape grown(Shape shape, double by_mm) {
    return {[distance = std::move(shape.distance), by_mm](const glm::dvec3& point) {
                return distance(point) - by_mm;
            },
            {shape.ball.centre, shape.ball.radius + by_mm}};
}

glm::dmat3 frame_of(const glm::dvec3& up, const glm::dvec3& back) {
    const glm::dvec3 z = glm::normalize(up);
    const glm::dvec3 y = glm::normalize(back - z * glm::dot(back, z));
    return {glm::cross(y, z), y, z};
}

} // namespace overt
