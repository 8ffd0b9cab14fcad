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

/// A device that takes lines of text: the code in figures, or the marker's text, and a line feed.
class SerialText final : public MarkerOutput {
  public:
    /// `sends_codes`: only markers with a code, in figures; else every marker's text. `clock` must outlive
    /// it, and be the line's.
    SerialText(std::unique_ptr<ByteTransport> line, const Clock& clock, bool sends_codes);

    const std::string& name() const noexcept override { return name_; }
    bool needs_code() const noexcept override { return sends_codes_; }
    bool send(const Marker& marker) noexcept override;
    std::string fault() const override;

  private:
    std::unique_ptr<ByteTransport> line_;
    const Clock& clock_;
    bool sends_codes_;
    std::string name_;
};

} // namespace overt
