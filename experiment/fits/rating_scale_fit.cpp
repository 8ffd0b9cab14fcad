#include "experiment/fits/rating_scale_fit.h"

#include <cmath>
#include <limits>

#include <Eigen/Dense>

#include "experiment/fits/answer_curve.h"
#include "experiment/statistics/distributions.h"

namespace overt {

namespace {

/// Counts by stimulus and by category that was given at all.
using RatingTable = std::vector<std::vector<double>>;

/// Shares of a stimulus's categories, and their derivatives by its place's and the cuts' values.
class CumulativeProbit {
  public:
    CumulativeProbit(const RatingTable& table, std::size_t cuts) : table_(table), cuts_(cuts) {}

    /// Cuts first, then all stimuli but the first.
    Eigen::Index count() const { return static_cast<Eigen::Index>(cuts_ + table_.size() - 1); }

    double value(const Eigen::VectorXd& at) const {
        double sum = 0.0;
        for (std::size_t s = 0; s < table_.size(); ++s)
            for (std::size_t c = 0; c <= cuts_; ++c) {
                if (!(table_[s][c] > 0.0))
                    continue;
                const double share = upper(at, s, c) - lower(at, s, c);
                if (!(share > 0.0))
                    return -std::numeric_limits<double>::infinity();
                sum += table_[s][c] * std::log(share);
            }
        return sum;
    }

    void derivatives(const Eigen::VectorXd& at, Eigen::VectorXd& gradient,
                     Eigen::MatrixXd& information) const {
        gradient = Eigen::VectorXd::Zero(count());
        information = Eigen::MatrixXd::Zero(count(), count());
        for (std::size_t s = 0; s < table_.size(); ++s) {
            double ratings = 0.0;
            for (const double one : table_[s])
                ratings += one;
            for (std::size_t c = 0; c <= cuts_; ++c) {
                const double share = upper(at, s, c) - lower(at, s, c);
                if (!(share > 1e-300))
                    continue;
                Eigen::VectorXd slope = Eigen::VectorXd::Zero(count());
                const double above = c < cuts_ ? density_at(at, s, c) : 0.0;
                const double below = c > 0 ? density_at(at, s, c - 1) : 0.0;
                if (c < cuts_)
                    slope[static_cast<Eigen::Index>(c)] += above;
                if (c > 0)
                    slope[static_cast<Eigen::Index>(c) - 1] -= below;
                if (s > 0)
                    slope[static_cast<Eigen::Index>(cuts_ + s) - 1] -= above - below;
                gradient += table_[s][c] / share * slope;
                information += ratings / share * slope * slope.transpose();
            }
        }
    }

  private:
    double place(const Eigen::VectorXd& at, std::size_t stimulus) const {
        return stimulus > 0 ? at[static_cast<Eigen::Index>(cuts_ + stimulus) - 1] : 0.0;
    }
    double distance(const Eigen::VectorXd& at, std::size_t stimulus, std::size_t cut) const {
        return at[static_cast<Eigen::Index>(cut)] - place(at, stimulus);
    }
    double upper(const Eigen::VectorXd& at, std::size_t stimulus, std::size_t category) const {
        return category < cuts_ ? normal_probability(distance(at, stimulus, category)) : 1.0;
    }
    double lower(const Eigen::VectorXd& at, std::size_t stimulus, std::size_t category) const {
        return category > 0 ? normal_probability(distance(at, stimulus, category - 1)) : 0.0;
    }
    double density_at(const Eigen::VectorXd& at, std::size_t stimulus, std::size_t cut) const {
        return curve_at(CurveShape::normal, distance(at, stimulus, cut)).first;
    }

    const RatingTable& table_;
    std::size_t cuts_;
};

} // namespace

RatingMean rating_mean(const RatingCounts& counts) {
    RatingMean found;
    double sum = 0.0, squares = 0.0;
    for (std::size_t c = 0; c < counts.by_category.size(); ++c) {
        found.count += counts.by_category[c];
        sum += counts.by_category[c] * static_cast<double>(c + 1);
    }
    found.mean = found.count > 0.0 ? sum / found.count : 0.0;
    for (std::size_t c = 0; c < counts.by_category.size(); ++c)
        squares += counts.by_category[c] * std::pow(static_cast<double>(c + 1) - found.mean, 2);
    if (found.count > 1.0)
        found.sd = std::sqrt(squares / (found.count - 1.0));
    return found;
}

std::optional<RatingScale> fit_rating_scale(std::span<const RatingCounts> stimuli) {
    if (stimuli.empty())
        return std::nullopt;
    const std::size_t categories = stimuli.front().by_category.size();
    std::vector<std::size_t> given;
    for (std::size_t c = 0; c < categories; ++c)
        for (const RatingCounts& one : stimuli)
            if (one.by_category[c] > 0.0) {
                given.push_back(c);
                break;
            }
    if (given.size() < 2)
        return std::nullopt;
    RatingTable table;
    std::vector<double> totals(given.size(), 0.0);
    double all = 0.0;
    for (const RatingCounts& one : stimuli) {
        std::vector<double>& row = table.emplace_back();
        for (std::size_t g = 0; g < given.size(); ++g) {
            row.push_back(one.by_category[given[g]]);
            totals[g] += row.back();
            all += row.back();
        }
    }
    const std::size_t cuts = given.size() - 1;
    const CumulativeProbit model(table, cuts);
    Eigen::VectorXd at = Eigen::VectorXd::Zero(model.count());
    double below = 0.0;
    for (std::size_t c = 0; c < cuts; ++c) {
        below += totals[c];
        at[static_cast<Eigen::Index>(c)] = normal_quantile(below / all);
    }
    double value = model.value(at);
    Eigen::VectorXd gradient;
    Eigen::MatrixXd information;
    bool has_converged = false;
    for (int round = 0; round < 200 && !has_converged; ++round) {
        model.derivatives(at, gradient, information);
        const Eigen::LDLT<Eigen::MatrixXd> factors(information);
        if (!(factors.vectorD().minCoeff() > 1e-10 * factors.vectorD().maxCoeff()))
            return std::nullopt;
        const Eigen::VectorXd step = factors.solve(gradient);
        if (step.cwiseAbs().maxCoeff() < 1e-9) {
            has_converged = true;
            break;
        }
        double part = 1.0;
        for (; part > 1e-10; part *= 0.5) {
            const double there = model.value(at + part * step);
            if (there >= value - 1e-13 * std::abs(value)) {
                value = there;
                at += part * step;
                break;
            }
        }
        if (part <= 1e-10)
            return std::nullopt;
    }
    if (!has_converged || at.cwiseAbs().maxCoeff() > 12.0) // places so far apart are only kept by rounding
        return std::nullopt;
    const Eigen::MatrixXd covariance =
        information.ldlt().solve(Eigen::MatrixXd::Identity(model.count(), model.count()));
    RatingScale scale;
    scale.log_likelihood = value;
    scale.categories = given;
    for (std::size_t c = 0; c < cuts; ++c) {
        const auto cut = static_cast<Eigen::Index>(c);
        scale.cuts.push_back(at[cut]);
        scale.cuts_se.push_back(std::sqrt(covariance(cut, cut)));
    }
    for (std::size_t s = 0; s < stimuli.size(); ++s) {
        const auto index = static_cast<Eigen::Index>(cuts + s) - 1;
        scale.stimuli.push_back(s > 0 ? at[index] : 0.0);
        scale.stimuli_se.push_back(s > 0 ? std::sqrt(covariance(index, index)) : 0.0);
    }
    return scale;
}

} // namespace overt
