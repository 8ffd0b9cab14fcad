#include "experiment/study/fixations/trial_presentation.h"

#include <algorithm>

#include "experiment/record/no_stimulus.h"
#include "experiment/record/read/recorded_validation.h"

namespace overt {

std::vector<RecordedAccuracy> validations_of(const SessionRecord& record) {
    std::vector<RecordedAccuracy> validations;
    record.read_events([&](const RecordedEvent& event) {
        if (const std::optional<ValidationResult> result = validation_of(event))
            validations.push_back({event.at, result->mean_error.value, result->max_error.value});
    });
    return validations;
}

TrialPresentation presentation_of(const SessionHeader& header, const TrialRecord& trial, bool has_ledger,
                                  std::span<const RecordedAccuracy> validations) {
    const TrialOutcome& outcome = trial.outcome;
    const bool has_onset = trial.reached(outcome.presentation_onset);
    TrialPresentation of;
    of.has_stimulus = has_ledger || !knows_no_stimulus(header);
    of.onset = has_onset ? outcome.presentation_onset : trial.started;
    if (has_onset && trial.reached(outcome.presentation_end))
        of.duration_s = to_seconds(outcome.presentation_end - of.onset);
    else if (trial.has_outcome() && outcome.responded_at > of.onset)
        of.duration_s = to_seconds(outcome.responded_at - of.onset);
    else if (of.has_stimulus)
        of.duration_s = header.animation_of(trial.trial.stimulus).duration_s;
    const auto validation = std::find_if(validations.rbegin(), validations.rend(),
                                         [&](const auto& one) { return one.at <= trial.started; });
    if (validation != validations.rend())
        of.validation = *validation;
    return of;
}

} // namespace overt
