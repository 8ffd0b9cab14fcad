/// The operator's view as a response panel: its commands are the operator's keys.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "devices/operator/operator_server.h"
#include "experiment/ports/clock.h"
#include "experiment/ports/response_panel.h"

namespace overt {

/// Asks the operator's view, and another panel besides. A command is confirmed in the view before it is sent,
/// so the question that the session asks about it is answered here; one that the session asks by itself is
/// answered by the view's yes or no. A command takes effect where a key would.
class OperatorPanel final : public ResponsePanel {
  public:
    /// All of it must outlive the panel.
    OperatorPanel(OperatorServer& server, const Clock& clock, ResponsePanel& answering)
        : server_(&server), clock_(&clock), answering_(&answering) {}

    void await(Awaited what, SessionTime since, const Trial* trial) override;
    void offer(const std::vector<AnswerOffer>& answers) override { answering_->offer(answers); }
    void offer_turning(const TurningOffer& turning) override { answering_->offer_turning(turning); }
    void window_opened(SessionTime at) noexcept override { answering_->window_opened(at); }
    std::optional<SetupKey> next_setup_key() override { return answering_->next_setup_key(); }
    std::optional<ObserverInput> next_input() noexcept override { return answering_->next_input(); }
    std::optional<ResponsePress> poll() noexcept override;
    bool has_keyboard() const noexcept override { return answering_->has_keyboard(); }
    std::string answer() override { return answering_->answer(); }
    std::vector<std::string> closing_warnings() const override { return answering_->closing_warnings(); }
    /// Records the commands and notes that came since.
    void write_down(SessionLog& log) override;
    void entered(SessionPhase phase, int trial) noexcept override;

    /// The session acts on a key now, and may ask about it next.
    void acted_on(std::string_view key) noexcept;

  private:
    /// A key that was given to the session, and what its question is answered with.
    struct Given {
        ResponsePress::Key key = ResponsePress::Key::pause;
        int reason = 0;
        bool is_asked_next = false; ///< the session has taken it
    };
    struct Taken {
        OperatorCommand command;
        SessionTime at;
        int trial = -1;
    };
    std::optional<ResponsePress> take(const OperatorCommand& command) noexcept;
    void reply(std::string_view words) noexcept;
    std::string_view refusal_of(ResponsePress::Key key) const noexcept;

    OperatorServer* server_;
    const Clock* clock_;
    ResponsePanel* answering_;
    bool is_asked_ = false; ///< the operator, by the session
    SessionPhase phase_ = SessionPhase::set_up;
    int trial_ = -1;
    std::optional<Given> given_;
    std::optional<ResponsePress> next_answer_;
    std::optional<OperatorCommand> held_; ///< until the one before is dealt with
    /// To be recorded when the trial is over. What finds no room is refused, notes before keys.
    static constexpr std::size_t most_taken = 64, kept_for_keys = 16;
    std::array<Taken, most_taken> taken_{};
    std::size_t taken_count_ = 0;
};

} // namespace overt
