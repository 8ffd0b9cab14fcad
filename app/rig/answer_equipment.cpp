#include "app/rig/answer_equipment.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

#include "app/cli/terminal_output.h"
#include "devices/simulated/simulated_answer_recorder.h"
#include "devices/sound/answer_engine.h"
#include "devices/sound/port_audio_input.h"
#include "experiment/base/error.h"

namespace overt {

namespace {

std::string words_for(const SoundInputInfo& input) {
    return fmt::format("{}{}, usually {:.0f} Hz, latency {:.1f} ms", input.name,
                       input.is_default ? " (default)" : "", input.usual_rate_hz, 1e3 * input.latency_s);
}

/// A bar of forty places from -60 dBFS to full scale.
std::string bar_of(const AudioLevel& level) {
    const int places = 40;
    const auto place = [places](float share) {
        const double dbfs = share > 0.0f ? 20.0 * std::log10(static_cast<double>(share)) : -60.0;
        return std::clamp(static_cast<int>(std::lround((dbfs + 60.0) / 60.0 * places)), 0, places);
    };
    std::string bar(static_cast<std::size_t>(places), ' ');
    std::fill_n(bar.begin(), place(level.rms), '=');
    if (const int peak = place(level.peak); peak > 0)
        bar[static_cast<std::size_t>(peak) - 1] = '|';
    return bar;
}

} // namespace

AnswerEquipment::AnswerEquipment(const AnswerSettings& settings, const Clock& clock,
                                 const SimulatedObserver* simulated, std::uint64_t seed) {
    if (settings.record == AnswerUse::none) {
        description_ = "not recorded";
        return;
    }
    if (simulated) {
        SimulatedSoundSettings sound;
        sound.sample_rate_hz = settings.sample_rate_hz;
        sound.bits = settings.bits;
        simulated_ = std::make_unique<SimulatedAnswerRecorder>(clock, *simulated, seed, sound);
        description_ = SimulatedAnswerRecorder::device_name;
        return;
    }
    auto ring = std::make_unique<SoundRing>(sound_ring_blocks);
    try {
        input_ = std::make_unique<PortAudioInput>(settings.device, settings.sample_rate_hz, clock, *ring);
    } catch (const DeviceError& error) {
        if (settings.record == AnswerUse::required)
            throw DeviceError(fmt::format(
                "{}; the protocol requires that answers are recorded: [answers] record", error.what()));
        description_ = fmt::format("not recorded: {}", error.what());
        return;
    }
    ring_ = std::move(ring);
    engine_ = std::make_unique<AnswerEngine>(
        clock, *ring_,
        SoundFormat{input_->name(), settings.sample_rate_hz, settings.bits, input_->latency()});
    description_ = fmt::format("{}, {} Hz, {} bits, input latency {:.1f} ms", input_->name(),
                               settings.sample_rate_hz, settings.bits, 1e3 * to_seconds(input_->latency()));
}

AnswerEquipment::~AnswerEquipment() = default;

void AnswerEquipment::keep_in(const std::filesystem::path& folder) {
    if (engine_)
        engine_->keep_in(folder);
    if (simulated_)
        simulated_->keep_in(folder);
}

AnswerRecorder* AnswerEquipment::recorder() {
    if (engine_)
        return engine_.get();
    return simulated_.get();
}

std::function<void(const AudioLevel&)> AnswerEquipment::meter() const {
    if (!engine_ || ::isatty(STDERR_FILENO) != 1)
        return {};
    return [last = std::chrono::steady_clock::time_point(),
            was_clipped = false](const AudioLevel& level) mutable {
        const auto now = std::chrono::steady_clock::now();
        was_clipped = was_clipped || level.is_clipping;
        if (now - last < std::chrono::milliseconds(100))
            return;
        last = now;
        const OwnControls own;
        fmt::print(stderr, "\ranswer [{}] {}", bar_of(level), was_clipped ? "CLIPPED" : "       ");
        std::fflush(stderr);
        was_clipped = false;
    };
}

std::string check_sound(const Protocol& protocol, Diagnostics& diagnostics) {
    const AnswerSettings& settings = protocol.answers;
    if (settings.record == AnswerUse::none)
        return "spoken answers are not recorded";
    const bool is_required = settings.record == AnswerUse::required;
    const auto input = sound_input_called(settings.device);
    if (input)
        return fmt::format("spoken answers are recorded{} with {}",
                           is_required ? "" : " where there is a sound device; here", words_for(*input));
    const std::string none =
        settings.device.empty()
            ? std::string("this machine has no sound device that records")
            : fmt::format("this machine has no sound device called \"{}\" that records", settings.device);
    if (is_required)
        diagnostics.error(protocol.file.string(), protocol.places.of("answers.record"), none,
                          "connect one, or write record = \"optional\"");
    return fmt::format("spoken answers {}: {}", is_required ? "cannot be recorded" : "are not recorded here",
                       none);
}

std::vector<std::string> sound_overview() {
    std::vector<std::string> lines;
    try {
        for (const SoundInputInfo& input : sound_inputs())
            lines.push_back(words_for(input));
    } catch (const DeviceError& error) {
        lines.emplace_back(error.what());
    }
    if (lines.empty())
        lines.emplace_back("none that records: spoken answers cannot be recorded here");
    return lines;
}

} // namespace overt
