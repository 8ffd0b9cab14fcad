#include "devices/simulated/simulated_answer_recorder.h"

#include <algorithm>
#include <cmath>

#include "experiment/base/error.h"
#include "experiment/base/random.h"

namespace overt {

namespace {

constexpr std::size_t block_samples = 256;

class SimulatedRecording final : public AnswerRecording {
  public:
    SimulatedRecording(std::filesystem::path folder, const Trial& trial, const Clock& clock,
                       const SimulatedObserver& observer, std::uint64_t seed,
                       const SimulatedSoundSettings& settings)
        : folder_(std::move(folder)), trial_(trial), clock_(&clock), begun_(clock.now()),
          said_(observer.answer_to(trial)), seed_(seed), settings_(settings) {}

    void response_screen_lit(SessionTime onset) noexcept override { onset_ = onset; }
    /// About as loud as the voice that its file will hold.
    AudioLevel level() const noexcept override {
        const SessionDuration spoken = clock_->now() - onset_;
        const bool speaks =
            onset_ != SessionTime() && spoken >= said_.voice_after && spoken < said_.voice_until;
        const double peak =
            speaks ? std::min(1.0, 0.3 * settings_.gain) : std::pow(10.0, settings_.noise_dbfs / 20.0);
        return {static_cast<float>(peak), static_cast<float>(0.3 * peak), peak >= 1.0};
    }
    void end(SessionTime at) noexcept override { ended_ = at; }
    std::optional<RecordedAnswer> result() override {
        if (!answer_)
            answer_ = make();
        return answer_;
    }

  private:
    RecordedAnswer make() const {
        const SoundFormat format{SimulatedAnswerRecorder::device_name, settings_.sample_rate_hz,
                                 settings_.bits, SessionDuration{}};
        RecordedAnswer answer;
        try {
            AnswerSink sink(folder_, free_answer_name(folder_, trial_.index), format);
            speak(sink);
            answer = sink.finish(onset_, {});
        } catch (const RecordError& failure) {
            answer.device = format.device;
            answer.fault = failure.what();
        }
        answer.trial = trial_.index;
        return answer;
    }

    void speak(AnswerSink& sink) const {
        const double rate_hz = settings_.sample_rate_hz * (1.0 + 1e-6 * settings_.clock_drift_ppm);
        const double onset_s = to_seconds(onset_ - begun_), duration_s = to_seconds(ended_ - begun_);
        SimulatedVoice voice;
        voice.noise_dbfs = settings_.noise_dbfs;
        voice.gain = settings_.gain;
        voice.begin_s = onset_s + to_seconds(said_.voice_after);
        voice.end_s = std::max(voice.begin_s, onset_s + to_seconds(said_.voice_until));
        const auto stream = static_cast<std::uint64_t>(trial_.index);
        const std::vector<float> sound = simulated_sound(voice, rate_hz, duration_s, seed_ + stream);
        RandomStream jitter(seed_, "sound stamps", stream);
        for (std::size_t first = 0; first < sound.size(); first += block_samples) {
            const double at_s = static_cast<double>(first) / rate_hz +
                                jitter.uniform(-settings_.stamp_jitter_s, settings_.stamp_jitter_s);
            sink.add(std::span(sound).subspan(first, std::min(block_samples, sound.size() - first)),
                     begun_ + from_seconds(at_s));
        }
    }

    std::filesystem::path folder_;
    Trial trial_;
    const Clock* clock_;
    SessionTime begun_, onset_, ended_;
    SimulatedAnswer said_;
    std::uint64_t seed_;
    SimulatedSoundSettings settings_;
    std::optional<RecordedAnswer> answer_;
};

} // namespace

std::unique_ptr<AnswerRecording> SimulatedAnswerRecorder::begin(const Trial& trial) {
    return std::make_unique<SimulatedRecording>(folder_, trial, *clock_, *observer_, seed_, settings_);
}

} // namespace overt
