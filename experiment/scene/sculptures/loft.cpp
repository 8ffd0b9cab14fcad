#include "experiment/scene/sculptures/loft.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "experiment/scene/sculptures/quadratic_curve.h"

namespace overt {

namespace {

using Values = std::array<double, 4>; // half side, half front, side shift, front shift

/// Natural cubic spline through four numbers at once.
class SectionSpline {
  public:
    explicit SectionSpline(const std::vector<LoftSection>& sections) {
        for (const LoftSection& s : sections) {
            along_.push_back(s.along);
            values_.push_back({s.half_side, s.half_front, s.side_shift, s.front_shift});
        }
        bends_.assign(along_.size(), Values{});
        for (std::size_t k = 0; k < 4; ++k)
            solve(k);
    }

    Values at(double t) const {
        std::size_t i = 1;
        while (i + 1 < along_.size() && t > along_[i])
            ++i;
        const double width = along_[i] - along_[i - 1];
        const double b = (t - along_[i - 1]) / width;
        const double a = 1.0 - b;
        Values result;
        for (std::size_t k = 0; k < 4; ++k)
            result[k] =
                a * values_[i - 1][k] + b * values_[i][k] +
                ((a * a * a - a) * bends_[i - 1][k] + (b * b * b - b) * bends_[i][k]) * width * width / 6.0;
        return result;
    }

  private:
    /// Second derivatives at the knots, 0 at the ends: the tridiagonal system by elimination.
    void solve(std::size_t k) {
        const std::size_t n = along_.size();
        std::vector<double> rest(n, 0.0);
        std::vector<double> factor(n, 0.0);
        for (std::size_t i = 1; i + 1 < n; ++i) {
            const double before = along_[i] - along_[i - 1];
            const double after = along_[i + 1] - along_[i];
            const double share = before / (before + after);
            const double pivot = share * factor[i - 1] + 2.0;
            factor[i] = (share - 1.0) / pivot;
            const double turn =
                (values_[i + 1][k] - values_[i][k]) / after - (values_[i][k] - values_[i - 1][k]) / before;
            rest[i] = (6.0 * turn / (before + after) - share * rest[i - 1]) / pivot;
        }
        for (std::size_t i = n - 1; i-- > 1;)
            bends_[i][k] = factor[i] * bends_[i + 1][k] + rest[i];
    }

    std::vector<double> along_;
    std::vector<Values> values_;
    std::vector<Values> bends_;
};

/// Farther off than this a loft gives a lower bound of its distance, which costs less: no seam is filled and
/// no block of the grid decided upon so far from the surface.
constexpr double bound_suffices_mm = 45.0;

class Loft {
  public:
    Loft(const LoftAxis& axis, const std::vector<LoftSection>& sections, double cap, double reach)
        : axis_(axis), curve_{axis.start, axis.control, axis.end}, spline_(sections), cap_(cap),
          reach_(reach) {
        const glm::dvec3 natural =
            glm::cross(curve_.derivative(0.5), axis.front_at_start + axis.front_at_end);
        hand_ = glm::dot(natural, axis.side) < 0.0 ? -1.0 : 1.0;
        const double bend = glm::distance(axis.control, 0.5 * (axis.start + axis.end));
        is_straight_ = bend < 1e-6;
        reach_ += 0.5 * bend;
    }

    double distance(const glm::dvec3& point) const {
        const glm::dvec3 chord = curve_.b - curve_.a;
        const double on_chord =
            std::clamp(glm::dot(point - curve_.a, chord) / glm::dot(chord, chord), 0.0, 1.0);
        const double bound = glm::distance(point, curve_.a + on_chord * chord) - reach_;
        if (bound > bound_suffices_mm)
            return bound;
        const double t = is_straight_ ? on_chord : parameter(point, on_chord);
        const glm::dvec3 along = glm::normalize(curve_.derivative(t));
        glm::dvec3 front = glm::mix(axis_.front_at_start, axis_.front_at_end, t);
        front = glm::normalize(front - along * glm::dot(front, along));
        const glm::dvec3 side = hand_ * glm::cross(along, front);
        const auto [half_side, half_front, side_shift, front_shift] = spline_.at(t);
        const glm::dvec3 offset = point - curve_.at(t);
        const double beyond = (t <= 0.0 || t >= 1.0) ? glm::dot(offset, along) : 0.0;
        const glm::dvec3 inside(glm::dot(offset, side) - side_shift, glm::dot(offset, front) - front_shift,
                                beyond);
        return ellipsoid_distance(inside, {half_side, half_front, cap_ * std::min(half_side, half_front)});
    }

  private:
    /// Newton steps from the chord; the curve is bent too little for a second foot near the surface.
    double parameter(const glm::dvec3& point, double t) const {
        const glm::dvec3 bend = 2.0 * (curve_.a - 2.0 * curve_.control + curve_.b);
        for (int i = 0; i < 4; ++i) {
            const glm::dvec3 slope = curve_.derivative(t);
            const glm::dvec3 offset = point - curve_.at(t);
            const double square = glm::dot(slope, slope);
            t += glm::dot(offset, slope) / std::max(0.4 * square, square - glm::dot(offset, bend));
            t = std::clamp(t, 0.0, 1.0);
        }
        return t;
    }

    LoftAxis axis_;
    QuadraticCurve curve_;
    SectionSpline spline_;
    double cap_;
    double reach_;
    double hand_;
    bool is_straight_;
};

} // namespace

Shape loft(const LoftAxis& axis, const std::vector<LoftSection>& sections, double cap) {
    Ball ball{axis.start, 0.0};
    double farthest = 0.0;
    const QuadraticCurve curve{axis.start, axis.control, axis.end};
    for (const LoftSection& s : sections) {
        // Splines may swing a little beyond the sections.
        const double reach =
            1.15 * std::max(s.half_side, s.half_front) + std::hypot(s.side_shift, s.front_shift);
        ball = enclosing_ball(ball, {curve.at(s.along), reach});
        farthest = std::max(farthest, reach);
    }
    return {[solid = Loft(axis, sections, cap, farthest)](const glm::dvec3& point) {
                return solid.distance(point);
            },
            ball};
}

} // namespace overt
