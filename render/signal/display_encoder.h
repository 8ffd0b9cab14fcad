/// Turns linear light into what is sent to the display. The work is done by the processor, in double
/// precision: the bytes are the same with every graphics card and driver, which only carry them.
///
/// One rounding rule holds everywhere: floor(value * levels + 0.5) of a value clipped to 0 … 1.
#pragma once

#include <array>
#include <span>

#include "render/gl/gl_objects.h"
#include "render/image/linear_image.h"
#include "render/signal/row_levels.h"
#include "render/signal/t_lock.h"

namespace overt {

struct ModeCoding;

/// A rectangle of the screen.
struct ScreenPatch {
    glm::ivec2 origin_px{0}, size_px{0};
};

class DisplayEncoder {
  public:
    explicit DisplayEncoder(const DisplaySettings& display);

    /// Whether the last step, from 16-bit codes to the levels of the video signal, is left to the graphics
    /// card: where it differs from refresh to refresh, or where there are more than 8 bits in a byte's place.
    bool leaves_last_step() const { return leaves_last_step_; }

    /// How the encoder's pixels lie in memory: bytes for the signal, or codes of 16 bits.
    PixelFormat format() const { return leaves_last_step_ ? PixelFormat::rgba16 : PixelFormat::rgba8; }

    /// The part of the screen on which a picture at a place leaves its traces: whole pairs, and as far as the
    /// filter reaches.
    ScreenPatch patch_of(glm::ivec2 origin_px, glm::ivec2 size_px) const;

    /// Encodes a picture that stands on the screen at `origin_px`, over the background by its alpha (colours
    /// are multiplied by alpha already), with the background around it, for the whole of patch_of(). `into`
    /// holds that patch in format(), top row first. From any thread.
    void encode(const LinearImage& picture, glm::ivec2 origin_px, std::span<std::byte> into) const;

    /// The same for the background alone.
    void encode_background(glm::ivec2 size_px, std::span<std::byte> into) const;

    /// The table of colours of Bits++: light of index i / 255, as 16 bits of each channel.
    SignalColourTable colour_table() const;

  private:
    using Row = std::vector<glm::dvec3>;
    void encode_row(const Row& row, int width, std::byte* into) const;

    DisplaySettings display_;
    const ModeCoding* coding_;
    bool leaves_last_step_;
    int reach_px_; ///< of the filter, to each side of a pair
    LevelTables tables_;
};

} // namespace overt
