/// One spoken answer on its way into a file, with all that is measured of it.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "devices/sound/wav_file.h"
#include "experiment/audio/sample_clock.h"
#include "experiment/audio/voice_finder.h"
#include "experiment/ports/recorded_answer.h"

namespace overt {

/// What a recording comes from.
struct SoundFormat {
    std::string device;
    int sample_rate_hz = 48000;
    int bits = 16;
    SessionDuration input_latency{};
};

/// A name under `answers/` in a session's folder that no file has yet: trial_03.wav, or trial_03_2.wav for a
/// later attempt. Makes the folder. Throws RecordError.
std::string free_answer_name(const std::filesystem::path& folder, int trial);

/// One thread. Errors of writing are kept in the answer's `fault`, not thrown: a session goes on without.
class AnswerSink {
  public:
    /// `folder` is the session's, `name` relative to it.
    AnswerSink(const std::filesystem::path& folder, const std::string& name, const SoundFormat& format);

    /// The next samples, of which the first was taken at `at` as far as the sound system knows.
    void add(std::span<const float> samples, SessionTime at);
    /// So many samples did not come: zeros stand for them, so that later ones keep their place.
    void add_gap(std::int64_t lost);
    void count_overrun() { ++answer_.overruns; }

    AudioLevel level() const { return level_; } ///< of the last samples

    /// Closes the file. `onset`: of the response screen. `fault`: why it ends early, or empty.
    RecordedAnswer finish(SessionTime onset, const std::string& fault);

  private:
    void write(std::span<const float> samples);

    std::filesystem::path folder_;
    RecordedAnswer answer_;
    SampleClock clock_;
    VoiceFinder voice_;
    std::unique_ptr<WavFile> file_; ///< null after a failure
    AudioLevel level_;
};

} // namespace overt
