/// A trigger box or a cable on a serial port: a marker is a byte.
#pragma once

#include <memory>
#include <string>

#include "devices/link/byte_transport.h"
#include "devices/triggers/marker_output.h"
#include "experiment/ports/clock.h"

namespace overt {

/// Sends the code, and 0 where the pulse is to end. Boxes that make their pulses by themselves want no 0: a
/// pulse of length zero for them.
class SerialTrigger final : public MarkerOutput {
  public:
    /// `clock` must outlive it, and be the line's.
    SerialTrigger(std::unique_ptr<ByteTransport> line, const Clock& clock);

    const std::string& name() const noexcept override { return name_; }
    bool needs_code() const noexcept override { return true; }
    bool send(const Marker& marker) noexcept override { return write(marker.code); }
    void rest() noexcept override { write(0); }
    std::string fault() const override;

  private:
    bool write(std::uint8_t byte) noexcept;

    std::unique_ptr<ByteTransport> line_;
    const Clock& clock_;
    std::string name_;
};

} // namespace overt
