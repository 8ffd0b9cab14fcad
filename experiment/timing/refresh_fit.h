/// When each refresh of a presentation really began: a line through all its time stamps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "experiment/clock_map.h"
#include "experiment/flip_report.h"
#include "experiment/session_time.h"

namespace overt {

/// What is known of one flip's time.
struct StampedRefresh {
    std::int64_t refresh = 0; ///< by the display's count, or only an estimate
    SessionTime stamp;
};

/// An interval between refreshes that is known from elsewhere, as from the other presentations of a sitting.
struct KnownInterval {
    double ns = 0.0;
    double uncertainty_ns = 0.0; ///< one standard deviation
};

/// The line stamp = onset + interval * refresh, robust against stamps that are wrong.
///
/// A display's refreshes are as regular as its quartz: over the seconds of a presentation they lie on a line
/// to within microseconds. Time stamps scatter about it, for the program learns of a refresh when the system
/// lets it. The line averages that out: with n stamps of scatter s it is off by about s / sqrt(n). It is
/// found by Tukey's biweight (iterated, from a resistant line through the medians of thirds; Beaton and Tukey
/// 1974), so that single wrong stamps do not count.
///
/// A delay that all stamps share cannot be seen in them and stays in the onset.
class RefreshFit {
  public:
    /// Stamps in the order of the flips. With `counts_are_known` their refresh numbers are taken as they are;
    /// else they are inferred: the phase of the stamps within the interval does not care how many refreshes
    /// went by, and gives the interval (within 0.3 % of nominal) and the grid that the stamps are counted by.
    /// `known`: weighs in with the interval that the stamps have themselves. At least one stamp.
    RefreshFit(std::span<const StampedRefresh> stamps, double nominal_hz, bool counts_are_known,
               std::optional<KnownInterval> known = std::nullopt);

    /// When a refresh began, counted as refresh_of() counts; ± two standard errors of the line.
    MappedTime begin_of(std::int64_t refresh) const;

    /// The refresh of the i-th stamp: as given, or as inferred, the first being as given in any case.
    std::int64_t refresh_of(std::size_t i) const { return refreshes_[i]; }

    /// The i-th stamp contradicts the line: more than six times the scatter away, and more than 2 us.
    bool is_inconsistent(std::size_t i) const { return inconsistent_[i]; }
    int inconsistent_count() const;

    KnownInterval interval() const { return {interval_ns_, interval_se_ns_}; }

    /// Scatter of the consistent stamps about the line, their standard deviation.
    double jitter_sd_ns() const { return jitter_sd_ns_; }

  private:
    /// Sums over the weighted stamps.
    struct Weighing {
        double scatter_ns = 0.0, weights = 0.0, spread = 0.0;
        double moved_ns = 0.0; ///< by how much the line's ends moved
    };
    void infer_counts(std::span<const StampedRefresh> stamps, double nominal_ns);
    void fit(double nominal_ns, std::optional<KnownInterval> known);
    void begin_line(double start_ns, bool interval_is_known);
    Weighing draw_line(double start_ns, double known_se_ns);
    double since_first(std::size_t i) const;
    double residual_ns(std::size_t i) const;

    SessionTime origin_; ///< the first stamp; all else counts from it
    std::int64_t first_refresh_ = 0;
    std::vector<std::int64_t> refreshes_;
    std::vector<double> since_ns_; ///< of each stamp since the first
    std::vector<bool> inconsistent_;
    double interval_ns_ = 0.0, interval_se_ns_ = 0.0;
    double centre_ = 0.0; ///< weighted mean of the refreshes, since the first
    double at_centre_ns_ = 0.0, at_centre_se_ns_ = 0.0;
    double jitter_sd_ns_ = 0.0;
};

/// The interval of several presentations of one sitting, each weighted by how well it tells; nothing of none.
std::optional<KnownInterval> common_interval(std::span<const RefreshFit> fits);

} // namespace overt
