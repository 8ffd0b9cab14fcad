#include "devices/simulated/simulated_eye_tracker.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "devices/tracker/tracker_device.h"
#include "experiment/base/error.h"

namespace overt {

namespace {

constexpr int validation_targets = 9;
constexpr double second_eye_deg = -0.2;
constexpr SessionDuration drift_window = std::chrono::milliseconds(100);
constexpr SessionDuration drift_patience = std::chrono::seconds(2);

/// Two normal deviates and a uniform one for a tick: one Philox block, so that a sample's noise does not
/// depend on which samples were taken before.
struct SampleNoise {
    double x, y, pupil;
};

SampleNoise noise_of(std::uint64_t seed, std::int64_t tick, bool is_second_eye) {
    constexpr std::uint32_t purpose = 0x6761'7a65u; // keep away from other streams
    const std::uint32_t pad = 0x6e6f'6973u + (is_second_eye ? 1u : 0u);
    const auto count = static_cast<std::uint64_t>(tick);
    const std::array<std::uint32_t, 4> bits = philox_4x32_10(
        {static_cast<std::uint32_t>(count), static_cast<std::uint32_t>(count >> 32), purpose, pad},
        {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)});
    const auto uniform = [](std::uint32_t word) { return (word + 0.5) * 0x1p-32; };
    const double radius = std::sqrt(-2.0 * std::log(uniform(bits[0])));
    const double turn = 2.0 * std::numbers::pi * uniform(bits[1]);
    return {radius * std::cos(turn), radius * std::sin(turn), 2.0 * uniform(bits[2]) - 1.0};
}

double rounded(double value, double steps) { return steps > 0.0 ? std::round(value * steps) / steps : value; }

} // namespace

SimulatedTrackerSettings simulated_tracker_settings(const TrackerSettings& settings) {
    SimulatedTrackerSettings simulated;
    simulated.rate_hz = settings.rate_hz;
    simulated.eye = settings.analysed_eye();
    simulated.both_eyes = settings.measures_both_eyes();
    simulated.noise_deg = settings.simulated_noise_deg;
    simulated.accuracy_deg = settings.simulated_accuracy_deg;
    simulated.clock_drift_ppm = settings.simulated_clock_drift_ppm;
    return simulated;
}

SimulatedEyeTracker::SimulatedEyeTracker(Clock& clock, const SimulatedObserver& observer, std::uint64_t seed,
                                         const SimulatedTrackerSettings& settings)
    : clock_(&clock), observer_(&observer), seed_(seed), settings_(settings),
      px_per_deg_(px_per_deg_at_centre(observer.scene().screen)), link_random_(seed, "clock readings") {
    if (!(settings.rate_hz >= 1.0 && settings.rate_hz <= 10000.0)) {
        throw InputError(fmt::format("the simulated eye tracker cannot sample at {} Hz: set rate_hz to a "
                                     "value between 1 and 10000",
                                     settings.rate_hz));
    }
    // It was switched on some hours ago.
    RandomStream random(seed, "tracker clock");
    clock_origin_ns_ = static_cast<std::int64_t>(random.uniform(0.5, 5.0) * 3600e9);
    draw_offset();
}

void SimulatedEyeTracker::draw_offset() {
    RandomStream random(seed_, "calibration offset", offsets_drawn_++);
    offset_deg_ = settings_.accuracy_deg * glm::dvec2(random.normal(), random.normal());
}

TrackerDescription SimulatedEyeTracker::description() const {
    return {"simulated", settings_.rate_hz, settings_.eye, settings_.both_eyes};
}

SetupOutcome SimulatedEyeTracker::set_up(SetupScreen&) {
    RandomStream random(seed_, "validation", calibrations_++);
    draw_offset();
    const glm::dvec2 screen_px = observer_->scene().screen.screen_px;
    ValidationResult result;
    for (int i = 0; i < validation_targets; ++i) {
        const int column = i % 3, row = i / 3;
        const ScreenPoint target{screen_px.x * (0.1 + 0.4 * column), screen_px.y * (0.1 + 0.4 * row)};
        const double right = random.normal(), down = random.normal();
        const double error = settings_.accuracy_deg * std::hypot(right, down);
        const glm::dvec2 away_px = settings_.accuracy_deg * glm::dvec2(right, down) * px_per_deg_;
        result.targets.push_back({settings_.eye,
                                  target,
                                  ScreenPoint{target.x_px + away_px.x, target.y_px + away_px.y},
                                  Degrees{error},
                                  {},
                                  {}});
    }
    result.sum_up();
    return {SetupOutcome::Kind::done, std::move(result), "tracker", {}};
}

