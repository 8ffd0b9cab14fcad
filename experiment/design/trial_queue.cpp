#include "experiment/design/trial_queue.h"

#include <algorithm>

#include "experiment/design/block_plan.h"
#include "experiment/error.h"

namespace overt {

namespace {

/// Index of the entry with this id.
template <class Entry> int index_of(const std::vector<Entry>& entries, const std::string& id) {
    const auto found =
        std::find_if(entries.begin(), entries.end(), [&](const Entry& entry) { return entry.id == id; });
    OVERT_EXPECTS(found != entries.end());
    return static_cast<int>(found - entries.begin());
}

} // namespace

std::string_view name_of(TrialFailure failure) {
    constexpr std::string_view names[] = {"none",     "missed refreshes", "gaze lost",
                                          "rejected", "repeated",         "skipped"};
    return names[static_cast<int>(failure)];
}

TrialQueue::TrialQueue(const Protocol& protocol, const Schedule& schedule) : protocol_(protocol) {
    for (const Trial& trial : schedule.trials)
        waiting_.push_back({trial});
    if (!waiting_.empty())
        begin_block(waiting_.front().trial.block);
}

void TrialQueue::begin_block(int block) {
    const bool is_first = block_ < 0;
    block_ = block;
    const BlockSettings& settings = block_at(protocol_, block);
    if (!settings.instructions.empty())
        before_.push_back({SessionStep::Kind::instructions, {}, 1, block});
    for (std::size_t i = 0; i < protocol_.practice.size(); ++i) {
        const PracticeSettings& practice = protocol_.practice[i];
        if (practice.block.empty() ? !is_first : practice.block != settings.id)
            continue;
        const Trial trial{static_cast<int>(i),
                          index_of(protocol_.tasks, practice.task),
                          {index_of(protocol_.sculptures, practice.sculpture),
                           index_of(protocol_.materials, practice.material)},
                          block};
        before_.push_back({SessionStep::Kind::practice, trial, 1, block});
    }
}

bool TrialQueue::needs_pause(bool is_new_block) const {
    const BreakSettings& breaks = protocol_.breaks;
    return (breaks.every_trials > 0 && attempts_since_pause_ >= breaks.every_trials) ||
           (breaks.between_blocks && is_new_block);
}

std::optional<SessionStep> TrialQueue::next() {
    OVERT_EXPECTS(!running_);
    if (before_.empty() && !waiting_.empty()) {
        const int block = waiting_.front().trial.block;
        if (needs_pause(block != block_)) {
            before_.push_back({SessionStep::Kind::pause, {}, 1, block});
            attempts_since_pause_ = 0;
        }
        if (block != block_)
            begin_block(block);
    }
    if (!before_.empty()) {
        const SessionStep step = before_.front();
        before_.pop_front();
        return step;
    }
    if (waiting_.empty())
        return std::nullopt;
    running_ = waiting_.front();
    waiting_.pop_front();
    ++attempts_since_pause_;
    return SessionStep{SessionStep::Kind::trial, running_->trial, running_->number, running_->trial.block};
}

AttemptVerdict TrialQueue::judge(const AttemptResult& result) const {
    const RepeatSettings& repeat = protocol_.repeat;
    // What the operator says comes before what was measured, and a picture that came late before an eye that
    // looked away from it.
    if (result.is_skipped)
        return {TrialFailure::skipped, RepeatWhen::never, false};
    if (result.is_repeated)
        return {TrialFailure::repeated, RepeatWhen::now, false};
    if (result.is_rejected)
        return {TrialFailure::rejected, repeat.rejected, false};
    if (repeat.missed_refreshes != RepeatWhen::never &&
        result.missed_refreshes > repeat.missed_refreshes_limit)
        return {TrialFailure::missed_refreshes, repeat.missed_refreshes, false};
    if (repeat.gaze_lost != RepeatWhen::never && result.gaze_lost_share > repeat.gaze_lost_limit)
        return {TrialFailure::gaze_lost, repeat.gaze_lost, false};
    return {};
}

AttemptVerdict TrialQueue::tell(const AttemptResult& result) {
    OVERT_EXPECTS(running_);
    AttemptVerdict verdict = judge(result);
    Attempt again{running_->trial, running_->number + 1};
    running_.reset();
    if (verdict.failure == TrialFailure::none)
        return verdict;
    if (again.number > protocol_.repeat.most_attempts && verdict.failure != TrialFailure::repeated)
        verdict.comes_again = RepeatWhen::never;
    switch (verdict.comes_again) {
    case RepeatWhen::never:
        verdict.counts = verdict.failure < TrialFailure::rejected;
        break;
    case RepeatWhen::now:
        waiting_.push_front(again);
        break;
    case RepeatWhen::end_of_block:
        waiting_.insert(
            std::find_if(waiting_.begin(), waiting_.end(),
                         [&](const Attempt& other) { return other.trial.block != again.trial.block; }),
            again);
        break;
    }
    return verdict;
}

std::optional<Condition> TrialQueue::expected() const {
    for (const SessionStep& step : before_) {
        if (step.kind == SessionStep::Kind::practice)
            return step.trial.condition;
    }
    return waiting_.empty() ? std::nullopt : std::optional(waiting_.front().trial.condition);
}

} // namespace overt
