/// Answers that are asked together: their window, whose turn it is, and what came of each.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiment/answers/answering.h"
#include "experiment/ports/given_answer.h"

namespace overt {

/// When presses count. What is not known yet has not happened.
struct AnswerWindow {
    std::optional<SessionTime> opens, closes;
    InputState state_at(SessionTime at) const noexcept {
        return !opens || at < *opens    ? InputState::before
               : closes && at > *closes ? InputState::late
                                        : InputState::open;
    }
};

/// Keys that are held, a few at a time. One that was held before is not pressed again until it was let go.
class HeldKeys {
  public:
    /// Whether it was not held before.
    bool press(const ObserverInput& input) noexcept;
    void release(const ObserverInput& input) noexcept;
    void release_all() noexcept { count_ = 0; }

  private:
    struct HeldKey {
        ShortName device, key;
        friend bool operator==(const HeldKey&, const HeldKey&) = default;
    };
    std::array<HeldKey, 16> held_{};
    std::size_t count_ = 0;
};

/// Of one attempt. Takes the observer's inputs in the order of time, before, in and after its window. Between
/// take() and the calls that tell instants nothing allocates or throws; the rest is for moments between
/// presentations.
class AnswerSheet {
  public:
    /// `waits_unseen`: a step that shows the stimulus waits for these answers, so that their window opens
    /// with it where the protocol says nothing else.
    AnswerSheet(const std::vector<AnswerForm>& forms, bool waits_unseen);

    // What happened meanwhile.
    void stimulus_lit(SessionTime onset) noexcept;
    void stimulus_gone(SessionTime offset) noexcept;
    /// The screen with the answers of this page, view(), was lit.
    void screen_lit(SessionTime onset) noexcept;
    /// A step began or another screen stands there: clicks begin anew. Held keys stay held.
    void begin_step() noexcept { is_button_down_ = false; }
    /// Presses count no longer.
    void close(SessionTime at) noexcept;
    /// Windows that are open stay open for so much longer.
    void pause(SessionDuration for_so_long) noexcept;

    /// `place`: where the pointer is. Whether what view() says changed.
    bool take(const ObserverInput& input, const AnswerPlace& place) noexcept;

    /// All was answered, or the window is over: with ends_step, a step that asks for it has nothing to wait
    /// for. The instant of the last answer, or when the window closed.
    std::optional<SessionTime> is_over_at(SessionTime now) const noexcept;
    /// The same of a step that shows the stimulus, by ends_stimulus: all was answered.
    std::optional<SessionTime> ends_stimulus_at() const noexcept;
    bool is_complete() const noexcept { return page_ >= pages_; }
    /// All of them were answered, and none was passed over.
    bool is_given() const noexcept;
    /// How many were, and when the last.
    int given_count() const noexcept;
    SessionTime given_last_at() const noexcept;

    /// The screen as it is now: the page that is being answered, or the last one. `accept`: words of what
    /// accepts it.
    AnswerView view(const std::string& accept) const;

    /// One of its answers is pointed at on the stimulus.
    bool points() const noexcept {
        return std::ranges::any_of(asked_, [](const Asked& asked) { return asked.answering->points(); });
    }
    /// Of a gauge that is asked now, where it stands and how it is turned; null: none is.
    const Answering* gauge() const noexcept;
    /// What is still to be answered on this page.
    std::vector<AnswerOffer> offers() const;
    /// When presses began to count for what keys go to now; nothing: they do not yet.
    std::optional<SessionTime> opened_at() const noexcept;
    int page() const noexcept { return page_; }

    /// Rows of all that was asked, in turn; and of all inputs.
    void add_to(std::vector<GivenAnswer>& given, std::vector<AnswerInput>& inputs) const;

    /// Of a match that sets what this place of the trial shows: its level, and when the input came that set
    /// it. Nothing: none does.
    struct SetLevel {
        int level = 0;
        std::optional<SessionTime> input_at = {};
    };
    std::optional<SetLevel> level_of(int place) const noexcept;

    /// Inputs that found no room.
    int lost_inputs() const noexcept { return lost_inputs_; }

  private:
    struct Asked {
        std::unique_ptr<Answering> answering;
        int page = 0;
        AnswerWindow window;
        std::optional<SessionTime> screen_onset, first_input_at, answered_at;
        std::optional<SessionTime> changed_at; ///< the last that changed it
        SessionDuration uncertainty{};
        ShortName key, device; ///< of what gave it
        bool is_done = false;  ///< it is given, or was passed over
        bool is_given = false;
        bool is_tied = false;
        int changes = 0;
        const TaskAnswer& settings() const { return answering->settings(); }
    };
    struct Taken {
        ObserverInput input;
        std::size_t asked = 0;
        InputState state = InputState::open;
        bool has_counted = false;
        std::optional<double> number = {};
        std::optional<Attitude> attitude = {};
    };
    AnswerOpening::From opens_from(const Asked& asked) const noexcept;
    void open_by(AnswerOpening::From from, SessionTime at) noexcept;
    bool take_key(Taken& taken, const AnswerPlace& place) noexcept;
    bool take_pointer(Taken& taken, const AnswerPlace& place) noexcept;
    bool let_answer(Taken& taken, const AnswerPlace& place) noexcept;
    bool accept(Asked& asked, const ObserverInput& input) noexcept;
    bool accept_all(Taken& taken) noexcept;
    void give(Asked& asked, const ObserverInput& input) noexcept;
    void go_on(SessionTime at) noexcept;
    void step_aside(int by) noexcept;
    void look_for_tie(const ObserverInput& input) noexcept;
    std::size_t first_on(int page) const noexcept;
    std::size_t end_of(int page) const noexcept;
    void note(const Taken& taken) noexcept;
    GivenAnswer given(const Asked& asked) const;

    std::vector<Asked> asked_;
    bool waits_unseen_;
    int page_ = 0, pages_ = 0;
    std::size_t here_ = 0; ///< index of the one that keys go to
    std::optional<SessionTime> stimulus_onset_, completed_at_;
    HeldKeys held_;
    bool is_button_down_ = false; ///< of the mouse, in this step
    bool is_accept_down_ = false; ///< on what accepts
    std::vector<Taken> taken_;
    SessionTime moved_since_{}; ///< the first of the moves that the last of these stands for
    int lost_inputs_ = 0;
};

} // namespace overt
