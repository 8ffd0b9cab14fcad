#include "experiment/timing/refresh_fit.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "experiment/base/error.h"
#include "experiment/timing/refresh_count.h"

namespace overt {

namespace {

/// Turns a robust distance into a standard deviation for normal scatter: 1 / 0.6745.
constexpr double sd_of_median_distance = 1.4826;

/// Tukey's constant: 95 % efficiency for normal scatter.
constexpr double biweight_reach = 4.685;

/// Stamps are whole nanoseconds: no scatter is smaller than their rounding.
constexpr double smallest_scatter_ns = 0.5;

constexpr double inconsistent_scatters = 6.0;
constexpr double inconsistent_least_ns = 2000.0;

/// Over a presentation the rates of two quartzes stay the same to better than this.
constexpr double rate_stability = 1e-6;

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Sum of the stamps as turns of a clock hand that goes round once in `interval_ns`: its length says how well
/// they agree about a phase, its angle which.
std::complex<double> phase_sum(const std::vector<double>& since_ns, double interval_ns) {
    std::complex<double> sum{0.0, 0.0};
    for (const double time : since_ns) {
        const double turns = time / interval_ns;
        sum += std::polar(1.0, 2.0 * std::numbers::pi * (turns - std::floor(turns)));
    }
    return sum;
}

/// The interval within ± largest_deviation of nominal about whose phase the stamps agree best.
double interval_by_phase(const std::vector<double>& since_ns, double nominal_ns) {
    // The agreement is a peak of about interval / span; a third of it is a step that cannot miss it.
    const double span = std::max(since_ns.back() - since_ns.front(), nominal_ns) / nominal_ns;
    double step = 1.0 / (3.0 * span), best = 1.0, agreement = std::norm(phase_sum(since_ns, nominal_ns));
    const auto look = [&](double share) {
        const double here = std::norm(phase_sum(since_ns, share * nominal_ns));
        if (here > agreement) {
            agreement = here;
            best = share;
        }
    };
    const int steps = static_cast<int>(2.0 * largest_deviation / step);
    for (int i = 0; i <= steps; ++i)
        look(1.0 - largest_deviation + i * step);
    for (int halving = 0; halving < 8; ++halving) {
        step *= 0.5;
        const double middle = best;
        look(middle - step);
        look(middle + step);
    }
    return best * nominal_ns;
}

/// Marks a longest subsequence that never falls.
std::vector<bool> longest_rise(const std::vector<std::int64_t>& values) {
    std::vector<std::size_t> tails, before(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto at =
            std::upper_bound(tails.begin(), tails.end(), values[i],
                             [&](std::int64_t value, std::size_t j) { return value < values[j]; });
        before[i] = at == tails.begin() ? values.size() : *std::prev(at);
        if (at == tails.end())
            tails.push_back(i);
        else
            *at = i;
    }
    std::vector<bool> chosen(values.size());
    for (std::size_t i = tails.back(); i < values.size(); i = before[i])
        chosen[i] = true;
    return chosen;
}

} // namespace

RefreshFit::RefreshFit(std::span<const StampedRefresh> stamps, double nominal_hz, bool counts_are_known,
                       std::optional<KnownInterval> known) {
    OVERT_EXPECTS(!stamps.empty() && nominal_hz > 0.0);
    origin_ = stamps.front().stamp;
    first_refresh_ = stamps.front().refresh;
    refreshes_.reserve(stamps.size());
    since_ns_.reserve(stamps.size());
    for (const StampedRefresh& stamp : stamps) {
        refreshes_.push_back(stamp.refresh);
        since_ns_.push_back(static_cast<double>((stamp.stamp - origin_).count()));
    }
    inconsistent_.resize(stamps.size());
    if (!counts_are_known && stamps.size() > 1)
        infer_counts(stamps, 1e9 / nominal_hz);
    fit(1e9 / nominal_hz, known);
}

void RefreshFit::infer_counts(std::span<const StampedRefresh> stamps, double nominal_ns) {
    const double interval_ns = interval_by_phase(since_ns_, nominal_ns);
    const double phase = std::arg(phase_sum(since_ns_, interval_ns)) / (2.0 * std::numbers::pi);
    // Each flip is at least one refresh after the one before: what lies above that never falls. Stamps off by
    // more than half an interval would make it fall, and are passed over.
    std::vector<std::int64_t> above(stamps.size());
    for (std::size_t i = 0; i < stamps.size(); ++i)
        above[i] = std::llround(since_ns_[i] / interval_ns - phase) - static_cast<std::int64_t>(i);
    const std::vector<bool> agrees = longest_rise(above);
    std::int64_t least = *std::min_element(above.begin(), above.end());
    for (std::size_t i = 0; i < stamps.size(); ++i) {
        if (agrees[i]) {
            least = above[i];
            continue;
        }
        const auto next = std::find(agrees.begin() + static_cast<std::ptrdiff_t>(i), agrees.end(), true);
        const std::int64_t most = next == agrees.end()
                                      ? std::max(least, above[i])
                                      : above[static_cast<std::size_t>(next - agrees.begin())];
        above[i] = std::clamp(above[i], std::min(least, most), most);
        least = above[i];
    }
    for (std::size_t i = 0; i < stamps.size(); ++i)
        refreshes_[i] = first_refresh_ + above[i] - above[0] + static_cast<std::int64_t>(i);
}

double RefreshFit::residual_ns(std::size_t i) const {
    const auto refresh = static_cast<double>(refreshes_[i] - first_refresh_);
    return since_ns_[i] - (at_centre_ns_ + (refresh - centre_) * interval_ns_);
}

double RefreshFit::since_first(std::size_t i) const {
    return static_cast<double>(refreshes_[i] - first_refresh_);
}

/// A line that a third of the stamps, however wrong, cannot move.
void RefreshFit::begin_line(double start_ns, bool interval_is_known) {
    const std::size_t n = refreshes_.size();
    interval_ns_ = start_ns;
    centre_ = at_centre_ns_ = 0.0;
    std::vector<double> off(n), counts(n);
    for (std::size_t i = 0; i < n; ++i) {
        off[i] = residual_ns(i);
        counts[i] = since_first(i);
    }
    if (n >= 3 && !interval_is_known) {
        const auto third = static_cast<std::ptrdiff_t>(n / 3);
        const auto rise = [third](const std::vector<double>& values) {
            return median({values.end() - third, values.end()}) -
                   median({values.begin(), values.begin() + third});
        };
        if (const double run = rise(counts); run > 0.0)
            interval_ns_ += rise(off) / run;
        for (std::size_t i = 0; i < n; ++i)
            off[i] = residual_ns(i);
    }
    at_centre_ns_ = median(off);
}

/// Weighs each stamp by its distance from the line, and draws the line anew. `known_se_ns`: standard error of
/// `start_ns` as an interval known from elsewhere; 0: it is not known.
RefreshFit::Weighing RefreshFit::draw_line(double start_ns, double known_se_ns) {
    const std::size_t n = refreshes_.size();
    std::vector<double> distance(n), weight(n);
    for (std::size_t i = 0; i < n; ++i)
        distance[i] = std::abs(residual_ns(i));
    Weighing sums;
    sums.scatter_ns = std::max(sd_of_median_distance * median(distance), smallest_scatter_ns);
    double mean_refresh = 0.0, mean_ns = 0.0, together = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        const double u = distance[i] / (biweight_reach * sums.scatter_ns);
        weight[i] = u < 1.0 ? (1.0 - u * u) * (1.0 - u * u) : 0.0;
        sums.weights += weight[i];
        mean_refresh += weight[i] * since_first(i);
        mean_ns += weight[i] * since_ns_[i];
    }
    mean_refresh /= sums.weights;
    mean_ns /= sums.weights;
    for (std::size_t i = 0; i < n; ++i) {
        const double aside = since_first(i) - mean_refresh;
        sums.spread += weight[i] * aside * aside;
        together += weight[i] * aside * (since_ns_[i] - mean_ns - start_ns * aside);
    }
    // An interval known from elsewhere counts as so many stamps more about the slope, none about the phase.
    if (known_se_ns > 0.0)
        sums.spread += sums.scatter_ns * sums.scatter_ns / (known_se_ns * known_se_ns);
    const double interval_ns = start_ns + (sums.spread > 0.0 ? together / sums.spread : 0.0);
    sums.moved_ns = std::abs(interval_ns - interval_ns_) * static_cast<double>(n);
    interval_ns_ = interval_ns;
    centre_ = mean_refresh;
    at_centre_ns_ = mean_ns;
    return sums;
}

