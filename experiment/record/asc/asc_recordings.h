/// The recordings of an ASC file: that each has one START and one END, and what readers need to know before.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <glm/vec2.hpp>

#include "experiment/record/asc/asc_writer.h"

namespace overt {

/// Passes lines on to a writer. A recording that lacks its START gets one before its first sample, one that
/// lacks its END gets one before the next START or at the file's end; an END without a recording is left out.
/// pymovements takes the screen's size for that of the last RECCFG, and fails if there was none: RECCFG and
/// GAZE_COORDS are written before the first START, or before GAZE_COORDS, where the lines have none.
class AscRecordings {
  public:
    AscRecordings(AscWriter& writer, glm::ivec2 screen_px) : writer_(writer), screen_px_(screen_px) {}

    AscWriter& writer() { return writer_; }
    const AscLayout& layout() const { return writer_.layout(); }

    void message(TrackerTime at, std::string_view text);
    /// `text`: as in GazeEvent::Kind::started. Eyes of the samples that follow are added to those it names.
    void start(TrackerTime at, std::string_view text, std::span<const GazeSample> next);
    void end(TrackerTime at, std::string_view resolution);
    void samples(std::span<const GazeSample> instant);
    /// There is nothing more.
    void finish();

  private:
    void need_setup(TrackerTime at);
    TrackerTime after_last_sample() const;

    AscWriter& writer_;
    glm::ivec2 screen_px_;
    bool is_open_ = false, has_setup_ = false, has_mount_ = false, has_coordinates_ = false;
    std::optional<TrackerTime> last_sample_;
    TrackerTime started_;
    std::string tracking_{usual_tracking}; ///< of the last START
};

} // namespace overt
