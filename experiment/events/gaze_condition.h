/// Waits for gaze to stay somewhere: sample by sample, while a trial runs or when it is read.
#pragma once

#include <optional>

#include "experiment/session_time.h"

namespace overt {

/// A sample of one eye, as a condition sees it.
struct WatchedSample {
    TrackerTime at;
    bool has_gaze = false;  ///< false: the eye was lost, as in a blink
    bool is_inside = false; ///< gaze is where it is waited for
};

/// Comes true once gaze has been inside for a time in one piece. Time counts between neighbouring samples
/// that are both inside. Gaze that is lost, or samples that are lacking, for no longer than `longest_blink`
/// neither count nor break the piece; a single sample outside breaks it. Depends on nothing but the samples,
/// so that it says of a record what it said live. Allocates and throws nothing.
class GazeCondition {
  public:
    struct Settings {
        TrackerClock::duration piece{};         ///< for so long; 0: a single sample inside is enough
        TrackerClock::duration longest_blink{}; ///< 0: the first lost sample breaks the piece
        TrackerClock::duration interval{};      ///< from sample to sample, nominal
    };
    explicit GazeCondition(const Settings& settings) : settings_(settings) {}

    /// Samples of one eye in their order. True from the sample on at which it comes true.
    bool take(const WatchedSample& sample) noexcept;

    bool is_true() const noexcept { return detected_.has_value(); }
    /// The first sample of the piece, and the sample by which it was long enough; nothing before that.
    std::optional<TrackerTime> onset() const noexcept { return is_true() ? begin_ : std::nullopt; }
    std::optional<TrackerTime> detected() const noexcept { return detected_; }

  private:
    Settings settings_;
    std::optional<TrackerTime> begin_; ///< of the piece under way
    std::optional<TrackerTime> detected_;
    TrackerTime last_inside_;          ///< of that piece
    TrackerClock::duration counted_{}; ///< of it
};

} // namespace overt
