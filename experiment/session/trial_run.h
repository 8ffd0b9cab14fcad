/// One attempt at a trial: the steps of its plan.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "experiment/design/trial_plan.h"
#include "experiment/design/trial_queue.h"
#include "experiment/session/answer_asking.h"
#include "experiment/session/answer_taking.h"
#include "experiment/session/drift_checks.h"
#include "experiment/session/gaze_watch.h"
#include "experiment/session/object_turning.h"
#include "experiment/session/recorded_turning.h"
#include "experiment/session/shown_probes.h"
#include "experiment/session/step_screens.h"
#include "experiment/session/tracker_feed.h"
#include "experiment/timing/refresh_ledger.h"
#include "experiment/timing/slot_cycles.h"

namespace overt {

class TrialRun {
  public:
    /// `state`, `control` and `schedule` must outlive this.
    TrialRun(SessionState& state, OperatorControl& control, const ScreenPoint& screen_centre,
             const Schedule& schedule);

    /// What an attempt was like.
    struct Attempt {
        TrialOutcome outcome; ///< status is aborted until the session has judged the attempt
        AttemptResult result;
    };
    /// `next`: what probably comes after it. `is_practice`: its events are noted outside of
    /// trials, and no answer is recorded. Throws GraphicsError or RecordError for what breaks between its
    /// presentations; what happens in one, or to the tracker, is in the outcome.
    Attempt run(const Trial& trial, const std::optional<Trial>& next, bool is_practice);

  private:
    /// Which attempt it is, and what comes after it.
    struct Running {
        const Trial& trial;
        const std::optional<Trial>& next;
        bool is_practice = false;
        Attempt& attempt;
        TrialPlan plan = {};
        bool is_answered = false; ///< in time
    };
    // Steps (trial_steps.cpp).
    void run_steps(Running& running);
    void run_watched(Running& running, std::size_t begin, std::size_t end);
    void run_step(Running& running, std::size_t number);
    void ask(Running& running, std::size_t number);
    void check_drift(Running& running, const PlannedStep& step);
    void take_answer(Running& running, std::size_t number);
    void ask_answers(Running& running, std::size_t number);
    StepCircumstances circumstances(const Running& running, std::size_t number) const;
    void stand(Running& running, std::size_t number);
    void hold(Running& running, std::size_t number);
    void await_end(Running& running, std::size_t number, SessionTime since);
    void take_gaze(AttemptStep& row, const PlannedStep& step) const;
    bool is_gaze_missed(Running& running, std::size_t number);
    void add_row(Running& running, const PlannedStep& step);
    void begin_row(Running& running, SessionTime lit) noexcept;
    void end_row(Running& running, SessionTime lit);
    void mark_step(const PlannedStep& step, SessionTime lit);
    static std::string step_text(const PlannedStep& step);
    bool begin_watching(Running& running);
    void end_watching(Running& running);
    bool is_cut_short() const noexcept;

    void start_recording();
    void note_what_came(Attempt& attempt);
    void act_on_tracker(Attempt& attempt);
    void note_lost_trackers();
    void present(Running& running, std::size_t number);
    void begin_show(Running& running, std::size_t number);
    /// Finds what of a show the observer moves. Each attempt at its flips.
    void begin_steering(const PlannedStep& step);
    void turn_to(std::size_t lit, AnimationFrameIndex frame) noexcept;
    void steer(const std::vector<int>& places) noexcept;
    void note_steered(const FlipRecord& flip) noexcept;
    void note_flip(const FlipRecord& flip) noexcept;
    void note_show(Running& running, std::size_t number);
    void act_on_pressed_keys(Attempt& attempt);
    bool goes_on(const Attempt& attempt) const;
    void take_items(int trial) noexcept;
    void wait_and_take_items(int trial, SessionTime until) noexcept;
    void read_clocks() noexcept;
    void look_at_keys() noexcept;
    /// To the trackers and to the outputs of markers.
    void mark(MarkedEvent event, SessionTime at, std::string_view text) noexcept;
    void mark_trackers(SessionTime at, std::string_view text) noexcept;
    void mark_flip(const FlipRecord& flip) noexcept;
    void mark_result(const Trial& trial, const Attempt& attempt);
    void note_disturbance(const Clock::Disturbance& before);

    SessionState& state_;
    OperatorControl& control_;
    DriftChecks drift_checks_;
    AnswerTaking answers_;
    ShownProbes probes_;
    AnswerAsking asking_;
    ObjectTurning turning_;
    RecordedTurning recorded_;
    std::uint64_t seed_;            ///< of the session, from which steps are drawn
    std::vector<PageCycle> cycles_; ///< by motion
    PoseTable poses_;
    PageCycle shown_; ///< what the step that shows stimuli lights, of the first of them
    Trial lit_;       ///< the trial with what that step lights
    RefreshLedger ledger_;
    GazeWatch watch_;
    int shows_ = 0;                          ///< of this attempt, of which flips were recorded
    std::optional<RefreshIndex> first_flip_; ///< of its first show
    bool has_shown_ = false;                 ///< in what is watched now
    bool has_ended_in_order_ = false;        ///< what was watched in this attempt
    bool awaits_key_ = false;                ///< of the observer, to end the step under way
    bool was_next_pressed_ = false;          ///< it came
    int gaze_checks_ = 0;                    ///< drift checks in this attempt because gaze did not come
    SlotCycles slots_;
    /// A place that is lit and that the observer moves.
    struct Steered {
        std::size_t lit = 0;         ///< which of the places that are lit
        std::size_t first_level = 0; ///< of what is loaded; of a match
        SteeredFlip next;            ///< what the next flip shows
    };
    std::vector<Steered> steered_;
    std::size_t loaded_count_ = 1;
    std::vector<std::size_t> first_levels_; ///< of each match of the task, where its levels are loaded
    std::vector<Screen> held_;              ///< what the watched steps that show no stimulus show, by step
    /// Of one tracker of the session.
    struct Feed {
        UsedTracker& used;
        TrackerFeed items;
        GazeYield earlier =
            {}; ///< of what was watched in this attempt before an answer, and showed something
    };
    std::vector<Feed> feeds_;                     ///< of all trackers, the session's own first
    std::optional<ResponsePress> pressed_;        ///< by the operator during a presentation, the first
    AnimationFrameIndex marked_frame_ = no_frame; ///< the last whose flip the trackers were told of
    std::string onset_text_;                      ///< what they are told at a show's first
};

} // namespace overt
