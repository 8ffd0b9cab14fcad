/// Markers and gaze for those who record along by the Lab Streaming Layer.
#pragma once

#include <memory>
#include <string>

#include "devices/lsl/lsl_library.h"
#include "devices/tracker/live_clock_offset.h"
#include "devices/tracker/tracker_driver.h"
#include "devices/triggers/marker_output.h"
#include "experiment/ports/clock.h"

namespace overt {

/// A stream of markers: name "overt", type "Markers", one channel of text, no rate. Time stamps are when what
/// a marker marks happened, on liblsl's clock.
class LslMarkerOutlet final : public MarkerOutput {
  public:
    /// `session`: tells streams of several sessions apart. `clock` must outlive it. Throws DeviceError if the
    /// stream cannot be opened.
    LslMarkerOutlet(std::shared_ptr<const LslLibrary> library, const std::string& session,
                    const Clock& clock);

    const std::string& name() const noexcept override { return name_; }
    bool needs_code() const noexcept override { return false; }
    /// The text, or the code in figures where there is none.
    bool send(const Marker& marker) noexcept override;
    std::string fault() const override { return "liblsl does not take them"; }

  private:
    std::shared_ptr<const LslLibrary> library_;
    LslOwned<LslStreamOutlet> outlet_;
    const Clock& clock_;
    std::string name_;
};

/// A tracker whose samples are sent on, whatever it is: name "overt gaze", type "Gaze", of each eye place on
/// the screen in px, pupil and confidence, and the tracker's own time in seconds. Time stamps are when it was
/// measured, on liblsl's clock, as the readings of the tracker's clock so far have it; before the first
/// reading arrivals at this program.
class LslGazeRelay final : public TrackerDriver {
  public:
    /// `clock` must outlive it and be that of the readings.
    LslGazeRelay(std::unique_ptr<TrackerDriver> tracker, std::shared_ptr<const LslLibrary> library,
                 std::string session, const Clock& clock);
    ~LslGazeRelay() override;

    TrackerDescription connect(const TrackerWish& wish) override;
    bool tells_events() const noexcept override { return tracker_->tells_events(); }
    bool calibrates_itself() const noexcept override { return tracker_->calibrates_itself(); }
    SetupOutcome set_up(SetupScreen& setup_screen) override { return tracker_->set_up(setup_screen); }
    std::optional<DriftOutcome> drift_check(ScreenPoint target) override {
        return tracker_->drift_check(target);
    }
    void start() override { tracker_->start(); }
    void stop() noexcept override { tracker_->stop(); }
    RecordingState read(TrackerItemSink& sink, SessionTime deadline) noexcept override;
    void send(const TrackerMark& mark) noexcept override { tracker_->send(mark); }
    std::optional<ClockPair> read_clocks() noexcept override;
    void belongs_in(const std::string& folder) noexcept override { tracker_->belongs_in(folder); }
    std::vector<std::string> finish(const std::string& folder,
                                    const EyeTracker::FileProgress& progress) override {
        return tracker_->finish(folder, progress);
    }

  private:
    class Tap;
    std::unique_ptr<TrackerDriver> tracker_;
    std::shared_ptr<const LslLibrary> library_;
    std::string session_;
    const Clock& clock_;
    LiveClockOffset offset_; ///< of the thread that reads
    LslOwned<LslStreamOutlet> outlet_;
    std::unique_ptr<Tap> tap_;
};

} // namespace overt
