/// Waits for the observer's keys and acts on the operator's.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "experiment/session/session_state.h"

namespace overt {

/// What the operator decided about the trial that is running.
struct TrialDecision {
    enum class Kind : std::uint8_t {
        none,
        rejected, ///< comes again as the protocol says
        repeated, ///< comes again at once
        skipped   ///< does not come again
    };
    Kind kind = Kind::none;
    std::string why;              ///< empty: no reason is given
    bool is_tracker_lost = false; ///< of a repeated one: because of that
};

/// A screen that stands until a key is pressed or a time is up.
struct Waiting {
    Screen screen; ///< shown again after a pause, a calibration or a question
    SessionTime onset;
    double min_s = 0.0; ///< earlier presses do not count
    double max_s = 0.0; ///< after which it ends by itself
    /// Tells the panel which answer is expected, from a time on; empty: any key.
    std::function<void(SessionTime)> await = {};
    /// Called a few hundred times a second; may be empty.
    std::function<void()> meanwhile = {};
    /// Tells, as often as that, whether it is over, and since when; may be empty. As if a key had ended it.
    std::function<std::optional<SessionTime>()> is_over = {};
    bool turns_pages = false; ///< left and back go back, right goes on
    bool takes_keys = true;   ///< of the observer; else only time or the operator ends it
    bool starts_over = false; ///< when it is shown again: max_s counts from then
};

/// How often the keys are looked at while a screen stands still.
inline constexpr SessionDuration key_interval = std::chrono::milliseconds(4);

/// max_s of a screen that only a key ends.
inline constexpr double without_end_s = 1e9;

class OperatorControl {
  public:
    /// `state` must outlive this.
    explicit OperatorControl(SessionState& state) : state_(state) {}

    enum class How : std::uint8_t { next, back, yes, no, timed_out, trial_over, session_over };
    struct Press {
        How how = How::next;
        SessionTime at;
        SessionDuration uncertainty{}; ///< see ResponsePress
    };
    /// Waits until the observer presses a key or the time is up, or until the operator ends the trial or the
    /// session. Pauses and calibrations in between are done here; pauses do not count as waiting.
    Press wait(const Waiting& waiting);

    /// Acts on an operator's key, after asking where the key needs confirmation, and records when it was
    /// pressed. Gives false if the trial or the session is over by it.
    bool act_on(const ResponsePress& press);

    /// Shows a question and waits for yes or no. A digit up to `reasons` says yes, too. Gives that digit's
    /// number, or 0 for a plain yes.
    std::optional<int> confirm(const std::string& question, int reasons = 0);
    /// The same on a screen of its own, whose text is the question.
    std::optional<int> confirm(const Screen& screen, int reasons = 0);

    /// Of the trial that is running. begin_trial() forgets the one before.
    const TrialDecision& decision() const { return decision_; }
    void begin_trial() { decision_ = {}; }

    /// Sets all trackers up, the session's own first; those that were left out are connected again first.
    void calibrate();
    /// Sets one up, until it is calibrated well enough or the operator goes on all the same; else the session
    /// is over, or a further tracker is left out. A tracker that is lost meanwhile is connected again as
    /// regain_tracker() does.
    void calibrate(UsedTracker& used);
    /// Shows the target in the middle of the screen and compares gaze with it, for the operator: the record
    /// notes what was found. Does nothing else about a drift, except where the tracker asks to be set up.
    void check_drift();
    /// Where what is typed goes to another window: says so on the screen until it comes back, or the session
    /// is over; false: it did not. Every screen that waits for a key looks for it, and counts none of that
    /// time.
    bool await_keyboard();
    /// Records what of the screen has changed, and gives it. Between trials.
    std::vector<std::string> note_screen_changes();
    /// Where the screen is not what it was any more: records what has changed, and asks whether to go on;
    /// else the session is over. Between trials.
    void look_at_screen();
    /// The session's own tracker was lost, with what it said: asks whether to connect again, and sets it up.
    /// Otherwise the session is over.
    void regain_tracker(const std::string& why = {});
    /// The same of all further trackers that are lost; what the operator gives up is left out.
    /// Between trials.
    void regain_further_trackers();

    /// What was decided at the tracker's host.
    void repeat_trial() { decision_ = {TrialDecision::Kind::repeated, {}}; }
    void repeat_for_lost_tracker() { decision_ = {TrialDecision::Kind::repeated, {}, true}; }
    void reject_trial(std::string why) { decision_ = {TrialDecision::Kind::rejected, std::move(why)}; }
    void skip_trial(std::string why) { decision_ = {TrialDecision::Kind::skipped, std::move(why)}; }

  private:
    void pause();
    bool end_trial(ResponsePress::Key key);
    bool accepts(UsedTracker& used, const SetupOutcome& outcome);
    bool connect_again(UsedTracker& used, std::string why);
    void give_up(UsedTracker& used, const std::string& why);
    void begin_calibration();
    void rest_a_little(SessionTime latest);

    SessionState& state_;
    TrialDecision decision_;
    bool is_awaiting_keyboard_ = false;
};

} // namespace overt
