#include <algorithm>

#include <fmt/format.h>

#include "experiment/clock_map.h"
#include "experiment/ports/event_kinds.h"
#include "experiment/record/foreign/foreign_session.h"
#include "experiment/record/read/import_source.h"
#include "experiment/record/write/row_writer.h"

namespace overt {
namespace {

TrialOutcome outcome_of(const ForeignTrial& trial, const AskedAnswer& asked) {
    TrialOutcome outcome;
    outcome.afterwards = TrialOutcome::Afterwards::never;
    // Screens that nobody logged have the time 0, before the trial: it did not get to them.
    outcome.presentation_onset = trial.onset;
    outcome.presentation_end = trial.end;
    outcome.shown_refreshes = static_cast<int>(trial.flips.size());
    if (trial.responded)
        outcome.responded_at = *trial.responded;
    const LoggedTrial& logged = trial.logged;
    if (asked.id.empty()) {
        outcome.answer = logged.answer;
        if (trial.responded) // its response time counts from there
            outcome.response_screen_onset = trial.onset;
        return outcome;
    }
    GivenAnswer given;
    given.id = asked.id;
    given.kind = asked.kind;
    given.is_missed = logged.answer.empty();
    given.value = logged.answer;
    given.number = number_in_cell(logged.answer);
    given.correct = logged.correct;
    if (!given.is_missed && !given.correct.empty())
        given.is_correct = given.value == given.correct;
    given.zero = AnswerZero::stimulus;
    given.stimulus_onset = trial.onset;
    given.answered_at = given.first_input_at = given.is_missed ? std::nullopt : trial.responded;
    outcome.given.push_back(std::move(given));
    return outcome;
}

/// Writes trials one after the other, each with the samples that come in its time.
class TrialRows {
  public:
    TrialRows(RowWriter& writer, const ForeignPlan& plan, const std::vector<AskedAnswer>& asked)
        : writer_(writer), plan_(plan), asked_(asked) {}

    /// Gives whether the time is within a trial.
    bool go_to(SessionTime at) {
        while (next_ < plan_.trials.size() && at >= plan_.trials[next_].from) {
            if (!is_open_)
                begin();
            if (at < plan_.trials[next_].until)
                return true;
            finish();
        }
        return false;
    }
    int trial() const { return plan_.trials[next_].trial.index; }
    void end() {
        for (; next_ < plan_.trials.size();) {
            if (!is_open_)
                begin();
            finish();
        }
    }

  private:
    void begin() {
        const ForeignTrial& trial = plan_.trials[next_];
        writer_.write(TrialStart{trial.trial, trial.from});
        for (const FlipRecord& flip : trial.flips)
            writer_.write(flip);
        for (const SlotFlip& flip : trial.slot_flips)
            writer_.write(flip);
        is_open_ = true;
    }
    void finish() {
        const ForeignTrial& trial = plan_.trials[next_];
        const auto task = static_cast<std::size_t>(trial.trial.task);
        writer_.write(
            TrialFinish{trial.trial, outcome_of(trial, task < asked_.size() ? asked_[task] : AskedAnswer())});
        is_open_ = false;
        ++next_;
    }

    RowWriter& writer_;
    const ForeignPlan& plan_;
    const std::vector<AskedAnswer>& asked_;
    std::size_t next_ = 0;
    bool is_open_ = false;
};

} // namespace

ForeignCounts write_foreign_rows(const std::filesystem::path& session_file, const Sitting& sitting,
                                 const ForeignPlan& plan, const ForeignGaze& gaze,
                                 const std::vector<AskedAnswer>& asked, const std::string& source_text) {
    RowWriter writer(session_file, sitting);
    writer.write(EventRow{SessionTime(), -1, std::string(gaze_imported_event), source_text});
    for (const std::string& remark : plan.remarks)
        writer.write(EventRow{SessionTime(), -1, std::string(gaze_imported_event), remark});
    for (const ClockPair& pair : plan.clocks.pairs)
        writer.write(pair);
    const ClockMap clock_map(plan.clocks.pairs);
    for (const ToldValidation& told : plan.validations) {
        // Of before the session's begin: at its begin.
        const SessionTime at = std::max(SessionTime(), clock_map.to_session(told.at).time);
        writer.write(EventRow{at, -1, std::string(validation_event),
                              fmt::format("mean error {:.3f} deg, largest {:.3f} deg",
                                          told.found.mean_error.value, told.found.max_error.value)});
        writer.write(RecordedCalibration{at, -1, "tracker", told.found});
    }
    ForeignCounts counts;
    TrialRows trials(writer, plan, asked);
    gaze.read([&](const ForeignItem& item) {
        const SessionTime at = clock_map.to_session(item.at).time;
        const bool is_within = trials.go_to(at);
        if (!item.sample) {
            if (!item.mark.is_trial)
                writer.write(
                    EventRow{at, is_within ? trials.trial() : -1, "mark in the recording", item.mark.text});
            return;
        }
        ++(is_within ? counts.samples : counts.outside);
        if (is_within)
            writer.write(SampleRow{trials.trial(), *item.sample});
    });
    trials.end();
    writer.close();
    return counts;
}

} // namespace overt
