/// The output lines of a device of Cedrus that speaks XID: StimTracker, c-pod, m-pod, and response boxes with
/// an accessory connector.
#pragma once

#include <string>

#include "devices/buttons/xid_line.h"
#include "devices/triggers/marker_output.h"

namespace overt {

/// A marker is the pattern of its lines: bit 0 is line 1. The lines stay until rest(); the device's own
/// pulses are switched off, so that how long a code stands is the session's to say.
class XidTrigger final : public MarkerOutput {
  public:
    /// Throws as XidLine's constructor, and DeviceError for a device that has no output lines.
    XidTrigger(const std::string& port, const XidLine::Opener& open, Clock& clock);

    const std::string& name() const noexcept override { return name_; }
    bool needs_code() const noexcept override { return true; }
    bool send(const Marker& marker) noexcept override { return write(marker.code); }
    void rest() noexcept override { write(0); }
    std::string fault() const override;

  private:
    bool write(std::uint8_t lines) noexcept;

    XidLine line_;
    bool has_wide_command_;
    std::string name_;
};

} // namespace overt
