#include "experiment/design/trial_queue.h"

#include <algorithm>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/design/block_plan.h"
#include "experiment/design/point_trials.h"
#include "experiment/design/recorded_trials.h"

namespace overt {

namespace {

/// Index of the entry with this id.
template <class Entry> int index_of(const std::vector<Entry>& entries, const std::string& id) {
    const auto found = std::ranges::find(entries, id, &Entry::id);
    OVERT_EXPECTS(found != entries.end());
    return static_cast<int>(found - entries.begin());
}

Stimulus practised(const Protocol& protocol, const PracticeSettings& practice) {
    Stimulus stimulus;
    for (std::size_t list = 0; list < stimulus_lists.size(); ++list) {
        const std::vector<std::string_view> ids = ids_in_list(protocol, list);
        if (!practice.entries[list].empty())
            stimulus.*stimulus_lists[list].index =
                static_cast<int>(std::ranges::find(ids, practice.entries[list]) - ids.begin());
    }
    return stimulus;
}

} // namespace

TrialQueue::TrialQueue(const Protocol& protocol, const Schedule& schedule)
    : protocol_(protocol), schedule_(schedule), procedures_(protocol, schedule) {
    for (const Trial& trial : schedule.trials)
        waiting_.push_back({trial});
    if (!waiting_.empty())
        begin_block(waiting_.front().trial.block);
}

void TrialQueue::begin_block(int block) {
    const bool is_first = block_ < 0;
    block_ = block;
    correct_.clear();
    counted_ = 0;
    const BlockSettings& settings = block_at(protocol_, block);
    if (!settings.instructions.empty())
        before_.push_back({SessionStep::Kind::instructions, {}, 1, block});
    for (std::size_t i = 0; i < protocol_.practice.size(); ++i) {
        const PracticeSettings& practice = protocol_.practice[i];
        if (practice.block.empty() ? !is_first : practice.block != settings.id)
            continue;
        Trial trial{static_cast<int>(i), index_of(protocol_.tasks, practice.task),
                    practised(protocol_, practice), block};
        fill_slots(protocol_, trial);
        trial.levels = first_points(protocol_, trial.task);
        // What finds nothing stands.
        (void)yoke(protocol_, schedule_.observer.number, std::span(&trial, 1), true);
        before_.push_back({SessionStep::Kind::practice, trial, 1, block});
    }
}

bool TrialQueue::needs_pause(bool is_new_block) const {
    const BreakSettings& breaks = protocol_.breaks;
    if (breaks.between_blocks && is_new_block)
        return true;
    // One that would come a single trial before the break between blocks waits for that.
    const bool block_ends_next =
        breaks.between_blocks && waiting_.size() > 1 && waiting_[1].trial.block != waiting_[0].trial.block;
    return breaks.every_trials > 0 && attempts_since_pause_ >= breaks.every_trials && !block_ends_next;
}

void TrialQueue::add_feedback() {
    if (block_ >= 0 && !block_at(protocol_, block_).feedback.empty())
        before_.push_back({SessionStep::Kind::feedback, {}, 1, block_});
}

/// Finds what comes before the next trial, or at the end, where that is not done already.
void TrialQueue::look_ahead() {
    if (before_.empty() && waiting_.empty() && !interrupted_ && !is_last_over_) {
        is_last_over_ = true;
        add_feedback();
    }
    if (before_.empty() && !waiting_.empty()) {
        const int block = waiting_.front().trial.block;
        is_last_over_ = false;
        if (block != block_)
            add_feedback();
        if (needs_pause(block != block_)) {
            before_.push_back({SessionStep::Kind::pause, {}, 1, block});
            attempts_since_pause_ = 0;
        }
        if (block != block_)
            begin_block(block);
    }
}

std::optional<SessionStep> TrialQueue::next() {
    OVERT_EXPECTS(!running_);
    look_ahead();
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
    std::optional<ProcedureChoice> choice = procedures_.decide(running_->trial);
    return SessionStep{SessionStep::Kind::trial, running_->trial, running_->number, running_->trial.block,
                       std::move(choice)};
}

AttemptVerdict TrialQueue::judge(const AttemptResult& result) const {
    const RepeatSettings& repeat = protocol_.repeat;
    // What the operator says comes before what was measured, and a picture that came late before an eye that
    // looked away from it.
    if (result.is_skipped)
        return {TrialFailure::skipped, RepeatWhen::never, false};
    if (result.is_repeated)
        return {result.is_tracker_lost ? TrialFailure::tracker_lost : TrialFailure::repeated, RepeatWhen::now,
                false};
    if (result.is_rejected)
        return {TrialFailure::rejected, repeat.rejected, false};
    if (result.is_over())
        return {result.is_tracker_lost    ? TrialFailure::tracker_lost
                : result.has_clock_jumped ? TrialFailure::clock_jumped
                                          : TrialFailure::broken_off,
                repeat.rejected, false};
    if (repeat.missed_refreshes != RepeatWhen::never &&
        result.missed_refreshes > repeat.missed_refreshes_limit)
        return {TrialFailure::missed_refreshes, repeat.missed_refreshes, false};
    if (repeat.gaze_lost != RepeatWhen::never && result.gaze_lost_share > repeat.gaze_lost_limit)
        return {TrialFailure::gaze_lost, repeat.gaze_lost, false};
    if (result.gaze_lost_share > hardly_any_gaze)
        return {TrialFailure::gaze_lost, RepeatWhen::never, true};
    return {};
}

AttemptVerdict TrialQueue::tell(const AttemptResult& result) {
    OVERT_EXPECTS(running_);
    AttemptVerdict verdict = judge(result);
    Attempt again{running_->trial, running_->number + 1};
    running_.reset();
    if (verdict.failure == TrialFailure::none) {
        count(again.trial, result.given);
        return verdict;
    }
    if (again.number > protocol_.repeat.most_attempts && !result.is_repeated)
        verdict.comes_again = RepeatWhen::never;
    if (verdict.comes_again == RepeatWhen::never)
        verdict.counts = verdict.failure < TrialFailure::rejected;
    put_back(again, verdict.comes_again);
    if (verdict.counts && verdict.comes_again == RepeatWhen::never)
        count(again.trial, result.given);
    return verdict;
}

/// Of a trial that counts. Where a procedure has ended, the rest of its trials are left out; where the
/// block's criterion is met, the rest of the block.
void TrialQueue::count(const Trial& trial, const std::vector<GivenAnswer>& given) {
    procedures_.tell(trial, given);
    if (procedures_.has_ended(trial))
        std::erase_if(waiting_, [&](const Attempt& other) {
            const bool is_left_out = procedures_.is_same_condition(trial, other.trial);
            if (is_left_out)
                left_out_.push_back(other.trial.index);
            return is_left_out;
        });
    const CriterionSettings& criterion = block_at(protocol_, trial.block).criterion;
    if (!criterion.is_written())
        return;
    ++counted_;
    if (std::ranges::any_of(given, [](const GivenAnswer& answer) { return !answer.correct.empty(); }))
        correct_.push_back(correctness_of(given).value_or(false));
    const auto last = static_cast<std::size_t>(criterion.last());
    if (counted_ < criterion.at_least || correct_.size() < last ||
        std::count(correct_.end() - static_cast<std::ptrdiff_t>(last), correct_.end(), true) <
            criterion.correct)
        return;
    while (!waiting_.empty() && waiting_.front().trial.block == trial.block) {
        left_out_.push_back(waiting_.front().trial.index);
        waiting_.pop_front();
    }
}

void TrialQueue::put_back(const Attempt& attempt, RepeatWhen when) {
    const auto is_of_another_block = [&](const Attempt& other) {
        return other.trial.block != attempt.trial.block;
    };
    if (when == RepeatWhen::now)
        waiting_.push_front(attempt);
    else if (when == RepeatWhen::end_of_block)
        waiting_.insert(std::find_if(waiting_.begin(), waiting_.end(), is_of_another_block), attempt);
}

void TrialQueue::go_through(std::span<const RecordedStep> steps) {
    for (const RecordedStep& step : steps) {
        switch (step.kind) {
        case RecordedStep::Kind::practice:
            leave_out_to_practice();
            break;
        case RecordedStep::Kind::pause:
            look_ahead();
            if (const auto pause = std::ranges::find(before_, SessionStep::Kind::pause, &SessionStep::kind);
                pause != before_.end())
                before_.erase(before_.begin(), pause + 1);
            break;
        case RecordedStep::Kind::trial:
            go_on_to_trial(step.trial);
            take_fate(step.fate, step.given);
            break;
        case RecordedStep::Kind::resumed:
            resume(step.policy);
            break;
        }
    }
}

void TrialQueue::leave_out_to_practice() {
    look_ahead();
    const auto practice = std::ranges::find(before_, SessionStep::Kind::practice, &SessionStep::kind);
    if (practice == before_.end())
        throw RecordError("the record tells of practice where its protocol has none: it cannot be gone on "
                          "with");
    before_.erase(before_.begin(), practice + 1);
}

/// What comes before it was read and done.
void TrialQueue::go_on_to_trial(int trial) {
    std::optional<SessionStep> step;
    do
        step = next();
    while (step && step->kind != SessionStep::Kind::trial);
    if (!step || step->trial.index != trial)
        throw RecordError(fmt::format("the record has an attempt at trial {} where its order has another "
                                      "one: it cannot be gone on with",
                                      trial + 1));
}

void TrialQueue::take_fate(AttemptFate fate, const std::vector<GivenAnswer>& given) {
    const Attempt attempt = *running_;
    running_.reset();
    const Attempt again{attempt.trial, attempt.number + 1};
    switch (fate) {
    case AttemptFate::counted:
        count(attempt.trial, given);
        break;
    case AttemptFate::skipped:
        break;
    case AttemptFate::comes_again_now:
        put_back(again, RepeatWhen::now);
        break;
    case AttemptFate::comes_again_at_end:
        put_back(again, RepeatWhen::end_of_block);
        break;
    case AttemptFate::interrupted:
        interrupted_ = attempt;
        break;
    }
}

ResumeEffect TrialQueue::resume(ResumePolicy policy) {
    OVERT_EXPECTS(!running_);
    ResumeEffect effect;
    if (policy == ResumePolicy::restart_block) {
        const bool is_running = interrupted_ || (!waiting_.empty() && waiting_.front().trial.block == block_);
        if (is_running)
            effect.restarted_block = block_;
    }
    if (interrupted_ && policy == ResumePolicy::redo) {
        waiting_.push_front(*interrupted_);
        --attempts_since_pause_;
    }
    if (interrupted_ && policy == ResumePolicy::skip)
        effect.skipped = interrupted_->trial.index;
    interrupted_.reset();
    if (effect.restarted_block)
        restart_block();
    return effect;
}

void TrialQueue::restart_block() {
    std::erase_if(waiting_, [&](const Attempt& attempt) { return attempt.trial.block == block_; });
    std::for_each(schedule_.trials.rbegin(), schedule_.trials.rend(), [&](const Trial& trial) {
        if (trial.block == block_)
            waiting_.push_front({trial});
    });
    procedures_.restart(block_);
    // Practice that is not done yet still comes.
    std::erase_if(before_, [](const SessionStep& step) { return step.kind != SessionStep::Kind::practice; });
    if (const BlockSettings& settings = block_at(protocol_, block_); !settings.instructions.empty())
        before_.push_front({SessionStep::Kind::instructions, {}, 1, block_});
    attempts_since_pause_ = 0;
    correct_.clear();
    counted_ = 0;
}

std::optional<Trial> TrialQueue::expected() const {
    for (const SessionStep& step : before_) {
        if (step.kind == SessionStep::Kind::practice)
            return step.trial;
    }
    if (waiting_.empty())
        return std::nullopt;
    Trial trial = waiting_.front().trial;
    (void)procedures_.decide(trial);
    return trial;
}

} // namespace overt
