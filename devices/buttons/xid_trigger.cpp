#include "devices/buttons/xid_trigger.h"

#include <fmt/format.h>

#include "devices/triggers/marker_device.h"
#include "devices/usb/serial_line.h"

namespace overt {

XidTrigger::XidTrigger(const std::string& port, const XidLine::Opener& open, Clock& clock)
    : line_(port, open, clock),
      // As Cedrus' own pyxid has it: `mh` of two bytes from the second firmware on and of StimTrackers,
      // before it `ah` of one byte whose bits are turned round.
      has_wide_command_(line_.identity().product == 'S' ||
                        (line_.identity().firmware >= '2' && line_.identity().firmware <= '9')),
      name_(fmt::format("Cedrus XID, product {}, at {}", line_.identity().product, line_.name())) {
    // A pulse of no length: lines stay as they are set.
    if (has_wide_command_)
        line_.send(std::string_view("mp\0\0\0\0", 6));
    else
        line_.send("a10"); // its connector's lines are outputs
    rest();                // whatever a program before left raised
}

bool XidTrigger::write(std::uint8_t lines) noexcept {
    const char wide[] = {'m', 'h', static_cast<char>(lines), '\0'};
    const char narrow[] = {'a', 'h', static_cast<char>(~lines), '\0'};
    return has_wide_command_ ? line_.try_send({wide, sizeof wide}) : line_.try_send({narrow, sizeof narrow});
}

std::string XidTrigger::fault() const {
    return line_.lost() ? line_.loss() : "the device did not take them in time";
}

template <> MarkerDevice marker_device_of<kind_called<MarkerOutputKind>("xid")>() {
    return {.open = [](const MarkerParts& parts) -> std::unique_ptr<MarkerOutput> {
        return std::make_unique<XidTrigger>(
            xid_port(parts.settings.address),
            [&clock = parts.clock](const std::string& port, int baud) {
                return open_serial_line(port, clock, baud);
            },
            parts.clock);
    }};
}

} // namespace overt
