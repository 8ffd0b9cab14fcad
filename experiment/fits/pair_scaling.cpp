#include "experiment/fits/pair_scaling.h"

#include <cmath>
#include <numbers>

#include "experiment/fits/binomial_model.h"
#include "experiment/statistics/distributions.h"

namespace overt {

std::optional<PairScale> fit_pairs(std::span<const PairCount> counts, std::size_t items, PairModel model,
                                   bool with_side) {
    if (items < 2)
        return std::nullopt;
    std::vector<BinomialRow> rows;
    for (const PairCount& one : counts) {
        std::vector<double> weights(items, 0.0);
        weights[one.first_item] += 1.0;
        weights[one.second_item] -= 1.0;
        BinomialRow& row =
            rows.emplace_back(BinomialRow{{weights.begin() + 1, weights.end()}, one.trials, one.first});
        if (with_side)
            row.weights.push_back(1.0);
    }
    const bool is_thurstone = model == PairModel::thurstone;
    const std::optional<BinomialFit> fit =
        fit_binomial(rows, is_thurstone ? BinomialLink::probit : BinomialLink::logit);
    if (!fit)
        return std::nullopt;
    // The probit's unit is the noise of a difference, which has sqrt 2 times that of a percept.
    const double unit = is_thurstone ? std::numbers::sqrt2 : 1.0;
    PairScale scale;
    const auto n = static_cast<double>(items);
    double mean = 0.0;
    scale.from_first = {0.0};
    scale.from_first_se = {0.0};
    for (std::size_t i = 0; i + 1 < items; ++i) {
        scale.from_first.push_back(unit * fit->coefficients[i]);
        scale.from_first_se.push_back(unit * fit->se(i));
        mean += unit * fit->coefficients[i] / n;
    }
    for (std::size_t item = 0; item < items; ++item) {
        scale.centred.push_back(scale.from_first[item] - mean);
        // Each coefficient's weight in the item less the mean.
        double variance = 0.0;
        const auto weight = [&](std::size_t i) { return (i + 1 == item ? 1.0 : 0.0) - 1.0 / n; };
        for (std::size_t i = 0; i + 1 < items; ++i)
            for (std::size_t j = 0; j + 1 < items; ++j)
                variance += weight(i) * weight(j) * fit->covariance[i][j];
        scale.centred_se.push_back(unit * std::sqrt(variance));
    }
    if (with_side) {
        scale.side = unit * fit->coefficients.back();
        scale.side_se = unit * fit->se(items - 1);
    }
    scale.log_likelihood = fit->log_likelihood;
    scale.deviance = fit->deviance;
    scale.degrees = fit->degrees;
    scale.is_penalised = fit->is_penalised;
    return scale;
}

std::optional<std::vector<double>> row_mean_scale(const std::vector<std::vector<double>>& wins) {
    std::vector<double> scale;
    for (std::size_t i = 0; i < wins.size(); ++i) {
        double sum = 0.0;
        for (std::size_t j = 0; j < wins.size(); ++j) {
            const double trials = wins[i][j] + wins[j][i];
            if (i == j || !(trials > 0.0))
                continue;
            if (!(wins[i][j] > 0.0 && wins[j][i] > 0.0))
                return std::nullopt;
            sum += normal_quantile(wins[i][j] / trials);
        }
        scale.push_back(sum / static_cast<double>(wins.size()));
    }
    return scale;
}

CircularTriads circular_triads(const std::vector<std::vector<bool>>& beats) {
    const auto n = static_cast<double>(beats.size());
    double squares = 0.0;
    for (const std::vector<bool>& row : beats) {
        double won = 0.0;
        for (const bool one : row)
            won += one ? 1.0 : 0.0;
        squares += won * won;
    }
    CircularTriads found;
    found.count = n * (n - 1.0) * (2.0 * n - 1.0) / 12.0 - 0.5 * squares;
    found.most = beats.size() % 2 == 1 ? (n * n * n - n) / 24.0 : (n * n * n - 4.0 * n) / 24.0;
    found.expected = n * (n - 1.0) * (n - 2.0) / 24.0;
    found.consistency = found.most > 0.0 ? 1.0 - found.count / found.most : 1.0;
    return found;
}

} // namespace overt
