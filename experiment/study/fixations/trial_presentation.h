/// When a trial's stimulus was presented, and how far off the tracker was then.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "experiment/record/read/session_record.h"

namespace overt {

/// What a session's events say of its trials' accuracy.
struct RecordedAccuracy {
    SessionTime at;
    double mean_deg = 0.0, worst_deg = 0.0;
};

/// A session's validations, in the order of time. Throws RecordError.
std::vector<RecordedAccuracy> validations_of(const SessionRecord& record);

struct TrialPresentation {
    bool has_stimulus = true; ///< the trial has a ledger, or the session knows of stimuli
    SessionTime onset;        ///< the trial's begin where no presentation is recorded
    /// Until the answer, or as planned, where its end is not recorded. Nothing without a stimulus where the
    /// trial has neither end nor answer.
    std::optional<double> duration_s;
    std::optional<RecordedAccuracy> validation; ///< the last before the trial
};

/// `has_ledger`: whether the trial has a TrialLedger. `validations` by their times.
TrialPresentation presentation_of(const SessionHeader& header, const TrialRecord& trial, bool has_ledger,
                                  std::span<const RecordedAccuracy> validations);

} // namespace overt
