/// A spoken answer as it is recorded.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "experiment/session_time.h"

namespace overt {

/// A spoken answer: its file, and how that lies in time.
struct RecordedAnswer {
    int trial = -1;
    std::string file;   ///< relative to the session's directory
    std::string sha256; ///< of the file
    std::string device;
    double sample_rate_hz = 0.0;   ///< nominal
    double measured_rate_hz = 0.0; ///< by the session clock
    int bits = 16;
    SessionDuration input_latency{}; ///< as the sound system has it; the times below are before it
    std::int64_t samples = 0;
    double onset_sample = 0.0; ///< index of the sample at the response screen's onset; not whole
    SessionDuration onset_uncertainty{};
    std::int64_t overruns = 0;     ///< of the ring or the sound system
    std::int64_t lost_samples = 0; ///< in them; zeros stand for those that were counted
    double peak_dbfs = 0.0;
    double noise_dbfs = 0.0; ///< root mean square of what is not voice
    std::int64_t clipped_samples = 0;
    std::optional<SessionDuration> voice_onset, voice_end; ///< after the response screen's onset
    std::string fault;                                     ///< why it broke off; empty: it did not
    bool operator==(const RecordedAnswer&) const = default;
};

/// How loud it is now, as shares of full scale.
struct AudioLevel {
    float peak = 0.0f, rms = 0.0f;
    bool is_clipping = false;
};

} // namespace overt
