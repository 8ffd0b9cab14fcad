/// What is heard while the eye tracker is set up.
#pragma once

#include <memory>
#include <string>

#include "experiment/ports/setup_screen.h"

namespace overt {

class Beeper;

/// The default sound device, or silence where there is none.
class SetupSounds {
  public:
    /// `wanted`: else silence, and nothing is opened.
    explicit SetupSounds(bool wanted);
    ~SetupSounds();

    void play(SetupBeep beep) noexcept;
    /// For the operator: the device, or why there is no sound.
    const std::string& description() const { return description_; }

  private:
    std::unique_ptr<Beeper> beeper_;
    std::string description_;
};

} // namespace overt
