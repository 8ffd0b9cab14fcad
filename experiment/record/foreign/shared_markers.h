/// How the clock of a presenter's log goes with that of the tracker.
#pragma once

#include <string>
#include <vector>

#include "experiment/clock_pair.h"
#include "experiment/record/foreign/logged_trials.h"

namespace overt {

/// The session's clock is the log's, less a zero that lies a second before all.
struct ClockRelation {
    std::vector<ClockPair> pairs; ///< each as wide as times may be off
    LogTime zero{};               ///< the log's time at session time 0
    SessionDuration bound{};      ///< how far a sample's session time may be off
    std::vector<std::string> remarks;

    SessionTime session(LogTime at) const { return SessionTime(at - zero); }
};

/// By the markers that stand in both: the n-th of a text in the log is the n-th of it in the gaze's file,
/// where both have it equally often. A log without markers has the tracker's own clock, or counts from
/// TrialLog::zero. A straight line goes through all markers; the bound is the largest distance of one from
/// it, with half a step of both clocks' times. Throws InputError if markers are named and none is in both, or
/// if without markers the log's times are not within the recording's.
ClockRelation relate_clocks(const TrialLog& log, const GazeSurvey& gaze, const std::string& file);

} // namespace overt
