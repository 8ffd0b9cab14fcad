/// The only way from another machine's clock to the session's: a line through readings of both clocks, which
/// also says how far it can be wrong.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "experiment/clock_pair.h"
#include "experiment/session_time.h"

namespace overt {

/// An instant on the session clock that was read off another clock.
struct MappedTime {
    SessionTime time;
    SessionDuration uncertainty; ///< the true instant lies within ± this, see ClockMap
};

/// Maps the time of another clock, a tracker's or a display box's, to session time by weighted linear
/// regression over clock pairs, each weighted by the inverse square of its round trip. Whole nanoseconds
/// throughout: only the small correction to "offset plus elapsed time of the other clock" is computed in
/// floating point, so nothing is lost at large times.
///
/// The uncertainty is a bound and not a standard deviation. A pair says that the other clock was read
/// somewhere between the two readings of the session clock, so its midpoint is off by half the round trip at
/// most; the bound is what these errors amount to if all conspire, plus the tick of the other clock, plus
/// what the worst pair lies off the line beyond its own half round trip (a rate that was not constant).
/// Before the first and after the last pair it takes the rate to stay as it was.
template <class OtherClock> class ClockMapOf {
  public:
    using OtherTime = typename OtherClock::time_point;

    /// How far two clocks' rates can differ at all: 200 parts per million, as between an EyeLink's host and
    /// the stimulus computer. Where the pairs cannot tell the rate more closely than this (one pair, or all
    /// within a few milliseconds), it is taken as 1 and uncertain by this much.
    static constexpr double largest_drift_ppm = 200.0;

    /// At least one pair, in any order, all from one run of the other clock: none from before a reset.
    explicit ClockMapOf(std::span<const ClockPairOf<OtherClock>> pairs);

    MappedTime to_session(OtherTime time) const;

    /// The other clock's time of a session time, to the microsecond below: to_session(to_other(t)) is not
    /// later than t, and less than two microseconds earlier.
    OtherTime to_other(SessionTime time) const;

    /// By how much a second of the session clock exceeds a second of the other, in millionths.
    double drift_ppm() const { return slope_ * 1e6; }

    /// Bound on the error of drift_ppm().
    double drift_uncertainty_ppm() const { return slope_uncertainty_ * 1e6; }

  private:
    void fit_line(std::span<const ClockPairOf<OtherClock>> pairs);
    double nanoseconds_since_reference(OtherTime time) const;

    OtherTime reference_other_;
    SessionTime reference_session_;
    double centre_ns_ = 0.0; ///< weighted mean of the pairs' other times since the reference
    double offset_ns_ = 0.0; ///< correction at the centre
    double slope_ = 0.0;
    double offset_uncertainty_ns_ = 0.0;
    double slope_uncertainty_ = 0.0;
    double worst_excess_ns_ = 0.0;
};

/// By how much the other clock went forward between two readings beyond what two clocks can differ by: half
/// their round trips, largest_drift_ppm of the time between, and a millisecond. Nothing if it may have run on
/// steadily.
std::optional<SessionDuration> clock_jump(const ClockPair& from, const ClockPair& to);

/// A tracker's clock over one sitting. It runs steadily, but may begin anew, when the tracker was lost and
/// connected again, or be set while it runs: each run of it then has a line of its own. A single reading off
/// the line is no run, and counts towards the bound on the error.
class ClockMap {
  public:
    /// At least one pair, in any order, all of one sitting.
    explicit ClockMap(std::span<const ClockPair> pairs);

    /// By the run whose readings are around this time, or at most five minutes off. Where the tracker's clock showed the same time in two
    /// runs, the uncertainty covers both; see at().
    MappedTime to_session(TrackerTime time) const;

    /// See ClockMapOf; by the run that a session time is in.
    TrackerTime to_other(SessionTime time) const;

    /// The map with the run alone that a session time is in, such as the onset of a trial's presentation:
    /// what was sampled in that trial has but one time.
    ClockMap at(SessionTime time) const;

    /// Of the last run, see ClockMapOf.
    double drift_ppm() const { return runs_.back().line.drift_ppm(); }
    double drift_uncertainty_ppm() const { return runs_.back().line.drift_uncertainty_ppm(); }

    std::size_t run_count() const { return runs_.size(); }

  private:
    struct Run {
        ClockMapOf<TrackerClock> line;
        SessionTime first, last; ///< of its readings
    };
    explicit ClockMap(const Run& run) : runs_{run} {}
    const Run& run_at(SessionTime time) const;

    std::vector<Run> runs_; ///< in the order of their times
};

} // namespace overt
