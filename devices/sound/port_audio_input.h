/// A microphone through PortAudio.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "devices/sound/sound_block.h"
#include "experiment/ports/clock.h"

namespace overt {

struct SoundInputInfo {
    std::string name; ///< with the sound system's: "ALSA: USB Microphone"
    bool is_default = false;
    double usual_rate_hz = 0.0;
    double latency_s = 0.0;
};

/// All that can record. Libraries below write what they tried to standard error; it is kept quiet meanwhile.
std::vector<SoundInputInfo> sound_inputs();

/// The one whose name holds this text, or the default one for an empty text; nothing if there is none.
std::optional<SoundInputInfo> sound_input_called(const std::string& name);

/// Runs from construction to destruction, and pushes one channel into the ring from a thread of the sound
/// system's. When the ring is full blocks are dropped; their samples are counted on.
class PortAudioInput {
  public:
    /// Clock and ring must outlive this. Throws DeviceError if there is no such device, or if it does not
    /// take the rate.
    PortAudioInput(const std::string& name, int sample_rate_hz, const Clock& clock, SoundRing& ring);
    ~PortAudioInput();

    const std::string& name() const;
    SessionDuration latency() const; ///< as PortAudio has it

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace overt