DriftOutcome SimulatedEyeTracker::drift_check(ScreenPoint target) {
    const SessionTime patience_ends = clock_->now() + drift_patience;
    while (clock_->now() < patience_ends) {
        const SessionTime begin = clock_->now(), end = begin + drift_window;
        clock_->wait_until(end);
        glm::dvec2 sum(0.0);
        int seen = 0;
        const std::int64_t first = first_tick_from(begin), last = first_tick_from(end);
        for (std::int64_t tick = first; tick < last; ++tick) {
            if (const std::optional<ScreenPoint> gaze = sample_at(tick, offset_deg_, settings_.eye).gaze) {
                sum += glm::dvec2(gaze->x_px, gaze->y_px);
                ++seen;
            }
        }
        if (2 * seen > last - first) {
            const glm::dvec2 mean = sum / static_cast<double>(seen);
            return {DriftOutcome::Kind::measured,
                    observer_->scene().screen.angle_between({mean.x, mean.y}, target)};
        }
    }
    return {};
}

std::optional<ClockPair> SimulatedEyeTracker::read_clocks() noexcept {
    const double trip_s = 1e-4 + link_random_.exponential(1e-4);
    const double outward_s = trip_s * link_random_.uniform();
    ClockPair pair;
    pair.before = clock_->now();
    clock_->wait_until(pair.before + from_seconds(outward_s));
    pair.other = tracker_time_at(clock_->now());
    clock_->wait_until(pair.before + from_seconds(trip_s));
    pair.after = clock_->now();
    return pair;
}

void SimulatedEyeTracker::start_recording() {
    next_tick_ = std::max(next_tick_, first_tick_from(clock_->now()));
    end_tick_ = next_tick_;
    left_is_taken_ = false;
    recorded_offset_deg_ = offset_deg_;
    recording_ = true;
}

void SimulatedEyeTracker::stop_recording() {
    if (!recording_)
        return;
    end_tick_ = std::max(next_tick_, first_tick_from(clock_->now()));
    recording_ = false;
    draw_offset();
}

std::size_t SimulatedEyeTracker::poll(std::span<TrackerItem> into) noexcept {
    const std::int64_t arrived =
        recording_ ? first_tick_from(clock_->now() - settings_.delivery_latency) : end_tick_;
    const std::int64_t kept = arrived - static_cast<std::int64_t>(settings_.queue_capacity);
    if (next_tick_ < kept) {
        overflowed_ += kept - next_tick_;
        next_tick_ = kept;
        left_is_taken_ = false;
    }
    std::size_t taken = 0;
    while (taken < into.size() && next_tick_ < arrived) {
        if (settings_.both_eyes && !left_is_taken_) {
            into[taken++] = sample_at(next_tick_, recorded_offset_deg_, Eye::left);
            left_is_taken_ = true;
            continue;
        }
        into[taken++] =
            sample_at(next_tick_++, recorded_offset_deg_, settings_.both_eyes ? Eye::right : settings_.eye);
        left_is_taken_ = false;
    }
    return taken;
}

std::int64_t SimulatedEyeTracker::tracker_ns_at(SessionTime time) const noexcept {
    const std::int64_t session_ns = time.time_since_epoch().count();
    const double gained_ns = static_cast<double>(session_ns) * settings_.clock_drift_ppm * 1e-6;
    return clock_origin_ns_ + session_ns + static_cast<std::int64_t>(std::floor(gained_ns));
}

SessionTime SimulatedEyeTracker::session_time_of_ns(std::int64_t tracker_ns) const noexcept {
    const std::int64_t elapsed_ns = tracker_ns - clock_origin_ns_;
    const double drift = settings_.clock_drift_ppm * 1e-6;
    const double gained_ns = static_cast<double>(elapsed_ns) * (drift / (1.0 + drift));
    return SessionTime(SessionDuration(elapsed_ns - std::llround(gained_ns)));
}

