#include "experiment/power/sequential_design.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiment/base/error.h"
#include "experiment/statistics/distributions.h"

namespace overt {

namespace {

/// How much of alpha has been spent, on both sides together, when a share of the observers has come.
double spent(double share, double alpha, AlphaSpending spending) {
    if (spending == AlphaSpending::pocock)
        return alpha * std::log1p((std::numbers::e - 1.0) * share);
    return 2.0 * (2.0 - 2.0 * normal_probability(normal_quantile(1.0 - 0.25 * alpha) / std::sqrt(share)));
}

/// Beyond so many standard errors nothing is spent that a double would show.
constexpr double farthest_bound = 8.0;

/// Steps between the bounds, an even number: with 400 the bounds are right to 1e-6.
constexpr int steps = 400;

double density(double x) { return std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi); }

/// The sum of observers' normal values, as a share of the time at the last look, that has crossed no bound:
/// its density at places between the bounds, for Simpson's rule.
struct Going {
    std::vector<double> places{0.0}, weights{1.0}; ///< before the first look it is at 0
    double time = 0.0;

    /// The chance to be beyond a bound, of either sign, at a later time.
    double beyond(double bound, double later) const {
        const double sd = std::sqrt(later - time);
        double sum = 0.0;
        for (std::size_t i = 0; i < places.size(); ++i)
            sum += weights[i] * (normal_probability((-bound - places[i]) / sd) +
                                 normal_probability((places[i] - bound) / sd));
        return sum;
    }

    Going within(double bound, double later) const {
        Going next;
        next.time = later;
        next.places.clear();
        next.weights.clear();
        const double sd = std::sqrt(later - time), step = 2.0 * bound / steps;
        for (int i = 0; i <= steps; ++i) {
            const double place = -bound + step * i;
            double sum = 0.0;
            for (std::size_t j = 0; j < places.size(); ++j)
                sum += weights[j] * density((place - places[j]) / sd) / sd;
            const double simpson = i == 0 || i == steps ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
            next.places.push_back(place);
            next.weights.push_back(sum * simpson * step / 3.0);
        }
        return next;
    }
};

} // namespace

std::string_view name_of(AlphaSpending spending) {
    return spending == AlphaSpending::pocock ? "pocock" : "obrien-fleming";
}

std::vector<double> sequential_levels(std::span<const int> observers, double alpha, AlphaSpending spending) {
    OVERT_EXPECTS(!observers.empty() && observers.front() > 0 && alpha > 0.0 && alpha < 1.0);
    std::vector<double> levels;
    Going going;
    double before = 0.0;
    for (const int count : observers) {
        const double time = static_cast<double>(count) / observers.back();
        const double until_now = spent(time, alpha, spending), now = std::max(until_now - before, 0.0);
        before = until_now;
        // In standard errors of the sum at this look.
        double low = 0.0, high = farthest_bound;
        for (int halving = 0; halving < 60; ++halving) {
            const double middle = 0.5 * (low + high);
            (going.beyond(middle * std::sqrt(time), time) > now ? low : high) = middle;
        }
        levels.push_back(2.0 - 2.0 * normal_probability(high));
        going = going.within(high * std::sqrt(time), time);
    }
    return levels;
}

} // namespace overt
