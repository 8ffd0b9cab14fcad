/// The keyboard as a response panel: the observer's keys, and the operator's as the protocol has them.
#pragma once

#include <array>
#include <cstdint>

#include "experiment/ports/clock.h"
#include "experiment/ports/pressed_on.h"
#include "experiment/ports/response_panel.h"
#include "experiment/ports/session_phase.h"
#include "experiment/protocol/sitting_settings.h"
#include "render/window/window_context.h"

namespace overt {

/// A key of the window by its name in a protocol: "f1", "escape", "pause", or a letter.
struct NamedKey {
    WindowKey key = WindowKey::other;
    char32_t character = 0; ///< of a letter
    bool is(const WindowKeyPress& press) const noexcept;
};
NamedKey key_called(const std::string& name);

/// As a tracker's set-up is told it; nothing for keys that it does not know.
std::optional<SetupKey> setup_key_of(const WindowKeyPress& press) noexcept;

class WindowResponsePanel final : public ResponsePanel {
  public:
    /// `answering`, if given, is asked for presses and answers too: a simulated observer whose session the
    /// operator can lead. All references must outlive the panel.
    WindowResponsePanel(WindowContext& window, const Clock& clock, const OperatorSettings& operators,
                        const ConsentSettings& consent, ResponsePanel* answering = nullptr);

    /// Has places of the pointer told as this makes them of those from the middle of the window: where what
    /// is shown does not count from there. It must not throw.
    void take_places_by(std::function<glm::dvec2(glm::dvec2 from_middle_px)> place) {
        place_ = std::move(place);
    }

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
    std::optional<SetupKey> next_setup_key() override;
    std::optional<ObserverInput> next_input() noexcept override;
    std::optional<ResponsePress> poll() noexcept override;
    std::string answer() override { return answering_ ? answering_->answer() : std::string(); }
    bool has_keyboard() const noexcept override { return !window_->has_lost_focus(); }
    void write_down(SessionLog& log) override;
    std::vector<std::string> closing_warnings() const override;
    void entered(SessionPhase phase, int trial) noexcept override {
        pressed_on_.entered(phase, trial);
        if (answering_)
            answering_->entered(phase, trial);
    }

  private:
    /// A key that was pressed, to be recorded.
    struct Noted {
        WindowKeyPress press{WindowKey::other};
        SessionTime at;
        SessionDuration uncertainty{};
        SessionPhase screen = SessionPhase::trial;
        int trial = -1;
        std::optional<ResponsePress::Key> meaning;
    };

    void look() noexcept;
    bool is_operators_key(int glfw_key) const noexcept;
    /// The next one of the window, noted where keys are recorded.
    bool next_press(WindowKeyPress& press) noexcept;
    /// The same until one means something; what it means is noted with it.
    std::optional<ResponsePress> next_meant() noexcept;
    void write_presses(SessionLog& log);
    std::optional<ResponsePress> meaning_of(const WindowKeyPress& press) const noexcept;

    WindowContext* window_;
    const Clock* clock_;
    ResponsePanel* answering_;
    std::array<std::pair<NamedKey, ResponsePress::Key>, 6> operators_;
    NamedKey yes_, no_, accept_, decline_;
    bool answers_ = true;            ///< the keyboard answers for the observer, too
    Awaited awaited_ = Awaited::key; ///< a response is a key, too
    bool has_key_gone_down_ = false; ///< since something is awaited: what a key writes before is none of it
    // The operator's presses that came while something was prepared.
    std::array<ResponsePress, 16> kept_{};
    std::size_t kept_count_ = 0;
    SessionTime looked_before_, looked_; ///< at the keys
    /// That the keyboard went to another window, or came back; to be recorded.
    struct FocusChange {
        SessionTime at;
        bool is_lost = false;
    };
    std::array<FocusChange, 16> focus_changes_{};
    std::size_t focus_change_count_ = 0;
    bool is_focus_lost_ = false;                  ///< by the last of them
    std::function<glm::dvec2(glm::dvec2)> place_; ///< empty: as they are
    // Keys that were pressed, with room for those of a presentation.
    PressedOn pressed_on_;
    std::array<Noted, 256> noted_{};
    std::size_t noted_count_ = 0;
    bool is_last_noted_ = false; ///< the press that next_press() gave last is the last of them
    int unnoted_ = 0;            ///< for want of room
};

} // namespace overt
