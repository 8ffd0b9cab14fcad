#include "devices/tobii/tobii_calibration.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {
namespace {

using namespace std::chrono_literals;

constexpr SessionDuration looking_slice = 5ms;
/// A target appears larger, which draws the eye, and shrinks while it is waited for.
constexpr double appears_larger = 2.0;
constexpr int steps_of_shrinking = 10;

constexpr std::int32_t valid_and_used = 1;

class Course {
  public:
    Course(std::shared_ptr<const TobiiLibrary> library, TobiiEyeTracker* tracker, SetupScreen& setup_screen,
           const TobiiSettings& settings)
        : library_(std::move(library)), tracker_(tracker), setup_screen_(setup_screen), settings_(settings) {
        if (const TobiiStatus status = library_->enter_calibration(tracker_); status != tobii_ok)
            throw DeviceError(fmt::format("The eye tracker does not begin to calibrate ({}).",
                                          describe_tobii_status(status)));
    }
    Course(const Course&) = delete;
    Course& operator=(const Course&) = delete;
    ~Course() {
        setup_screen_.clear();
        if (answers_)
            library_->leave_calibration(tracker_);
    }

    bool is_cancelled() {
        is_cancelled_ = setup_screen_.wants_out() || is_cancelled_;
        return is_cancelled_;
    }

    /// False: the tracker could not measure there, or it was cancelled.
    bool measure(ScreenPoint target) {
        for (int step = steps_of_shrinking; step >= 0; --step) {
            const double factor = 1.0 + (appears_larger - 1.0) * step / steps_of_shrinking;
            setup_screen_.show_target(target, Degrees{factor * settings_.target.value});
            if (step == steps_of_shrinking)
                setup_screen_.beep(Beep::target_appears);
            setup_screen_.wait(settings_.target_delay / (steps_of_shrinking + 1));
            if (is_cancelled())
                return false;
        }
        const auto [x, y] = share_of(target);
        return finish_of([library = library_, tracker = tracker_, x = x, y = y] {
                   return library->collect_data(tracker, x, y);
               }) == tobii_ok;
    }

    void discard(ScreenPoint target) {
        const auto [x, y] = share_of(target);
        library_->discard_data(tracker_, x, y);
    }

    /// Throws DeviceError; nothing to free is left behind.
    std::shared_ptr<TobiiCalibrationResult> compute() {
        const auto result = std::make_shared<TobiiCalibrationResult*>(nullptr);
        const TobiiStatus status = finish_of([library = library_, tracker = tracker_, result] {
            return library->compute_and_apply(tracker, result.get());
        });
        if (status != tobii_ok || !*result)
            throw DeviceError(fmt::format("The eye tracker does not compute its calibration ({}).",
                                          describe_tobii_status(status)));
        return {*result, [library = library_](TobiiCalibrationResult* made) {
                    library->free_calibration_result(made);
                }};
    }

  private:
    std::pair<float, float> share_of(ScreenPoint target) const {
        const glm::dvec2 size = setup_screen_.geometry().screen_px;
        return {static_cast<float>(target.x_px / size.x), static_cast<float>(target.y_px / size.y)};
    }

    /// Calls what takes its time on a thread of its own, so that the window stays alive. One that never comes
    /// back is left to itself: what it holds it holds by itself.
    TobiiStatus finish_of(std::function<TobiiStatus()> call) {
        std::packaged_task<TobiiStatus()> task(std::move(call));
        std::future<TobiiStatus> status = task.get_future();
        std::thread(std::move(task)).detach();
        const SessionTime give_up = setup_screen_.now() + settings_.calibration_patience;
        while (status.wait_for(0s) != std::future_status::ready) {
            is_cancelled();
            if (setup_screen_.now() >= give_up) {
                answers_ = false;
                throw DeviceError(
                    "The eye tracker does not end what it was to do for its calibration: see its "
                    "cables, and begin the session anew.");
            }
            setup_screen_.wait(looking_slice);
        }
        return status.get();
    }

