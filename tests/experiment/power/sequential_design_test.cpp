/// Looks at a growing study: their levels, and what studies come to.
#include "experiment/power/sequential_design.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "experiment/power/power_results.h"
#include "experiment/statistics/distributions.h"

using namespace overt;

namespace {

/// In standard errors.
std::vector<double> bounds_of(const std::vector<int>& observers, AlphaSpending spending) {
    std::vector<double> bounds;
    for (const double level : sequential_levels(observers, 0.05, spending))
        bounds.push_back(normal_quantile(1.0 - 0.5 * level));
    return bounds;
}

} // namespace

TEST_CASE("levels of looks are those of Lan and DeMets", "[unit]") {
    const std::vector<int> five{10, 20, 30, 40, 50};
    // Two-sided bounds at 0.05 of R's ldbounds (Casper and Perez): 0.025 on each side, iuse = 1 and 2.
    const std::vector<double> strict{4.8769, 3.3569, 2.6803, 2.2898, 2.0310},
        even{2.4380, 2.4268, 2.4101, 2.3966, 2.3859};
    const std::vector<double> found = bounds_of(five, AlphaSpending::obrien_fleming),
                              found_even = bounds_of(five, AlphaSpending::pocock);
    for (std::size_t look = 0; look < five.size(); ++look) {
        CAPTURE(look);
        CHECK(found[look] == Approx(strict[look]).margin(2e-3));
        CHECK(found_even[look] == Approx(even[look]).margin(2e-3));
    }
    // A study with a single look has the level for itself.
    CHECK(sequential_levels(std::vector<int>{12}, 0.05, AlphaSpending::pocock).at(0) ==
          Approx(0.05).margin(1e-9));
    CHECK(sequential_levels(std::vector<int>{12}, 0.01, AlphaSpending::obrien_fleming).at(0) ==
          Approx(0.01).margin(1e-9));
}

TEST_CASE("without an effect no more studies end at some look than alpha allows", "[unit]") {
    const std::vector<int> observers{8, 10, 16, 24};
    for (const AlphaSpending spending : {AlphaSpending::obrien_fleming, AlphaSpending::pocock}) {
        const std::vector<double> levels = sequential_levels(observers, 0.05, spending);
        constexpr int studies = 20000;
        int found = 0, found_by_alpha = 0;
        for (int study = 0; study < studies; ++study) {
            RandomStream random(5, "looks", static_cast<std::uint64_t>(study));
            double sum = 0.0;
            int count = 0;
            bool ends = false, ends_by_alpha = false;
            for (std::size_t look = 0; look < observers.size(); ++look) {
                for (; count < observers[look]; ++count)
                    sum += random.normal();
                const double p = 2.0 - 2.0 * normal_probability(std::abs(sum) / std::sqrt(count));
                ends = ends || p <= levels[look];
                ends_by_alpha = ends_by_alpha || p <= 0.05;
            }
            found += ends;
            found_by_alpha += ends_by_alpha;
        }
        // The standard error is 0.15 %.
        CHECK(found / static_cast<double>(studies) == Approx(0.05).margin(0.005));
        CHECK(found_by_alpha / static_cast<double>(studies) > 0.09);
    }
}

TEST_CASE("a study ends at the first look whose level its p keeps to", "[unit]") {
    PowerCurve curve;
    for (const int observers : {10, 20}) {
        curve.points.emplace_back();
        curve.points.back().observers = observers;
    }
    const std::vector<double> levels =
        sequential_levels(std::vector<int>{10, 20}, 0.05, AlphaSpending::pocock);
    // Ends at once; at the second look, since the first's level is below alpha; never; has nothing to test at
    // first.
    curve.points[0].studies = {{levels[0], {}, 0}, {0.049, {}, 0}, {0.5, {}, 0}, {{}, {}, 0}};
    curve.points[1].studies = {{0.9, {}, 0}, {0.01, {}, 0}, {0.049, {}, 0}, {0.001, {}, 0}};
    const SequentialOutcome outcome = with_looks(curve, 0.05, AlphaSpending::pocock);
    CHECK(outcome.levels == levels);
    CHECK(outcome.found == std::vector<int>{1, 3});
    CHECK(outcome.mean_observers == Approx((10 + 20 + 20 + 20) / 4.0));
    CHECK(outcome.interval.contains(0.75));
}
