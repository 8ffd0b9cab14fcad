/// The program's own calibration, of a simulated eye that a tracker sees turned, scaled and bent.
#include <catch2/catch.hpp>

#include <algorithm>

#include "experiment/base/error.h"
#include "experiment/calibration/own_calibration.h"
#include "tests/devices/simulated/sitting.h"
#include "tests/support/still_setup_screen.h"

using namespace overt;
using namespace std::chrono_literals;
using test::SimulatedSitting;

namespace {

/// Shows to the simulated observer; keys are pressed when the `n`-th target is shown.
class WatchedSetupScreen final : public SetupScreen {
  public:
    explicit WatchedSetupScreen(SimulatedSitting& sitting) : sitting_(sitting) {}
    const ScreenGeometry& geometry() const override { return sitting_.observer.scene().screen; }
    SessionTime show_target(ScreenPoint place, Degrees) override {
        if (shown.empty() || !(shown.back() == place))
            shown.push_back(place);
        Screen screen{.kind = Screen::Kind::target, .text = "", .target_place = place};
        if (is_ignored && is_ignored(place))
            screen.target_place = ignored_for;
        return flip(screen);
    }
    SessionTime clear() override { return flip({}); }
    void show_camera(const CameraImage&) override {}
    void show_text(const std::string&) override {}
    void show_result(const ValidationResult&, const std::string&) override {}
    void beep(Beep beep) override { beeps.push_back(beep); }
    std::optional<SetupKey> next_key() override {
        if (presses && looks_++ % 50 == 49)
            return presses(shown.size());
        return std::nullopt;
    }
    SessionTime now() const noexcept override { return sitting_.clock.now(); }
    void wait(SessionDuration time) override { sitting_.clock.wait_until(sitting_.clock.now() + time); }
    bool is_cancelled() const noexcept override { return false; }

    std::vector<ScreenPoint> shown;
    std::vector<Beep> beeps;
    std::function<std::optional<SetupKey>(std::size_t)> presses;
    std::function<bool(ScreenPoint)> is_ignored;
    ScreenPoint ignored_for{960.0, 540.0}; ///< what is looked at instead

  private:
    SessionTime flip(const Screen& screen) {
        sitting_.clock.wait_until(sitting_.clock.now() + 8333333ns);
        sitting_.observer.screen_shown(screen, sitting_.clock.now());
        return sitting_.clock.now();
    }
    SimulatedSitting& sitting_;
    int looks_ = 0;
};

SimulatedTrackerSettings uncalibrated(bool both_eyes = false) {
    SimulatedTrackerSettings settings;
    settings.uncalibrated = true;
    settings.both_eyes = both_eyes;
    settings.rate_hz = 1000.0;
    settings.noise_deg = 0.05;
    settings.accuracy_deg = 0.0;
    return settings;
}

std::unique_ptr<CalibratedTracker> tracker_of(SimulatedSitting& sitting,
                                              const SimulatedTrackerSettings& settings,
                                              const CalibrationSettings& calibration = {}) {
    return std::make_unique<CalibratedTracker>(
        std::make_unique<SimulatedEyeTracker>(sitting.clock, sitting.observer, 21, settings), sitting.clock,
        calibration, 21);
}

/// Mean place of what is recorded for half a second while a place is looked at.
ScreenPoint measured_at(SimulatedSitting& sitting, EyeTracker& tracker, ScreenPoint place,
                        Eye eye = Eye::right) {
    sitting.observer.screen_shown({.kind = Screen::Kind::target, .text = "", .target_place = place},
                                  sitting.clock.now());
    sitting.clock.wait_until(sitting.clock.now() + 500ms);
    tracker.start_recording();
    sitting.clock.wait_until(sitting.clock.now() + 500ms);
    tracker.stop_recording();
    std::vector<TrackerItem> items(2000);
    items.resize(tracker.poll(items));
    ScreenPoint sum{};
    double count = 0.0;
    for (const TrackerItem& item : items) {
        const auto& sample = std::get<GazeSample>(item);
        if (sample.eye == eye && sample.gaze) {
            sum = {sum.x_px + sample.gaze->x_px, sum.y_px + sample.gaze->y_px};
            ++count;
        }
    }
    REQUIRE(count > 200.0);
    return {sum.x_px / count, sum.y_px / count};
}

double error_at(SimulatedSitting& sitting, EyeTracker& tracker, ScreenPoint place, Eye eye = Eye::right) {
    return sitting.observer.scene()
        .screen.angle_between(measured_at(sitting, tracker, place, eye), place)
        .value;
}

} // namespace

