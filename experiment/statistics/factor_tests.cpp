#include "experiment/statistics/factor_tests.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace overt {

namespace {

/// Equal sums in another order differ by rounding: they count as equal.
constexpr double all_but_rounding = 1.0 - 1e-9;
/// What rounding leaves of a squared length of 1.
constexpr double no_length = 1e-9;
/// Differences of differences; a test of more would spend its power on them.
constexpr std::size_t most_tetrads = 60;

using Column = std::vector<double>;
/// Cells with their signs.
using Contrast = std::vector<std::pair<std::size_t, double>>;

double product(const Column& a, const Column& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += a[i] * b[i];
    return sum;
}

/// Takes off what observers' means and other groups tell.
class Beside {
  public:
    explicit Beside(const FactorTrials& trials) : observers_(trials.observers) {
        for (const std::size_t observer : observers_)
            count_ = std::max(count_, observer + 1);
        for (const std::vector<std::size_t>& groups : trials.beside) {
            const std::size_t all = groups.empty() ? 0 : *std::ranges::max_element(groups) + 1;
            for (std::size_t group = 0; group < all; ++group) {
                Column column(groups.size(), 0.0);
                for (std::size_t i = 0; i < groups.size(); ++i)
                    column[i] = groups[i] == group ? 1.0 : 0.0;
                add(std::move(column));
            }
        }
    }

    std::size_t observers() const { return count_; }
    std::size_t observer_of(std::size_t trial) const { return observers_[trial]; }
    /// Orthonormal; each is 0 on average within every observer.
    const std::vector<Column>& basis() const { return basis_; }

    void take_off(Column& column) const {
        take_means_off(column);
        // Twice, for rounding.
        for (int round = 0; round < 2; ++round) {
            for (const Column& one : basis_) {
                const double along = product(one, column);
                for (std::size_t i = 0; i < column.size(); ++i)
                    column[i] -= along * one[i];
            }
        }
    }

  private:
    void take_means_off(Column& column) const {
        std::vector<std::pair<double, int>> sums(count_);
        for (std::size_t i = 0; i < column.size(); ++i) {
            sums[observers_[i]].first += column[i];
            ++sums[observers_[i]].second;
        }
        for (std::size_t i = 0; i < column.size(); ++i)
            column[i] -= sums[observers_[i]].first / sums[observers_[i]].second;
    }

    void add(Column column) {
        const double before = product(column, column);
        take_off(column);
        const double length = product(column, column);
        if (!(length > no_length * before))
            return; // others tell it already
        for (double& value : column)
            value /= std::sqrt(length);
        basis_.push_back(std::move(column));
    }

    const std::vector<std::size_t>& observers_;
    std::size_t count_ = 0;
    std::vector<Column> basis_;
};

/// One contrast: what observers give to it.
class Gifts {
  public:
    /// Nothing is given where the contrast cannot be told from what is beside.
    Gifts(const Beside& beside, const Column& rest, const Column& weights) : gifts_(beside.observers(), 0.0) {
        const std::size_t n = beside.observers();
        std::vector<Column> along(n, Column(beside.basis().size(), 0.0));
        weight_of_.assign(n, 0.0);
        for (std::size_t i = 0; i < rest.size(); ++i) {
            const std::size_t observer = beside.observer_of(i);
            gifts_[observer] += weights[i] * rest[i];
            weight_of_[observer] += weights[i] * weights[i];
            for (std::size_t k = 0; k < along[observer].size(); ++k)
                along[observer][k] += beside.basis()[k][i] * weights[i];
        }
        for (std::size_t observer = 0; observer < n; ++observer) {
            squares_ += gifts_[observer] * gifts_[observer];
            weight_ += weight_of_[observer];
        }
        double most = 0.0;
        for (std::size_t a = 0; a < n; ++a) {
            for (std::size_t b = 0; b < n; ++b) {
                overlap_.push_back(product(along[a], along[b]) / weight_);
                most = std::max(most, std::abs(overlap_.back()));
            }
        }
        if (most < no_length)
            overlap_.clear();
    }

    /// What a contrast with these signs would be, squared, over the sum of squares.
    double size(std::span<const double> signs) const {
        double sum = 0.0, taken = 0.0;
        for (std::size_t a = 0; a < gifts_.size(); ++a) {
            sum += signs[a] * gifts_[a];
            if (overlap_.empty())
                continue;
            const double* row = &overlap_[a * gifts_.size()];
            double of_row = 0.0;
            for (std::size_t b = 0; b < a; ++b)
                of_row += signs[b] * row[b];
            taken += 2.0 * signs[a] * of_row + row[a];
        }
        const double left = 1.0 - taken;
        return left > no_length ? sum * sum / squares_ / left : 0.0;
    }

    bool has_any() const { return squares_ > 0.0; }
    bool is_given_by(std::size_t observer) const { return weight_of_[observer] > no_length * weight_; }

