/// Tones that tell the operator and the observer something.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "experiment/ports/beep.h"

namespace overt {

/// What a beep is made of: one tone after the other, each faded in and out within 5 ms, so that none clicks.
struct BeepTone {
    double pitch_hz = 0.0; ///< 0: silence
    double length_s = 0.0;
};
std::span<const BeepTone> tones_of(Beep beep) noexcept;

/// Makes the samples of beeps. start() may be called from another thread than fill().
class BeepSound {
  public:
    explicit BeepSound(double sample_rate_hz) : rate_hz_(sample_rate_hz) {}

    /// From the next fill() on; ends one that still sounds.
    void start(Beep beep) noexcept;
    /// The next samples, -1 to 1; silence where nothing sounds. Allocates and waits for nothing.
    void fill(std::span<float> samples) noexcept;
    /// For so many samples nothing has sounded.
    std::int64_t silent_samples() const noexcept { return silent_; }

  private:
    float next() noexcept;

    double rate_hz_;
    std::atomic<int> wanted_{-1}; ///< a Beep; -1: none
    std::span<const BeepTone> tones_;
    std::int64_t sample_ = 0; ///< of the first of tones_
    std::int64_t silent_ = 0;
};

/// Plays them through PortAudio's default output. What drives it rests when nothing has sounded for two
/// seconds.
class Beeper {
  public:
    /// Throws DeviceError if there is no sound device that plays.
    Beeper();
    ~Beeper();
    Beeper(const Beeper&) = delete;
    Beeper& operator=(const Beeper&) = delete;

    const std::string& name() const;
    /// May take some milliseconds.
    void play(Beep beep) noexcept;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace overt
