/// A calibration of the program's own, for trackers that have none: targets are shown one after another, what
/// the tracker measures while gaze rests is fitted to them, and the fit is validated at other places.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "experiment/base/random.h"
#include "experiment/calibration/calibration_settings.h"
#include "experiment/calibration/gaze_fit.h"
#include "experiment/calibration/resting_gaze.h"
#include "experiment/ports/clock.h"
#include "experiment/ports/eye_tracker.h"

namespace overt {

/// Where the targets of a calibration stand: 3 in a triangle, 5 in the middle and the corners, 9 in a grid,
/// 13 with four more halfway to the corners. The first is in the middle, where there is one. On even pixels,
/// where every output mode can show them. `area`: share of the screen that they span.
std::vector<ScreenPoint> calibration_targets(int points, double area, const ScreenGeometry& screen);

/// Where those of the validation stand, likewise, at other places.
std::vector<ScreenPoint> validation_targets(const CalibrationSettings& settings,
                                            const ScreenGeometry& screen);

/// A tracker whose gaze is calibrated by the program. All but calibration is the tracker's own.
class CalibratedTracker final : public EyeTracker {
  public:
    /// `clock` must outlive this. `seed`: of the order of the targets.
    CalibratedTracker(std::unique_ptr<EyeTracker> tracker, Clock& clock, const CalibrationSettings& settings,
                      std::uint64_t seed);

    TrackerDescription description() const override { return tracker_->description(); }
    bool measures_gaze() const noexcept override { return tracker_->measures_gaze(); }
    bool tells_events() const noexcept override { return tracker_->tells_events(); }
    bool calibrates_itself() const noexcept override { return false; }

    /// Targets in random order, each until gaze rested (or the space bar was pressed while it did); those
    /// that were missed, or that the fit to the others misses by far, come a second time. Then the
    /// validation. Keys: space takes what rests now, backspace shows the target before again, escape ends it.
    SetupOutcome set_up(SetupScreen& setup_screen) override;

    DriftOutcome drift_check(ScreenPoint target) override;
    std::optional<ClockPair> read_clocks() noexcept override { return tracker_->read_clocks(); }
    void start_recording() override;
    void stop_recording() override { tracker_->stop_recording(); }
    std::size_t poll(std::span<TrackerItem> into) noexcept override;
    bool tell_samples_to(SampleListener* listener) override;
    RecordingState recording_state() const noexcept override { return tracker_->recording_state(); }
    void reconnect() override;
    void mark(const TrackerMark& mark) noexcept override { tracker_->mark(mark); }
    void belongs_in(const std::string& folder) noexcept override { tracker_->belongs_in(folder); }
    std::vector<std::string> finish(const std::string& folder, const FileProgress& progress) override {
        return tracker_->finish(folder, progress);
    }

  private:
    using Fits = std::array<GazeFit, 2>; ///< by Eye
    /// Passes samples on as poll() gives them, on the tracker's thread: with fits of its own, taken over
    /// before a recording begins.
    struct Corrected final : SampleListener {
        void measured(const GazeSample& sample) noexcept override;
        Fits fits;
        SampleListener* listener = nullptr;
    };
    enum class Looked : std::uint8_t { rested, missed, back, cancelled };
    using Eyes = std::array<std::optional<RestedGaze>, 2>; ///< by Eye
    struct Visit {
        ScreenPoint target;
        Eyes gaze;
    };
    Looked look_at(SetupScreen& setup_screen, ScreenPoint target, Eyes& found);
    /// False: cancelled.
    bool visit_all(SetupScreen& setup_screen, std::vector<Visit>& visits);
    bool visit(SetupScreen& setup_screen, std::vector<Visit>& visits, std::vector<std::size_t> order);
    void take_samples(std::array<RestingGaze, 2>& eyes);
    std::vector<CalibrationPair> pairs_of(const std::vector<Visit>& visits, Eye eye) const;
    std::vector<std::size_t> to_visit_again(const std::vector<Visit>& visits,
                                            const ScreenGeometry& screen) const;
    ValidationResult result_of(const std::vector<Visit>& visits, const ScreenGeometry& screen) const;
    std::vector<Eye> eyes() const;

    std::unique_ptr<EyeTracker> tracker_;
    Clock* clock_;
    CalibrationSettings settings_;
    std::uint64_t seed_, set_ups_ = 0;
    Fits fits_;
    ScreenGeometry screen_; ///< of the last set-up
    Corrected told_;
};

} // namespace overt
