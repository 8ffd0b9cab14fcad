#include "experiment/fits/psychometric_fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Dense>

namespace overt {

namespace {

/// Constant and slope of the line, gamma, lambda.
using LineVector = Eigen::Vector4d;
using LineMatrix = Eigen::Matrix4d;

/// Of how small a share the logarithm is taken at the least.
constexpr double least_share = 1e-300;

/// What the likelihood needs of a level.
struct LineLevel {
    double abscissa, trials, yes;
};

struct ShareAt {
    double share, rest; ///< psi and 1 - psi
    LineVector slope;   ///< derivatives of psi
    CurveValue curve;
};

class LineLikelihood {
  public:
    LineLikelihood(const PsychometricModel& model, std::span<const LevelCount> counts) : model_(model) {
        for (const LevelCount& one : counts)
            levels_.push_back({curve_abscissa(model.shape, one.level), one.trials, one.yes});
    }
    const std::vector<LineLevel>& levels() const { return levels_; }

    ShareAt at(const LineLevel& level, const LineVector& line) const {
        ShareAt at;
        const double guess = line[2], lapse = line[3], span = 1.0 - guess - lapse;
        const bool is_below_all = std::isinf(level.abscissa);
        at.curve = is_below_all ? CurveValue{} : curve_at(model_.shape, line[0] + line[1] * level.abscissa);
        at.share = guess + span * at.curve.value;
        at.rest = lapse + span * at.curve.rest;
        at.slope << span * at.curve.first, is_below_all ? 0.0 : span * at.curve.first * level.abscissa,
            at.curve.rest, -at.curve.value;
        return at;
    }

    double value(const LineVector& line) const {
        double sum = 0.0;
        for (const LineLevel& level : levels_) {
            const ShareAt here = at(level, line);
            if (level.yes > 0.0)
                sum += level.yes * std::log(std::max(here.share, least_share));
            if (level.yes < level.trials)
                sum += (level.trials - level.yes) * std::log(std::max(here.rest, least_share));
        }
        return sum;
    }

    /// The gradient, and minus the second derivatives: expected, or those of these answers.
    void derivatives(const LineVector& line, LineVector& gradient, LineMatrix& information,
                     bool is_observed) const {
        gradient.setZero();
        information.setZero();
        for (const LineLevel& level : levels_) {
            const ShareAt here = at(level, line);
            const double share = std::max(here.share, least_share), rest = std::max(here.rest, least_share);
            const double no = level.trials - level.yes;
            const double first = (level.yes > 0.0 ? level.yes / share : 0.0) - (no > 0.0 ? no / rest : 0.0);
            gradient += first * here.slope;
            if (!is_observed) {
                if (const double weight = level.trials / (share * rest); std::isfinite(weight))
                    information += weight * here.slope * here.slope.transpose();
                continue;
            }
            const double second =
                (level.yes > 0.0 ? level.yes / (share * share) : 0.0) + (no > 0.0 ? no / (rest * rest) : 0.0);
            information += second * here.slope * here.slope.transpose();
            if (std::isinf(level.abscissa))
                continue;
            const double span = 1.0 - line[2] - line[3], t = level.abscissa;
            LineMatrix bend = LineMatrix::Zero();
            bend(0, 0) = span * here.curve.second;
            bend(0, 1) = bend(1, 0) = span * here.curve.second * t;
            bend(1, 1) = span * here.curve.second * t * t;
            for (const int asymptote : {2, 3}) {
                bend(0, asymptote) = bend(asymptote, 0) = -here.curve.first;
                bend(1, asymptote) = bend(asymptote, 1) = -here.curve.first * t;
            }
            information -= first * bend;
        }
    }

