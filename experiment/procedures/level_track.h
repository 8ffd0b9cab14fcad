/// What chooses the level of the next trial from the answers so far: a staircase, QUEST, QUEST+, constant
/// stimuli. A track is one run of such a procedure. It is pure: its state is what follows from its settings
/// and the answers that it was told, so that a session that is resumed or replayed has the same levels.
#pragma once

#include <cstdint>
#include <optional>

#include "experiment/base/enum_names.h"

namespace overt {

/// What an answer says to a procedure. `yes`: it is correct, or it is the choice that the procedure counts.
enum class TrackAnswer : std::uint8_t { no, yes, missed };
template <> inline constexpr auto names_of<TrackAnswer> = enum_names<TrackAnswer>("no", "yes", "missed");

/// What is made of a trial without an answer.
enum class UnansweredTrial : std::uint8_t {
    repeat, ///< the level comes again, and the trial does not count
    ignore, ///< the trial counts as one of the track's, and says nothing
    wrong   ///< as `no`
};
template <>
inline constexpr auto names_of<UnansweredTrial> = enum_names<UnansweredTrial>("repeat", "ignore", "wrong");

/// Where a track stands, for the record and for people. Levels are in the procedure's own unit.
struct TrackState {
    int trials = 0;                          ///< that counted
    std::optional<int> reversals = {};       ///< of a staircase
    bool was_clipped = false;                ///< the last change of a staircase was cut short by a limit
    bool has_reversed = false;               ///< the last answer turned a staircase round
    std::optional<double> estimate = {};     ///< of the threshold: mean of reversals, or of the posterior
    std::optional<double> spread = {};       ///< standard deviation of the posterior
    std::optional<double> entropy_bits = {}; ///< of the posterior over all parameters
    friend bool operator==(const TrackState&, const TrackState&) = default;
};

/// One run of a procedure. From one thread at a time.
class LevelTrack {
  public:
    virtual ~LevelTrack() = default;

    /// The level of the next trial; nothing when the track has ended.
    virtual std::optional<double> next() const = 0;

    /// The answer of a trial, and the level that was shown in it: next(), or the stimulus nearest to it. Does
    /// nothing when the track has ended.
    virtual void tell(double shown, TrackAnswer answer) = 0;

    virtual TrackState state() const = 0;
};

} // namespace overt
