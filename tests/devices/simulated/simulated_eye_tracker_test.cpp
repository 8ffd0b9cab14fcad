#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include "experiment/base/error.h"
#include "experiment/clock_map.h"
#include "tests/devices/tracker/row_parts.h"
#include "tests/support/still_setup_screen.h"

using namespace overt;
using namespace std::chrono_literals;
using test::SimulatedSitting;

namespace {

/// Measures exactly what is so.
SimulatedTrackerSettings perfect() {
    SimulatedTrackerSettings settings;
    settings.noise_deg = settings.accuracy_deg = settings.clock_drift_ppm = settings.steps_per_px = 0.0;
    return settings;
}

std::vector<GazeSample> take_all(EyeTracker& tracker, std::size_t at_a_time = 64) {
    std::vector<GazeSample> all;
    std::vector<TrackerItem> some(at_a_time);
    for (std::size_t taken = at_a_time; taken == at_a_time;) {
        taken = tracker.poll(some);
        for (std::size_t i = 0; i < taken; ++i)
            all.push_back(std::get<GazeSample>(some[i]));
    }
    return all;
}

void append(std::vector<GazeSample>& all, const std::vector<GazeSample>& more) {
    all.insert(all.end(), more.begin(), more.end());
}

/// Records one trial, polled at each flip or only afterwards.
std::vector<GazeSample> record(SimulatedSitting& sitting, SimulatedEyeTracker& tracker, const Trial& trial,
                               bool polled_at_flips = true) {
    std::vector<GazeSample> samples;
    tracker.start_recording();
    sitting.present(trial, {}, [&] {
        if (polled_at_flips)
            append(samples, take_all(tracker));
    });
    tracker.stop_recording();
    append(samples, take_all(tracker));
    return samples;
}

struct Spread {
    double mean = 0.0, sd = 0.0;
};
Spread spread_of(const std::vector<double>& values) {
    Spread spread;
    for (const double value : values)
        spread.mean += value / static_cast<double>(values.size());
    for (const double value : values)
        spread.sd += (value - spread.mean) * (value - spread.mean) / static_cast<double>(values.size());
    spread.sd = std::sqrt(spread.sd);
    return spread;
}

/// Measured minus true gaze along x, in degrees, of the samples with gaze.
std::vector<double> errors_deg(const SimulatedSitting& sitting, const SimulatedEyeTracker& tracker,
                               const std::vector<GazeSample>& samples) {
    std::vector<double> errors;
    const double px_per_deg = px_per_deg_at_centre(sitting.observer.scene().screen).x;
    for (const GazeSample& sample : samples) {
        const TrueGaze truth = sitting.observer.gaze_at(tracker.session_time_at(sample.sampled_at));
        if (sample.gaze)
            errors.push_back((sample.gaze->x_px - truth.place.x_px) / px_per_deg);
    }
    return errors;
}

} // namespace

TEST_CASE("a recording holds rate times duration samples, 500 us apart", "[unit]") {
    SimulatedSitting sitting(1);
    SimulatedEyeTracker tracker(sitting.clock, sitting.observer, 1, perfect());
    for (const SessionDuration length : {SessionDuration(1s), SessionDuration(2345ms + 500us)}) {
        sitting.clock.wait_until(sitting.clock.now() + 777us);
        tracker.start_recording();
        sitting.clock.wait_until(sitting.clock.now() + length);
        tracker.stop_recording();
        const std::vector<GazeSample> samples = take_all(tracker);
        CHECK(static_cast<std::int64_t>(samples.size()) == length / 500us);
        for (std::size_t i = 1; i < samples.size(); ++i)
            REQUIRE(samples[i].sampled_at - samples[i - 1].sampled_at == 500us);
        CHECK(take_all(tracker).empty());
    }
}

TEST_CASE("without noise the tracker gives the observer's gaze, and none while the eye is closed", "[unit]") {
    SimulatedSitting sitting(2);
    SimulatedEyeTracker tracker(sitting.clock, sitting.observer, 2, perfect());
    const std::vector<GazeSample> samples = record(sitting, tracker, {0, 0, {}});
    int closed = 0;
    for (const GazeSample& sample : samples) {
        const TrueGaze truth = sitting.observer.gaze_at(tracker.session_time_at(sample.sampled_at));
        REQUIRE(sample.gaze.has_value() == (truth.state != EyeState::blink));
        if (sample.gaze) {
            REQUIRE(*sample.gaze == truth.place);
            REQUIRE(sample.pupil_area > 500.0f);
        } else {
            ++closed;
            REQUIRE(sample.pupil_area == 0.0f);
        }
    }
    CHECK(closed > 200);
    CHECK(closed < 2000);
}

