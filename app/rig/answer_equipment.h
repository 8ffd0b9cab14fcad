/// What a session's spoken answers are recorded with.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "devices/sound/sound_block.h"
#include "experiment/base/diagnostics.h"
#include "experiment/ports/answer_recorder.h"
#include "experiment/ports/clock.h"
#include "experiment/ports/recorded_answer.h"
#include "experiment/protocol/protocol.h"

namespace overt {

class AnswerEngine;
class PortAudioInput;
class SimulatedAnswerRecorder;
class SimulatedObserver;

/// The sound device as the protocol wants it, or that of a simulated observer; or none, where the protocol
/// allows that.
class AnswerEquipment {
  public:
    /// `simulated`: who speaks, or null for a microphone. Clock and observer must outlive this. Throws
    /// DeviceError if answers have to be recorded and cannot be.
    AnswerEquipment(const AnswerSettings& settings, const Clock& clock, const SimulatedObserver* simulated,
                    std::uint64_t seed);
    ~AnswerEquipment();

    /// In words, for the operator and the record.
    const std::string& description() const { return description_; }

    void keep_in(const std::filesystem::path& folder);
    AnswerRecorder* recorder(); ///< null: nothing is recorded

    /// A meter in the operator's terminal; empty where there is none.
    std::function<void(const AudioLevel&)> meter() const;

  private:
    std::string description_;
    std::unique_ptr<SoundRing> ring_;
    std::unique_ptr<AnswerEngine> engine_;
    std::unique_ptr<PortAudioInput> input_; ///< after the engine: it stops first
    std::unique_ptr<SimulatedAnswerRecorder> simulated_;
};

/// What this machine can record answers with, in words; an error is found where the protocol requires more.
std::string check_sound(const Protocol& protocol, Diagnostics& diagnostics);

/// Lines for an overview of the machine: each device, or that there is none.
std::vector<std::string> sound_overview();

} // namespace overt
