/// A serial line by its address, whichever way it is reached.
#pragma once

#include "devices/link/serial_port.h"
#include "devices/usb/ftdi_line.h"

namespace overt {

/// A port of the system, such as /dev/ttyUSB0, or a chip that it has no port for, as FtdiChip::address() has
/// it. Throws as SerialPort and FtdiLine.
inline std::unique_ptr<ByteTransport> open_serial_line(const std::string& address, const Clock& clock,
                                                       int baud) {
    if (is_usb_address(address))
        return std::make_unique<FtdiLine>(address, clock, baud);
    return std::make_unique<SerialPort>(address, clock, baud);
}

} // namespace overt
