/// Gazepoint trackers, and others that speak the Open Gaze API, version 2.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "devices/link/tcp_line.h"
#include "devices/opengaze/opengaze_clock.h"
#include "devices/opengaze/opengaze_link.h"
#include "devices/opengaze/opengaze_marks.h"
#include "devices/opengaze/opengaze_samples.h"
#include "devices/tracker/tracker_driver.h"
#include "experiment/ports/clock.h"

namespace overt {

struct Protocol;

struct OpenGazeSettings {
    /// Where Gazepoint Control listens.
    NetworkAddress server{"127.0.0.1", 4242};
    TrackedPoint point = TrackedPoint::eyes;
    /// Where the stimulus screen lies on the desktop of the tracker's machine, in px; the tracker is told to
    /// track that screen. Nothing: it tracks the one that it is set to.
    std::optional<glm::ivec2> screen_origin_px;
    /// Whether targets are shown by the tracker's own window, on its own machine, and not on the set-up
    /// screen.
    bool own_calibration_screen = false;
    /// Targets of a calibration, as shares of the screen; empty: those that the tracker has.
    std::vector<glm::dvec2> calibration_points;
    /// How long a target is there before it is measured, and how long that takes.
    SessionDuration target_delay = std::chrono::milliseconds(1000),
                    target_time = std::chrono::milliseconds(1250);
    /// The longest time between the time that a record tells and its arrival here. A setting, since no
    /// document names it: on one machine and at 60 Hz records come within some 20 ms (inferred).
    SessionDuration longest_delay = std::chrono::milliseconds(50);
    OpenGazeTimeouts timeouts;
};

/// Samples carry the pupil's diameter in mm, and details the eye's place from the camera's focal point.
/// There is no way to ask the server for its clock: readings of both clocks are bounds, from records' times
/// and arrivals. Marks become USER_DATA of the next record; those that come before it stand there together.
class OpenGazeTracker final : public TrackerDriver {
  public:
    using LineOpener = std::function<std::unique_ptr<ByteTransport>()>;

    /// `clock` must outlive the driver. `open`: makes the connection; else it goes to settings.server.
    OpenGazeTracker(OpenGazeSettings settings, const Clock& clock, LineOpener open = {});
    ~OpenGazeTracker() override;

    TrackerDescription connect(const TrackerWish& wish) override;
    bool calibrates_itself() const noexcept override { return true; }
    SetupOutcome set_up(SetupScreen& setup_screen) override;
    void start() override;
    void stop() noexcept override;
    RecordingState read(TrackerItemSink& sink, SessionTime deadline) noexcept override;
    void send(const TrackerMark& mark) noexcept override;
    std::vector<std::string> finish(const std::string& folder,
                                    const EyeTracker::FileProgress& progress) override;

  private:
    void require(std::string_view id, std::string_view values, std::string_view what);
    void choose_records();
    void choose_screen();
    std::string identity();
    double measure_rate();
    void stream(bool on);

    OpenGazeSettings settings_;
    const Clock& clock_;
    LineOpener open_;
    TrackerWish wish_;
    std::unique_ptr<OpenGazeLink> link_;
    OpenGazeClock tracker_clock_;
    std::optional<OpenGazeSamples> samples_;
    OpenGazeMarks marks_;
    SessionTime started_;
};

/// How a protocol wants Gazepoint's tracker.
OpenGazeSettings opengaze_settings_of(const Protocol& protocol);

} // namespace overt
