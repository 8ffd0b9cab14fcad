#include "experiment/statistics/swap_test.h"

#include <algorithm>
#include <cmath>

namespace overt {

namespace {

/// As much larger as rounding may make it.
constexpr double swap_rounding = 1e-9;

/// Takes the mean away. What rounding leaves of a constant map is nothing.
void centre(std::vector<double>& map, double mean) {
    double most = 0.0;
    for (double& value : map) {
        value -= mean;
        most = std::max(most, std::abs(value));
    }
    if (most <= 1e-12 * std::abs(mean))
        std::fill(map.begin(), map.end(), 0.0);
}

/// The sums of one surface for one way of swapping. With S the sum and D the difference of both conditions'
/// maps, these are (S + D) / 2 and (S - D) / 2; swaps change the signs in D alone.
class SwappedMaps {
  public:
    SwappedMaps(const PairedMaps& maps, std::size_t observers) {
        const std::vector<PairedMaps::OfObserver>& all = maps.observers();
        while (count_ < all.size() && all[count_].observer < observers)
            ++count_;
        differences_.assign(count_ * count_, 0.0);
        by_sum_.assign(count_, 0.0);
        for (std::size_t i = 0; i < count_; ++i) {
            numbers_.push_back(all[i].observer);
            for (std::size_t j = 0; j <= i; ++j) {
                sum_square_ += (i == j ? 1.0 : 2.0) * all[i].sums[j];
                differences_[i * count_ + j] = differences_[j * count_ + i] = all[i].differences[j];
                by_sum_[j] += all[i].sum_by_differences[j];
                if (i != j)
                    by_sum_[i] += all[i].difference_by_sums[j];
            }
        }
    }

    /// The observer whose conditions bit `i` of the swaps changes is numbers()[i].
    const std::vector<std::size_t>& numbers() const { return numbers_; }

    /// `signs` by observer's number, 1 or -1. Nothing if a map is constant.
    std::optional<double> correlation(std::span<const double> signs) const {
        double square = 0.0, product = 0.0;
        for (std::size_t i = 0; i < count_; ++i) {
            const double sign = signs[numbers_[i]];
            const double* row = &differences_[i * count_];
            double of_row = 0.0;
            for (std::size_t j = 0; j < i; ++j)
                of_row += signs[numbers_[j]] * row[j];
            square += row[i] + 2.0 * sign * of_row;
            product += sign * by_sum_[i];
        }
        const double together = sum_square_ + square;
        const double variances = together * together - 4.0 * product * product;
        if (!(variances > 1e-24 * together * together))
            return std::nullopt;
        return (sum_square_ - square) / std::sqrt(variances);
    }

  private:
    std::size_t count_ = 0;
    std::vector<std::size_t> numbers_;
    double sum_square_ = 0.0;
    std::vector<double> by_sum_, differences_;
};

std::optional<double> mean_correlation(std::span<const SwappedMaps> surfaces, std::span<const double> signs) {
    double sum = 0.0;
    int count = 0;
    for (const SwappedMaps& surface : surfaces) {
        if (const std::optional<double> one = surface.correlation(signs)) {
            sum += *one;
            ++count;
        }
    }
    return count > 0 ? std::optional(sum / count) : std::nullopt;
}

} // namespace

PairedMaps::PairedMaps(std::span<const double> areas) : areas_(areas.begin(), areas.end()) {}

double PairedMaps::product(std::span<const double> a, std::span<const double> b) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < areas_.size(); ++i)
        sum += areas_[i] * a[i] * b[i];
    return sum;
}

void PairedMaps::add(std::size_t observer, std::span<const double> a, std::span<const double> b) {
    OfObserver one;
    one.observer = observer;
    double sum = 0.0, difference = 0.0, area = 0.0;
    for (std::size_t i = 0; i < areas_.size(); ++i) {
        one.sum.push_back(a[i] + b[i]);
        one.difference.push_back(a[i] - b[i]);
        sum += areas_[i] * one.sum.back();
        difference += areas_[i] * one.difference.back();
        area += areas_[i];
    }
    centre(one.sum, sum / area);
    centre(one.difference, difference / area);
    observers_.push_back(std::move(one));
    OfObserver& last = observers_.back();
    for (const OfObserver& other : observers_) {
        last.sums.push_back(product(last.sum, other.sum));
        last.differences.push_back(product(last.difference, other.difference));
        last.sum_by_differences.push_back(product(last.sum, other.difference));
        last.difference_by_sums.push_back(product(last.difference, other.sum));
    }
}

std::optional<SwapTest> swap_test(std::span<const PairedMaps> surfaces, std::size_t observers,
                                  const PermutationSettings& settings) {
    std::vector<SwappedMaps> swapped;
    std::vector<bool> is_there(observers, false);
    for (const PairedMaps& surface : surfaces) {
        swapped.emplace_back(surface, observers);
        for (const std::size_t number : swapped.back().numbers())
            is_there[number] = true;
    }
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < observers; ++i) {
        if (is_there[i])
            numbers.push_back(i);
    }
    if (numbers.size() < 2)
        return std::nullopt;
    std::vector<double> signs(observers, 1.0);
    const std::optional<double> observed = mean_correlation(swapped, signs);
    if (!observed)
        return std::nullopt;
    return SwapTest{*observed, flip_test(numbers.size(), "swapped conditions", settings,
                                         [&](std::span<const double> of_numbers) {
                                             for (std::size_t i = 0; i < numbers.size(); ++i)
                                                 signs[numbers[i]] = of_numbers[i];
                                             const std::optional<double> one =
                                                 mean_correlation(swapped, signs);
                                             return one && *one <= *observed + swap_rounding;
                                         })};
}

} // namespace overt
