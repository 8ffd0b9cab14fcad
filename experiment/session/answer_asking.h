/// Answers of a trial that keys, the mouse or boxes give: asked on a screen of their own, or waited for
/// while the stimulus is shown.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "experiment/answers/answer_sheet.h"
#include "experiment/design/answer_forms.h"
#include "experiment/design/trial_plan.h"
#include "experiment/session/object_turning.h"
#include "experiment/session/operator_control.h"
#include "experiment/session/shown_probes.h"

namespace overt {

class AnswerAsking {
  public:
    /// All must outlive this. Of the schedule: who observes, the seed, and the order of its trials.
    AnswerAsking(SessionState& state, OperatorControl& control, const Schedule& schedule,
                 const ShownProbes& probes);

    /// Forgets the trial before. All must outlive the trial. `turning`: objects that inputs turn before they
    /// answer anything.
    void begin_trial(const Trial& trial, const TrialPlan& plan, ObjectTurning& turning, bool is_practice);
    /// Something is asked by inputs.
    bool asks() const noexcept { return !sheets_.empty(); }

    /// A step during which gaze is recorded begins; inputs are told from `since` on. Not in one that another
    /// key ends: `goes_elsewhere`.
    void begin_watched_step(std::size_t number, SessionTime since, bool goes_elsewhere);
    /// A screen stands from `since` on that asks nothing. After the last answer what is pressed then is late,
    /// and is told as that.
    void begin_standing_step(std::size_t number, SessionTime since);
    /// Keys were waited for otherwise in between.
    void interrupted() noexcept { is_awaiting_ = false; }
    /// Takes what the observer did. Allocates and throws nothing, as all that follow.
    void look() noexcept;
    /// The stimulus of this step of the plan is on the screen.
    void stimulus_lit(std::size_t number, SessionTime onset) noexcept;
    /// Nothing of it is any more.
    void stimulus_gone(SessionTime offset) noexcept;
    /// What a match sets this place of the trial to; nothing: none does.
    std::optional<AnswerSheet::SetLevel> level_of(int place) const noexcept;
    /// The gauge that is set while this step shows its stimulus; null: none is.
    const Answering* gauge(std::size_t number) const noexcept {
        return is_awaiting_ && sheet_at(number) == current_ && plan_->steps[number].ends_by_answer() &&
                       current_
                   ? current_->gauge()
                   : nullptr;
    }
    /// The answers that this step waits for were given since it began.
    bool has_ended(std::size_t number) const noexcept;
    /// They had been given before it began: a screen that only waits for them is passed over.
    bool is_needless(std::size_t number) const noexcept;

    /// Shows the screen of a step `answer` until all is answered or time is up, `limit_s` or the protocol's.
    /// `next`: whose frames are loaded meanwhile. Gives how it ended.
    OperatorControl::Press ask(std::size_t number, const std::optional<Trial>& next, SessionTime& onset);

    /// At the attempt's end: what was answered, and all inputs. Given before the operator ended it, too.
    void finish(TrialOutcome& outcome);

    /// Of the answers so far: all asked were given.
    bool is_answered() const noexcept;
    /// Whether they were correct; nothing where nobody knows.
    std::optional<bool> is_correct() const;

  private:
    AnswerSheet& sheet_of(std::size_t number) noexcept;
    const AnswerSheet* sheet_at(std::size_t number) const noexcept;
    void go_to(AnswerSheet& sheet);
    void tell_opening() noexcept;
    Screen screen() const;
    void note_answer() noexcept;
    void put_beside(std::size_t number);
    void offer_turning(std::size_t number, SessionTime since);
    void take_away();
    void offer();
    void find_slot_targets(const PlannedStep& step);
    AnswerPlace place_of(const ObserverInput& input) const noexcept;

    /// An image that is clicked on, from the middle of the screen.
    struct SlotTarget {
        glm::dvec2 first_px, end_px;
        AnswerPlace place;
    };

    SessionState& state_;
    OperatorControl& control_;
    const Schedule& schedule_;
    const ShownProbes& probes_;
    std::vector<int> ranks_;
    const Trial* trial_ = nullptr;
    const TrialPlan* plan_ = nullptr;
    ObjectTurning* turning_ = nullptr;
    int turned_shows_ = 0;
    std::vector<std::unique_ptr<AnswerSheet>> sheets_; ///< as the plan has them
    AnswerSheet* current_ = nullptr;                   ///< that inputs go to
    bool is_awaiting_ = false;                         ///< inputs are told
    bool has_screen_ = false;                          ///< current_ stands on it: places mean something
    bool is_drawing_due_ = false;
    bool stands_beside_ = false;           ///< current_ is seen with the stimulus
    std::vector<SlotTarget> slot_targets_; ///< of the step under way
    std::optional<SessionTime> opening_told_;
    int answers_marked_ = 0;
    std::optional<SessionTime> step_since_;
    std::array<ObserverInput, 64> batch_{};
};

} // namespace overt
