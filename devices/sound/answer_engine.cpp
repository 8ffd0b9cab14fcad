#include "devices/sound/answer_engine.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "experiment/base/error.h"

namespace overt {

namespace {

constexpr auto idle = std::chrono::milliseconds(5);

/// Half a second at 48 kHz: far longer than the engine takes to notice that it is wanted.
constexpr std::size_t recent_blocks = 96;

/// A device that gives nothing for so long has stopped.
constexpr SessionDuration longest_silence = std::chrono::seconds(1);

class EngineRecording final : public AnswerRecording {
  public:
    explicit EngineRecording(std::shared_ptr<AnswerEngine::Recording> shared) : shared_(std::move(shared)) {}
    void response_screen_lit(SessionTime onset) noexcept override {
        shared_->onset_ns = onset.time_since_epoch().count();
    }
    AudioLevel level() const noexcept override { return {shared_->peak, shared_->rms, shared_->is_clipping}; }
    void end(SessionTime at) noexcept override { shared_->end_ns = at.time_since_epoch().count(); }
    std::optional<RecordedAnswer> result() override {
        return shared_->is_done.load(std::memory_order_acquire) ? std::optional(shared_->answer)
                                                                : std::nullopt;
    }

  private:
    std::shared_ptr<AnswerEngine::Recording> shared_;
};

SessionTime time_of(std::int64_t nanoseconds) { return SessionTime(SessionDuration(nanoseconds)); }

} // namespace

AnswerEngine::AnswerEngine(const Clock& clock, SoundRing& ring, SoundFormat format)
    : clock_(&clock), ring_(&ring), format_(std::move(format)), last_block_(clock.now()),
      thread_([this] { run(); }) {}

AnswerEngine::~AnswerEngine() {
    stopping_ = true;
    thread_.join();
}

std::unique_ptr<AnswerRecording> AnswerEngine::begin(const Trial& trial) {
    auto recording = std::make_shared<Recording>();
    recording->trial = trial.index;
    recording->begun = clock_->now();
    wanted_.store(recording);
    return std::make_unique<EngineRecording>(std::move(recording));
}

void AnswerEngine::run() {
    SoundBlock block;
    while (!stopping_) {
        if (std::shared_ptr<Recording> wanted = wanted_.exchange(nullptr))
            begin_writing(std::move(wanted));
        bool is_idle = true;
        while (ring_->try_pop(block)) {
            take(block);
            is_idle = false;
        }
        look_for_end();
        if (is_idle)
            std::this_thread::sleep_for(idle);
    }
    if (recording_)
        finish("the session ended");
}

void AnswerEngine::begin_writing(std::shared_ptr<Recording> recording) {
    if (recording_)
        finish("the next one began");
    recording_ = std::move(recording);
    next_sample_ = -1;
    last_block_ = clock_->now();
    try {
        sink_ = std::make_unique<AnswerSink>(folder_, free_answer_name(folder_, recording_->trial), format_);
    } catch (const RecordError& failure) {
        finish(failure.what());
        return;
    }
    for (const SoundBlock& block : recent_)
        if (block.at >= recording_->begun)
            write(block);
}

void AnswerEngine::take(const SoundBlock& block) {
    last_block_ = clock_->now();
    if (recent_.size() == recent_blocks)
        recent_.pop_front();
    recent_.push_back(block);
    if (recording_)
        write(block);
}

void AnswerEngine::write(const SoundBlock& block) {
    if (!recording_)
        return;
    if (next_sample_ >= 0 && block.first_sample > next_sample_)
        sink_->add_gap(block.first_sample - next_sample_);
    else if (block.is_after_overflow && next_sample_ >= 0)
        sink_->count_overrun();
    next_sample_ = block.first_sample + block.count;
    // What was taken after the key belongs to no answer.
    std::span<const float> sound = block.sound();
    const std::int64_t end_ns = recording_->end_ns;
    bool is_last = false;
    if (end_ns >= 0) {
        const double samples = to_seconds(time_of(end_ns) - block.at) * format_.sample_rate_hz;
        is_last = samples <= static_cast<double>(sound.size());
        sound = sound.first(static_cast<std::size_t>(
            std::lround(std::clamp(samples, 0.0, static_cast<double>(sound.size())))));
    }
    sink_->add(sound, block.at);
    const AudioLevel level = sink_->level();
    recording_->peak = level.peak;
    recording_->rms = level.rms;
    recording_->is_clipping = level.is_clipping;
    if (is_last)
        finish({});
}

/// A device that has stopped never brings the last sample.
void AnswerEngine::look_for_end() {
    if (recording_ && clock_->now() - last_block_ > longest_silence)
        finish("the sound device gave nothing for a second");
}

void AnswerEngine::finish(const std::string& fault) {
    const std::shared_ptr<Recording> recording = std::exchange(recording_, nullptr);
    if (const std::unique_ptr<AnswerSink> sink = std::exchange(sink_, nullptr)) {
        recording->answer = sink->finish(time_of(recording->onset_ns), fault);
    } else {
        recording->answer.device = format_.device;
        recording->answer.fault = fault;
    }
    recording->answer.trial = recording->trial;
    recording->is_done.store(true, std::memory_order_release);
}

} // namespace overt
