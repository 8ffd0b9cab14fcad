#include <algorithm>
#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "experiment/statistics/bootstrap.h"
#include "experiment/statistics/distributions.h"
#include "experiment/statistics/point_spread.h"
#include "experiment/statistics/proportion.h"

namespace {

using namespace overt;
using Values = std::vector<double>;

const auto exactly = [](double value) { return Approx(value).margin(1e-13).epsilon(1e-10); };

TEST_CASE("probabilities and quantiles are those of scipy.stats", "[unit]") {
    CHECK(normal_quantile(0.975) == exactly(1.959963984540054));
    CHECK(normal_quantile(1e-9) == exactly(-5.9978070150076865));
    CHECK(normal_quantile(0.01) == exactly(-2.3263478740408408));
    CHECK(normal_probability(-1.7) == exactly(0.04456546275854304));
    CHECK(student_probability(1.3, 11) == exactly(0.8899093686500791));
    CHECK(student_probability(-4.5, 3) == exactly(0.010245206172226701));
    CHECK(student_quantile(0.975, 11) == exactly(2.200985160082949));
    CHECK(student_quantile(0.995, 2) == exactly(9.92484320091807));
    CHECK(student_quantile(0.05, 29) == exactly(-1.6991270265334977));
}

TEST_CASE("Wilson's interval is that of scipy.stats.binomtest", "[unit]") {
    CHECK(wilson_interval(0, 10)->high == exactly(0.27753279986288926));
    CHECK(wilson_interval(0, 10)->low == Approx(0.0).margin(1e-15));
    CHECK(wilson_interval(7, 12)->low == exactly(0.31951131254954973));
    CHECK(wilson_interval(7, 12)->high == exactly(0.8067396863412435));
    CHECK(wilson_interval(30, 30)->low == exactly(0.8864866068260312));
    CHECK(wilson_interval(613, 1000)->low == exactly(0.5824343266729659));
    CHECK_FALSE(wilson_interval(0, 0));
}

TEST_CASE("variances divide by N, and WSS is their sum", "[unit]") {
    std::vector<glm::dvec3> points;
    Values weights;
    for (int i = 0; i < 40; ++i) {
        points.emplace_back(std::sin(i), 3.0 * std::cos(2 * i), 0.1 * i);
        weights.push_back(1.0 + 0.5 * std::sin(2.1 * i));
    }
    // numpy.var(axis = 0), and numpy.average of squares with weights.
    const PointSpread plain = *point_spread(points), weighted = *point_spread(points, weights);
    CHECK(plain.variance.x == Approx(0.49621761));
    CHECK(plain.variance.y == Approx(4.60516685));
    CHECK(plain.variance.z == Approx(1.3325));
    CHECK(weighted.variance.x == Approx(0.44474855));
    CHECK(weighted.variance.y == Approx(4.44028527));
    CHECK(weighted.variance.z == Approx(1.336281));
    double squares = 0.0;
    for (const glm::dvec3& point : points)
        squares += glm::dot(point - plain.mean, point - plain.mean);
    CHECK(plain.wss() == Approx(squares / 40.0));
    CHECK_FALSE(point_spread({}));
    CHECK_FALSE(point_spread(points, Values(40, 0.0)));
}

const Values scores{0.61, 0.42, 0.75, 0.55, 0.93, 0.31, 0.48, 0.66, 0.59, 0.70, 0.22, 0.81};

TEST_CASE("WSS divided by N - 1 has the same mean whatever the number of points, and one has none",
          "[unit]") {
    double few = 0.0, many = 0.0;
    constexpr int draws = 4000;
    for (int draw = 0; draw < draws; ++draw) {
        RandomStream random(4, "points", static_cast<std::uint64_t>(draw));
        std::vector<glm::dvec3> points;
        for (int i = 0; i < 20; ++i)
            points.emplace_back(random.normal(), 2.0 * random.normal(), 3.0 * random.normal());
        many += *unbiased_wss(points) / draws;
        few += *unbiased_wss(std::span(points).first(3)) / draws;
    }
    // 1 + 4 + 9; of three points divided by N it is 9.3.
    CHECK(many == Approx(14.0).margin(0.3));
    CHECK(few == Approx(14.0).margin(0.8));
    CHECK_FALSE(unbiased_wss(std::vector{glm::dvec3(1.0)}));
}

TEST_CASE("the ends of a BCa interval follow from its draws as in scipy.stats.bootstrap", "[unit]") {
    Values draws, jackknife;
    for (int k = 0; k < 999; ++k)
        draws.push_back(0.585 + 0.055 * normal_quantile((k + 0.5) / 999) + 0.01 * std::sin(k));
    double sum = 0.0;
    for (const double value : scores)
        sum += value;
    for (const double value : scores)
        jackknife.push_back((sum - value) / 11.0);
    // numpy, by the formulas of scipy.stats._resampling._bca_interval.
    const Interval interval = bca_interval(draws, sum / 12.0, jackknife, 0.95);
    CHECK(interval.low == exactly(0.47606585385537753));
    CHECK(interval.high == exactly(0.6940001121825387));
}

TEST_CASE("a bootstrap over observers comes to the interval that scipy.stats.bootstrap has", "[unit]") {
    // scipy 1.10, BCa with 200,000 draws at the expanded level 2 Phi(sqrt(n / (n - 1)) t) - 1 of scipy.stats:
    // 0.97849 for twelve has 0.4492 … 0.7092 of these, 0.98290 for ten has 0.977 … 5.034 of skewed ones.
    CHECK(expanded_confidence(0.95, 12) == exactly(0.9784867701663795));
    CHECK(expanded_confidence(0.95, 10) == exactly(0.9828987219483842));
    const BootstrapSettings settings{20000, 0.95, 5};
    const Interval interval = *interval_of_mean(scores, settings);
    CHECK(interval.low == Approx(0.4492).margin(0.004));
    CHECK(interval.high == Approx(0.7092).margin(0.004));
    Values skewed{-1.2, 0.3, 0.9, -0.4, 1.7, 0.1, -0.8, 0.6, 2.1, -0.3};
    for (double& value : skewed)
        value = std::exp(value);
    const Interval of_skewed = *interval_of_mean(skewed, settings);
    CHECK(of_skewed.low == Approx(0.977).margin(0.03));
    CHECK(of_skewed.high == Approx(5.034).margin(0.15));
}

TEST_CASE("a bootstrap repeats with its seed, and has no interval for fewer than three", "[unit]") {
    const BootstrapSettings settings{500, 0.95, 7};
    CHECK(*interval_of_mean(scores, settings) == *interval_of_mean(scores, settings));
    CHECK_FALSE(*interval_of_mean(scores, settings) == *interval_of_mean(scores, {500, 0.95, 8}));
    CHECK_FALSE(interval_of_mean(Values{1.0, 2.0}, settings));
    CHECK(*interval_of_mean(Values(5, 0.4), settings) == Interval{0.4, 0.4});
    const Estimate none = estimated_mean({}, settings, "no fixation");
    CHECK_FALSE(none.value);
    CHECK(none.absent == "no fixation");
}

TEST_CASE("95 % intervals of twelve observers hold the truth about as often", "[unit]") {
    int held = 0;
    for (int study = 0; study < 300; ++study) {
        RandomStream random(11, "coverage", static_cast<std::uint64_t>(study));
        Values values;
        for (int i = 0; i < 12; ++i)
            values.push_back(0.4 + 0.1 * random.normal());
        held += interval_of_mean(values, {400, 0.95, static_cast<std::uint64_t>(study)})->contains(0.4);
    }
    // 272 or fewer of 300 at 95 % come about once in 800 times; without expansion 91 % hold it.
    CHECK(held > 272);
    CHECK(held < 297);
}

TEST_CASE("means of fewer than ten have Student's interval", "[unit]") {
    // scipy.stats.t.
    const Interval interval = *interval_of_mean(std::span(scores).first(5), {});
    CHECK(interval.low == exactly(0.4092554822552741));
    CHECK(interval.high == exactly(0.894744517744726));
}

TEST_CASE("means of numbers in a range have Student's interval on its scale", "[unit]") {
    // m exp(-+ h / m) and the logistic of logit m -+ h / (m (1 - m)), with h = t of 2 degrees times the
    // standard error of three numbers, reckoned in Python.
    const Values few{0.1, 0.2, 0.6};
    const Interval amount = *interval_of_mean(few, {}, from_zero_on);
    CHECK(amount.low == exactly(0.03354805668080856));
    CHECK(amount.high == exactly(2.682718729621237));
    const Interval share = *interval_of_mean(few, {}, zero_to_one);
    CHECK(share.low == Approx(0.018396677554076472).epsilon(1e-8));
    CHECK(share.high == exactly(0.9074106917554914));
    // The same of twice the numbers from 1 on, less 1.
    const Interval above_one = *interval_of_mean(Values{1.2, 1.4, 2.2}, {}, {1.0, from_zero_on.high});
    CHECK(above_one.low == Approx(1.0 + 2.0 * amount.low).epsilon(1e-12));
    CHECK(above_one.high == Approx(1.0 + 2.0 * amount.high).epsilon(1e-12));
    // Student's own would reach from -0.36 to 0.96.
    CHECK(interval_of_mean(few, {})->low < 0.0);
    // Of a mean the jackknife has the usual standard error.
    const auto mean_of_drawn = [&](std::span<const std::uint32_t> drawn) -> std::optional<double> {
        double sum = 0.0;
        for (const std::uint32_t i : drawn)
            sum += few[i];
        return sum / static_cast<double>(drawn.size());
    };
    const Interval of_statistic = *interval_in_range(3, mean_of_drawn, {}, from_zero_on);
    CHECK(of_statistic.low == Approx(amount.low).epsilon(1e-12));
    CHECK(of_statistic.high == Approx(amount.high).epsilon(1e-12));
    CHECK_FALSE(interval_in_range(2, mean_of_drawn, {}, from_zero_on));
    CHECK_FALSE(interval_of_mean(std::span(few).first(2), {}, from_zero_on));
    // At an end there is nothing to scatter; beyond it, it is cut.
    CHECK(*interval_of_mean(Values(4, 0.0), {}, from_zero_on) == Interval{0.0, 0.0});
    CHECK(*interval_of_mean(Values(4, 1.0), {}, zero_to_one) == Interval{1.0, 1.0});
    const Interval beyond = *interval_of_mean(Values{-0.1, -0.2, 0.1}, {}, zero_to_one);
    CHECK(beyond.low == 0.0);
    CHECK(beyond.high > 0.0);
    // Draws of many are cut as well.
    Values many(30, -0.01);
    many.front() = 0.2;
    CHECK(interval_of_mean(many, {200, 0.95, 1}, from_zero_on)->low == 0.0);
}

TEST_CASE("95 % intervals of few observers' skewed numbers hold the truth about as often", "[unit]") {
    constexpr int studies = 1000;
    for (const int observers : {4, 6, 12}) {
        int held = 0, held_by_student = 0;
        for (int study = 0; study < studies; ++study) {
            RandomStream random(12, "coverage in a range", static_cast<std::uint64_t>(study));
            // Exponential: the mean and the standard deviation are 2 s.
            Values values;
            for (int i = 0; i < observers; ++i)
                values.push_back(random.exponential(2.0));
            const auto seed = static_cast<std::uint64_t>(study);
            held += interval_of_mean(values, {100, 0.95, seed}, from_zero_on)->contains(2.0);
            held_by_student += interval_of_mean(values, {100, 0.95, seed})->contains(2.0);
        }
        CAPTURE(observers, held, held_by_student);
        // The standard error of 95 % is 0.7 %.
        CHECK(held > 910);
        CHECK(held < 972);
        CHECK(held > held_by_student);
    }
}

} // namespace
