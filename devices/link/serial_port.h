/// A serial line of the system: the tty that a USB device of the CDC class appears as, or one with a UART.
#pragma once

#include <string>

#include "devices/link/descriptor_line.h"

namespace overt {

/// Opens a tty for this program alone: raw bytes, no echo, no flow control, modem lines ignored. Whatever had
/// arrived before is thrown away.
class SerialPort final : public DescriptorLine {
  public:
    /// `baud`, with 8 data bits, no parity and 1 stop bit, has no meaning for a USB device of the CDC class.
    /// Throws DeviceError naming the port: not there, no permission, in use by another program, no tty, a
    /// speed that it cannot have. `clock` must go by itself and outlive the port.
    SerialPort(const std::string& path, const Clock& clock, int baud = 115200);
    ~SerialPort() override;
    SerialPort(const SerialPort&) = delete;
    SerialPort& operator=(const SerialPort&) = delete;
};

/// Opens SerialPorts that follow this clock.
TransportOpener serial_port_opener(const Clock& clock);

} // namespace overt
