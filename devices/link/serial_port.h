/// A serial line of the system: the tty that a USB device of the CDC class appears as.
#pragma once

#include <string>

#include "devices/link/byte_transport.h"
#include "experiment/ports/clock.h"

namespace overt {

/// Opens a tty for this program alone: raw bytes, no echo, no flow control, modem lines ignored. The speed
/// set (115200) has no meaning for a USB device. Whatever had arrived before is thrown away.
class SerialPort final : public ByteTransport {
  public:
    /// Throws DeviceError naming the port: not there, no permission, in use by another program, no tty.
    /// `clock` must go by itself and outlive the port.
    SerialPort(std::string path, const Clock& clock);
    ~SerialPort() override;
    SerialPort(const SerialPort&) = delete;
    SerialPort& operator=(const SerialPort&) = delete;

    const std::string& name() const noexcept override { return path_; }
    bool write(std::string_view bytes, SessionTime deadline) noexcept override;
    std::size_t read(std::span<char> into, SessionTime deadline) noexcept override;
    bool lost() const noexcept override { return lost_; }
    std::string loss() const override;

  private:
    bool wait_for(short events, SessionTime deadline) noexcept;
    void lose(int error) noexcept;

    std::string path_;
    const Clock& clock_;
    int descriptor_ = -1;
    bool lost_ = false;
    int loss_error_ = 0; ///< errno, 0 where the other end hung up
};

/// Opens SerialPorts that follow this clock.
TransportOpener serial_port_opener(const Clock& clock);

} // namespace overt
