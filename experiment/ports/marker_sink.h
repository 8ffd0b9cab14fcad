/// The port of what is told of a session's events as they happen: recordings of other devices, by a stream of
/// markers or by pulses on a cable.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/session_time.h"

namespace overt {

/// Something that happened, for those who record along.
struct Marker {
    SessionTime at;        ///< when it happened, such as a vertical blank
    std::uint8_t code = 0; ///< for outputs that carry a byte; 0: none, which such outputs pass over
    std::string_view text; ///< ASCII; what exceeds longest_marker bytes is cut; copied before a call returns
    std::int64_t number = 0; ///< by which the giver knows it again
};
inline constexpr std::size_t longest_marker = 120;

/// What became of a marker, for the record.
struct SentMarker {
    bool is_sent = true; ///< else the output is gone, or did not take it
    std::uint8_t code = 0;
    SessionTime at; ///< as the marker had it
    /// It was handed to the system between these two; or that was tried.
    SessionTime not_before, not_after;
    std::int64_t number = 0; ///< as the marker had it
};

/// On the session's thread. What is noexcept is called between a presentation's first and last flip as well,
/// and allocates, opens and waits for nothing.
class MarkerSink {
  public:
    virtual ~MarkerSink() = default;
    /// As the record and messages name it, such as "serial port /dev/ttyUSB0".
    virtual const std::string& name() const noexcept = 0;
    virtual void mark(const Marker& marker) noexcept = 0;
    /// Takes what became of markers, in the order in which they were given; gives the number. Call until it
    /// gives less than the span holds.
    virtual std::size_t poll(std::span<SentMarker> into) noexcept = 0;
    /// Sends what is still held and ends the output. What became of it can be polled afterwards. Gives a
    /// sentence for each thing the operator should know.
    virtual std::vector<std::string> finish() = 0;
};

} // namespace overt
