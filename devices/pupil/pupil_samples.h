/// From what Pupil Capture publishes to samples.
#pragma once

#include <array>
#include <cstddef>

#include "devices/pupil/pupil_message.h"
#include "devices/tracker/tracker_driver.h"

namespace overt {

/// Where a surface lies on the screen.
struct SurfaceOnScreen {
    ScreenPoint top_left;
    double width_px = 0.0, height_px = 0.0;
    /// `place`: share of the surface with y upward.
    ScreenPoint on_screen(const glm::dvec2& place) const noexcept {
        return {top_left.x_px + place.x * width_px, top_left.y_px + (1.0 - place.y) * height_px};
    }
};

/// What one eye's camera measured last, so long that gaze which comes late still finds its pupil: Pupil
/// Capture pairs the eyes, waits for the other one after a blink, and tells gaze of a surface with the scene
/// camera's next picture. 0.6 s at 200 Hz, each picture measured in 2D and in 3D.
class PupilHistory {
  public:
    /// Each picture is measured in 2D and in 3D; what only one of them tells is kept.
    void take(const PupilDatum& pupil) noexcept;
    /// The one that was measured nearest to this time; null: none within two pictures of a camera of 60 Hz.
    const PupilDatum* nearest(double time_s) const noexcept;

  private:
    std::array<PupilDatum, 128> pupils_{};
    std::size_t count_ = 0, next_ = 0;
};

/// Nothing allocates or throws.
class PupilSamples {
  public:
    /// Gaze of less confidence is lost.
    PupilSamples(const TrackerWish& wish, const SurfaceOnScreen& surface, double least_confidence) noexcept;

    void begin() noexcept { *this = PupilSamples(eye_, both_eyes_, surface_, least_confidence_); }

    /// Remembers the eye's pupil for the samples to come, and for those that come late.
    void take(const PupilDatum& pupil) noexcept;

    /// Puts a sample of the wished eye, or one of each, the left first. Gaze that was reckoned from the other
    /// eye alone is none of this one's. Gaze that is not later than the last is dropped: Pupil Capture pairs
    /// eyes, and tells some pairs late.
    void take(const SurfaceGaze& gaze, TrackerItemSink& sink) noexcept;

    void take_noise(TrackerItemSink& sink) const noexcept;
    TrackerTime last_time() const noexcept { return last_time_; }

  private:
    PupilSamples(Eye eye, bool both_eyes, const SurfaceOnScreen& surface, double least_confidence) noexcept;
    void put_eye(Eye eye, const SurfaceGaze& gaze, bool is_its_own, TrackerItemSink& sink) const noexcept;

    Eye eye_;
    bool both_eyes_;
    SurfaceOnScreen surface_;
    double least_confidence_;
    std::array<PupilHistory, 2> pupils_; ///< left, right
    TrackerTime last_time_{};
    bool has_time_ = false;
};

} // namespace overt
