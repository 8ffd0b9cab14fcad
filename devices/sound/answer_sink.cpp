#include "devices/sound/answer_sink.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "experiment/base/content_hash.h"
#include "experiment/base/error.h"

namespace overt {

std::string free_answer_name(const std::filesystem::path& folder, int trial) {
    std::error_code error;
    std::filesystem::create_directory(folder / "answers", error); // in the session's folder, or nowhere
    if (error)
        throw RecordError(
            fmt::format("{}: cannot be made: {}.", (folder / "answers").string(), error.message()));
    std::string name = fmt::format("answers/trial_{:02}.wav", trial + 1);
    for (int again = 2; std::filesystem::exists(folder / name); ++again)
        name = fmt::format("answers/trial_{:02}_{}.wav", trial + 1, again);
    return name;
}

AnswerSink::AnswerSink(const std::filesystem::path& folder, const std::string& name,
                       const SoundFormat& format)
    : folder_(folder), clock_(format.sample_rate_hz), voice_(format.sample_rate_hz) {
    answer_.file = name;
    answer_.device = format.device;
    answer_.sample_rate_hz = format.sample_rate_hz;
    answer_.bits = format.bits;
    answer_.input_latency = format.input_latency;
    try {
        file_ = std::make_unique<WavFile>(folder / name, format.sample_rate_hz, format.bits);
    } catch (const RecordError& failure) {
        answer_.fault = failure.what();
    }
}

void AnswerSink::write(std::span<const float> samples) {
    voice_.add(samples);
    answer_.samples += static_cast<std::int64_t>(samples.size());
    if (!file_)
        return;
    try {
        file_->write(samples);
    } catch (const RecordError& failure) {
        answer_.fault = failure.what();
        file_.reset();
    }
}

void AnswerSink::add(std::span<const float> samples, SessionTime at) {
    if (samples.empty())
        return;
    clock_.add(answer_.samples, at);
    const std::int64_t clipped = voice_.clipped_samples();
    write(samples);
    double squares = 0.0;
    level_ = {};
    for (const float sample : samples) {
        level_.peak = std::max(level_.peak, std::abs(sample));
        squares += static_cast<double>(sample) * static_cast<double>(sample);
    }
    level_.rms = static_cast<float>(std::sqrt(squares / static_cast<double>(samples.size())));
    level_.is_clipping = voice_.clipped_samples() > clipped;
}

void AnswerSink::add_gap(std::int64_t lost) {
    ++answer_.overruns;
    answer_.lost_samples += lost;
    const std::array<float, 256> zeros{};
    for (; lost > 0; lost -= static_cast<std::int64_t>(zeros.size()))
        write(std::span(zeros).first(static_cast<std::size_t>(std::min<std::int64_t>(lost, zeros.size()))));
}

RecordedAnswer AnswerSink::finish(SessionTime onset, const std::string& fault) {
    if (answer_.fault.empty())
        answer_.fault = fault;
    if (file_) {
        try {
            file_->close();
        } catch (const RecordError& failure) {
            answer_.fault = failure.what();
        }
    }
    try {
        answer_.sha256 = hash_of_file(folder_ / answer_.file);
    } catch (const InputError&) {
        // There is no file; the fault says why.
    }
    answer_.peak_dbfs = voice_.peak_dbfs();
    answer_.noise_dbfs = voice_.noise_dbfs();
    answer_.clipped_samples = voice_.clipped_samples();
    if (clock_.is_empty())
        return answer_;
    const SampleClock::Place place = clock_.sample_at(onset);
    answer_.measured_rate_hz = clock_.rate_hz();
    answer_.onset_sample = place.sample;
    answer_.onset_uncertainty = place.uncertainty;
    if (const std::optional<VoiceSpan> span = voice_.voice()) {
        const auto after_onset = [&](double sample) {
            return from_seconds((sample - place.sample) / answer_.measured_rate_hz);
        };
        answer_.voice_onset = after_onset(span->begin);
        answer_.voice_end = after_onset(span->end);
    }
    return answer_;
}

} // namespace overt
