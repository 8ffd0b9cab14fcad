#include "experiment/fits/binomial_model.h"

#include <cmath>

#include <Eigen/Dense>

#include "experiment/fits/answer_curve.h"

namespace overt {

namespace {

CurveValue link_at(BinomialLink link, double sum) {
    return curve_at(link == BinomialLink::probit ? CurveShape::normal : CurveShape::logistic, sum);
}

/// The model's likelihood, with or without Jeffreys' prior.
class BinomialLikelihood {
  public:
    BinomialLikelihood(const std::vector<BinomialRow>& rows, BinomialLink link)
        : rows_(rows), link_(link), design_(static_cast<Eigen::Index>(rows.size()),
                                            static_cast<Eigen::Index>(rows.front().weights.size())) {
        for (std::size_t r = 0; r < rows.size(); ++r)
            for (std::size_t c = 0; c < rows[r].weights.size(); ++c)
                design_(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = rows[r].weights[c];
    }

    const Eigen::MatrixXd& design() const { return design_; }

    double plain(const Eigen::VectorXd& coefficients) const {
        const Eigen::VectorXd sums = design_ * coefficients;
        double value = 0.0;
        for (std::size_t r = 0; r < rows_.size(); ++r) {
            const CurveValue at = link_at(link_, sums[static_cast<Eigen::Index>(r)]);
            if (rows_[r].yes > 0.0)
                value += rows_[r].yes * std::log(std::max(at.value, 1e-300));
            if (rows_[r].yes < rows_[r].trials)
                value += (rows_[r].trials - rows_[r].yes) * std::log(std::max(at.rest, 1e-300));
        }
        return value;
    }

    /// With half the logarithm of the information's determinant.
    double penalised(const Eigen::VectorXd& coefficients) const {
        const Eigen::LDLT<Eigen::MatrixXd> factors(information(coefficients));
        return plain(coefficients) + 0.5 * factors.vectorD().cwiseMax(1e-300).array().log().sum();
    }

    Eigen::VectorXd weights(const Eigen::VectorXd& sums) const {
        Eigen::VectorXd weights(sums.size());
        for (Eigen::Index r = 0; r < sums.size(); ++r) {
            const CurveValue at = link_at(link_, sums[r]);
            const double product = at.value * at.rest;
            weights[r] = product > 0.0
                             ? rows_[static_cast<std::size_t>(r)].trials * at.first * at.first / product
                             : 0.0;
        }
        return weights;
    }

    Eigen::MatrixXd information(const Eigen::VectorXd& coefficients) const {
        return design_.transpose() * weights(design_ * coefficients).asDiagonal() * design_;
    }

    Eigen::VectorXd score(const Eigen::VectorXd& coefficients) const {
        const Eigen::VectorXd sums = design_ * coefficients;
        Eigen::VectorXd by_row(sums.size());
        for (Eigen::Index r = 0; r < sums.size(); ++r) {
            const BinomialRow& row = rows_[static_cast<std::size_t>(r)];
            const CurveValue at = link_at(link_, sums[r]);
            const double no = row.trials - row.yes;
            by_row[r] = at.first * ((row.yes > 0.0 ? row.yes / std::max(at.value, 1e-300) : 0.0) -
                                    (no > 0.0 ? no / std::max(at.rest, 1e-300) : 0.0));
        }
        return design_.transpose() * by_row;
    }

    /// Of the prior: half the trace of the inverse information times its derivative.
    Eigen::VectorXd prior_score(const Eigen::VectorXd& coefficients, const Eigen::MatrixXd& inverse) const {
        const Eigen::VectorXd sums = design_ * coefficients;
        Eigen::VectorXd by_row(sums.size());
        for (Eigen::Index r = 0; r < sums.size(); ++r) {
            const CurveValue at = link_at(link_, sums[r]);
            const double product = at.value * at.rest;
            const double leverage = design_.row(r) * inverse * design_.row(r).transpose();
            // d/du of first^2 / (value rest)
            const double bend =
                product > 0.0 && at.first > 0.0
                    ? at.first * at.first / product *
                          (2.0 * at.second / at.first - at.first * (at.rest - at.value) / product)
                    : 0.0;
            by_row[r] = 0.5 * rows_[static_cast<std::size_t>(r)].trials * bend * leverage;
        }
        return design_.transpose() * by_row;
    }

  private:
    const std::vector<BinomialRow>& rows_;
    BinomialLink link_;
    Eigen::MatrixXd design_;
};

struct BinomialMaximum {
    Eigen::VectorXd coefficients;
    bool has_converged = false;
};

BinomialMaximum climb(const BinomialLikelihood& likelihood, bool is_penalised) {
    BinomialMaximum found{Eigen::VectorXd::Zero(likelihood.design().cols())};
    const auto value_at = [&](const Eigen::VectorXd& there) {
        return is_penalised ? likelihood.penalised(there) : likelihood.plain(there);
    };
    double value = value_at(found.coefficients);
    for (int round = 0; round < 100; ++round) {
        const Eigen::LDLT<Eigen::MatrixXd> factors(likelihood.information(found.coefficients));
        const Eigen::VectorXd pivots = factors.vectorD();
        if (!(pivots.minCoeff() > 1e-10 * pivots.maxCoeff()))
            return found;
        Eigen::VectorXd gradient = likelihood.score(found.coefficients);
        if (is_penalised)
            gradient += likelihood.prior_score(found.coefficients, factors.solve(Eigen::MatrixXd::Identity(
                                                                       gradient.size(), gradient.size())));
        const Eigen::VectorXd step = factors.solve(gradient);
        // Where answers are separated the sums keep growing while the likelihood hardly does.
        if (step.cwiseAbs().maxCoeff() < 1e-9 * (1.0 + found.coefficients.cwiseAbs().maxCoeff())) {
            found.has_converged = true;
            return found;
        }
        double part = 1.0;
        for (; part > 1e-10; part *= 0.5) {
            const double there = value_at(found.coefficients + part * step);
            if (there >= value - 1e-13 * std::abs(value)) {
                value = there;
                found.coefficients += part * step;
                break;
            }
        }
        if (part <= 1e-10) {
            found.has_converged = step.cwiseAbs().maxCoeff() < 1e-5;
            return found;
        }
    }
    return found;
}

} // namespace

double share_of_sum(BinomialLink link, double sum) { return link_at(link, sum).value; }

double BinomialFit::se(std::size_t coefficient) const {
    return std::sqrt(covariance[coefficient][coefficient]);
}

std::optional<BinomialFit> fit_binomial(const std::vector<BinomialRow>& rows, BinomialLink link) {
    if (rows.empty() || rows.front().weights.empty())
        return std::nullopt;
    const BinomialLikelihood likelihood(rows, link);
    const Eigen::Index count = likelihood.design().cols();
    if (Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(likelihood.design()).rank() < count)
        return std::nullopt;
    BinomialFit fit;
    BinomialMaximum maximum = climb(likelihood, false);
    if (!maximum.has_converged) {
        fit.is_penalised = true;
        maximum = climb(likelihood, true);
        if (!maximum.has_converged)
            return std::nullopt;
    }
    const Eigen::MatrixXd covariance =
        likelihood.information(maximum.coefficients).ldlt().solve(Eigen::MatrixXd::Identity(count, count));
    for (Eigen::Index i = 0; i < count; ++i) {
        fit.coefficients.push_back(maximum.coefficients[i]);
        std::vector<double>& row = fit.covariance.emplace_back();
        for (Eigen::Index j = 0; j < count; ++j)
            row.push_back(covariance(i, j));
    }
    fit.log_likelihood = likelihood.plain(maximum.coefficients);
    double best = 0.0; // each row by its own share
    for (const BinomialRow& row : rows) {
        const double no = row.trials - row.yes;
        best += (row.yes > 0.0 ? row.yes * std::log(row.yes / row.trials) : 0.0) +
                (no > 0.0 ? no * std::log(no / row.trials) : 0.0);
    }
    fit.deviance = 2.0 * (best - fit.log_likelihood);
    fit.degrees = static_cast<int>(rows.size()) - static_cast<int>(count);
    return fit;
}

} // namespace overt
