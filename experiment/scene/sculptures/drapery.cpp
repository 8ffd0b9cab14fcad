#include "experiment/scene/sculptures/drapery.h"

#include <cmath>
#include <numbers>

#include "experiment/scene/sculptures/quadratic_curve.h"

namespace overt {

namespace {

/// Beyond so many mm off the surface a fold has no effect.
constexpr double reach_mm = 20.0;

/// A stretch of a fold, small enough for a tight ball.
struct Stretch {
    QuadraticCurve curve;
    double from, to; ///< shares of the fold
    Ball ball;
};

struct LaidFold {
    std::vector<Stretch> stretches;
    Ball ball;
    Fold fold;
};

/// Uniform quadratic spline with the path as its control polygon, clamped to its ends.
std::vector<QuadraticCurve> spline(const std::vector<glm::dvec3>& path) {
    std::vector<QuadraticCurve> curves;
    for (std::size_t i = 1; i + 1 < path.size(); ++i) {
        const glm::dvec3 a = i == 1 ? path[0] : 0.5 * (path[i - 1] + path[i]);
        const glm::dvec3 b = i + 2 == path.size() ? path[i + 1] : 0.5 * (path[i] + path[i + 1]);
        curves.push_back({a, path[i], b});
    }
    return curves;
}

LaidFold lay(const Clay& base, Fold fold) {
    for (glm::dvec3& point : fold.path)
        point = base.foot(point);
    LaidFold laid;
    const std::vector<QuadraticCurve> curves = spline(fold.path);
    const auto n = static_cast<double>(curves.size());
    const double margin = std::max(fold.width_at_start, fold.width_at_end) + reach_mm;
    for (std::size_t i = 0; i < curves.size(); ++i) {
        const QuadraticCurve& c = curves[i];
        Ball ball = enclosing_ball(enclosing_ball({c.a, margin}, {c.b, margin}), {c.control, margin});
        laid.stretches.push_back({c, static_cast<double>(i) / n, static_cast<double>(i + 1) / n, ball});
        laid.ball = i == 0 ? ball : enclosing_ball(laid.ball, ball);
    }
    laid.fold = std::move(fold);
    return laid;
}

/// Height of one fold at a point whose distance to the bare surface is known.
double height_at(const LaidFold& laid, const glm::dvec3& point, double distance) {
    double best = 1e30;
    double share = 0.0;
    for (const Stretch& stretch : laid.stretches) {
        if (stretch.ball.distance(point) > 0.0)
            continue;
        const double t = stretch.curve.nearest(point);
        const glm::dvec3 offset = point - stretch.curve.at(t);
        const double square = glm::dot(offset, offset);
        if (square < best) {
            best = square;
            share = stretch.from + t * (stretch.to - stretch.from);
        }
    }
    const Fold& fold = laid.fold;
    const double width = glm::mix(fold.width_at_start, fold.width_at_end, share);
    // Along the surface: what the point's height adds to the way is taken off.
    const double u2 = std::max(0.0, best - distance * distance) / (width * width);
    if (u2 >= 1.0)
        return 0.0;
    // Round crest, steep sides, soft foot.
    double height = fold.height * (1.0 - u2) * (1.0 - u2) * (1.0 + 1.1 * u2);
    if (fold.fade_in > 0.0)
        height *= smooth_step(share / fold.fade_in);
    if (fold.fade_out > 0.0)
        height *= smooth_step((1.0 - share) / fold.fade_out);
    return height;
}

} // namespace

Relief fold_relief(const Clay& base, const std::vector<Fold>& folds) {
    std::vector<LaidFold> laid;
    Ball ball{glm::dvec3(0.0), -1.0};
    for (const Fold& fold : folds) {
        laid.push_back(lay(base, fold));
        ball = ball.radius < 0.0 ? laid.back().ball : enclosing_ball(ball, laid.back().ball);
    }
    return {[laid](const glm::dvec3& point, double distance) {
                const double nearness =
                    1.0 - smooth_step((std::abs(distance) - 0.5 * reach_mm) / (0.5 * reach_mm));
                if (nearness <= 0.0)
                    return 0.0;
                double fourth_powers = 0.0;
                for (const LaidFold& fold : laid) {
                    if (fold.ball.distance(point) > 0.0)
                        continue;
                    const double height = height_at(fold, point, distance);
                    fourth_powers += height * height * height * height;
                }
                return nearness * std::sqrt(std::sqrt(fourth_powers));
            },
            ball};
}

std::vector<glm::dvec3> falling_path(const Clay& base, const glm::dvec2& axis, double angle_top_deg,
                                     double z_top, double angle_bottom_deg, double z_bottom) {
    constexpr int points = 8;
    std::vector<glm::dvec3> path;
    for (int i = 0; i < points; ++i) {
        const double share = i / (points - 1.0);
        const double angle = glm::radians(glm::mix(angle_top_deg, angle_bottom_deg, share));
        const glm::dvec3 out(std::sin(angle), -std::cos(angle), 0.0);
        glm::dvec3 point = glm::dvec3(axis, glm::mix(z_top, z_bottom, share)) + 160.0 * out;
        for (int step = 0; step < 60; ++step)
            point -= 0.8 * base.distance(point) * out;
        path.push_back(point);
    }
    return path;
}

std::vector<glm::dvec3> hanging_path(const std::vector<glm::dvec3>& points) {
    constexpr int steps = 3;
    std::vector<glm::dvec3> path;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const glm::dvec3 b = points[i];
        const glm::dvec3 c = points[i + 1];
        const glm::dvec3 a = i > 0 ? points[i - 1] : 2.0 * b - c;
        const glm::dvec3 d = i + 2 < points.size() ? points[i + 2] : 2.0 * c - b;
        for (int k = 0; k < steps; ++k) {
            const double t = static_cast<double>(k) / steps;
            path.push_back(0.5 * (2.0 * b + t * (c - a) + t * t * (2.0 * a - 5.0 * b + 4.0 * c - d) +
                                  t * t * t * (3.0 * b - 3.0 * c + d - a)));
        }
    }
    path.push_back(points.back());
    return path;
}

