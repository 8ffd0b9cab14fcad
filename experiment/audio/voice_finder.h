/// Where in a recording somebody speaks, how loud it is, and whether it was too loud for the converter.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace overt {

/// Begin and end of the voice, in samples.
struct VoiceSpan {
    double begin = 0.0, end = 0.0;
};

/// Takes a recording block by block and keeps its energy by the millisecond: memory grows with 4 kB a second.
///
/// The method: the sound is high-passed (80 Hz, second order: steps and hum of the room), and its energy
/// averaged over windows of 10 ms, one for each millisecond. The noise floor is the level that a fifth of all
/// windows stay below, or the median of the first 150 ms where that is lower: nobody answers sooner, and who
/// answers to the end leaves no fifth of silence. A stretch is voice if its level stays 4 dB above the floor
/// for at least 50 ms, rises 9 dB above it, and above -65 dBFS (two thresholds, so that a level near one does
/// not flicker). The voice begins with the first of three milliseconds in a row 6 dB above the floor in the
/// first stretch's first window, and ends with the last stretch.
class VoiceFinder {
  public:
    explicit VoiceFinder(double rate_hz);

    /// Samples as shares of full scale.
    void add(std::span<const float> samples);

    /// Of what was added so far. None: silence.
    std::optional<VoiceSpan> voice() const;
    double noise_dbfs() const; ///< root mean square of the floor; a sine of full scale has -3 dBFS
    double peak_dbfs() const;  ///< of the sound as it came

    /// In runs of two and more at full scale.
    std::int64_t clipped_samples() const { return clipped_; }

  private:
    std::vector<float> windows() const;
    static double floor_of(const std::vector<float>& windows);

    double rate_hz_;
    int block_;                   ///< samples that are taken for a millisecond
    std::vector<float> energies_; ///< mean square of each
    double sum_ = 0.0;
    int in_block_ = 0;
    // The high-pass: two of first order.
    double pole_, last_in_ = 0.0, first_out_ = 0.0, second_out_ = 0.0;
    float peak_ = 0.0f;
    int run_ = 0; ///< samples at full scale, one after the other; negative below zero
    std::int64_t clipped_ = 0;
};

} // namespace overt
