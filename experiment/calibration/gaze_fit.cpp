#include "experiment/calibration/gaze_fit.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "experiment/base/counted.h"
#include "experiment/base/error.h"

namespace overt {

namespace {

constexpr double huber_k = 1.345;
/// Of the normal distribution: median absolute deviation to standard deviation.
constexpr double sd_of_median = 1.4826;
/// Residuals below this are what eyes do, and no reason to weigh.
constexpr double least_sd_deg = 0.1;
constexpr int most_iterations = 50;

/// Rows of A beta = b for one pair, of both coordinates.
struct Equations {
    Eigen::MatrixXd a;
    Eigen::VectorXd b;
};

int order_for(std::size_t pairs) { return pairs < 8 ? 1 : 2; }

} // namespace

std::array<double, 6> GazeFit::terms_of(ScreenPoint measured) const noexcept {
    const double x = (measured.x_px - centre_.x_px) / half_width_px_,
                 y = (measured.y_px - centre_.y_px) / half_width_px_;
    return {1.0, x, y, x * y, x * x, y * y};
}

GazeFit::GazeFit(std::span<const CalibrationPair> pairs, CalibrationModel model, const ScreenGeometry& screen)
    : is_fitted_(true), is_homography_(model == CalibrationModel::homography),
      half_width_px_(0.5 * screen.screen_px.x), centre_(screen.centre()) {
    const auto count = static_cast<Eigen::Index>(pairs.size());
    const int order = is_homography_ ? 1 : order_for(pairs.size());
    const Eigen::Index terms = order == 1 ? 3 : 6, unknowns = is_homography_ ? 8 : 2 * terms;
    if (2 * count < unknowns)
        throw InputError(fmt::format("{} are too few for a calibration by a {}",
                                     counted(pairs.size(), "target"), name_of(model)));
    Equations all{Eigen::MatrixXd::Zero(2 * count, unknowns), Eigen::VectorXd(2 * count)};
    for (Eigen::Index i = 0; i < count; ++i) {
        const CalibrationPair& pair = pairs[static_cast<std::size_t>(i)];
        const std::array<double, 6> of = terms_of(pair.measured), at = terms_of(pair.target);
        for (int axis = 0; axis < 2; ++axis) {
            const Eigen::Index row = 2 * i + axis;
            const double target = at[static_cast<std::size_t>(1 + axis)];
            for (Eigen::Index term = 0; term < terms; ++term)
                all.a(row, axis * terms + term) = of[static_cast<std::size_t>(term)];
            if (is_homography_) {
                all.a(row, 6) = -target * of[1];
                all.a(row, 7) = -target * of[2];
            }
            all.b(row) = target;
        }
    }
    Eigen::VectorXd weights = Eigen::VectorXd::Ones(2 * count), solution;
    const double least_sd = least_sd_deg * screen.px_per_deg_at_centre() / half_width_px_;
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
        const Eigen::VectorXd roots = weights.cwiseSqrt();
        const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver(roots.asDiagonal() * all.a);
        if (solver.rank() < unknowns)
            throw InputError("the gaze that was measured at the targets lies in a line or at one place: no "
                             "calibration can be made of it");
        const Eigen::VectorXd next = solver.solve(roots.cwiseProduct(all.b));
        const bool is_settled = iteration > 0 && (next - solution).norm() < 1e-10;
        solution = next;
        if (is_settled)
            break;
        // Both coordinates of a target are weighed as one: an eye that looked elsewhere is wrong in both.
        const Eigen::VectorXd residuals = all.a * solution - all.b;
        std::vector<double> lengths;
        for (Eigen::Index i = 0; i < count; ++i)
            lengths.push_back(std::hypot(residuals(2 * i), residuals(2 * i + 1)));
        std::vector<double> sorted = lengths;
        std::nth_element(sorted.begin(), sorted.begin() + count / 2, sorted.end());
        const double sd = std::max(least_sd, sd_of_median * sorted[static_cast<std::size_t>(count / 2)]);
        for (Eigen::Index i = 0; i < count; ++i) {
            const double length = lengths[static_cast<std::size_t>(i)];
            weights(2 * i) = weights(2 * i + 1) = length <= huber_k * sd ? 1.0 : huber_k * sd / length;
        }
    }
    for (Eigen::Index term = 0; term < terms; ++term) {
        x_[static_cast<std::size_t>(term)] = solution(term);
        y_[static_cast<std::size_t>(term)] = solution(terms + term);
    }
    if (is_homography_)
        below_ = {solution(6), solution(7)};
    description_ = is_homography_ ? fmt::format("homography, {} targets", pairs.size())
                                  : fmt::format("polynomial of {} order, {} targets",
                                                order == 1 ? "first" : "second", pairs.size());
}

ScreenPoint GazeFit::operator()(ScreenPoint measured) const noexcept {
    if (!is_fitted_)
        return measured;
    const std::array<double, 6> of = terms_of(measured);
    double x = 0.0, y = 0.0;
    for (std::size_t term = 0; term < of.size(); ++term) {
        x += x_[term] * of[term];
        y += y_[term] * of[term];
    }
    const double below = is_homography_ ? 1.0 + below_[0] * of[1] + below_[1] * of[2] : 1.0;
    return {centre_.x_px + half_width_px_ * x / below, centre_.y_px + half_width_px_ * y / below};
}

namespace {

std::optional<GazeFit> fit_if_possible(std::span<const CalibrationPair> pairs, CalibrationModel model,
                                       const ScreenGeometry& screen) {
    try {
        return GazeFit(pairs, model, screen);
    } catch (const InputError&) {
        return std::nullopt;
    }
}

} // namespace

std::vector<Degrees> misses_left_out(std::span<const CalibrationPair> pairs, CalibrationModel model,
                                     const ScreenGeometry& screen) {
    const std::size_t least = model == CalibrationModel::homography ? 4 : 3;
    if (pairs.size() <= least)
        return {};
    std::vector<Degrees> misses;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        std::vector<CalibrationPair> others(pairs.begin(), pairs.end());
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
        const std::optional<GazeFit> fit = fit_if_possible(others, model, screen);
        misses.push_back(fit ? screen.angle_between((*fit)(pairs[i].measured), pairs[i].target) : Degrees{});
    }
    return misses;
}

} // namespace overt
