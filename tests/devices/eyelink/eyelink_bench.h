/// What tests of the EyeLink share: the stand-in library by its functions for tests, a stage that writes down
/// what it is asked to show, and a sink that keeps what it gets.
#pragma once

#include <algorithm>
#include <deque>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include <dlfcn.h>
#include <fmt/format.h>

#include "devices/host/clocks.h"
#include "experiment/ports/setup_stage.h"
#include "tests/support/kept_items.h"

namespace overt::test {

/// One of the stand-in libraries, as new. Its state is common to all who load it.
class StandIn {
  public:
    explicit StandIn(std::string file = OVERT_STAND_IN_EYELINK) : path(std::move(file)) {
        library_ = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
        if (!library_)
            throw std::runtime_error(dlerror());
        function<void()>("stand_in_reset")();
    }
    StandIn(const StandIn&) = delete;
    StandIn& operator=(const StandIn&) = delete;
    ~StandIn() { dlclose(library_); }

    void set(const char* name, double value) {
        function<void(const char*, double)>("stand_in_set")(name, value);
    }
    void tell(const char* name, const char* text) {
        function<void(const char*, const char*)>("stand_in_tell")(name, text);
    }
    /// All that was said to it, in its order.
    std::vector<std::string> said() const {
        std::vector<std::string> all;
        const auto at = function<const char*(int)>("stand_in_said");
        for (int i = 0; const char* text = at(i); ++i)
            all.emplace_back(text);
        return all;
    }
    bool heard(const std::string& text) const {
        const auto all = said();
        return std::ranges::find(all, text) != all.end();
    }

    std::string path;

  private:
    template <class Signature> Signature* function(const char* name) const {
        return reinterpret_cast<Signature*>(dlsym(library_, name));
    }
    void* library_ = nullptr;
};

/// Presses keys and writes down what it shows.
class DiaryStage final : public SetupStage {
  public:
    explicit DiaryStage(Clock& clock_) : clock(clock_) {}
    const ScreenGeometry& screen() const override { return geometry; }
    SessionTime show_target(ScreenPoint place, Degrees diameter) override {
        diary.push_back(fmt::format("target {} {} of {}", place.x_px, place.y_px, diameter.value));
        if (on_target)
            on_target();
        return now();
    }
    SessionTime clear() override { return now(); }
    void show_camera(const CameraImage& image) override {
        diary.push_back(fmt::format("camera {}x{} {}", image.width_px, image.height_px, image.title));
        camera = image;
    }
    void show_text(const std::string& text) override { diary.push_back("text " + text); }
    void show_result(const ValidationResult&, const std::string&) override {}
    void beep(SetupBeep beep) override { diary.push_back(fmt::format("beep {}", static_cast<int>(beep))); }
    std::optional<SetupKey> next_key() override {
        if (keys.empty())
            return std::nullopt;
        const SetupKey key = keys.front();
        keys.pop_front();
        return key;
    }
    SessionTime now() const noexcept override { return clock.now(); }
    void wait(SessionDuration time) override { clock.wait_until(clock.now() + time); }
    bool is_cancelled() const noexcept override { return cancelled; }

    bool showed(const std::string& what) const { return std::ranges::find(diary, what) != diary.end(); }

    Clock& clock;
    ScreenGeometry geometry;
    std::deque<SetupKey> keys;
    std::vector<std::string> diary;
    CameraImage camera;
    std::function<void()> on_target;
    bool cancelled = false;
};

} // namespace overt::test
