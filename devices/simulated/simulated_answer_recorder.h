/// The sound device of a simulated observer: what it says is known to the sample.
#pragma once

#include <filesystem>

#include "devices/simulated/simulated_observer.h"
#include "devices/simulated/simulated_voice.h"
#include "devices/sound/answer_sink.h"
#include "experiment/ports/answer_recorder.h"
#include "experiment/ports/clock.h"

namespace overt {

struct SimulatedSoundSettings {
    int sample_rate_hz = 48000;
    int bits = 16;
    double noise_dbfs = -60.0;
    double clock_drift_ppm = 25.0; ///< by which the device's seconds are shorter than the session's
    double stamp_jitter_s = 0.001; ///< to both sides, of each block's time stamp
    double gain = 1.0;             ///< what is beyond full scale is clipped
};

/// When the recording ends its sound is made, at once and on the thread that ends it: time may be virtual,
/// and the same seeds give the same files.
class SimulatedAnswerRecorder final : public AnswerRecorder {
  public:
    /// Clock and observer must outlive this.
    SimulatedAnswerRecorder(const Clock& clock, const SimulatedObserver& observer, std::uint64_t seed,
                            const SimulatedSoundSettings& settings = {})
        : clock_(&clock), observer_(&observer), seed_(seed), settings_(settings) {}

    void keep_in(const std::filesystem::path& folder) { folder_ = folder; }
    std::unique_ptr<AnswerRecording> begin(const Trial& trial) override;

    static constexpr const char* device_name = "simulated sound device";

  private:
    const Clock* clock_;
    const SimulatedObserver* observer_;
    std::uint64_t seed_;
    SimulatedSoundSettings settings_;
    std::filesystem::path folder_;
};

} // namespace overt
