/// A set-up screen on which nothing is seen or typed: for trackers that calibrate by themselves.
#pragma once

#include "experiment/ports/setup_screen.h"

namespace overt::test {

class StillSetupScreen final : public SetupScreen {
  public:
    const ScreenGeometry& geometry() const override { return geometry_; }
    SessionTime show_target(ScreenPoint, Degrees) override { return now_; }
    SessionTime clear() override { return now_; }
    void show_camera(const CameraImage&) override {}
    void show_text(const std::string&) override {}
    void show_result(const ValidationResult&, const std::string&) override {}
    void beep(Beep) override {}
    std::optional<SetupKey> next_key() override { return std::nullopt; }
    SessionTime now() const noexcept override { return now_; }
    void wait(SessionDuration time) override { now_ += time; }
    bool is_cancelled() const noexcept override { return false; }

  private:
    ScreenGeometry geometry_;
    SessionTime now_{};
};

} // namespace overt::test
