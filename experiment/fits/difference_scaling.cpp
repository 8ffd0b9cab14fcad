#include "experiment/fits/difference_scaling.h"

#include <algorithm>
#include <cmath>

#include "experiment/base/random.h"
#include "experiment/statistics/bootstrap.h"

namespace overt {

namespace {

/// Rows of the model: the first level's weight is left out, its scale being 0.
std::vector<BinomialRow> difference_rows(std::span<const DifferenceCount> counts, int levels) {
    std::vector<BinomialRow> rows;
    for (const DifferenceCount& one : counts) {
        std::vector<double> weights(static_cast<std::size_t>(levels), 0.0);
        const auto weight = [&](std::size_t member) -> double& {
            return weights[static_cast<std::size_t>(one.places[member])];
        };
        if (one.places.size() == 3) {
            weight(0) += 1.0;
            weight(1) -= 2.0;
            weight(2) += 1.0;
        } else {
            weight(0) += 1.0;
            weight(1) -= 1.0;
            weight(2) -= 1.0;
            weight(3) += 1.0;
        }
        rows.push_back({{weights.begin() + 1, weights.end()}, one.trials, one.upper});
    }
    return rows;
}

/// Which of the weights belongs to a factor's level above its first.
std::size_t conjoint_weight(std::span<const int> levels_of_factor, std::size_t factor, int level) {
    std::size_t before = 0;
    for (std::size_t f = 0; f < factor; ++f)
        before += static_cast<std::size_t>(levels_of_factor[f] - 1);
    return before + static_cast<std::size_t>(level - 1);
}

} // namespace

std::optional<DifferenceScale> fit_difference_scale(std::span<const DifferenceCount> counts, int levels) {
    if (levels < 3)
        return std::nullopt;
    std::optional<BinomialFit> fit = fit_binomial(difference_rows(counts, levels), BinomialLink::probit);
    if (!fit)
        return std::nullopt;
    DifferenceScale scale;
    scale.raw = {0.0};
    scale.raw_se = {0.0};
    for (std::size_t i = 0; i < fit->coefficients.size(); ++i) {
        scale.raw.push_back(fit->coefficients[i]);
        scale.raw_se.push_back(fit->se(i));
    }
    const double last = scale.raw.back();
    for (const double one : scale.raw)
        scale.scale.push_back(one / last);
    scale.sigma = 1.0 / last;
    scale.log_likelihood = fit->log_likelihood;
    scale.deviance = fit->deviance;
    scale.is_penalised = fit->is_penalised;
    scale.fit = std::move(*fit);
    return scale;
}

std::optional<double> DifferenceScale::normalised_se(std::size_t level) const {
    const std::size_t last = raw.size() - 1;
    if (!(raw.back() > 0.0))
        return std::nullopt;
    if (level == 0 || level == last)
        return 0.0;
    // d (a / b) = da / b - a db / b^2, of coefficients one below their levels.
    const double by_own = 1.0 / raw.back(), by_last = -raw[level] / (raw.back() * raw.back());
    const std::vector<std::vector<double>>& covariance = fit.covariance;
    return std::sqrt(by_own * by_own * covariance[level - 1][level - 1] +
                     by_last * by_last * covariance[last - 1][last - 1] +
                     2.0 * by_own * by_last * covariance[level - 1][last - 1]);
}

std::optional<ScaleIntervals> bootstrap_difference_scale(std::span<const DifferenceCount> counts,
                                                         const DifferenceScale& scale,
                                                         const ScaleBootstrap& settings) {
    const auto levels = static_cast<int>(scale.raw.size());
    const std::vector<BinomialRow> rows = difference_rows(counts, levels);
    std::vector<DifferenceCount> sample(counts.begin(), counts.end());
    std::vector<std::vector<double>> drawn(scale.raw.size());
    std::vector<double> sigmas;
    ScaleIntervals found;
    for (int draw = 0; draw < settings.resamples; ++draw) {
        RandomStream random(settings.seed, "scale bootstrap", static_cast<std::uint64_t>(draw));
        for (std::size_t r = 0; r < rows.size(); ++r) {
            double sum = 0.0;
            for (std::size_t i = 0; i < rows[r].weights.size(); ++i)
                sum += rows[r].weights[i] * scale.raw[i + 1];
            const double share = share_of_sum(BinomialLink::probit, sum);
            sample[r].upper = 0.0;
            for (int trial = 0; trial < static_cast<int>(rows[r].trials); ++trial)
                sample[r].upper += random.uniform() < share ? 1.0 : 0.0;
        }
        const std::optional<DifferenceScale> again = fit_difference_scale(sample, levels);
        if (!again || !(again->raw.back() > 0.0)) {
            ++found.failures;
            continue;
        }
        found.penalised += again->is_penalised ? 1 : 0;
        for (std::size_t i = 0; i < drawn.size(); ++i)
            drawn[i].push_back(again->scale[i]);
        sigmas.push_back(again->sigma);
    }
    if (2 * static_cast<int>(sigmas.size()) < settings.resamples || sigmas.size() < 2)
        return std::nullopt;
    const auto percentiles = [&](std::vector<double>& of) {
        std::ranges::sort(of);
        return Interval{quantile_of_sorted(of, 0.5 - 0.5 * settings.confidence),
                        quantile_of_sorted(of, 0.5 + 0.5 * settings.confidence)};
    };
    for (std::vector<double>& one : drawn) {
        double mean = 0.0, squares = 0.0;
        for (const double value : one)
            mean += value / static_cast<double>(one.size());
        for (const double value : one)
            squares += (value - mean) * (value - mean);
        found.scale_sd.push_back(std::sqrt(squares / static_cast<double>(one.size() - 1)));
        found.scale.push_back(percentiles(one));
    }
    found.sigma = percentiles(sigmas);
    return found;
}

std::optional<ConjointScale> fit_conjoint(std::span<const ConjointCount> counts,
                                          std::span<const int> levels_of_factor) {
    std::size_t weights = 0;
    for (const int levels : levels_of_factor)
        weights += static_cast<std::size_t>(levels - 1);
    std::vector<BinomialRow> rows;
    for (const ConjointCount& one : counts) {
        BinomialRow& row =
            rows.emplace_back(BinomialRow{std::vector<double>(weights, 0.0), one.trials, one.first});
        for (std::size_t f = 0; f < levels_of_factor.size(); ++f) {
            if (one.first_levels[f] > 0)
                row.weights[conjoint_weight(levels_of_factor, f, one.first_levels[f])] += 1.0;
            if (one.second_levels[f] > 0)
                row.weights[conjoint_weight(levels_of_factor, f, one.second_levels[f])] -= 1.0;
        }
    }
    const std::optional<BinomialFit> fit = fit_binomial(rows, BinomialLink::probit);
    if (!fit)
        return std::nullopt;
    ConjointScale scale;
    for (std::size_t f = 0; f < levels_of_factor.size(); ++f) {
        std::vector<double>& parts = scale.parts.emplace_back(1, 0.0);
        std::vector<double>& errors = scale.parts_se.emplace_back(1, 0.0);
        for (int level = 1; level < levels_of_factor[f]; ++level) {
            const std::size_t at = conjoint_weight(levels_of_factor, f, level);
            parts.push_back(fit->coefficients[at]);
            errors.push_back(fit->se(at));
        }
    }
    scale.log_likelihood = fit->log_likelihood;
    scale.deviance = fit->deviance;
    scale.degrees = fit->degrees;
    scale.is_penalised = fit->is_penalised;
    return scale;
}

} // namespace overt
