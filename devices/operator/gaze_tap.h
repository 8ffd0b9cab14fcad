/// Tells the operator's view of gaze as soon as it is known.
#pragma once

#include <array>
#include <chrono>
#include <optional>

#include "devices/operator/operator_server.h"
#include "experiment/ports/clock.h"
#include "experiment/ports/sample_listener.h"

namespace overt {

/// For one thread at a time: the tracker's, or the session's.
class GazeTap final : public SampleListener {
  public:
    /// Between points of the same eye: what the picture of a view can show.
    static constexpr TrackerClock::duration between_points = std::chrono::milliseconds(4);

    /// Both must outlive this.
    GazeTap(OperatorServer& server, const Clock& clock) : server_(server), clock_(clock) {}

    void measured(const GazeSample& sample) noexcept override {
        std::optional<TrackerTime>& told = told_[sample.eye == Eye::left ? 0 : 1];
        if (told && sample.sampled_at >= *told && sample.sampled_at - *told < between_points)
            return;
        told = sample.sampled_at;
        server_.push_gaze({clock_.now(), sample.sampled_at, sample.eye == Eye::right, sample.gaze.has_value(),
                           sample.gaze.value_or(ScreenPoint{})});
    }

  private:
    OperatorServer& server_;
    const Clock& clock_;
    std::array<std::optional<TrackerTime>, 2> told_; ///< by eye
};

} // namespace overt