Shape half_space(const glm::dvec3& point, const glm::dvec3& outwards) {
    const glm::dvec3 normal = glm::normalize(outwards);
    return {[=](const glm::dvec3& p) { return glm::dot(p - point, normal); }, {point, 2000.0}};
}

Shape common(Shape a, Shape b, double blend_mm) {
    const Ball ball = a.ball.radius < b.ball.radius ? a.ball : b.ball;
    return {[a = std::move(a.distance), b = std::move(b.distance), blend_mm](const glm::dvec3& point) {
                return smooth_intersection(a(point), b(point), blend_mm);
            },
            ball};
}

Clay twisted_roll(const std::vector<glm::dvec3>& path, double radius, int strands, double turns) {
    Clay roll;
    const auto n = static_cast<double>(path.size() - 1);
    for (int strand = 0; strand < strands; ++strand) {
        std::vector<glm::dvec3> line;
        for (std::size_t i = 0; i < path.size(); ++i) {
            const glm::dvec3 along = path[std::min(i + 1, path.size() - 1)] - path[i == 0 ? 0 : i - 1];
            const glm::dmat3 axes = frame_of(along, {0.1, 0.2, 1.0});
            const double angle =
                2.0 * std::numbers::pi * (turns * static_cast<double>(i) / n + double(strand) / strands);
            line.push_back(path[i] + 0.55 * radius * (std::cos(angle) * axes[0] + std::sin(angle) * axes[1]));
        }
        const std::vector<QuadraticCurve> curves = spline(line);
        for (const QuadraticCurve& c : curves)
            roll.add(cord(c.a, c.control, c.b, glm::dvec3(0.58 * radius)), 2.0);
    }
    return roll;
}

} // namespace overt
