/// Steps of the first day at the eye tracker.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "app/cli/own_folders.h"
#include "app/doctor/first_day_steps.h"
#include "app/inputs/protocol_inputs.h"
#include "app/tracker/tracker_commands.h"
#include "experiment/base/error.h"
#include "experiment/ports/tracker_kinds.h"

namespace overt {
namespace {

constexpr double most_lost_percent = 0.1;
constexpr double most_rate_error = 0.02; ///< of the rate asked for, as is_same_rate() has it
/// A clock that runs on steadily lies within this of its line: less than a sample of most trackers.
constexpr double most_off_line_us = 1000.0;
constexpr double longest_stream_s = 3600.0;

/// Nothing where there is one to be measured.
std::optional<RigStep> missing_tracker(const FirstDay& day) {
    if (row_of(day.protocol.tracker.kind).measures_gaze)
        return std::nullopt;
    return not_proved("The protocol has no eye tracker ([tracker] kind = \"none\").",
                      "nothing, if sessions are to have none");
}

RigStep with_model(RigStep step, const FirstDay& day, const TrackerDescription& tracker) {
    add_model_fact(step.facts, tracker);
    return row_of(day.protocol.tracker.kind).is_made_up ? as_simulated(std::move(step), "the eye tracker")
           : name_of(day.protocol.tracker.kind) == "mouse"
               ? as_simulated(std::move(step), "the mouse stands in for an eye tracker")
               : step;
}

constexpr const char* to_look_at =
    "see that an observer sits before the tracker and that its cable and network carry it (overt tracker "
    "test); where its rate alone is another, write that as [tracker] rate_hz; repeat this step";

} // namespace

RigStep measure_gaze_stream(const FirstDay& day) {
    if (std::optional<RigStep> none = missing_tracker(day))
        return *none;
    const MeasuredStream stream = measure_stream(day.protocol, day.options.seconds);
    const StreamFigures& figures = stream.figures;
    const double wished_hz = day.protocol.tracker.rate_hz;
    BenchFigures measured{
        at_most("interruptions of the connection", stream.is_lost ? 1.0 : 0.0, "", 0.0),
        at_least("samples", static_cast<double>(figures.samples()), "", 1.0),
        at_most("samples out of order or repeated",
                static_cast<double>(figures.out_of_order() + figures.repeated()), "", 0.0),
        at_most("gaps that the tracker told", static_cast<double>(figures.gaps()), "", 0.0)};
    for (const Eye eye : {Eye::left, Eye::right}) {
        if (!figures.has(eye))
            continue;
        const std::string which = eye == Eye::left ? "left" : "right";
        const double rate_hz = figures.rate_hz(eye).value_or(0.0);
        const auto missing = static_cast<double>(figures.missing(eye));
        const double all = rate_hz * stream.seconds;
        measured.push_back(at_most(which + " eye: distance of its rate from the one asked for",
                                   std::abs(rate_hz - wished_hz), "Hz", most_rate_error * wished_hz));
        measured.push_back(at_most(which + " eye: samples that are missing",
                                   all > 0.0 ? 100.0 * missing / all : 100.0, "%", most_lost_percent));
        measured.push_back({which + " eye: rate", rate_hz, "Hz"});
        measured.push_back(
            {which + " eye: longest time between samples", figures.longest_interval_ms(eye), "ms"});
    }
    const auto without = static_cast<double>(figures.without_gaze());
    measured.push_back(
        {"samples without gaze",
         figures.samples() > 0 ? 100.0 * without / static_cast<double>(figures.samples()) : 0.0, "%"});
    RigStep step =
        judged(std::move(measured),
               fmt::format("{} samples came in {:.0f} s.", figures.samples(), stream.seconds), to_look_at);
    return with_model(std::move(step), day, stream.tracker);
}

RigStep measure_accuracy(const FirstDay& day) {
    if (std::optional<RigStep> none = missing_tracker(day))
        return *none;
    if (day.is_headless() && !day.options.simulate_observer)
        return not_proved("There is no screen here on which targets could be shown.",
                          "repeat this step where a monitor is connected");
    Experiment experiment =
        read_experiment_or_report(day.options.protocol, cache_folder(), InputDepth::objects);
    experiment.protocol = day.protocol;
    TrackerCalibrateOptions wish;
    wish.context = day.doctor_options().context;
    wish.virtual_time = day.is_headless() && !row_of(day.protocol.tracker.kind).is_hardware();
    wish.windowed = day.options.windowed;
    wish.monitor = day.options.monitor;
    wish.simulate_observer = day.options.simulate_observer;
    const TriedCalibration tried = calibrate_on(experiment, wish);
    if (!tried.calibration)
        return not_proved(fmt::format("The tracker was not calibrated{}{}.",
                                      tried.why_not.empty() ? "" : ": ", tried.why_not),
                          "calibrate it to its end, and repeat this step");
    const ValidationResult& validation = tried.calibration->validation;
    if (validation.targets.empty() && validation.mean_error.value == 0.0)
        return not_proved(
            fmt::format("{}: the tracker told no errors of its validation.", tried.calibration->method),
            "write [calibration] by = \"overt\", which measures them, or look at the tracker's "
            "own display");
    const CalibrationKeys& limits = day.protocol.calibration;
    BenchFigures figures{at_most("mean error", validation.mean_error.value, "deg", limits.mean_limit_deg),
                         at_most("largest error", validation.max_error.value, "deg", limits.max_limit_deg),
                         {"targets", static_cast<double>(validation.targets.size()), ""}};
    const auto unseen =
        std::ranges::count_if(validation.targets, [](const ValidatedTarget& target) { return !target.gaze; });
    figures.push_back(at_most("targets that were not seen", static_cast<double>(unseen), "", 0.0));
    RigStep step = judged(
        std::move(figures),
        fmt::format("Calibration: {}; at known targets gaze is off by {:.2f} deg in the mean and {:.2f} "
                    "deg at most.",
                    tried.calibration->method, validation.mean_error.value, validation.max_error.value),
        "see that tracker, screen and chair stand as in sessions and that [display] has the "
        "screen's true size and distance; clean glasses; repeat this step");
    step = with_model(std::move(step), day, tried.tracker);
    return day.options.simulate_observer && !step.is_simulated ? as_simulated(std::move(step), "the observer")
                                                               : step;
}

RigStep measure_clock(const FirstDay& day) {
    if (std::optional<RigStep> none = missing_tracker(day))
        return *none;
    const double seconds = std::min(longest_stream_s, 60.0 * day.options.clock_minutes);
    const MeasuredStream stream = measure_stream(day.protocol, seconds, std::min(1.0, seconds / 10.0));
    const StreamFigures& figures = stream.figures;
    const std::optional<ClockMap> clock = figures.clock();
    if (!clock)
        return with_model(not_proved("This tracker offers no way to compare its clock: its samples are timed "
                                     "when they come.",
                                     "count with what the link takes (docs/trackers.md says how long)"),
                          day, stream.tracker);
    RigStep step = judged(
        {at_most("interruptions of the connection", stream.is_lost ? 1.0 : 0.0, "", 0.0),
         at_least("readings of both clocks", static_cast<double>(figures.clock_readings()), "", 3.0),
         at_most("reading farthest off the line", *figures.worst_off_line_us(), "µs", most_off_line_us),
         at_most("size of the drift", std::abs(clock->drift_ppm()), "ppm",
                 ClockMapOf<TrackerClock>::largest_drift_ppm),
         {"drift of the tracker's clock", -clock->drift_ppm(), "ppm"},
         {"the drift's uncertainty", clock->drift_uncertainty_ppm(), "ppm"},
         {"half a round trip, shortest", figures.best_half_trip_us().value_or(0.0), "µs"},
         {"watched for", figures.clock_span_s(), "s"}},
        fmt::format("Over {:.0f} s the tracker's clock ran {:+.1f} ± {:.1f} ppm against this computer's.",
                    figures.clock_span_s(), -clock->drift_ppm(), clock->drift_uncertainty_ppm()),
        "see that nothing sets this computer's or the tracker's clock meanwhile, and that the network to it "
        "has no other load; repeat this step");
    return with_model(std::move(step), day, stream.tracker);
}

} // namespace overt
