/// Scales from paired comparisons: Bradley and Terry (Biometrika 39, 1952) and Thurstone's Case V.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace overt {

/// Answers to one pair, shown in these places: `first` counts choices of the first item.
struct PairCount {
    std::size_t first_item = 0, second_item = 0;
    double trials = 0.0, first = 0.0;
};

enum class PairModel {
    bradley_terry, ///< logit P(i over j) = scale_i - scale_j
    thurstone      ///< P(i over j) = normal probability of (scale_i - scale_j) / sqrt 2: in SD of one percept
};

struct PairScale {
    std::vector<double> centred, centred_se;       ///< by item, with a mean of 0
    std::vector<double> from_first, from_first_se; ///< by item, less the first item
    std::optional<double> side, side_se; ///< what being in the first place adds; only where it was asked for
    double log_likelihood = 0.0, deviance = 0.0;
    int degrees = 0;
    bool is_penalised = false; ///< an item always won or always lost: see BinomialFit
};

/// Nothing where the pairs do not hang together, or there are fewer than two items.
std::optional<PairScale> fit_pairs(std::span<const PairCount> counts, std::size_t items, PairModel model,
                                   bool with_side = false);

/// The least-squares solution of Case V (Mosteller 1951): row means of the normal quantiles of observed
/// shares, in units of the difference's noise, centred. `wins`: row over column. Nothing where a share is 0
/// or 1.
std::optional<std::vector<double>> row_mean_scale(const std::vector<std::vector<double>>& wins);

/// Circular triads (Kendall and Babington Smith, Biometrika 31, 1940) of one observer's choices, each pair
/// judged once. `beats`: row over column.
struct CircularTriads {
    double count = 0.0, most = 0.0, expected = 0.0; ///< expected of an observer who guesses
    double consistency = 0.0;                       ///< zeta = 1 - count / most
};
CircularTriads circular_triads(const std::vector<std::vector<bool>>& beats);

} // namespace overt
