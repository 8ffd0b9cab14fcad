/// Whether a file of samples and a file of events are of the same recording.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <span>
#include <string>

#include "experiment/gaze_event.h"

namespace overt {

/// Takes both in the order of their times. The tracker's clock tells most: it began with the tracker, so that
/// another recording's samples lie outside of START and END. Of recordings that are as late, the fixations of
/// the one have other places than the samples of the other.
class AscPairCheck {
  public:
    void samples(std::span<const GazeSample> samples);
    void event(const GazeEvent& event);
    /// Why they do not belong together, as the end of a sentence; empty if they do.
    std::string fault() const;

  private:
    void take_fixation(const GazeEvent& fixation);

    std::int64_t inside_ = 0, outside_ = 0; ///< lines of samples, of recordings
    int agreeing_ = 0, contradicted_ = 0;   ///< fixations that have a place
    bool is_recording_ = false, has_recordings_ = false;
    std::array<std::deque<GazeSample>, 2> latest_; ///< by eye: as many as a fixation may have
};

} // namespace overt