void RefreshFit::fit(double nominal_ns, std::optional<KnownInterval> known) {
    const double start_ns = known ? known->ns : nominal_ns;
    const double known_se_ns = known ? std::hypot(known->uncertainty_ns, rate_stability * known->ns) : 0.0;
    begin_line(start_ns, known.has_value());
    Weighing sums = draw_line(start_ns, known_se_ns);
    for (int again = 0; again < 10 && (again < 2 || sums.moved_ns > 1e-3 * sums.scatter_ns); ++again)
        sums = draw_line(start_ns, known_se_ns);

    // What the line is worth.
    double squares = 0.0;
    int consistent = 0;
    const double too_far_ns = std::max(inconsistent_scatters * sums.scatter_ns, inconsistent_least_ns);
    for (std::size_t i = 0; i < refreshes_.size(); ++i) {
        const double away_ns = std::abs(residual_ns(i));
        inconsistent_[i] = away_ns > too_far_ns;
        if (inconsistent_[i])
            continue;
        squares += away_ns * away_ns;
        ++consistent;
    }
    jitter_sd_ns_ = consistent > 2 ? std::sqrt(squares / (consistent - 2)) : 0.0;
    at_centre_se_ns_ = jitter_sd_ns_ / std::sqrt(std::max(sums.weights, 1.0));
    interval_se_ns_ = sums.spread > 0.0 && refreshes_.size() > 2
                          ? std::max(jitter_sd_ns_, smallest_scatter_ns) / std::sqrt(sums.spread)
                          : largest_deviation * nominal_ns;
}

MappedTime RefreshFit::begin_of(std::int64_t refresh) const {
    const double aside = static_cast<double>(refresh - first_refresh_) - centre_;
    const double at_ns = at_centre_ns_ + aside * interval_ns_;
    const double error_ns = 2.0 * std::hypot(at_centre_se_ns_, aside * interval_se_ns_);
    return {origin_ + SessionDuration(std::llround(at_ns)), SessionDuration(std::llround(error_ns))};
}

int RefreshFit::inconsistent_count() const {
    return static_cast<int>(std::count(inconsistent_.begin(), inconsistent_.end(), true));
}

std::optional<KnownInterval> common_interval(std::span<const RefreshFit> fits) {
    double weights = 0.0, sum = 0.0;
    for (const RefreshFit& fit : fits) {
        const KnownInterval one = fit.interval();
        const double weight = 1.0 / (one.uncertainty_ns * one.uncertainty_ns);
        weights += weight;
        sum += weight * one.ns;
    }
    if (weights <= 0.0)
        return std::nullopt;
    return KnownInterval{sum / weights, std::sqrt(1.0 / weights)};
}

} // namespace overt
