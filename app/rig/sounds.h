/// What operator and observer hear.
#pragma once

#include <memory>
#include <string>

#include "experiment/ports/beep.h"

namespace overt {

class Beeper;

/// The default sound device, or silence where there is none.
class Sounds {
  public:
    /// `wanted`: else silence, and nothing is opened.
    explicit Sounds(bool wanted);
    ~Sounds();

    void play(Beep beep) noexcept;
    /// What is played is heard; false if nothing is wanted.
    bool are_heard() const noexcept { return beeper_ != nullptr; }
    /// For the operator: the device, or why there is no sound.
    const std::string& description() const { return description_; }

  private:
    std::unique_ptr<Beeper> beeper_;
    std::string description_;
};

} // namespace overt
