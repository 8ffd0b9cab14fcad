/// Eye trackers whose own program sends gaze over the Lab Streaming Layer.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "devices/lsl/lsl_gaze_layout.h"
#include "devices/lsl/lsl_library.h"
#include "devices/lsl/lsl_stream_search.h"
#include "devices/tracker/tracker_driver.h"
#include "experiment/ports/clock.h"

namespace overt {

struct LslInletSettings {
    std::string library;    ///< file of liblsl; empty: see load_lsl()
    LslStreamChoice stream; ///< empty: the only one of gaze
    LslLayoutSettings layout;
    SessionDuration patience = std::chrono::seconds(5);
    /// Of a recording in which no sample comes: the tracker is lost. Streams without a rate may send nothing
    /// while there is nothing new.
    SessionDuration silence = std::chrono::seconds(2), irregular_silence = std::chrono::seconds(10);
};

/// Samples carry the stream's own time stamps; the clock is read by the exchange of times that liblsl makes
/// in the background. The rate is what comes, whatever the stream says. The stream's program calibrates by
/// itself before the session.
class LslInlet final : public TrackerDriver {
  public:
    /// `clock` must go by the machine's monotonic time, as liblsl's does, and outlive the driver.
    LslInlet(LslInletSettings settings, const Clock& clock);
    ~LslInlet() override;

    TrackerDescription connect(const TrackerWish& wish) override;
    /// Nothing is to be done: says who has calibrated.
    SetupOutcome set_up(SetupScreen& setup_screen) override;
    void start() override;
    void stop() noexcept override {}
    RecordingState read(TrackerItemSink& sink, SessionTime deadline) noexcept override;
    std::optional<ClockPair> read_clocks() noexcept override;

  private:
    std::string identity(LslStreamInfo* info) const;
    double measure_rate();
    std::optional<TrackerTime> pull(double timeout_s) noexcept;

    LslInletSettings settings_;
    const Clock& clock_;
    std::shared_ptr<const LslLibrary> library_;
    LslOwned<LslStreamInlet> inlet_{nullptr, {}};
    std::string name_; ///< of the stream, in quotes
    std::optional<LslGazeLayout> layout_;
    std::vector<double> values_; ///< of the sample that was pulled last
    bool is_lost_ = false;
    bool is_regular_ = false;
    SessionTime last_arrival_;
    TrackerTime last_time_{};
};

} // namespace overt
