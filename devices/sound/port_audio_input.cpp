#include "devices/sound/port_audio_input.h"

#include <algorithm>

#include <fmt/format.h>

#include "devices/sound/sound_system.h"
#include "experiment/base/error.h"

namespace overt {

namespace {

struct SoundInput {
    PaDeviceIndex index;
    SoundInputInfo info;
};

std::vector<SoundInput> inputs_of(const SoundSystem&) {
    std::vector<SoundInput> devices;
    for (PaDeviceIndex i = 0; i < Pa_GetDeviceCount(); ++i) {
        const PaDeviceInfo* const info = Pa_GetDeviceInfo(i);
        if (info->maxInputChannels > 0)
            devices.push_back(
                {i,
                 {fmt::format("{}: {}", Pa_GetHostApiInfo(info->hostApi)->name, info->name),
                  i == Pa_GetDefaultInputDevice(), info->defaultSampleRate, info->defaultLowInputLatency}});
    }
    return devices;
}

std::optional<SoundInput> choose(const std::vector<SoundInput>& devices, const std::string& name) {
    const auto found = std::find_if(devices.begin(), devices.end(), [&](const SoundInput& device) {
        return name.empty() ? device.info.is_default : device.info.name.find(name) != std::string::npos;
    });
    return found == devices.end() ? std::nullopt : std::optional(*found);
}

} // namespace

std::vector<SoundInputInfo> sound_inputs() {
    std::vector<SoundInputInfo> inputs;
    for (const SoundInput& device : inputs_of(SoundSystem()))
        inputs.push_back(device.info);
    return inputs;
}

std::optional<SoundInputInfo> sound_input_called(const std::string& name) {
    const auto device = choose(inputs_of(SoundSystem()), name);
    return device ? std::optional(device->info) : std::nullopt;
}

struct PortAudioInput::State {
    SoundSystem system;
    const Clock* clock = nullptr;
    SoundRing* ring = nullptr;
    PaStream* stream = nullptr;
    std::string name;
    double rate_hz = 0.0;
    SessionDuration latency{};
    std::int64_t samples = 0; ///< the callback's

    ~State() {
        if (stream)
            Pa_CloseStream(stream);
    }

    static int on_sound(const void* input, void*, unsigned long frames, const PaStreamCallbackTimeInfo* times,
                        PaStreamCallbackFlags flags, void* of) {
        auto& state = *static_cast<State*>(of);
        // How long ago the first sample was taken. Some systems do not know; then the block was taken just
        // now.
        double age_s = times->currentTime - times->inputBufferAdcTime;
        if (!(times->inputBufferAdcTime > 0.0 && age_s >= 0.0 && age_s < 5.0))
            age_s = static_cast<double>(frames) / state.rate_hz;
        const SessionTime first = state.clock->now() - from_seconds(age_s);
        const auto* sound = static_cast<const float*>(input);
        SoundBlock block;
        for (unsigned long done = 0; done < frames;) {
            block.first_sample = state.samples + static_cast<std::int64_t>(done);
            block.at = first + from_seconds(static_cast<double>(done) / state.rate_hz);
            block.is_after_overflow = done == 0 && (flags & paInputOverflow) != 0;
            block.count =
                static_cast<std::uint32_t>(std::min<unsigned long>(SoundBlock::room, frames - done));
            std::copy_n(sound + done, block.count, block.samples.begin());
            state.ring->try_push(block);
            done += block.count;
        }
        state.samples += static_cast<std::int64_t>(frames);
        return paContinue;
    }
};

PortAudioInput::PortAudioInput(const std::string& name, int sample_rate_hz, const Clock& clock,
                               SoundRing& ring)
    : state_(std::make_unique<State>()) {
    State& state = *state_;
    state.clock = &clock;
    state.ring = &ring;
    state.rate_hz = sample_rate_hz;
    const auto devices = inputs_of(state.system);
    const auto device = choose(devices, name);
    if (!device) {
        std::string list;
        for (const auto& one : devices)
            list += "\n  " + one.info.name;
        throw DeviceError(
            name.empty() ? "there is no sound device that records"
                         : fmt::format("there is no sound device called \"{}\" that records. There are:{}",
                                       name, list.empty() ? " none" : list));
    }
    state.name = device->info.name;
    PaStreamParameters parameters{};
    parameters.device = device->index;
    parameters.channelCount = 1;
    parameters.sampleFormat = paFloat32;
    parameters.suggestedLatency = device->info.latency_s;
    const QuietErrors quiet;
    PaError error = Pa_OpenStream(&state.stream, &parameters, nullptr, sample_rate_hz, SoundBlock::room,
                                  paClipOff, &State::on_sound, &state);
    if (error == paNoError)
        error = Pa_StartStream(state.stream);
    if (error != paNoError)
        throw DeviceError(fmt::format("{}: records no {} samples a second: {}", state.name, sample_rate_hz,
                                      Pa_GetErrorText(error)));
    if (const PaStreamInfo* const info = Pa_GetStreamInfo(state.stream))
        state.latency = from_seconds(info->inputLatency);
}

PortAudioInput::~PortAudioInput() = default;

const std::string& PortAudioInput::name() const { return state_->name; }

SessionDuration PortAudioInput::latency() const { return state_->latency; }

} // namespace overt