    std::shared_ptr<const TobiiLibrary> library_;
    TobiiEyeTracker* tracker_;
    SetupScreen& setup_screen_;
    const TobiiSettings& settings_;
    bool is_cancelled_ = false, answers_ = true;
};

ScreenPoint place_of(TobiiPoint2 share, const ScreenGeometry& screen) {
    return {share.x * static_cast<double>(screen.screen_px.x),
            share.y * static_cast<double>(screen.screen_px.y)};
}

/// What an eye's samples that went into the calibration say at a target.
ValidatedTarget measured_at(const TobiiCalibrationPoint& point, Eye eye, const ScreenGeometry& screen) {
    ValidatedTarget target;
    target.eye = eye;
    target.target = place_of(point.on_display, screen);
    std::vector<ScreenPoint> used;
    for (std::size_t i = 0; i < point.sample_count; ++i) {
        const TobiiCalibrationSample& sample = point.samples[i];
        const TobiiCalibrationEye& of_eye = eye == Eye::left ? sample.left : sample.right;
        if (of_eye.validity == valid_and_used)
            used.push_back(place_of(of_eye.on_display, screen));
    }
    if (used.empty())
        return target;
    const auto count = static_cast<double>(used.size());
    ScreenPoint mean{0.0, 0.0};
    for (const ScreenPoint& place : used) {
        mean.x_px += place.x_px / count;
        mean.y_px += place.y_px / count;
    }
    target.gaze = mean;
    target.error = screen.angle_between(target.target, mean);
    double squares = 0.0;
    for (const ScreenPoint& place : used)
        squares += std::pow(screen.angle_between(place, mean).value, 2);
    target.sd = Degrees{std::sqrt(squares / count)};
    return target;
}

SetupOutcome outcome_of(const TobiiCalibrationResult& result, const TrackerWish& wish) {
    SetupOutcome outcome;
    outcome.method = fmt::format("tracker, {} points", result.point_count);
    const auto is_calibrated = [&](Eye eye) {
        return result.status != tobii_calibration_failed &&
               result.status != (eye == Eye::left ? tobii_calibrated_right : tobii_calibrated_left);
    };
    if (!is_calibrated(wish.eye)) {
        outcome.kind = SetupOutcome::Kind::failed;
        outcome.message = result.status == tobii_calibration_failed
                              ? "the tracker found too little for a calibration"
                              : fmt::format("the tracker could calibrate the other eye only, not the {} one",
                                            wish.eye == Eye::left ? "left" : "right");
        return outcome;
    }
    ValidationResult validation;
    for (std::size_t i = 0; i < result.point_count; ++i)
        for (const Eye eye : {Eye::left, Eye::right})
            if ((wish.both_eyes || eye == wish.eye) && is_calibrated(eye))
                validation.targets.push_back(measured_at(result.points[i], eye, wish.screen));
    const int measured = validation.sum_up();
    outcome.message = fmt::format("{} of {} measurements at targets went into it; errors are those of the "
                                  "calibration at its own targets, not of a validation",
                                  measured, validation.targets.size());
    if (wish.both_eyes && !is_calibrated(wish.eye == Eye::left ? Eye::right : Eye::left))
        outcome.message += "; the other eye could not be calibrated";
    if (measured > 0)
        outcome.validation = std::move(validation);
    return outcome;
}

} // namespace

SetupOutcome calibrate_tobii(std::shared_ptr<const TobiiLibrary> library, TobiiEyeTracker* tracker,
                             SetupScreen& setup_screen, const TobiiSettings& settings,
                             const TrackerWish& wish) {
    Course course(std::move(library), tracker, setup_screen, settings);
    for (const ScreenPoint target : settings.calibration_points) {
        if (course.measure(target))
            continue;
        if (course.is_cancelled())
            break;
        course.discard(target);
        setup_screen.beep(Beep::calibration_bad);
        course.measure(target);
    }
    if (course.is_cancelled())
        return {SetupOutcome::Kind::cancelled, {}, {}, "the calibration was broken off"};
    const std::shared_ptr<TobiiCalibrationResult> result = course.compute();
    SetupOutcome outcome = outcome_of(*result, wish);
    setup_screen.beep(outcome.kind == SetupOutcome::Kind::done ? Beep::calibration_good
                                                               : Beep::calibration_bad);
    return outcome;
}

} // namespace overt
