/// How observers turned objects, by the ledger of what was shown.
#pragma once

#include <optional>
#include <vector>

#include "experiment/record/read/session_record.h"
#include "experiment/timing/input_delays.h"

namespace overt {

/// One show of an object that the observer turned. A flip's pose is taken to be reached by the shorter way
/// from that of the flip before.
struct ObserverTurns {
    int step = 0;           ///< which of the attempt's, from 1; 0: the only one that shows anything
    double seconds = 0.0;   ///< from the first refresh to the last
    Degrees start{}, end{}; ///< of the object, about the vertical
    Degrees start_elevation{}, end_elevation{};
    Degrees net{};          ///< sum of all turns about the vertical, counter-clockwise ones positive
    Degrees path{};         ///< sum of the angles between poses that follow one another
    double turning_s = 0.0; ///< time between refreshes whose poses differ
    int changes = 0;        ///< of the pose
    int reversals = 0;      ///< turns about the vertical against the direction of the one before
    int poses = 0;          ///< that differ
    /// From the latest input of each picture that contains a further one, to the refresh that it was lit at,
    /// without the display's latency. Nothing: no input moved it.
    std::optional<double> median_delay_s = {}, longest_delay_s = {};
};

/// Of all that observers moved in the presentations of trials that count: what they turned, and what they set
/// to match. Nothing where they moved nothing.
std::optional<InputDelays> input_delays(const SessionRecord& record);

/// The delays in flips and what they contain, in the order of refreshes.
std::vector<double> delays_in(std::span<const FlipRecord> flips, std::span<const SteeredFlip> steered);

/// Of a presentation (TrialRecord::seen_in), a row for each of its shows; none where the observer turned
/// nothing.
std::vector<ObserverTurns> observer_turns(const SessionRecord& record, const TrialRecord& seen,
                                          const std::optional<TrialLedger>& ledger);

/// What the observer had moved the slot of a presentation to, by the refreshes as the line through all time
/// stamps counts them.
std::vector<SteeredFlip> steered_as_fitted(const SessionRecord& record, const TrialRecord& seen,
                                           const TrialLedger& ledger);

/// The same of flips and what they contain, in the order of refreshes: pure.
ObserverTurns turns_of(std::span<const FlipRecord> flips, std::span<const SteeredFlip> steered,
                       const PoseTable& poses);

} // namespace overt