TEST_CASE("gaze that is far off before a calibration is right after it", "[unit]") {
    for (const int points : {9, 13}) {
        SimulatedSitting sitting(31);
        CalibrationSettings settings;
        settings.points = points;
        const auto tracker = tracker_of(sitting, uncalibrated(), settings);
        const ScreenPoint place{1500.0, 300.0};
        CHECK(error_at(sitting, *tracker, place) > 1.0);
        WatchedSetupScreen setup_screen(sitting);
        const SetupOutcome outcome = tracker->set_up(setup_screen);
        REQUIRE(outcome.kind == SetupOutcome::Kind::done);
        REQUIRE(outcome.validation);
        CHECK(outcome.validation->targets.size() == 5);
        CHECK(outcome.validation->mean_error.value < 0.3);
        CHECK(outcome.validation->max_error.value < 0.6);
        CHECK(outcome.method == "polynomial of second order, " + std::to_string(points) + " targets of " +
                                    std::to_string(points) + " points");
        CHECK(error_at(sitting, *tracker, place) < 0.5);
        CHECK(error_at(sitting, *tracker, {700.0, 600.0}) < 0.4);
        CHECK(setup_screen.beeps.back() == Beep::calibration_good);
        // Each place once, in an order that is not that of the layout.
        CHECK(setup_screen.shown.size() == static_cast<std::size_t>(points) + 5);
        std::vector<ScreenPoint> first(setup_screen.shown.begin(), setup_screen.shown.begin() + points);
        const std::vector<ScreenPoint> layout =
            calibration_targets(points, settings.area, sitting.observer.scene().screen);
        CHECK_FALSE(first == layout);
        CHECK(std::is_permutation(first.begin(), first.end(), layout.begin()));
    }
}

TEST_CASE("what a validation says is what it is: noise of its own, and both eyes", "[unit]") {
    SimulatedSitting sitting(32, test::without_wandering());
    const auto tracker = tracker_of(sitting, uncalibrated(true));
    WatchedSetupScreen setup_screen(sitting);
    const SetupOutcome outcome = tracker->set_up(setup_screen);
    REQUIRE(outcome.validation);
    REQUIRE(outcome.validation->targets.size() == 10);
    for (const ValidatedTarget& target : outcome.validation->targets) {
        REQUIRE(target.gaze);
        CHECK(target.error.value ==
              Approx(sitting.observer.scene().screen.angle_between(*target.gaze, target.target).value));
        // Noise of 0.05 degrees along each axis, stretched by the fit by up to a fifth.
        CHECK(target.sd->value == Approx(0.05 * std::sqrt(2.0)).epsilon(0.35));
        CHECK(target.rms_s2s->value == Approx(0.05 * 2.0).epsilon(0.35));
    }
    // The left eye, which points beside the right one, is put right as well.
    CHECK(error_at(sitting, *tracker, {600.0, 400.0}, Eye::left) < 0.5);
    CHECK(error_at(sitting, *tracker, {600.0, 400.0}, Eye::right) < 0.5);
}

TEST_CASE("a target that was not looked at at first comes again", "[unit]") {
    SimulatedSitting sitting(33);
    const auto tracker = tracker_of(sitting, uncalibrated());
    WatchedSetupScreen setup_screen(sitting);
    const std::vector<ScreenPoint> layout = calibration_targets(9, 0.8, sitting.observer.scene().screen);
    // The first time that the last corner is shown, the opposite one is looked at.
    setup_screen.ignored_for = layout[1];
    int times = 0;
    ScreenPoint before{};
    setup_screen.is_ignored = [&](ScreenPoint place) {
        if (place == layout[4] && !(before == place))
            ++times;
        before = place;
        return place == layout[4] && times == 1;
    };
    const SetupOutcome outcome = tracker->set_up(setup_screen);
    REQUIRE(outcome.kind == SetupOutcome::Kind::done);
    CHECK(std::ranges::count(setup_screen.shown, layout[4]) == 2);
    CHECK(outcome.validation->max_error.value < 0.6);
}

TEST_CASE("an eye that is never seen, or never follows, calibrates nothing and hangs nothing", "[unit]") {
    ObserverSettings asleep;
    asleep.blinks_per_minute = 1e3;
    SimulatedSitting sitting(34, asleep);
    const auto tracker = tracker_of(sitting, uncalibrated());
    WatchedSetupScreen setup_screen(sitting);
    CHECK(tracker->set_up(setup_screen).kind == SetupOutcome::Kind::failed);
    CHECK(setup_screen.beeps.back() == Beep::calibration_bad);

    SimulatedSitting staring(35);
    const auto second = tracker_of(staring, uncalibrated());
    WatchedSetupScreen ignored(staring);
    ignored.is_ignored = [](ScreenPoint) { return true; };
    const SetupOutcome outcome = second->set_up(ignored);
    CHECK(outcome.kind != SetupOutcome::Kind::cancelled);
    if (outcome.validation)
        CHECK(outcome.validation->max_error.value > 2.0);
}

