/// What a session's ledger says of the presentation's timing, trial by trial and altogether.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "experiment/record/read/session_record.h"

namespace overt {

struct TrialTiming {
    Trial trial;
    int attempt = 1;
    TrialRecord::Status status = TrialRecord::Status::open;
    bool counts = false; ///< as TrialRecord has it
    int planned_refreshes = 0;
    int flipped_refreshes = 0; ///< rows of flips within the plan's time
    int missed_refreshes = 0;  ///< within the plan's time and after it
    int unaccounted = 0;       ///< refreshes of the plan without a row: of a trial cut off, or of lost rows
    std::vector<MissedRun> missed_runs;
    std::vector<int> wrong_stamps;     ///< refreshes whose time stamp contradicts the others
    std::vector<double> intervals_ms;  ///< from flip to flip, by the time stamps as they came
    double longest_gap_ms = 0.0;       ///< of these
    double onset_deviation_ms = 0.0;   ///< of the onset's own time stamp from the line through all
    double onset_uncertainty_ms = 0.0; ///< of the line at the onset, two standard errors
    double stamp_sd_ms = 0.0;          ///< scatter of the consistent stamps about the line
    double interval_ms = 0.0, interval_uncertainty_ms = 0.0; ///< of refreshes; one standard error
    // Gaze samples during the trial.
    int samples = 0;
    int samples_on_frame = 0;              ///< with gaze, taken while a frame was lit on its row
    int samples_off_plan = 0;              ///< that the plan would have put on another frame
    std::vector<std::string> disturbances; ///< the machine slept, the wall clock was set
};

struct TimingReport {
    double nominal_interval_ms = 0.0;
    std::vector<TrialTiming> trials;   ///< attempts with at least one flip
    bool has_simulated_faults = false; ///< of the display
    bool is_virtual = false;           ///< time did not really pass
    bool is_unproven = false;          ///< SessionHeader::is_timing_unproven()
    std::vector<std::string> sources;  ///< where the times come from
    // Over the completed trials.
    int planned_refreshes = 0, flipped_refreshes = 0, missed_refreshes = 0, unaccounted = 0;
    int missed_by_cause[3] = {0, 0, 0}; ///< by MissCause
    double longest_gap_ms = 0.0;
    double onset_jitter_ms = 0.0; ///< root mean square of the onsets' deviations
    double interval_ms = 0.0, interval_uncertainty_ms = 0.0;
    double stamp_sd_ms = 0.0;
    int wrong_stamps = 0;
    int samples = 0, samples_on_frame = 0, samples_off_plan = 0;
};

/// Reads all flips and samples once. Throws RecordError.
TimingReport timing_report(const SessionRecord& record);

/// How many flips came how long after the one before.
struct IntervalBin {
    double from_ms = 0.0, to_ms = 0.0;
    int count = 0;
};
/// Over the trials that count. Bins of an eighth of the nominal interval, the whole multiples in the middle
/// of theirs, from the first to the last that holds any. Longer than `longest` intervals: together in the
/// last.
std::vector<IntervalBin> interval_histogram(const TimingReport& report, int longest = 32);

} // namespace overt
