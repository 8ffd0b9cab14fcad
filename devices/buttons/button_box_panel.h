/// Response boxes as a response panel: what their buttons mean where something is read, decided or answered.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "devices/buttons/threaded_button_box.h"
#include "experiment/ports/button_meaning.h"
#include "experiment/ports/pressed_on.h"
#include "experiment/ports/recorded_button.h"
#include "experiment/ports/response_panel.h"

namespace overt {

/// A box of a session.
struct BoxInHand {
    std::string id; ///< as the protocol calls it
    bool is_operators = false;
    std::vector<ButtonMeaning> meanings; ///< none: all buttons go on
    std::unique_ptr<ThreadedButtonBox> box;
};

/// Asks the boxes, and another panel besides. What an observer's box says is never taken for the operator's,
/// and the other way round.
class ButtonBoxPanel final : public ResponsePanel {
  public:
    /// `answering`: asked for presses and answers as well; null if there is none. `tell`: what the operator
    /// should know now. Clock and panel must outlive this. Throws InputError for a button that a box does not
    /// have.
    ButtonBoxPanel(std::vector<BoxInHand> boxes, const Clock& clock, ResponsePanel* answering,
                   std::function<void(const std::string&)> tell);

    void await(Awaited what, SessionTime since, const Trial* trial) override;
    void offer(const std::vector<AnswerOffer>& answers) override {
        if (answering_)
            answering_->offer(answers);
    }
    void offer_turning(const TurningOffer& turning) override {
        if (answering_)
            answering_->offer_turning(turning);
    }
    void window_opened(SessionTime at) noexcept override {
        if (answering_)
            answering_->window_opened(at);
    }
    std::optional<SetupKey> next_setup_key() override {
        return answering_ ? answering_->next_setup_key() : std::nullopt;
    }
    /// Buttons of the observers' boxes by the names on them, their knobs, and what the other panel tells.
    std::optional<ObserverInput> next_input() noexcept override;
    std::optional<ResponsePress> poll() noexcept override;
    bool has_keyboard() const noexcept override { return !answering_ || answering_->has_keyboard(); }
    std::string answer() override;
    std::vector<std::string> closing_warnings() const override;
    void write_down(SessionLog& log) override;
    void entered(SessionPhase phase, int trial) noexcept override;

  private:
    struct Hand {
        BoxInHand in_hand;
        std::vector<int> meaning_of;       ///< by the button's number: index into the meanings, or -1
        std::vector<ShortName> names = {}; ///< by the button's number
        bool is_noted = false;             ///< what it is stands in the record
        int losses = 0;
    };
    /// What is to be recorded.
    struct Change {
        std::size_t hand = 0;
        ButtonChange change;
        int trial = -1;
        std::optional<SessionPhase> screen; ///< that stood there; nothing where keys are not recorded
    };
    const ButtonMeaning* meaning(const Hand& hand, int button) const noexcept;
    bool next_change(Change& into) noexcept;
    void keep(const Change& change) noexcept;
    void note_input(const Change& change) noexcept;
    void note_turn(const Change& change) noexcept;
    std::optional<ResponsePress> next_press() noexcept;
    std::optional<ResponsePress> press_of(const Hand& hand, const ButtonChange& change) noexcept;
    void write_news(SessionLog& log, Hand& hand);

    std::vector<Hand> hands_;
    const Clock* clock_;
    ResponsePanel* answering_;
    std::function<void(const std::string&)> tell_;
    ButtonMeaning goes_on_;
    PressedOn pressed_on_;
    Awaited awaited_ = Awaited::key;
    SessionTime since_;
    int trial_ = -1;
    const ButtonMeaning* answered_ = nullptr; ///< the button that answered
    bool box_answered_ = false;
    std::array<ResponsePress, 16> kept_{}; ///< the operator's, that came while something was prepared
    std::size_t kept_count_ = 0;
    std::array<ObserverInput, 128> inputs_{}; ///< since an answer is awaited, told by nobody yet
    std::size_t input_count_ = 0;
    std::vector<Change> changes_;  ///< to be recorded, with room for those of a presentation
    std::vector<Change> recorded_; ///< of which nobody was told yet, with room as well
    std::int64_t unrecorded_ = 0;
};

} // namespace overt
