/// A set-up screen that notes what is shown on it and gives keys of a script, in the time of a clock.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "experiment/ports/clock.h"
#include "experiment/ports/setup_screen.h"

namespace overt::test {

class ScriptedSetupScreen final : public SetupScreen {
  public:
    explicit ScriptedSetupScreen(Clock& clock, ScreenGeometry geometry = {})
        : clock_(clock), geometry_(geometry) {}

    std::vector<ScreenPoint> targets; ///< in the order shown
    std::vector<std::string> texts;
    int beeps = 0;
    std::deque<SetupKey> keys;      ///< given one a call, once that many targets were shown
    std::size_t keys_after = 0;     ///< targets
    std::size_t cancel_after = ~0u; ///< targets

    const ScreenGeometry& geometry() const override { return geometry_; }
    SessionTime show_target(ScreenPoint place, Degrees) override {
        targets.push_back(place);
        return clock_.now();
    }
    SessionTime clear() override { return clock_.now(); }
    void show_camera(const CameraImage&) override {}
    void show_text(const std::string& text) override { texts.push_back(text); }
    void show_result(const ValidationResult&, const std::string& text) override { texts.push_back(text); }
    void beep(Beep) override { ++beeps; }
    std::optional<SetupKey> next_key() override {
        if (keys.empty() || targets.size() < keys_after)
            return std::nullopt;
        const SetupKey key = keys.front();
        keys.pop_front();
        return key;
    }
    SessionTime now() const noexcept override { return clock_.now(); }
    void wait(SessionDuration time) override { clock_.wait_until(clock_.now() + time); }
    bool is_cancelled() const noexcept override { return targets.size() >= cancel_after; }

  private:
    Clock& clock_;
    ScreenGeometry geometry_;
};

} // namespace overt::test
