/// What the record tells of the steps of a session, in their order.
#include <algorithm>
#include <tuple>

#include "experiment/ports/event_kinds.h"
#include "experiment/record/read/session_record.h"
#include "experiment/record/session_file.h"
#include "experiment/record/sql.h"

namespace overt {
namespace {

AttemptFate fate_of(const TrialRecord& attempt) {
    if (attempt.status == TrialRecord::Status::completed)
        return AttemptFate::counted;
    if (attempt.status != TrialRecord::Status::aborted)
        return AttemptFate::interrupted;
    switch (attempt.outcome.afterwards) {
    case TrialOutcome::Afterwards::never:
        return AttemptFate::skipped;
    case TrialOutcome::Afterwards::now:
        return AttemptFate::comes_again_now;
    case TrialOutcome::Afterwards::end_of_block:
        return AttemptFate::comes_again_at_end;
    case TrialOutcome::Afterwards::undecided:
        break;
    }
    return AttemptFate::interrupted;
}

ResumePolicy policy_called(const std::string& word) {
    for (const auto policy : {ResumePolicy::skip, ResumePolicy::restart_block})
        if (word == name_of(policy))
            return policy;
    return ResumePolicy::redo;
}

struct DatedStep {
    int sitting;
    SessionTime at;
    RecordedStep step;
};

} // namespace

SessionHistory SessionRecord::history() const {
    std::vector<DatedStep> dated;
    for (const auto& [sitting, policy] : resumptions())
        dated.push_back(
            {sitting, SessionTime::min(), {RecordedStep::Kind::resumed, -1, {}, policy_called(policy), {}}});
    for (const TrialRecord& trial : trials_)
        dated.push_back(
            {trial.sitting,
             trial.started,
             {RecordedStep::Kind::trial, trial.trial.index, fate_of(trial), {}, trial.outcome.given}});
    for (const RecordedEvent& event : events()) {
        if (event.kind == practice_answered_event || event.kind == practice_skipped_event)
            dated.push_back({event.sitting, event.at, {RecordedStep::Kind::practice, -1, {}, {}, {}}});
        if (event.kind == break_begins_event)
            dated.push_back({event.sitting, event.at, {RecordedStep::Kind::pause, -1, {}, {}, {}}});
    }
    std::stable_sort(dated.begin(), dated.end(), [](const DatedStep& a, const DatedStep& b) {
        // In virtual time a trial begins at the very instant at which what was before it ended.
        const auto rank = [](const DatedStep& entry) { return entry.step.kind == RecordedStep::Kind::trial; };
        return std::tuple(a.sitting, a.at, rank(a)) < std::tuple(b.sitting, b.at, rank(b));
    });
    SessionHistory history;
    for (const DatedStep& entry : dated)
        history.steps.push_back(entry.step);
    history.counted_trials = static_cast<int>(
        std::count_if(trials_.begin(), trials_.end(), [](const TrialRecord& trial) { return trial.counts; }));
    return history;
}

} // namespace overt
