/// USB serial chips of FTDI that the kernel makes no tty of: response boxes and trigger cables whose product
/// number its driver does not know.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "devices/link/byte_transport.h"
#include "experiment/ports/clock.h"

namespace overt {

/// What such a chip says of itself. Texts are empty where it says nothing, or may not be opened.
struct FtdiChip {
    std::uint16_t product_id = 0;
    std::string product, serial_number;
    bool has_tty = false; ///< the kernel's driver has it: it is a /dev/ttyUSB
    /// As a protocol names it: "usb:0403:f1c0", and ":" with the serial number where it has one.
    std::string address() const;
};

/// "usb:0403:f1c0:AB12 (RB-740)".
std::string describe(const FtdiChip& chip);

/// Those that are plugged in. Throws DeviceError if USB cannot be had at all.
std::vector<FtdiChip> ftdi_chips();

/// Whether an address of a serial line names a chip, and not a port of the system.
inline bool is_usb_address(std::string_view address) { return address.starts_with("usb:"); }

/// The first byte of each packet tells the modem's lines, the second the line's errors: what stands before
/// the bytes of the device.
inline constexpr int ftdi_status_bytes = 2;

/// How a chip of 3 MHz (FT232 and later) is told a speed: the divisor in eighths, its fraction encoded above
/// bit 13. Nothing for speeds below 184 or above 3,000,000 baud.
struct FtdiSpeed {
    std::uint16_t value = 0, index = 0;
    bool operator==(const FtdiSpeed&) const = default;
};
std::optional<FtdiSpeed> ftdi_speed(int baud);

/// 8 data bits, no parity, 1 stop bit, no flow control. The chip hands over what has arrived each
/// millisecond.
class FtdiLine final : public ByteTransport {
  public:
    /// Throws InputError for what is no such address, DeviceError: not there, several, no permission, in use
    /// by the kernel's driver or another program, a speed that it cannot have. `clock` must go by itself and
    /// outlive the line.
    FtdiLine(const std::string& address, const Clock& clock, int baud = 115200);
    ~FtdiLine() override;
    FtdiLine(const FtdiLine&) = delete;
    FtdiLine& operator=(const FtdiLine&) = delete;

    const std::string& name() const noexcept override { return name_; }
    bool write(std::string_view bytes, SessionTime deadline) noexcept override;
    std::size_t read(std::span<char> into, SessionTime deadline) noexcept override;
    bool lost() const noexcept override;
    std::string loss() const override;

  private:
    class Chip;
    std::string name_;
    const Clock* clock_;
    std::unique_ptr<Chip> chip_;
};

} // namespace overt
