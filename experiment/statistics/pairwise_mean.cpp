#include "experiment/statistics/pairwise_mean.h"

#include <algorithm>

#include "experiment/base/error.h"
#include "experiment/statistics/bootstrap.h"

namespace overt {

PairwiseMean::PairwiseMean(std::size_t observers) : observers_(observers), numbers_(observers * observers) {}

void PairwiseMean::add(std::size_t a, std::size_t b, double value) {
    OVERT_EXPECTS(a != b && a < observers_ && b < observers_);
    Numbers& numbers = numbers_[std::min(a, b) * observers_ + std::max(a, b)];
    numbers.sum += value;
    ++numbers.count;
}

Estimate PairwiseMean::estimate(double confidence, const std::string& reason) const {
    double sum = 0.0;
    int pairs = 0;
    std::vector<double> sum_with(observers_, 0.0);
    std::vector<int> pairs_with(observers_, 0);
    for (std::size_t a = 0; a < observers_; ++a) {
        for (std::size_t b = a + 1; b < observers_; ++b) {
            const Numbers& numbers = numbers_[a * observers_ + b];
            if (numbers.count == 0)
                continue;
            const double value = numbers.sum / numbers.count;
            sum += value;
            ++pairs;
            for (const std::size_t one : {a, b}) {
                sum_with[one] += value;
                ++pairs_with[one];
            }
        }
    }
    if (pairs == 0)
        return Estimate::none(reason);
    const double mean = sum / pairs;
    std::vector<double> without;
    for (std::size_t k = 0; k < observers_; ++k) {
        if (pairs_with[k] > 0 && pairs_with[k] < pairs)
            without.push_back((sum - sum_with[k]) / (pairs - pairs_with[k]));
    }
    return Estimate::of(mean, jackknife_interval(mean, without, confidence));
}

} // namespace overt
