#include "experiment/fits/gauge_relief.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Dense>

namespace overt {

namespace {

constexpr double gauge_radians = std::numbers::pi / 180.0;

/// A fit by least squares, and how much of the variance about the mean it leaves.
struct LinearFit {
    Eigen::VectorXd coefficients;
    double r_squared = 0.0;
};

LinearFit linear_fit(const Eigen::MatrixXd& design, const Eigen::VectorXd& of) {
    LinearFit fit{design.colPivHouseholderQr().solve(of)};
    const double left = (of - design * fit.coefficients).squaredNorm();
    const double whole = (of.array() - of.mean()).matrix().squaredNorm();
    fit.r_squared = whole > 0.0 ? 1.0 - left / whole : 0.0;
    return fit;
}

Eigen::Vector3d normal_of(double slant_deg, double tilt_deg) {
    const double slant = slant_deg * gauge_radians, tilt = tilt_deg * gauge_radians;
    return {std::sin(slant) * std::cos(tilt), std::sin(slant) * std::sin(tilt), std::cos(slant)};
}

} // namespace

std::optional<GaugeRelief> gauge_relief(std::span<const ReliefNode> nodes,
                                        std::span<const GaugeSetting> settings) {
    if (nodes.size() < 3 || settings.empty())
        return std::nullopt;
    GaugeRelief relief;
    relief.equations = static_cast<int>(3 * settings.size());
    // The first node is held at 0 while solving.
    const auto unknowns = static_cast<Eigen::Index>(nodes.size()) - 1;
    Eigen::MatrixXd design = Eigen::MatrixXd::Zero(relief.equations, unknowns);
    Eigen::VectorXd rise(relief.equations);
    Eigen::Index row = 0;
    for (const GaugeSetting& one : settings) {
        relief.clipped += one.slant_deg > steepest_slant_deg ? 1 : 0;
        const double slant = std::min(one.slant_deg, steepest_slant_deg) * gauge_radians;
        const double tilt = one.tilt_deg * gauge_radians;
        const double dz_dx = -std::tan(slant) * std::cos(tilt), dz_dy = -std::tan(slant) * std::sin(tilt);
        for (std::size_t i = 0; i < 3; ++i, ++row) {
            const std::size_t from = one.nodes[i], to = one.nodes[(i + 1) % 3];
            if (to > 0)
                design(row, static_cast<Eigen::Index>(to) - 1) += 1.0;
            if (from > 0)
                design(row, static_cast<Eigen::Index>(from) - 1) -= 1.0;
            rise[row] = dz_dx * (nodes[to].x - nodes[from].x) + dz_dy * (nodes[to].y - nodes[from].y);
        }
    }
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factors(design);
    if (factors.rank() < unknowns)
        return std::nullopt;
    const Eigen::VectorXd z = factors.solve(rise);
    relief.residual_sum = (rise - design * z).squaredNorm();
    const double mean = z.sum() / static_cast<double>(nodes.size());
    relief.z.push_back(-mean);
    for (const double one : z)
        relief.z.push_back(one - mean);
    return relief;
}

std::optional<ReliefAgreement> compare_relief(std::span<const ReliefNode> nodes, std::span<const double> z,
                                              std::span<const double> true_z) {
    const auto count = static_cast<Eigen::Index>(nodes.size());
    if (count < 5 || z.size() != nodes.size() || true_z.size() != nodes.size())
        return std::nullopt;
    Eigen::MatrixXd design(count, 4);
    Eigen::VectorXd of(count);
    for (Eigen::Index i = 0; i < count; ++i) {
        const auto node = static_cast<std::size_t>(i);
        design.row(i) << 1.0, true_z[node], nodes[node].x, nodes[node].y;
        of[i] = z[node];
    }
    const LinearFit plain = linear_fit(design.leftCols(2), of), affine = linear_fit(design, of);
    return ReliefAgreement{plain.coefficients[1],  plain.r_squared,        affine.coefficients[1],
                           affine.coefficients[2], affine.coefficients[3], affine.r_squared};
}

double normal_angle_deg(double slant_deg, double tilt_deg, double other_slant_deg, double other_tilt_deg) {
    const Eigen::Vector3d one = normal_of(slant_deg, tilt_deg),
                          other = normal_of(other_slant_deg, other_tilt_deg);
    return std::atan2(one.cross(other).norm(), one.dot(other)) / gauge_radians;
}

} // namespace overt
