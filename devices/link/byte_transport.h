/// A line to a device over which bytes go both ways. BitsLink and ColorCal speak their protocols over it;
/// they are tested without hardware by giving them another transport.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "experiment/session_time.h"

namespace overt {

/// An open line. Deadlines are instants of the clock that the transport was made with. Nothing throws: a line
/// can break while a trial runs, and then that is data. One thread at a time.
class ByteTransport {
  public:
    virtual ~ByteTransport() = default;

    /// How the experimenter knows it, such as "/dev/ttyACM0".
    virtual const std::string& name() const noexcept = 0;

    /// Hands over all bytes. False if the line was lost or did not take them all by the deadline.
    virtual bool write(std::string_view bytes, SessionTime deadline) noexcept = 0;

    /// Takes what has arrived, at most as much as fits; waits until the deadline for a first byte. A deadline
    /// that is past means: do not wait. Gives the number of bytes, 0 if none came or the line was lost.
    virtual std::size_t read(std::span<char> into, SessionTime deadline) noexcept = 0;

    /// The device was unplugged or the system has given it up. Stays true.
    virtual bool lost() const noexcept = 0;

    /// What the system said when the line was lost; empty before.
    virtual std::string loss() const = 0;
};

/// Opens the line to a port by its name. Throws DeviceError if it cannot be had.
using TransportOpener = std::function<std::unique_ptr<ByteTransport>(const std::string& port)>;

/// Forgets what has arrived by `now`; of a line that never rests a thousand readings.
void read_away(ByteTransport& line, SessionTime now) noexcept;

/// Bytes as they may stand in a message: control characters and bytes above 126 as \xNN, and when longer than
/// `longest` bytes only their end, after "…".
std::string printable(std::string_view bytes, std::size_t longest = 160);

} // namespace overt