  private:
    std::vector<double> gifts_, weight_of_;
    double squares_ = 0.0, weight_ = 0.0;
    std::vector<double> overlap_; ///< of observers' weights with what is beside; empty: none anywhere
};

std::optional<FactorTest> largest_contrast(const FactorTrials& trials, std::size_t cells,
                                           std::span<const Contrast> contrasts,
                                           const PermutationSettings& settings) {
    if (trials.values.empty())
        return std::nullopt;
    const Beside beside(trials);
    Column rest = trials.values;
    beside.take_off(rest);
    // What rounding leaves of values that are all told already.
    const double length = product(trials.values, trials.values);
    if (!(product(rest, rest) > 1e-24 * length))
        std::ranges::fill(rest, 0.0);
    std::vector<Column> weights_of_cells;
    for (std::size_t cell = 0; cell < cells; ++cell) {
        Column& weights = weights_of_cells.emplace_back();
        for (const std::size_t own : trials.cells)
            weights.push_back(own == cell ? 1.0 : 0.0);
        beside.take_off(weights);
    }
    std::vector<Gifts> all;
    std::vector<bool> takes_part(beside.observers(), false);
    for (const Contrast& contrast : contrasts) {
        Column weights(rest.size(), 0.0);
        for (const auto& [cell, sign] : contrast) {
            for (std::size_t i = 0; i < rest.size(); ++i)
                weights[i] += sign * weights_of_cells[cell][i];
        }
        if (!(product(weights, weights) > no_length))
            continue;
        Gifts gifts(beside, rest, weights);
        for (std::size_t observer = 0; observer < beside.observers(); ++observer)
            takes_part[observer] = takes_part[observer] || gifts.is_given_by(observer);
        if (gifts.has_any())
            all.push_back(std::move(gifts));
    }
    std::vector<std::size_t> flipped;
    for (std::size_t observer = 0; observer < takes_part.size(); ++observer) {
        if (takes_part[observer])
            flipped.push_back(observer);
    }
    if (flipped.size() < 2)
        return std::nullopt;
    const auto largest = [&](std::span<const double> signs) {
        double size = 0.0;
        for (const Gifts& gifts : all)
            size = std::max(size, gifts.size(signs));
        return size;
    };
    std::vector<double> signs(beside.observers(), 1.0);
    const double observed = largest(signs), threshold = observed * all_but_rounding;
    FactorTest found;
    found.observers = static_cast<int>(flipped.size());
    found.statistic = std::sqrt(observed);
    found.test =
        flip_test(flipped.size(), "signs of observers", settings, [&](std::span<const double> of_flipped) {
            for (std::size_t i = 0; i < flipped.size(); ++i)
                signs[flipped[i]] = of_flipped[i];
            return largest(signs) >= threshold;
        });
    found.least_p = found.test.is_exact ? 2.0 / static_cast<double>(found.test.permutations)
                                        : 1.0 / (settings.permutations + 1.0);
    return found;
}

/// Without observers who have one level alone.
void leave_single_levels_out(FactorTrials& trials) {
    std::vector<std::size_t> first;
    std::vector<bool> has_two;
    for (std::size_t i = 0; i < trials.values.size(); ++i) {
        const std::size_t observer = trials.observers[i];
        if (first.size() <= observer) {
            first.resize(observer + 1, std::size_t(-1));
            has_two.resize(observer + 1, false);
        }
        if (first[observer] == std::size_t(-1))
            first[observer] = trials.cells[i];
        has_two[observer] = has_two[observer] || first[observer] != trials.cells[i];
    }
    FactorTrials kept;
    kept.beside.resize(trials.beside.size());
    for (std::size_t i = 0; i < trials.values.size(); ++i) {
        if (!has_two[trials.observers[i]])
            continue;
        kept.values.push_back(trials.values[i]);
        kept.observers.push_back(trials.observers[i]);
        kept.cells.push_back(trials.cells[i]);
        for (std::size_t list = 0; list < trials.beside.size(); ++list)
            kept.beside[list].push_back(trials.beside[list][i]);
    }
    trials = std::move(kept);
}

} // namespace

std::optional<FactorTest> main_effect_test(FactorTrials trials, std::size_t levels,
                                           const PermutationSettings& settings) {
    leave_single_levels_out(trials);
    std::vector<Contrast> contrasts;
    for (std::size_t a = 0; a < levels; ++a) {
        for (std::size_t b = a + 1; b < levels; ++b)
            contrasts.push_back({{a, 1.0}, {b, -1.0}});
    }
    return largest_contrast(trials, levels, contrasts, settings);
}

std::optional<FactorTest> interaction_test(const FactorTrials& trials, std::size_t levels_of_a,
                                           std::size_t levels_of_b, const PermutationSettings& settings) {
    std::vector<Contrast> contrasts;
    const std::size_t tetrads = levels_of_a * (levels_of_a - 1) / 2 * (levels_of_b * (levels_of_b - 1) / 2);
    if (tetrads > most_tetrads) {
        for (std::size_t cell = 0; cell < levels_of_a * levels_of_b; ++cell)
            contrasts.push_back({{cell, 1.0}});
        return largest_contrast(trials, levels_of_a * levels_of_b, contrasts, settings);
    }
    for (std::size_t a = 0; a < levels_of_a; ++a) {
        for (std::size_t other_a = a + 1; other_a < levels_of_a; ++other_a) {
            for (std::size_t b = 0; b < levels_of_b; ++b) {
                for (std::size_t other_b = b + 1; other_b < levels_of_b; ++other_b)
                    contrasts.push_back({{a * levels_of_b + b, 1.0},
                                         {a * levels_of_b + other_b, -1.0},
                                         {other_a * levels_of_b + b, -1.0},
                                         {other_a * levels_of_b + other_b, 1.0}});
            }
        }
    }
    return largest_contrast(trials, levels_of_a * levels_of_b, contrasts, settings);
}

} // namespace overt
