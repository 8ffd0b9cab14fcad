/// Fixations, saccades and blinks of a running session: found from its samples as they are written, on the
/// writer's thread, so that the thread that presents has nothing to do with them, and put among the trial's
/// rows.
#pragma once

#include <cstdint>

#include "experiment/events/event_detector.h"
#include "experiment/record/gaze_rows.h"
#include "experiment/record/resumption.h"

namespace overt {

/// Within the caller's transactions. All throw SQLite::Exception.
class SittingEvents final : private EventListener {
  public:
    /// Notes who detects. `rows` must outlive this.
    SittingEvents(GazeRows& rows, int sitting, const SittingDetection& detection);

    /// What follows belongs to the attempt that the rows were begun for.
    void begin_trial();
    /// Nothing is made of samples outside of attempts.
    void sample(const GazeSample& sample);
    /// Writes what is open: the attempt's rows are complete.
    void finish_trial();

  private:
    void detected(const GazeEvent& event) override { rows_.event(event); }

    GazeRows& rows_;
    EventDetector detector_;
    bool in_trial_ = false;
};

} // namespace overt
