#include "devices/opengaze/opengaze_calibration.h"

#include <algorithm>

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {
namespace {

constexpr Degrees target_diameter{1.0};
constexpr SessionDuration looking_slice = std::chrono::milliseconds(5);
/// Added to what a calibration takes by its settings, once and for each target.
constexpr SessionDuration patience = std::chrono::seconds(10), target_patience = std::chrono::seconds(2);
constexpr int most_points = 25;

void set_state(OpenGazeLink& link, std::string_view id, bool on) {
    link.set(id, on ? "STATE=\"1\"" : "STATE=\"0\"");
}

/// Gives the number of targets.
int choose_points(OpenGazeLink& link, const OpenGazeSettings& settings) {
    if (settings.calibration_points.empty()) {
        const std::optional<OpenGazeAnswer> points = link.get("CALIBRATE_ADDPOINT");
        return points ? static_cast<int>(points->message().number("PTS").value_or(9.0)) : 9;
    }
    const auto require = [&](std::string_view id, const std::string& values) {
        const std::optional<OpenGazeAnswer> answer = link.set(id, values);
        if (!answer || !answer->is_granted)
            throw DeviceError(
                fmt::format("The eye tracker's server at {} does not take the calibration's points "
                            "({}); leave calibration_points out, and it takes its own.",
                            link.name(), id));
    };
    require("CALIBRATE_CLEAR", "");
    for (const glm::dvec2& point : settings.calibration_points)
        require("CALIBRATE_ADDPOINT", fmt::format("X=\"{:.5f}\" Y=\"{:.5f}\"", point.x, point.y));
    return static_cast<int>(settings.calibration_points.size());
}

void choose_times(OpenGazeLink& link, const OpenGazeSettings& settings) {
    link.set("CALIBRATE_DELAY", fmt::format("VALUE=\"{:.3f}\"", to_seconds(settings.target_delay)));
    link.set("CALIBRATE_TIMEOUT", fmt::format("VALUE=\"{:.3f}\"", to_seconds(settings.target_time)));
}

ScreenPoint place_of(const glm::dvec2& share, const ScreenGeometry& screen) {
    return {share.x * screen.screen_px.x, share.y * screen.screen_px.y};
}

/// What the server says in the end; nothing if the operator broke it off or it took too long.
struct Course {
    std::optional<OpenGazeAnswer> result;
    bool is_cancelled = false;
};

Course follow(OpenGazeLink& link, SetupScreen& setup_screen, const OpenGazeCalibration& calibration,
              SessionTime give_up) {
    Course course;
    while (!course.result && calibration.clock.now() < give_up) {
        if (link.lost())
            throw DeviceError(
                fmt::format("The eye tracker's server at {} was lost during the calibration: {}; start it "
                            "again and connect anew.",
                            link.name(), link.loss()));
        if (setup_screen.wants_out()) {
            course.is_cancelled = true;
            return course;
        }
        const std::optional<OpenGazeAnswer> said = link.next_calibration_message(calibration.clock.now());
        if (!said) {
            setup_screen.wait(looking_slice);
            continue;
        }
        const OpenGazeMessage message = said->message();
        const std::optional<double> x = message.number("CALX"), y = message.number("CALY");
        if (message.value("ID") == "CALIB_RESULT")
            course.result = said;
        else if (message.value("ID") == "CALIB_START_PT" && x && y &&
                 !calibration.settings.own_calibration_screen) {
            setup_screen.show_target(place_of({*x, *y}, calibration.wish.screen), target_diameter);
            setup_screen.beep(Beep::target_appears);
        }
    }
    return course;
}

void add_target(ValidationResult& result, Eye eye, const OpenGazeCalibrationPoint& point,
                const std::optional<glm::dvec2>& measured, const ScreenGeometry& screen) {
    ValidatedTarget target;
    target.eye = eye;
    target.target = place_of(point.target, screen);
    if (measured) {
        target.gaze = place_of(*measured, screen);
        target.error = screen.angle_between(target.target, *target.gaze);
    }
    result.targets.push_back(target);
}

} // namespace

SetupOutcome outcome_of(const OpenGazeMessage& result, const OpenGazeSettings& settings,
                        const TrackerWish& wish) {
    const bool both = wish.both_eyes || settings.point == TrackedPoint::best;
    ValidationResult validation;
    int points = 0;
    while (points < most_points) {
        const std::optional<OpenGazeCalibrationPoint> point = calibration_point(result, points + 1);
        if (!point)
            break;
        ++points;
        if (both || wish.eye == Eye::left)
            add_target(validation, Eye::left, *point, point->left, wish.screen);
        if (both || wish.eye == Eye::right)
            add_target(validation, Eye::right, *point, point->right, wish.screen);
    }
    const int valid = validation.sum_up();
    SetupOutcome outcome;
    outcome.method = fmt::format("tracker, {} points", points);
    if (valid == 0) {
        outcome.kind = SetupOutcome::Kind::failed;
        outcome.message = points == 0 ? "the tracker ended its calibration without a result"
                                      : "the tracker found the eye at none of its targets";
        return outcome;
    }
    outcome.validation = std::move(validation);
    outcome.message = fmt::format("{} of {} measurements at targets are valid; errors are those of the "
                                  "calibration at its own targets, not of a validation",
                                  valid, outcome.validation->targets.size());
    return outcome;
}

SetupOutcome calibrate_opengaze(OpenGazeLink& link, SetupScreen& setup_screen,
                                const OpenGazeCalibration& calibration) {
    const OpenGazeSettings& settings = calibration.settings;
    const int points = choose_points(link, settings);
    choose_times(link, settings);
    set_state(link, "CALIBRATE_SHOW", settings.own_calibration_screen);
    if (settings.own_calibration_screen)
        setup_screen.show_text("The targets are shown by the tracker's own window.\nEscape breaks off.");
    else
        setup_screen.clear();
    link.forget(); // what is still told of an earlier one
    const std::optional<OpenGazeAnswer> begun = link.set("CALIBRATE_START", "STATE=\"1\"");
    if (!begun || !begun->is_granted)
        throw DeviceError(
            fmt::format("The eye tracker's server at {} does not begin to calibrate; see whether "
                        "Gazepoint Control finds the observer's eyes.",
                        link.name()));
    const SessionTime give_up =
        calibration.clock.now() + patience +
        std::clamp(points, 1, most_points) * (settings.target_delay + settings.target_time + target_patience);
    const Course course = follow(link, setup_screen, calibration, give_up);
    if (!course.result)
        set_state(link, "CALIBRATE_START", false);
    set_state(link, "CALIBRATE_SHOW", false);
    setup_screen.clear();
    if (course.is_cancelled)
        return {SetupOutcome::Kind::cancelled, {}, {}, "the calibration was broken off"};
    if (!course.result)
        return {SetupOutcome::Kind::failed, {}, {}, "the tracker did not end its calibration in time"};
    SetupOutcome outcome = outcome_of(course.result->message(), settings, calibration.wish);
    if (const auto summary = link.get("CALIBRATE_RESULT_SUMMARY"); summary && summary->is_granted)
        if (const std::optional<double> error = summary->message().number("AVE_ERROR"))
            outcome.message += fmt::format("; the tracker's own mean error is {:.1f} px", *error);
    return outcome;
}

} // namespace overt
