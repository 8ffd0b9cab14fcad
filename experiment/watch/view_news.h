/// What a running session tells those who watch it: plain values that go through a ring, and what becomes of
/// them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/gaze.h"
#include "experiment/ports/session_phase.h"
#include "experiment/session_time.h"
#include "experiment/watch/session_view.h"

namespace overt {

/// One piece of news. What a kind does not name has no meaning in it. Counts are of all that was until now,
/// so that a piece that found no room does not make those after it wrong.
struct ViewNews {
    enum class Kind : std::uint8_t {
        phase,         ///< `phase`, `trial`
        trial_started, ///< `trial`, its place in the schedule
        trial_ended, ///< `counts`: it is completed; `text`: the answer; `value`: drift in deg, if `has_value`
        flip,        ///< `shown`, its `pose` and `frame`, `refresh`, missed
        samples,     ///< counts of samples
        event,       ///< `word`: its kind, `text`: its detail
        validation,  ///< `value` and `other`: mean and largest error in deg
        level,       ///< `value` and `other`: rms and peak; `counts`: it clips
        reply,       ///< `text`: to a command
    };
    Kind kind = Kind::event;
    SessionPhase phase = SessionPhase::set_up;
    bool counts = false, has_value = false;
    int trial = -1;
    int shown = 0; ///< which of what the trial shows (Trial::shown)
    int pose = -1, frame = -1, refresh = 0;
    SessionTime at;
    double value = 0.0, other = 0.0;
    std::int64_t samples = 0, lost = 0, samples_in_trial = 0, lost_in_trial = 0;
    std::int64_t missed = 0, missed_in_trial = 0;
    std::array<char, 32> word{};
    std::array<char, 256> text{};

    /// Cut at the end of a character; the last byte is always 0.
    void set_word(std::string_view from) noexcept;
    void set_text(std::string_view from) noexcept;
};

/// A sample, as soon as it came.
struct GazeNews {
    SessionTime at;         ///< at which it came
    TrackerTime sampled_at; ///< by the tracker's clock
    bool is_right = true, has_place = false;
    ScreenPoint place;
};

/// What is told of a trial that begins, by its place in the schedule.
struct ViewedTrial {
    std::string task, question;
    std::vector<ViewedStimulus> shown = {}; ///< as Trial::shown has them
    /// Of each: the picture of its motion (Animation::pictures), by animation frame.
    std::vector<std::vector<int>> picture_of_frame = {};
};

/// Makes of the news what is to be shown. For one thread.
class ViewBuilder {
  public:
    /// `trials`: by their index. `completed`: how many of them are done before this sitting. `slots`: gaze
    /// belongs to what is lit in the one that holds it; none: to the first that is lit.
    ViewBuilder(std::vector<ViewedTrial> trials, int completed, std::vector<ViewedSlot> slots = {});

    /// Gives an event if the news is one that is listed.
    std::optional<ViewedEvent> apply(const ViewNews& news);

    /// With the trial under way, in whose slot it lies and the pose that was lit there, by the news so far.
    ViewedGaze placed(const GazeNews& gaze) const;

    const SessionView& view() const { return view_; }
    void set_dropped(std::int64_t dropped) { view_.dropped = dropped; }
    void set_over() { view_.is_over = true; }

  private:
    /// From when on a pose was lit.
    struct Lit {
        SessionTime since;
        int pose = -1;
    };
    void apply_event(const ViewedEvent& event);
    void lit(SessionTime since, std::size_t shown, int pose);
    void nothing_lit(SessionTime since);
    /// That a frame of what the trial under way shows has; -1: not known.
    int picture_of(std::size_t shown, int frame) const;

    std::vector<ViewedTrial> trials_;
    SessionView view_;
    std::vector<ViewedSlot> slots_;
    std::vector<std::array<Lit, 8>> lit_; ///< of what is shown: the last ones, the newest first
};

} // namespace overt
