/// The frames of a presentation as they were lit, each with the gaze that fell on it.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "experiment/maps/surface_point.h"
#include "experiment/record/read/session_record.h"

namespace overt {

/// One frame period of a presentation.
struct ShownFrame {
    int number = 1;                             ///< of `count` in the presentation
    double begin_s = 0.0, end_s = 0.0;          ///< since the presentation's first light
    std::optional<AnimationFrameIndex> planned; ///< by the protocol
    std::optional<LitFrame> lit;                ///< in the middle of the period; nothing: nothing was lit
    int samples = 0;                            ///< taken in the period
    std::vector<glm::dvec2> gaze_px;            ///< of those with gaze, in the image
    std::optional<glm::dvec2> mean_px;
    std::optional<SurfacePoint> surface; ///< at the mean gaze, on the frame that was lit
};

/// Reads one attempt, as the presentation in its slot (TrialRecord::seen_in). `lookup`, null if there is no
/// surface, must outlive it.
class ShownFrames {
  public:
    /// Throws InputError for an attempt that showed nothing, RecordError.
    ShownFrames(const SessionRecord& record, const TrialRecord& trial, const SurfaceLookup* lookup);

    /// Periods of the presentation, the last as far as it was lit.
    int count() const { return count_; }
    double rate_hz() const { return 1.0 / period_s_; }
    /// 1 … count().
    ShownFrame frame(int number) const;

  private:
    struct TimedGaze {
        double at_s; ///< since the first light
        std::optional<glm::dvec2> image_px;
    };
    const SessionRecord& record_;
    const SurfaceLookup* lookup_;
    ScreenGeometry screen_; ///< with the slot's image
    FlipHistory history_;
    SessionTime first_light_;
    double period_s_ = 0.0;
    int count_ = 0;
    std::vector<TimedGaze> gaze_; ///< in the order of their times
};

/// The attempt at a trial, counted from 1, that counts, else the last. Throws InputError naming the trials
/// that there are.
const TrialRecord& attempt_at(const SessionRecord& record, int trial);

} // namespace overt
