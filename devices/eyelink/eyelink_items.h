/// What an EyeLink sends over its link, as its library hands it over: items of bytes with fields at fixed
/// offsets. Layouts are those of the library's float items on x86-64; later libraries write longer items that
/// begin with the same fields.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "devices/tracker/tracker_driver.h"

namespace overt {

/// Kinds of items, as eyelink_get_next_data tells them.
enum class EyelinkItem : std::int16_t {
    none = 0,
    blink_end = 4,
    saccade_end = 6,
    fixation_end = 8,
    button = 25,
    input = 28,
    lost_data = 0x3F, ///< the queue was full: items were thrown away
    sample = 200,
};

/// Room for the longest item of any library known, several times over.
using EyelinkItemBytes = std::array<std::byte, 2048>;

enum class EyelinkEyes : std::uint8_t { left, right, both };

/// Nothing for what eyelink_eye_available says when there is no data.
std::optional<EyelinkEyes> eyelink_eyes(std::int16_t available) noexcept;

/// Makes of one recording's items those of the port. Nothing allocates or throws, whatever the bytes are.
class EyelinkDecoder {
  public:
    /// `recorded`: where a sample's flags name no eye. `rate_hz`: 0 if not known.
    EyelinkDecoder(EyelinkEyes recorded, double rate_hz) : recorded_(recorded), rate_hz_(rate_hz) {}

    /// Puts what `kind` and the bytes say: of a sample one GazeSample per eye, the left one's first; the
    /// tracker's fixations, saccades and blinks when they have ended; changes of buttons and of the input
    /// port; after lost data a gap before the next sample, with the number of samples that the time between
    /// says. Other kinds and items that are too short are passed over.
    ///
    /// Durations are those of the tracker's own file: end - start + one sample, in whole milliseconds below
    /// (as measured on files of the vendor's converter). Amplitudes are reckoned from both ends of a saccade
    /// and the mean resolution there.
    void take(EyelinkItem kind, std::span<const std::byte> item, TrackerItemSink& sink) noexcept;

    /// Of the last sample; the clock's zero before the first.
    TrackerTime last_sample() const noexcept { return last_sample_; }

  private:
    void take_sample(std::span<const std::byte> item, TrackerItemSink& sink) noexcept;

    EyelinkEyes recorded_;
    double rate_hz_;
    TrackerTime last_sample_{};
    bool has_lost_data_ = false;
};

} // namespace overt
