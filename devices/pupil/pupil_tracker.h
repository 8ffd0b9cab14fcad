/// Pupil Core glasses, by way of Pupil Capture.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "devices/pupil/pupil_link.h"
#include "devices/pupil/pupil_samples.h"
#include "devices/tracker/tracker_driver.h"
#include "experiment/ports/clock.h"

namespace overt {

struct Protocol;

struct PupilSettings {
    /// Where Pupil Remote listens.
    NetworkAddress remote{"127.0.0.1", 50020};
    /// The surface that Pupil Capture knows by its markers, and where it lies on the screen; nothing: it is
    /// the whole screen.
    std::string surface = "screen";
    std::optional<SurfaceOnScreen> surface_place;
    /// Gaze and pupils of less confidence are lost (0 … 1). Pupil Capture's own plugins use 0.6.
    double least_confidence = 0.6;
    /// Whether Pupil Capture records, too, from the first recording of the session to its end.
    bool record = true;
    SessionDuration patience = std::chrono::seconds(5); ///< for an answer at set-up
    SessionDuration calibration_time = std::chrono::minutes(3);
    SessionDuration silence = std::chrono::seconds(2); ///< of a recording: the tracker is lost
};

/// Samples carry the pupil's diameter in mm, details confidence and the eyeball's middle from its eye camera.
/// Marks become annotations. The clock is read by questions.
class PupilTracker final : public TrackerDriver {
  public:
    /// `clock` must go by itself and outlive the driver.
    PupilTracker(PupilSettings settings, const Clock& clock);
    ~PupilTracker() override;

    TrackerDescription connect(const TrackerWish& wish) override;
    bool calibrates_itself() const noexcept override { return true; }
    /// Has Pupil Capture calibrate with its own targets, and waits for its end.
    SetupOutcome set_up(SetupScreen& setup_screen) override;
    void start() override;
    void stop() noexcept override;
    RecordingState read(TrackerItemSink& sink, SessionTime deadline) noexcept override;
    void send(const TrackerMark& mark) noexcept override;
    std::optional<ClockPair> read_clocks() noexcept override;
    std::vector<std::string> finish(const std::string& folder,
                                    const EyeTracker::FileProgress& progress) override;

  private:
    /// What comes in a second, of the wished eye's camera and of gaze: the matching of both eyes tells more
    /// gaze than a camera takes pictures, or less.
    struct Rates {
        double camera_hz = 0.0;
        double gaze_hz = 0.0; ///< on the surface, or where that is not seen at all; 0: none came
    };
    Rates measure_rates();
    /// Of Pupil Capture, where it records for us; false: it did not answer.
    bool end_recording() noexcept;
    void take_published(const PupilMessage& message, TrackerItemSink& sink) noexcept;
    void drop_published() noexcept;
    bool tell(const char* subject, std::string_view content) noexcept;

    PupilSettings settings_;
    const Clock& clock_;
    TrackerWish wish_;
    std::unique_ptr<PupilLink> link_;
    std::string surface_topic_;
    std::optional<PupilSamples> samples_;
    std::optional<ClockPair> last_clocks_;
    SessionTime last_arrival_;
    bool is_recording_ = false;                      ///< Pupil Capture, for us
    bool has_started_ = false, has_surface_ = false; ///< whether gaze on the surface ever came
};

/// How a protocol wants Pupil Core. With tags around the stimulus the surface is what they span.
PupilSettings pupil_settings_of(const Protocol& protocol);

} // namespace overt