  private:
    const PsychometricModel& model_;
    std::vector<LineLevel> levels_;
};

/// The inverse on the parameters that are free; nothing if it has none.
std::optional<LineMatrix> inverse_on(const LineMatrix& information, const std::vector<int>& free) {
    const auto size = static_cast<Eigen::Index>(free.size());
    Eigen::MatrixXd part(size, size);
    for (Eigen::Index i = 0; i < size; ++i)
        for (Eigen::Index j = 0; j < size; ++j)
            part(i, j) = information(free[static_cast<std::size_t>(i)], free[static_cast<std::size_t>(j)]);
    // Scaled to a diagonal of ones, so that units of the level do not decide whether it is singular.
    const Eigen::VectorXd scale = part.diagonal().cwiseMax(0.0).cwiseSqrt();
    if (!(scale.minCoeff() > 0.0) || !scale.allFinite())
        return std::nullopt;
    const Eigen::MatrixXd scaled =
        scale.cwiseInverse().asDiagonal() * part * scale.cwiseInverse().asDiagonal();
    const Eigen::LDLT<Eigen::MatrixXd> factors(scaled);
    if (factors.info() != Eigen::Success || !(factors.vectorD().minCoeff() > 1e-12))
        return std::nullopt;
    const Eigen::MatrixXd solved = factors.solve(Eigen::MatrixXd::Identity(size, size));
    LineMatrix inverse = LineMatrix::Zero();
    for (Eigen::Index i = 0; i < size; ++i)
        for (Eigen::Index j = 0; j < size; ++j)
            inverse(free[static_cast<std::size_t>(i)], free[static_cast<std::size_t>(j)]) =
                solved(i, j) / (scale[i] * scale[j]);
    return inverse;
}

const Asymptote& asymptote_of(const PsychometricModel& model, int index) {
    return index == 2 ? model.guess : model.lapse;
}

/// Those that a step may move: not an asymptote at a bound that the likelihood presses against.
std::vector<int> movable(const PsychometricModel& model, const LineVector& line, const LineVector& gradient) {
    std::vector<int> free{0, 1};
    for (const int i : {2, 3}) {
        const Asymptote& one = asymptote_of(model, i);
        if (one.is_free && !(line[i] <= one.lowest && gradient[i] <= 0.0) &&
            !(line[i] >= one.highest && gradient[i] >= 0.0))
            free.push_back(i);
    }
    return free;
}

/// A line to begin with: through the shares, drawn in from the asymptotes, weighted by trials.
LineVector first_line(const LineLikelihood& likelihood, const PsychometricModel& model) {
    const double guess = model.guess.value, lapse = model.lapse.value;
    double weight = 0.0, t_sum = 0.0, u_sum = 0.0, tt = 0.0, tu = 0.0;
    for (const LineLevel& level : likelihood.levels()) {
        if (std::isinf(level.abscissa))
            continue;
        const double share = (level.yes + 0.5) / (level.trials + 1.0);
        const double f = std::clamp((share - guess) / (1.0 - guess - lapse), 0.02, 0.98);
        const double u = curve_inverse(model.shape, f);
        weight += level.trials;
        t_sum += level.trials * level.abscissa;
        u_sum += level.trials * u;
        tt += level.trials * level.abscissa * level.abscissa;
        tu += level.trials * level.abscissa * u;
    }
    const double spread = tt - t_sum * t_sum / weight;
    const double slope = spread > 0.0 ? (tu - t_sum * u_sum / weight) / spread : 1.0;
    return {(u_sum - slope * t_sum) / weight, slope, guess, lapse};
}

struct LineMaximum {
    LineVector line;
    bool has_converged = false;
};

LineMaximum maximise(const LineLikelihood& likelihood, const PsychometricModel& model) {
    LineMaximum found{first_line(likelihood, model)};
    for (const int i : {2, 3})
        if (const Asymptote& one = asymptote_of(model, i); one.is_free)
            found.line[i] = std::clamp(one.value, one.lowest, one.highest);
    double value = likelihood.value(found.line);
    for (int round = 0; round < 200; ++round) {
        LineVector gradient;
        LineMatrix information;
        likelihood.derivatives(found.line, gradient, information, false);
        const std::vector<int> free = movable(model, found.line, gradient);
        const std::optional<LineMatrix> inverse = inverse_on(information, free);
        if (!inverse)
            return found;
        const LineVector step = *inverse * gradient;
        // What the step gains, in units of the log-likelihood: independent of units of the level.
        if (const double promised = gradient.dot(step); promised < 1e-20 * (1.0 + std::abs(value))) {
            found.has_converged = true;
            return found;
        }
        bool has_moved = false;
        for (double part = 1.0; part > 1e-9; part *= 0.5) {
            LineVector tried = found.line + part * step;
            for (const int i : {2, 3})
                if (const Asymptote& one = asymptote_of(model, i); one.is_free)
                    tried[i] = std::clamp(tried[i], one.lowest, one.highest);
            const double there = likelihood.value(tried);
            if (there >= value) {
                has_moved = there > value || part < 1.0 || tried != found.line;
                const bool is_same = there == value;
                found.line = tried;
                value = there;
                if (is_same && part < 0.5) // as exact as double precision lets it be
                    found.has_converged = true;
                break;
            }
        }
        if (found.has_converged)
            return found;
        if (!has_moved) {
            found.has_converged = true; // no step is better: the maximum to double precision
            return found;
        }
    }
    return found;
}

/// Levels whose share is neither at one asymptote nor at the other.
int levels_between(const LineLikelihood& likelihood, const LineVector& line) {
    int between = 0;
    for (const LineLevel& level : likelihood.levels()) {
        const ShareAt here = likelihood.at(level, line);
        between += here.curve.value > 1e-5 && here.curve.rest > 1e-5 ? 1 : 0;
    }
    return between;
}

/// Where the answers step: the middle between the highest level that is nearer to the guesses and the lowest
/// that is nearer to certainty.
double middle_of_step(std::span<const LevelCount> counts, const PsychometricModel& model) {
    const double half = 0.5 * (1.0 + model.guess.value - model.lapse.value);
    std::optional<double> below, above;
    for (const LevelCount& one : counts) {
        if (one.yes / one.trials < half) {
            below = below ? std::max(*below, one.level) : one.level;
        } else {
            above = above ? std::min(*above, one.level) : one.level;
        }
    }
    return below && above ? 0.5 * (*below + *above) : below.value_or(above.value_or(0.0));
}

std::optional<double> root_of(double variance) {
    return variance > 0.0 && std::isfinite(variance) ? std::optional(std::sqrt(variance)) : std::nullopt;
}

/// Standard errors of alpha and beta from the covariance of the line.
void set_errors(PsychometricFit& fit, const LineMatrix& covariance,
                std::optional<double> FittedParameter::*se) {
    const bool is_log = fit.model.shape == CurveShape::weibull;
    const double slope = fit.line_slope, abscissa = -fit.line_constant / slope;
    const double unit = is_log ? fit.alpha.value : 1.0; // d alpha / d abscissa
    const Eigen::Vector2d by(-unit / slope, -unit * abscissa / slope);
    fit.alpha.*se = root_of(by.dot(covariance.topLeftCorner<2, 2>() * by));
    fit.beta.*se = root_of(covariance(1, 1));
    if (fit.model.guess.is_free && !fit.guess.is_at_bound)
        fit.guess.*se = root_of(covariance(2, 2));
    if (fit.model.lapse.is_free && !fit.lapse.is_at_bound)
        fit.lapse.*se = root_of(covariance(3, 3));
}

void set_agreement(PsychometricFit& fit, std::span<const LevelCount> counts) {
    int free = 2 + (fit.model.guess.is_free ? 1 : 0) + (fit.model.lapse.is_free ? 1 : 0);
    fit.degrees = static_cast<int>(counts.size()) - free;
    for (const LevelCount& one : counts) {
        const double share = fit.share_at(one.level), no = one.trials - one.yes;
        if (one.yes > 0.0)
            fit.deviance += 2.0 * one.yes * std::log(one.yes / (one.trials * share));
        if (no > 0.0)
            fit.deviance += 2.0 * no * std::log(no / (one.trials * (1.0 - share)));
        const double off = one.yes - one.trials * share, variance = one.trials * share * (1.0 - share);
        fit.pearson_x2 += variance > 0.0 ? off * off / variance : 0.0;
    }
}

} // namespace

std::vector<LevelCount> counts_by_level(std::span<const LevelCount> trials) {
    std::vector<LevelCount> sorted(trials.begin(), trials.end()), counts;
    std::ranges::stable_sort(sorted, {}, &LevelCount::level);
    for (const LevelCount& one : sorted) {
        if (!counts.empty() && counts.back().level == one.level) {
            counts.back().trials += one.trials;
            counts.back().yes += one.yes;
        } else {
            counts.push_back(one);
        }
    }
    return counts;
}

double PsychometricFit::share_at(double x) const {
    const double abscissa = curve_abscissa(model.shape, x);
    const double span = 1.0 - guess.value - lapse.value;
    if (!has_slope)
        return x < alpha.value ? guess.value : x > alpha.value ? 1.0 - lapse.value : guess.value + 0.5 * span;
    if (std::isinf(abscissa))
        return guess.value;
    return guess.value + span * curve_at(model.shape, line_constant + line_slope * abscissa).value;
}

std::optional<PsychometricFit::Threshold> PsychometricFit::threshold(double psi) const {
    const double span = 1.0 - guess.value - lapse.value, share = (psi - guess.value) / span;
    if (!has_slope || !(share > 0.0 && share < 1.0))
        return std::nullopt;
    const double u = curve_inverse(model.shape, share), abscissa = (u - line_constant) / line_slope;
    Threshold found{curve_level(model.shape, abscissa)};
    const double steepness = curve_at(model.shape, u).first;
    // d abscissa by constant, slope, gamma and lambda; a larger gamma needs less of F, a larger lambda more.
    const LineVector by(-1.0 / line_slope, -abscissa / line_slope,
                        (share - 1.0) / (span * steepness * line_slope),
                        share / (span * steepness * line_slope));
    LineMatrix covariance;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
            covariance(i, j) = line_covariance[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    found.se = root_of(by.dot(covariance * by));
    if (found.se && model.shape == CurveShape::weibull)
        *found.se *= found.level;
    return found;
}

std::optional<PsychometricFit> fit_psychometric(std::span<const LevelCount> given,
                                                const PsychometricModel& model) {
    const std::vector<LevelCount> counts = counts_by_level(given);
    if (counts.size() < 2)
        return std::nullopt;
    const LineLikelihood likelihood(model, counts);
    const LineMaximum maximum = maximise(likelihood, model);
    PsychometricFit fit;
    fit.model = model;
    fit.line_constant = maximum.line[0];
    fit.line_slope = maximum.line[1];
    fit.guess.value = maximum.line[2];
    fit.lapse.value = maximum.line[3];
    for (auto [fitted, asymptote] :
         {std::pair(&fit.guess, &model.guess), std::pair(&fit.lapse, &model.lapse)}) {
        fitted->is_at_bound =
            asymptote->is_free && (fitted->value <= asymptote->lowest || fitted->value >= asymptote->highest);
        if (fitted->is_at_bound)
            fit.note = "an asymptote is at its bound and has no standard error";
    }
    fit.log_likelihood = likelihood.value(maximum.line);
    const bool is_step = levels_between(likelihood, maximum.line) < 2;
    const bool is_flat = !(std::abs(fit.line_slope) > 0.0) || !std::isfinite(fit.line_slope) ||
                         (model.shape == CurveShape::weibull && fit.line_slope <= 0.0);
    if (is_step || is_flat || !maximum.has_converged) {
        fit.has_slope = false;
        fit.alpha.value = middle_of_step(counts, model);
        fit.beta.value = 0.0;
        fit.note = is_step   ? "the answers step from one asymptote to the other: there is no slope"
                   : is_flat ? "the answers do not rise with the level"
                             : "the likelihood has no maximum";
        set_agreement(fit, counts);
        return fit;
    }
    fit.beta.value = fit.line_slope;
    fit.alpha.value = curve_level(model.shape, -fit.line_constant / fit.line_slope);
    std::vector<int> free{0, 1};
    if (model.guess.is_free && !fit.guess.is_at_bound)
        free.push_back(2);
    if (model.lapse.is_free && !fit.lapse.is_at_bound)
        free.push_back(3);
    LineVector gradient;
    LineMatrix information;
    likelihood.derivatives(maximum.line, gradient, information, false);
    if (const std::optional<LineMatrix> covariance = inverse_on(information, free))
        set_errors(fit, *covariance, &FittedParameter::se_expected);
    likelihood.derivatives(maximum.line, gradient, information, true);
    if (const std::optional<LineMatrix> covariance = inverse_on(information, free)) {
        set_errors(fit, *covariance, &FittedParameter::se_observed);
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = 0; j < 4; ++j)
                fit.line_covariance[i][j] =
                    (*covariance)(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    }
    set_agreement(fit, counts);
    return fit;
}

} // namespace overt
