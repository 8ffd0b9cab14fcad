/// The port of what records spoken answers.
#pragma once

#include <memory>
#include <optional>

#include "experiment/ports/recorded_answer.h"
#include "experiment/trial.h"

namespace overt {

/// A spoken answer that is being recorded, with all that belongs to it: nothing is shared with the one before
/// or after. No call waits for the sound device or the disk.
class AnswerRecording {
  public:
    virtual ~AnswerRecording() = default;
    /// The response screen was lit; to be told once, after the recording has begun.
    virtual void response_screen_lit(SessionTime onset) noexcept = 0;
    virtual AudioLevel level() const noexcept = 0;
    /// What is said up to then belongs to it.
    virtual void end(SessionTime at) noexcept = 0;
    /// What became of it, once its file is complete; some time after end().
    virtual std::optional<RecordedAnswer> result() = 0;
};

/// Where spoken answers go.
class AnswerRecorder {
  public:
    virtual ~AnswerRecorder() = default;
    /// Begins now. One at a time.
    virtual std::unique_ptr<AnswerRecording> begin(const Trial& trial) = 0;
};

} // namespace overt
