/// The session's screens and keys, as a tracker's set-up uses them.
#pragma once

#include "experiment/ports/setup_screen.h"
#include "experiment/session/session_state.h"

namespace overt {

class SessionSetupScreen final : public SetupScreen {
  public:
    /// From here on the panel tells keys as they are. `state` must outlive this.
    explicit SessionSetupScreen(SessionState& state);

    const ScreenGeometry& geometry() const override { return geometry_; }
    SessionTime show_target(ScreenPoint place, Degrees diameter) override;
    SessionTime clear() override;
    void show_camera(const CameraImage& image) override;
    void show_text(const std::string& text) override;
    void show_result(const ValidationResult& result, const std::string& text) override;
    void beep(Beep beep) override;
    std::optional<SetupKey> next_key() override { return state_.ports.panel.next_setup_key(); }
    SessionTime now() const noexcept override { return state_.now(); }
    void wait(SessionDuration time) override;
    bool is_cancelled() const noexcept override { return state_.went_away(); }

  private:
    SessionState& state_;
    ScreenGeometry geometry_;
};

} // namespace overt
