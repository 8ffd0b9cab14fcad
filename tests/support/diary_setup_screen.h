/// A set-up screen that writes down what it is asked to show.
#pragma once

#include <algorithm>
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "experiment/ports/clock.h"
#include "experiment/ports/setup_screen.h"

namespace overt::test {

/// Presses keys and writes down what it shows.
class DiarySetupScreen final : public SetupScreen {
  public:
    explicit DiarySetupScreen(Clock& session_clock) : clock(session_clock) {}
    const ScreenGeometry& geometry() const override { return geometry_; }
    SessionTime show_target(ScreenPoint place, Degrees diameter) override {
        diary.push_back(fmt::format("target {} {} of {}", place.x_px, place.y_px, diameter.value));
        if (on_target)
            on_target();
        return now();
    }
    SessionTime clear() override {
        ++cleared;
        return now();
    }
    void show_camera(const CameraImage& image) override {
        diary.push_back(fmt::format("camera {}x{} {}", image.width_px, image.height_px, image.title));
        camera = image;
    }
    void show_text(const std::string& text) override { diary.push_back("text " + text); }
    void show_result(const ValidationResult&, const std::string&) override {}
    void beep(Beep beep) override { diary.push_back(fmt::format("beep {}", static_cast<int>(beep))); }
    std::optional<SetupKey> next_key() override {
        if (keys.empty())
            return std::nullopt;
        const SetupKey key = keys.front();
        keys.pop_front();
        return key;
    }
    SessionTime now() const noexcept override { return clock.now(); }
    void wait(SessionDuration time) override {
        if (on_wait)
            on_wait();
        clock.wait_until(clock.now() + time);
    }
    bool is_cancelled() const noexcept override { return cancelled; }

    bool showed(const std::string& what) const { return std::ranges::find(diary, what) != diary.end(); }

    Clock& clock;
    std::deque<SetupKey> keys;
    std::vector<std::string> diary;
    CameraImage camera;
    std::function<void()> on_target, on_wait;
    bool cancelled = false;
    int cleared = 0; ///< times

  private:
    ScreenGeometry geometry_;
};

} // namespace overt::test
