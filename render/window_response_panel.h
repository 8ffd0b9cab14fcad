/// The keyboard as a response panel: space or enter goes on, escape ends the session.
#pragma once

#include "experiment/ports.h"
#include "render/window_context.h"

namespace overt {

class WindowResponsePanel final : public ResponsePanel {
  public:
    /// `answering`, if given, is asked for presses and answers too: a simulated observer whose session the
    /// operator can end. All references must outlive the panel.
    WindowResponsePanel(WindowContext& window, const Clock& clock, ResponsePanel* answering = nullptr)
        : window_(&window), clock_(&clock), answering_(answering) {}

    void await_key(SessionTime since) override;
    void await_response(const Trial& trial, SessionTime since) override;
    std::optional<ResponsePress> poll() noexcept override;
    std::string answer() override { return answering_ ? answering_->answer() : std::string(); }

  private:
    void forget_presses() noexcept;
    WindowContext* window_;
    const Clock* clock_;
    ResponsePanel* answering_;
    bool escape_pressed_ = false;
};

} // namespace overt