TEST_CASE(
    "gaze that rests at one place for all targets is a failed calibration, after which the next can be good",
    "[unit]") {
    SimulatedSitting sitting(34, test::without_wandering());
    SimulatedTrackerSettings settings = uncalibrated();
    settings.noise_deg = 0.0;
    const auto tracker = tracker_of(sitting, settings);
    WatchedSetupScreen setup_screen(sitting);
    setup_screen.is_ignored = [](ScreenPoint) { return true; };
    const SetupOutcome outcome = tracker->set_up(setup_screen);
    CHECK(outcome.kind == SetupOutcome::Kind::failed);
    CHECK_THAT(outcome.message, Catch::Contains("gaze rested at 9 of 9 targets") &&
                                    Catch::Contains("in a line or at one place"));
    CHECK(setup_screen.beeps.back() == Beep::calibration_bad);
    setup_screen.is_ignored = {};
    CHECK(tracker->set_up(setup_screen).kind == SetupOutcome::Kind::done);
}

TEST_CASE("escape ends a calibration, backspace shows the target before again, space accepts", "[unit]") {
    SimulatedSitting sitting(36);
    CalibrationSettings by_key;
    by_key.accept = TargetAcceptance::key;
    const auto tracker = tracker_of(sitting, uncalibrated(), by_key);
    WatchedSetupScreen setup_screen(sitting);
    setup_screen.presses = [](std::size_t shown) -> std::optional<SetupKey> {
        return SetupKey{shown == 3 ? SetupKey::Kind::escape : SetupKey::Kind::space};
    };
    CHECK(tracker->set_up(setup_screen).kind == SetupOutcome::Kind::cancelled);
    CHECK(setup_screen.shown.size() == 3);

    WatchedSetupScreen again(sitting);
    again.presses = [](std::size_t shown) -> std::optional<SetupKey> {
        return SetupKey{shown == 3 ? SetupKey::Kind::backspace : SetupKey::Kind::space};
    };
    REQUIRE(tracker->set_up(again).kind == SetupOutcome::Kind::done);
    CHECK(again.shown[3] == again.shown[1]);
}

TEST_CASE("who listens hears gaze as it is calibrated", "[unit]") {
    /// A tracker whose gaze is told as it comes.
    class Telling final : public EyeTracker {
      public:
        explicit Telling(std::unique_ptr<EyeTracker> tracker) : tracker_(std::move(tracker)) {}
        TrackerDescription description() const override { return tracker_->description(); }
        SetupOutcome set_up(SetupScreen& setup_screen) override { return tracker_->set_up(setup_screen); }
        DriftOutcome drift_check(ScreenPoint target) override { return tracker_->drift_check(target); }
        std::optional<ClockPair> read_clocks() noexcept override { return tracker_->read_clocks(); }
        void start_recording() override { tracker_->start_recording(); }
        void stop_recording() override { tracker_->stop_recording(); }
        bool tell_samples_to(SampleListener* listener) override {
            listener_ = listener;
            return true;
        }
        std::size_t poll(std::span<TrackerItem> into) noexcept override {
            const std::size_t count = tracker_->poll(into);
            for (const TrackerItem& item : into.first(count))
                if (const auto* sample = std::get_if<GazeSample>(&item); sample && listener_)
                    listener_->measured(*sample);
            return count;
        }

      private:
        std::unique_ptr<EyeTracker> tracker_;
        SampleListener* listener_ = nullptr;
    };
    struct Listener final : SampleListener {
        void measured(const GazeSample& sample) noexcept override { heard.push_back(sample); }
        std::vector<GazeSample> heard;
    };
    SimulatedSitting sitting(31);
    CalibratedTracker tracker(std::make_unique<Telling>(std::make_unique<SimulatedEyeTracker>(
                                  sitting.clock, sitting.observer, 21, uncalibrated())),
                              sitting.clock, {}, 21);
    Listener listener;
    CHECK(tracker.tell_samples_to(&listener));
    WatchedSetupScreen setup_screen(sitting);
    REQUIRE(tracker.set_up(setup_screen).kind == SetupOutcome::Kind::done);
    listener.heard.clear();
    const ScreenPoint place{700.0, 400.0};
    const ScreenPoint measured = measured_at(sitting, tracker, place);
    ScreenPoint sum{};
    double count = 0.0;
    for (const GazeSample& sample : listener.heard)
        if (sample.gaze) {
            sum = {sum.x_px + sample.gaze->x_px, sum.y_px + sample.gaze->y_px};
            ++count;
        }
    REQUIRE(count > 200.0);
    CHECK(sum.x_px / count == Approx(measured.x_px));
    CHECK(sum.y_px / count == Approx(measured.y_px));
    CHECK(sitting.observer.scene().screen.angle_between(measured, place).value < 1.0);
}