TrackerTime SimulatedEyeTracker::tracker_time_at(SessionTime time) const noexcept {
    return tracker_time(tracker_ns_at(time) / 1000);
}

SessionTime SimulatedEyeTracker::session_time_at(TrackerTime time) const noexcept {
    return session_time_of_ns(time.time_since_epoch().count() * 1000);
}

std::int64_t SimulatedEyeTracker::ns_of_tick(std::int64_t tick) const noexcept {
    return std::llround(static_cast<double>(tick) * (1e9 / settings_.rate_hz));
}

/// The first tick not before an instant. Estimated in floating point, one too few, and then set right in
/// whole numbers.
std::int64_t SimulatedEyeTracker::first_tick_from(SessionTime time) const noexcept {
    const std::int64_t ns = tracker_ns_at(time);
    std::int64_t tick = std::llround(static_cast<double>(ns) * 1e-9 * settings_.rate_hz) - 1;
    while (ns_of_tick(tick) < ns)
        ++tick;
    return tick;
}

/// A tilt of three degrees, gains of 1.1 and 0.85, a shift, and the bend of a sphere seen from below.
ScreenPoint SimulatedEyeTracker::as_measured(ScreenPoint place) const noexcept {
    const ScreenPoint centre = observer_->scene().screen.centre();
    const double half = centre.x_px, x = (place.x_px - centre.x_px) / half,
                 y = (place.y_px - centre.y_px) / half;
    return {centre.x_px + half * (0.06 + 1.1 * x + 0.05 * y + 0.04 * x * y),
            centre.y_px + half * (-0.03 - 0.05 * x + 0.85 * y + 0.05 * x * x - 0.03 * y * y)};
}

GazeSample SimulatedEyeTracker::sample_at(std::int64_t tick, glm::dvec2 offset_deg, Eye eye) const noexcept {
    const std::int64_t ns = ns_of_tick(tick);
    const SessionTime time = session_time_of_ns(ns);
    const TrueGaze gaze = observer_->gaze_at(time);
    GazeSample sample;
    sample.sampled_at = tracker_time((ns + 500) / 1000);
    sample.eye = eye;
    if (gaze.state == EyeState::blink)
        return sample;
    const bool is_second_eye = settings_.both_eyes && eye == Eye::left;
    const SampleNoise noise = noise_of(seed_, tick, is_second_eye);
    const glm::dvec2 beside_deg(is_second_eye ? second_eye_deg : 0.0, 0.0);
    const glm::dvec2 error_px =
        (offset_deg + beside_deg + settings_.noise_deg * glm::dvec2(noise.x, noise.y)) * px_per_deg_;
    ScreenPoint place{gaze.place.x_px + error_px.x, gaze.place.y_px + error_px.y};
    if (is_second_eye)
        place.x_px += gaze.other_eye_right_px;
    if (settings_.uncalibrated)
        place = as_measured(place);
    sample.gaze =
        ScreenPoint{rounded(place.x_px, settings_.steps_per_px), rounded(place.y_px, settings_.steps_per_px)};
    sample.pupil_area = pupil_area_at(time, noise.pupil);
    return sample;
}

/// In an EyeLink's arbitrary unit, whole numbers: about 1100 with the slow waves of a pupil at rest
/// ("hippus", below 0.5 Hz).
float SimulatedEyeTracker::pupil_area_at(SessionTime time, double noise) const noexcept {
    const double t = 2.0 * std::numbers::pi * to_seconds(time);
    const double area = 1100.0 + 70.0 * std::sin(0.07 * t) + 40.0 * std::sin(0.23 * t + 1.0) + 4.0 * noise;
    return static_cast<float>(std::round(area));
}

template <> TrackerDevice tracker_device_of<kind_called<TrackerKind>("simulated")>() {
    return {.make_tracker = [](const TrackerParts& parts) -> std::unique_ptr<EyeTracker> {
        SimulatedTrackerSettings settings = simulated_tracker_settings(parts.protocol.tracker);
        settings.uncalibrated = parts.protocol.calibration.by == CalibratedBy::overt;
        settings.rate_hz = parts.faults.granted_rate_hz.value_or(settings.rate_hz);
        return std::make_unique<SimulatedEyeTracker>(parts.clock, parts.observer, parts.seed, settings);
    }};
}

} // namespace overt
