/// Records spoken answers from a sound device that runs all the time, on a thread of its own.
#pragma once

#include <atomic>
#include <deque>
#include <filesystem>
#include <memory>
#include <thread>

#include "devices/sound/answer_sink.h"
#include "devices/sound/sound_block.h"
#include "experiment/ports/answer_recorder.h"
#include "experiment/ports/clock.h"
#include "experiment/ports/recorded_answer.h"

namespace overt {

/// The device's thread pushes blocks, this one's thread takes them, and while an answer is recorded writes
/// them. Each answer has an object of its own, which ends by the times of its samples: what is still on its
/// way when the key is pressed belongs to it, and nothing of one can end the next.
class AnswerEngine final : public AnswerRecorder {
  public:
    /// The clock must outlive the engine, and so must the ring, whose consumer it becomes.
    AnswerEngine(const Clock& clock, SoundRing& ring, SoundFormat format);
    ~AnswerEngine() override;

    /// Where answers go: a session's folder. Before the first begin().
    void keep_in(const std::filesystem::path& folder) { folder_ = folder; }

    std::unique_ptr<AnswerRecording> begin(const Trial& trial) override;

    /// Shared by the session's thread and the engine's: each field is written by one of them.
    struct Recording {
        int trial = -1;
        SessionTime begun;
        std::atomic<std::int64_t> onset_ns{0}, end_ns{-1}; ///< of the session clock; -1: not ended
        std::atomic<float> peak{0.0f}, rms{0.0f};
        std::atomic<bool> is_clipping{false}, is_done{false};
        RecordedAnswer answer; ///< the engine's, until is_done
    };

  private:
    void run();
    void take(const SoundBlock& block);
    void begin_writing(std::shared_ptr<Recording> recording);
    void write(const SoundBlock& block);
    void finish(const std::string& fault);
    void look_for_end();

    const Clock* clock_;
    SoundRing* ring_;
    SoundFormat format_;
    std::filesystem::path folder_;
    std::atomic<std::shared_ptr<Recording>> wanted_; ///< to be begun
    std::atomic<bool> stopping_{false};
    // The engine's thread's.
    std::shared_ptr<Recording> recording_;
    std::unique_ptr<AnswerSink> sink_;
    std::int64_t next_sample_ = -1; ///< that is expected while recording; -1: any
    std::deque<SoundBlock> recent_; ///< so that nothing is missed while a recording begins
    SessionTime last_block_;
    std::thread thread_; ///< last: it uses all of the above
};

} // namespace overt