TEST_CASE("samples polled late are the samples polled in time", "[unit]") {
    SimulatedSitting often(3), late(3);
    SimulatedEyeTracker polled_often(often.clock, often.observer, 3),
        polled_late(late.clock, late.observer, 3);
    const std::vector<GazeSample> a = record(often, polled_often, {0, 0, {}}, true);
    const std::vector<GazeSample> b = record(late, polled_late, {0, 0, {}}, false);
    REQUIRE(a.size() == b.size());
    CHECK(a.size() > 18000);
    for (std::size_t i = 0; i < a.size(); ++i) {
        REQUIRE(a[i].sampled_at == b[i].sampled_at);
        REQUIRE(a[i].gaze == b[i].gaze);
        REQUIRE(a[i].pupil_area == b[i].pupil_area);
    }
    CHECK(polled_late.overflowed() == 0);
}

TEST_CASE("samples beyond the queue's capacity are lost, the oldest first, and counted", "[unit]") {
    SimulatedSitting sitting(4);
    SimulatedTrackerSettings settings = perfect();
    settings.queue_capacity = 1000;
    SimulatedEyeTracker tracker(sitting.clock, sitting.observer, 4, settings);
    tracker.start_recording();
    sitting.clock.wait_until(sitting.clock.now() + 1s);
    tracker.stop_recording();
    const TrackerTime end = tracker.tracker_time_at(sitting.clock.now());
    const std::vector<GazeSample> samples = take_all(tracker);
    CHECK(samples.size() == 1000);
    CHECK(tracker.overflowed() == 1000);
    CHECK(end - samples.back().sampled_at <= 500us);
}

TEST_CASE("a sample is delivered once its latency has passed", "[unit]") {
    SimulatedSitting sitting(5);
    SimulatedEyeTracker tracker(sitting.clock, sitting.observer, 5);
    tracker.start_recording();
    sitting.clock.wait_until(sitting.clock.now() + 100ms);
    const SessionTime now = sitting.clock.now();
    const std::vector<GazeSample> samples = take_all(tracker);
    const SessionDuration age = now - tracker.session_time_at(samples.back().sampled_at);
    CHECK(age >= 2ms);
    CHECK(age < 2ms + 600us);
}

TEST_CASE("noise and calibration error are as large as set", "[unit]") {
    SimulatedSitting sitting(6);
    SimulatedTrackerSettings settings;
    settings.noise_deg = 0.07;
    settings.accuracy_deg = 0.4;
    SimulatedEyeTracker tracker(sitting.clock, sitting.observer, 6, settings);
    std::vector<double> offsets;
    for (int recording = 0; recording < 400; ++recording) {
        const glm::dvec2 offset_deg = tracker.offset_deg();
        tracker.start_recording();
        sitting.clock.wait_until(sitting.clock.now() + 500ms);
        tracker.stop_recording();
        const std::vector<double> errors = errors_deg(sitting, tracker, take_all(tracker));
        if (errors.size() < 900)
            continue; // mostly a blink
        const Spread spread = spread_of(errors);
        REQUIRE(spread.mean == Approx(offset_deg.x).margin(4.5 * 0.07 / 30.0));
        REQUIRE(spread.sd == Approx(0.07).epsilon(0.12));
        offsets.push_back(spread.mean);
    }
    CHECK(offsets.size() > 300);
    CHECK(spread_of(offsets).mean == Approx(0.0).margin(0.4 * 4.0 / std::sqrt(300.0)));
    CHECK(spread_of(offsets).sd == Approx(0.4).epsilon(0.15));
}

