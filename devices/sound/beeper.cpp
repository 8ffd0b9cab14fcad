#include "devices/sound/beeper.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "devices/sound/sound_system.h"

namespace overt {
namespace {

constexpr double fade_s = 0.005;
constexpr double longest_silence_s = 2.0;
constexpr double loudness = 0.3; ///< of full scale: to be heard, and not to startle

constexpr BeepTone short_tone[] = {{800.0, 0.08}};
constexpr BeepTone rising_tones[] = {{800.0, 0.1}, {0.0, 0.03}, {1200.0, 0.15}};
constexpr BeepTone falling_tones[] = {{600.0, 0.15}, {0.0, 0.05}, {400.0, 0.3}};
// Of feedback: high is right, low is wrong, and they differ in length too, for who hears no high tones.
constexpr BeepTone middle_tone[] = {{600.0, 0.1}};
constexpr BeepTone high_tone[] = {{1200.0, 0.1}};
constexpr BeepTone low_tone[] = {{300.0, 0.25}};
constexpr BeepTone low_tones[] = {{300.0, 0.1}, {0.0, 0.05}, {300.0, 0.1}};

} // namespace

std::span<const BeepTone> tones_of(Beep beep) noexcept {
    switch (beep) {
    case Beep::target_appears:
        return short_tone;
    case Beep::calibration_good:
    case Beep::drift_good:
        return rising_tones;
    case Beep::calibration_bad:
    case Beep::drift_bad:
        return falling_tones;
    case Beep::answered:
        return middle_tone;
    case Beep::correct:
        return high_tone;
    case Beep::wrong:
        return low_tone;
    case Beep::missed:
        return low_tones;
    }
    return {};
}

void BeepSound::start(Beep beep) noexcept { wanted_ = static_cast<int>(beep); }

float BeepSound::next() noexcept {
    while (!tones_.empty()) {
        const BeepTone& tone = tones_.front();
        const double at_s = static_cast<double>(sample_) / rate_hz_;
        if (at_s >= tone.length_s) {
            tones_ = tones_.subspan(1);
            sample_ = 0;
            continue;
        }
        ++sample_;
        silent_ = 0;
        const double from_end_s = std::min(at_s, tone.length_s - at_s);
        const double fade = std::min(1.0, from_end_s / fade_s);
        return static_cast<float>(loudness * fade * std::sin(2.0 * std::numbers::pi * tone.pitch_hz * at_s));
    }
    ++silent_;
    return 0.0f;
}

void BeepSound::fill(std::span<float> samples) noexcept {
    if (const int wanted = wanted_.exchange(-1); wanted >= 0) {
        tones_ = tones_of(static_cast<Beep>(wanted));
        sample_ = 0;
        silent_ = 0;
    }
    std::ranges::generate(samples, [this] { return next(); });
}

struct Beeper::State {
    SoundSystem system;
    std::string name;
    std::unique_ptr<BeepSound> sound;
    PaStream* stream = nullptr;
    std::int64_t longest_silence = 0; ///< in samples

    ~State() {
        const QuietErrors quiet;
        if (stream)
            Pa_CloseStream(stream);
    }

    static int on_room(const void*, void* output, unsigned long frames, const PaStreamCallbackTimeInfo*,
                       PaStreamCallbackFlags, void* of) {
        auto& state = *static_cast<State*>(of);
        state.sound->fill({static_cast<float*>(output), frames});
        return state.sound->silent_samples() > state.longest_silence ? paComplete : paContinue;
    }
};

Beeper::Beeper() : state_(std::make_unique<State>()) {
    State& state = *state_;
    const PaDeviceIndex device = Pa_GetDefaultOutputDevice();
    const PaDeviceInfo* const info = device == paNoDevice ? nullptr : Pa_GetDeviceInfo(device);
    if (!info)
        throw DeviceError("there is no sound device that plays");
    state.name = fmt::format("{}: {}", Pa_GetHostApiInfo(info->hostApi)->name, info->name);
    state.longest_silence = static_cast<std::int64_t>(longest_silence_s * info->defaultSampleRate);
    state.sound = std::make_unique<BeepSound>(info->defaultSampleRate);
    PaStreamParameters parameters{};
    parameters.device = device;
    parameters.channelCount = 1;
    parameters.sampleFormat = paFloat32;
    parameters.suggestedLatency = info->defaultLowOutputLatency;
    const QuietErrors quiet;
    PaError error = Pa_OpenStream(&state.stream, nullptr, &parameters, info->defaultSampleRate,
                                  paFramesPerBufferUnspecified, paNoFlag, &State::on_room, &state);
    if (error == paNoError)
        error = Pa_StartStream(state.stream);
    if (error != paNoError)
        throw DeviceError(fmt::format("{} does not play: {}", state.name, Pa_GetErrorText(error)));
}

Beeper::~Beeper() = default;

const std::string& Beeper::name() const { return state_->name; }

void Beeper::play(Beep beep) noexcept {
    state_->sound->start(beep);
    if (Pa_IsStreamActive(state_->stream) == 1)
        return;
    Pa_StopStream(state_->stream); // one that rests is not stopped yet
    Pa_StartStream(state_->stream);
}

} // namespace overt
