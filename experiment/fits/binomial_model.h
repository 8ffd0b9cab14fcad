/// Generalised linear models of counts: the share of `yes` is a link's value of a weighted sum. Scales from
/// differences and from pairs are such models.
#pragma once

#include <optional>
#include <vector>

namespace overt {

enum class BinomialLink { probit, logit };

/// A row of a model: what the weights are multiplied with, and answers.
struct BinomialRow {
    std::vector<double> weights; ///< one for each coefficient
    double trials = 0.0, yes = 0.0;
};

struct BinomialFit {
    std::vector<double> coefficients;
    std::vector<std::vector<double>> covariance; ///< from the expected information
    double log_likelihood = 0.0;                 ///< without binomial coefficients
    double deviance = 0.0;
    int degrees = 0; ///< of freedom: rows less coefficients
    /// The answers are separated (some sum of coefficients can grow for ever), so that the likelihood has no
    /// maximum: Jeffreys' prior was added (Firth, Biometrika 80, 1993), which keeps all coefficients finite.
    bool is_penalised = false;

    double se(std::size_t coefficient) const;
};

/// Fisher scoring with halved steps. Nothing where the rows cannot tell the coefficients apart. All rows have
/// as many weights as the first.
std::optional<BinomialFit> fit_binomial(const std::vector<BinomialRow>& rows, BinomialLink link);

/// The share of `yes` that a link gives to a sum.
double share_of_sum(BinomialLink link, double sum);

} // namespace overt