TEST_CASE("noise across and along are of one size and independent, and so is each sample's of the next",
          "[unit]") {
    SimulatedSitting sitting(8);
    SimulatedTrackerSettings settings;
    settings.noise_deg = 0.2;
    settings.accuracy_deg = 0.0;
    settings.steps_per_px = 0.0;
    SimulatedEyeTracker tracker(sitting.clock, sitting.observer, 8, settings);
    tracker.start_recording();
    sitting.clock.wait_until(sitting.clock.now() + 10s);
    tracker.stop_recording();
    std::vector<glm::dvec2> errors;
    const glm::dvec2 px_per_deg = px_per_deg_at_centre(sitting.observer.scene().screen);
    for (const GazeSample& sample : take_all(tracker)) {
        if (!sample.gaze)
            continue;
        const TrueGaze truth = sitting.observer.gaze_at(tracker.session_time_at(sample.sampled_at));
        errors.push_back(
            glm::dvec2(sample.gaze->x_px - truth.place.x_px, sample.gaze->y_px - truth.place.y_px) /
            px_per_deg / settings.noise_deg);
    }
    REQUIRE(errors.size() > 10'000);
    glm::dvec2 squares(0.0), to_next(0.0);
    double product = 0.0, product_of_squares = 0.0;
    for (std::size_t i = 0; i + 1 < errors.size(); ++i) {
        squares += errors[i] * errors[i];
        to_next += errors[i] * errors[i + 1];
        product += errors[i].x * errors[i].y;
        product_of_squares += (errors[i].x * errors[i].x - 1.0) * (errors[i].y * errors[i].y - 1.0);
    }
    const double n = static_cast<double>(errors.size() - 1), five_sigma = 5.0 / std::sqrt(n);
    CHECK(squares.x / n == Approx(1.0).margin(five_sigma * std::sqrt(2.0)));
    CHECK(squares.y / n == Approx(1.0).margin(five_sigma * std::sqrt(2.0)));
    CHECK(product / n == Approx(0.0).margin(five_sigma));
    CHECK(product_of_squares / n == Approx(0.0).margin(2.0 * five_sigma));
    CHECK(to_next.x / n == Approx(0.0).margin(five_sigma));
    CHECK(to_next.y / n == Approx(0.0).margin(five_sigma));
}

TEST_CASE("gaze comes in tenths of a pixel", "[unit]") {
    SimulatedSitting sitting(7);
    SimulatedEyeTracker tracker(sitting.clock, sitting.observer, 7);
    tracker.start_recording();
    sitting.clock.wait_until(sitting.clock.now() + 100ms);
    for (const GazeSample& sample : take_all(tracker)) {
        if (sample.gaze)
            REQUIRE(std::abs(10.0 * sample.gaze->x_px - std::round(10.0 * sample.gaze->x_px)) < 1e-9);
    }
}

TEST_CASE("the drift of the tracker's clock comes out of the clock readings", "[unit]") {
    for (const double drift_ppm : {-80.0, 0.0, 40.0}) {
        SimulatedSitting sitting(8);
        SimulatedTrackerSettings settings;
        settings.clock_drift_ppm = drift_ppm;
        SimulatedEyeTracker tracker(sitting.clock, sitting.observer, 8, settings);
        std::vector<ClockPair> pairs;
        std::vector<double> x, y;
        for (int i = 0; i < 400; ++i) {
            sitting.clock.wait_until(sitting.clock.now() + 1s);
            const ClockPair pair = *tracker.read_clocks();
            REQUIRE(pair.after - pair.before >= 100us);
            REQUIRE(tracker.session_time_at(pair.other) >= pair.before - 2us);
            REQUIRE(tracker.session_time_at(pair.other) <= pair.after);
            x.push_back(to_seconds(pair.before + (pair.after - pair.before) / 2));
            y.push_back(std::chrono::duration<double>(pair.other.time_since_epoch()).count());
        }
        // A straight line by least squares.
        const double mean_x = spread_of(x).mean, mean_y = spread_of(y).mean;
        double covariance = 0.0, variance = 0.0;
        for (std::size_t i = 0; i < x.size(); ++i) {
            covariance += (x[i] - mean_x) * (y[i] - mean_y);
            variance += (x[i] - mean_x) * (x[i] - mean_x);
        }
        CHECK((covariance / variance - 1.0) * 1e6 == Approx(drift_ppm).margin(0.2));
    }
}

TEST_CASE("a sample's instant on the session clock comes back through the clock map", "[unit]") {
    SimulatedSitting sitting(9);
    SimulatedEyeTracker tracker(sitting.clock, sitting.observer, 9);
    std::vector<ClockPair> pairs;
    for (int i = 0; i < 8; ++i)
        pairs.push_back(*tracker.read_clocks());
    const std::vector<GazeSample> samples = record(sitting, tracker, {0, 0, {}});
    for (int i = 0; i < 8; ++i)
        pairs.push_back(*tracker.read_clocks());
    const ClockMap map(pairs);
    for (std::size_t i = 0; i < samples.size(); i += 100) {
        const MappedTime mapped = map.to_session(samples[i].sampled_at);
        const SessionTime truth = tracker.session_time_at(samples[i].sampled_at);
        REQUIRE(mapped.time - truth <= mapped.uncertainty);
        REQUIRE(truth - mapped.time <= mapped.uncertainty);
        REQUIRE(mapped.uncertainty < 500us);
    }
}

TEST_CASE("on a steady clock a recording is as whole as in virtual time", "[unit]") {
    const Mesh mesh = test::bust();
    SteadyClock clock;
    const SimulatedObserver observer(test::scene_with(mesh), 10);
    SimulatedEyeTracker tracker(clock, observer, 10);
    const ClockPair pair = *tracker.read_clocks();
    CHECK(pair.after > pair.before);
    CHECK(tracker.session_time_at(pair.other) >= pair.before - 2us);
    CHECK(tracker.session_time_at(pair.other) <= pair.after);

    const SessionTime begin = clock.now();
    tracker.start_recording();
    std::vector<GazeSample> samples;
    for (int i = 0; i < 8; ++i) {
        clock.wait_until(begin + i * 5ms);
        append(samples, take_all(tracker));
    }
    tracker.stop_recording();
    append(samples, take_all(tracker));
    CHECK(samples.size() >= 69);
    for (std::size_t i = 1; i < samples.size(); ++i)
        REQUIRE(samples[i].sampled_at - samples[i - 1].sampled_at == 500us);
}

TEST_CASE("a drift check measures the offset of the recording to come", "[unit]") {
    SimulatedSitting sitting(11, test::without_wandering());
    SimulatedEyeTracker tracker(sitting.clock, sitting.observer, 11);
    const ScreenPoint centre = sitting.observer.scene().screen.centre();
    for (int i = 0; i < 20; ++i) {
        const DriftOutcome drift = tracker.drift_check(centre);
        REQUIRE(drift.kind == DriftOutcome::Kind::measured);
        CHECK(drift.error.value == Approx(glm::length(tracker.offset_deg())).margin(0.02));
        tracker.start_recording();
        sitting.clock.wait_until(sitting.clock.now() + 500ms);
        tracker.stop_recording();
    }
}

TEST_CASE("a drift check of an eye that stays closed finds nothing", "[unit]") {
    ObserverSettings asleep;
    asleep.blinks_per_minute = 1e3; // one after the other
    SimulatedSitting sitting(12, asleep);
    SimulatedEyeTracker tracker(sitting.clock, sitting.observer, 12);
    const DriftOutcome drift = tracker.drift_check(sitting.observer.scene().screen.centre());
    CHECK(drift.kind == DriftOutcome::Kind::no_eye);
    CHECK(sitting.clock.now() >= SessionTime(2s));
}

TEST_CASE("a validation reports errors as large as the set accuracy makes them", "[unit]") {
    SimulatedSitting sitting(13);
    SimulatedTrackerSettings settings;
    settings.accuracy_deg = 0.5;
    SimulatedEyeTracker tracker(sitting.clock, sitting.observer, 13, settings);
    double sum = 0.0;
    for (int i = 0; i < 200; ++i) {
        test::StillSetupScreen setup_screen;
        const ValidationResult result = *tracker.set_up(setup_screen).validation;
        REQUIRE(result.max_error > result.mean_error);
        sum += result.mean_error.value / 200.0;
    }
    // Mean of a Rayleigh distribution: the root of pi / 2.
    CHECK(sum == Approx(0.5 * std::sqrt(std::numbers::pi / 2.0)).epsilon(0.05));
}

TEST_CASE("a tracker with a rate that no tracker has is refused", "[unit]") {
    SimulatedSitting sitting(14);
    SimulatedTrackerSettings settings;
    settings.rate_hz = 0.0;
    CHECK_THROWS_AS(SimulatedEyeTracker(sitting.clock, sitting.observer, 1, settings), InputError);
    settings.rate_hz = std::nan("");
    CHECK_THROWS_AS(SimulatedEyeTracker(sitting.clock, sitting.observer, 1, settings), InputError);
}

TEST_CASE("gaze that is not calibrated is bent by a known way, which grows from the middle", "[unit]") {
    SimulatedSitting sitting(4, test::without_wandering());
    SimulatedTrackerSettings settings = perfect();
    settings.uncalibrated = true;
    SimulatedEyeTracker tracker(sitting.clock, sitting.observer, 4, settings);
    const ScreenPoint centre = sitting.observer.scene().screen.centre();
    int compared = 0;
    for (const GazeSample& sample : record(sitting, tracker, {0, 0, {}})) {
        const TrueGaze truth = sitting.observer.gaze_at(tracker.session_time_at(sample.sampled_at));
        if (!sample.gaze)
            continue;
        // In halves of the screen's width.
        const double x = (truth.place.x_px - centre.x_px) / centre.x_px;
        const double y = (truth.place.y_px - centre.y_px) / centre.x_px;
        const double right = (sample.gaze->x_px - centre.x_px) / centre.x_px;
        const double down = (sample.gaze->y_px - centre.y_px) / centre.x_px;
        REQUIRE(right == Approx(0.06 + 1.1 * x + 0.05 * y + 0.04 * x * y).margin(1e-9));
        REQUIRE(down == Approx(-0.03 - 0.05 * x + 0.85 * y + 0.05 * x * x - 0.03 * y * y).margin(1e-9));
        compared += x != 0.0 && y != 0.0;
    }
    CHECK(compared > 1000);
}

TEST_CASE("pupils have about 1100 units, with two slow waves and even noise of up to four", "[unit]") {
    SimulatedSitting sitting(5);
    SimulatedEyeTracker tracker(sitting.clock, sitting.observer, 5, perfect());
    std::vector<double> off;
    for (int trial = 0; trial < 6; ++trial)
        for (const GazeSample& sample : record(sitting, tracker, {trial, 0, {}})) {
            if (!sample.gaze)
                continue;
            CHECK(sample.pupil_area == std::round(sample.pupil_area));
            const double t = 2.0 * 3.14159265358979 *
                             to_seconds(tracker.session_time_at(sample.sampled_at) - SessionTime());
            off.push_back(static_cast<double>(sample.pupil_area) -
                          (1100.0 + 70.0 * std::sin(0.07 * t) + 40.0 * std::sin(0.23 * t + 1.0)));
        }
    REQUIRE(off.size() > 10'000);
    const Spread spread = spread_of(off);
    CHECK(spread.mean == Approx(0.0).margin(0.2));
    // Even noise has a third of its square as variance, and rounding a twelfth.
    CHECK(spread.sd == Approx(std::sqrt(16.0 / 3.0 + 1.0 / 12.0)).epsilon(0.02));
    CHECK(*std::ranges::max_element(off) <= 4.5);
    CHECK(*std::ranges::min_element(off) >= -4.5);
}

TEST_CASE("a validation's targets are a grid of nine, and its errors those between gaze and target",
          "[unit]") {
    SimulatedSitting sitting(6);
    SimulatedTrackerSettings settings;
    settings.accuracy_deg = 0.4;
    SimulatedEyeTracker tracker(sitting.clock, sitting.observer, 6, settings);
    const ScreenGeometry screen = sitting.observer.scene().screen;
    const double px_per_deg = px_per_deg_at_centre(screen).x;
    test::StillSetupScreen setup_screen;
    std::vector<double> right, down;
    for (int i = 0; i < 200; ++i) {
        const SetupOutcome outcome = tracker.set_up(setup_screen);
        CHECK(outcome.kind == SetupOutcome::Kind::done);
        CHECK(outcome.method == "tracker");
        REQUIRE(outcome.validation);
        REQUIRE(outcome.validation->targets.size() == 9);
        for (std::size_t k = 0; k < 9; ++k) {
            const ValidatedTarget& target = outcome.validation->targets[k];
            CHECK(target.target.x_px ==
                  Approx(screen.screen_px.x * (0.1 + 0.4 * static_cast<double>(k % 3))));
            CHECK(target.target.y_px ==
                  Approx(screen.screen_px.y * (0.1 + 0.4 * static_cast<double>(k / 3))));
            REQUIRE(target.gaze);
            right.push_back((target.gaze->x_px - target.target.x_px) / px_per_deg);
            down.push_back((target.gaze->y_px - target.target.y_px) / px_per_deg);
            CHECK(target.error.value == Approx(std::hypot(right.back(), down.back())).epsilon(0.01));
        }
    }
    for (const std::vector<double>& axis : {right, down}) {
        CHECK(spread_of(axis).mean == Approx(0.0).margin(4.0 * 0.4 / std::sqrt(1800.0)));
        CHECK(spread_of(axis).sd == Approx(0.4).epsilon(0.07));
    }
}

TEST_CASE(
    "a simulated tracker of a protocol has its rate, or the one that is granted, and calibrates as it says",
    "[unit]") {
    constexpr TrackerKind simulated = kind_called<TrackerKind>("simulated");
    test::RowParts parts;
    parts.protocol.tracker.rate_hz = 250.0;
    auto tracker = parts.tracker<simulated>();
    CHECK(tracker->description().sample_rate_hz == 250.0);
    CHECK(tracker->calibrates_itself());
    parts.faults.granted_rate_hz = 125.0;
    parts.protocol.calibration.by = CalibratedBy::overt;
    tracker = parts.tracker<simulated>();
    CHECK(tracker->description().sample_rate_hz == 125.0);
    CHECK_FALSE(tracker->calibrates_itself());
    parts.protocol.tracker.eye = "left";
    const auto none = parts.tracker<kind_called<TrackerKind>("none")>();
    CHECK_FALSE(none->measures_gaze());
    CHECK(none->description().name == "none");
    CHECK(none->description().sample_rate_hz == 0.0);
    CHECK(none->description().eye == Eye::left);
    std::array<TrackerItem, 4> items;
    none->start_recording();
    CHECK(none->poll(items) == 0);
    none->stop_recording();
    CHECK_FALSE(none->read_clocks());
}

TEST_CASE("a simulated tracker has 1 to 10,000 samples a second", "[unit]") {
    SimulatedSitting sitting(1);
    const auto takes = [&](double rate_hz) {
        SimulatedTrackerSettings settings;
        settings.rate_hz = rate_hz;
        try {
            const SimulatedEyeTracker tracker(sitting.clock, sitting.observer, 1, settings);
            return true;
        } catch (const Error&) {
            return false;
        }
    };
    CHECK(takes(1.0));
    CHECK(takes(10'000.0));
    CHECK_FALSE(takes(0.999));
    CHECK_FALSE(takes(10'000.1));
    CHECK_FALSE(takes(std::nan("")));
}

TEST_CASE("a drift check is made once the eye is open for more than half of 100 ms", "[unit]") {
    const auto takes = [](SessionDuration before_blink) {
        SimulatedSitting sitting(11, test::without_wandering());
        SimulatedTrackerSettings settings = perfect();
        settings.rate_hz = 1000.0;
        SimulatedEyeTracker tracker(sitting.clock, sitting.observer, 11, settings);
        SessionTime blink(1s);
        while (sitting.observer.gaze_at(blink).state != EyeState::blink)
            blink += 100us;
        sitting.clock.wait_until(blink - before_blink);
        const SessionTime asked = sitting.clock.now();
        const DriftOutcome drift = tracker.drift_check(sitting.observer.scene().screen.centre());
        CHECK(drift.kind == DriftOutcome::Kind::measured);
        CHECK(drift.error.value == Approx(0.0).margin(1e-6));
        return sitting.clock.now() - asked;
    };
    CHECK(takes(57ms) == 100ms);
    CHECK(takes(43ms) > 100ms);
    CHECK(takes(0ms) > 100ms);
    CHECK(takes(150ms) == 100ms);
}

TEST_CASE("a clock that runs a tenth too fast is turned back exactly, and ticks are told to the nearest "
          "microsecond",
          "[unit]") {
    SimulatedSitting sitting(3);
    SimulatedTrackerSettings settings = perfect();
    settings.clock_drift_ppm = 1e5;
    const SimulatedEyeTracker fast(sitting.clock, sitting.observer, 3, settings);
    const TrackerTime origin = fast.tracker_time_at({});
    for (const SessionDuration at : {0s, 1s, 1000s, 5000s}) {
        const TrackerTime shown = fast.tracker_time_at(SessionTime(at));
        CHECK(to_seconds(shown - origin) == Approx(1.1 * to_seconds(at)).margin(2e-6));
        CHECK(to_seconds(fast.session_time_at(shown) - SessionTime(at)) == Approx(0.0).margin(3e-6));
    }
    settings.clock_drift_ppm = 0.0;
    settings.rate_hz = 600.0;
    settings.delivery_latency = {};
    SimulatedEyeTracker tracker(sitting.clock, sitting.observer, 3, settings);
    tracker.start_recording();
    sitting.clock.wait_until(SessionTime(100ms));
    tracker.stop_recording();
    std::array<TrackerItem, 64> items;
    REQUIRE(tracker.poll(items) == 60);
    for (std::size_t i = 0; i < 60; ++i) {
        const double us =
            static_cast<double>(std::get<GazeSample>(items[i]).sampled_at.time_since_epoch().count());
        const double tick = std::round(us * 600e-6);
        CHECK(us == std::round(tick / 600e-6));
    }
}

TEST_CASE("a recording begins with the tick of the instant at which it is started", "[unit]") {
    SimulatedSitting sitting(3);
    SimulatedTrackerSettings settings = perfect();
    settings.clock_drift_ppm = 0.0;
    settings.rate_hz = 1000.0;
    settings.delivery_latency = {};
    SimulatedEyeTracker tracker(sitting.clock, sitting.observer, 3, settings);
    const std::int64_t ms = tracker.tracker_time_at({}).time_since_epoch().count() / 1000 + 7;
    const auto first_from = [&](TrackerTime start, SessionDuration later) {
        const SessionTime at = tracker.session_time_at(start) + later;
        sitting.clock.wait_until(at);
        tracker.start_recording();
        sitting.clock.wait_until(at + 3ms);
        tracker.stop_recording();
        std::array<TrackerItem, 8> items;
        REQUIRE(tracker.poll(items) == 3);
        return std::get<GazeSample>(items[0]).sampled_at;
    };
    CHECK(first_from(tracker_time(1000 * ms), 0ns) == tracker_time(1000 * ms));
    CHECK(first_from(tracker_time(1000 * (ms + 10)), 1ns) == tracker_time(1000 * (ms + 11)));
    CHECK(first_from(tracker_time(1000 * (ms + 20)), -1ns) == tracker_time(1000 * (ms + 20)));
}

TEST_CASE("a drift check takes the first 100 ms of which the eye is open in more than half", "[unit]") {
    int exact_halves = 0;
    for (int i = 0; i < 24; ++i) {
        SimulatedSitting sitting(11, test::without_wandering());
        SimulatedTrackerSettings settings = perfect();
        settings.rate_hz = 20.0; // two samples, or one of them and the next one
        settings.clock_drift_ppm = 0.0;
        SimulatedEyeTracker tracker(sitting.clock, sitting.observer, 11, settings);
        SessionTime blink(1s);
        while (sitting.observer.gaze_at(blink).state != EyeState::blink)
            blink += 1ms;
        const SessionTime asked = blink - 110ms + i * 7ms;
        sitting.clock.wait_until(asked);
        int seen = 0, all = 0;
        const std::int64_t first = tracker.tracker_time_at(asked).time_since_epoch().count() / 50'000 + 1;
        for (std::int64_t tick = first; tracker.session_time_at(tracker_time(50'000 * tick)) < asked + 100ms;
             ++tick) {
            ++all;
            seen += sitting.observer.gaze_at(tracker.session_time_at(tracker_time(50'000 * tick))).state !=
                    EyeState::blink;
        }
        exact_halves += 2 * seen == all;
        tracker.drift_check(sitting.observer.scene().screen.centre());
        CHECK((sitting.clock.now() - asked == 100ms) == (2 * seen > all));
    }
    CHECK(exact_halves > 3);
}

TEST_CASE("an eye that waits for its turn comes first, as long as nothing was lost", "[unit]") {
    for (int wait = 0; wait < 40; ++wait) {
        SimulatedSitting sitting(3);
        SimulatedTrackerSettings settings = perfect();
        settings.rate_hz = 1000.0;
        settings.both_eyes = true;
        settings.delivery_latency = {};
        settings.queue_capacity = 4;
        SimulatedEyeTracker tracker(sitting.clock, sitting.observer, 3, settings);
        sitting.clock.wait_until(SessionTime(1s));
        tracker.start_recording();
        sitting.clock.wait_until(SessionTime(1002ms));
        std::array<TrackerItem, 1> one;
        REQUIRE(tracker.poll(one) == 1);
        const GazeSample left = std::get<GazeSample>(one[0]);
        CHECK(left.eye == Eye::left);
        sitting.clock.wait_until(SessionTime(1002ms) + wait * 100us);
        REQUIRE(tracker.poll(one) == 1);
        const GazeSample next = std::get<GazeSample>(one[0]);
        CHECK((next.eye == Eye::right) == (tracker.overflowed() == 0));
        CHECK((next.sampled_at == left.sampled_at) == (tracker.overflowed() == 0));
    }
}
