/// Which serial ports there are, and what the system knows of the USB devices behind them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace overt {

/// A port and what the USB device says of itself. Texts are empty and numbers absent where it says nothing.
struct SerialPortInfo {
    std::string path; ///< such as /dev/ttyACM0
    std::optional<std::uint16_t> vendor_id = {}, product_id = {};
    std::string manufacturer = {}, product = {}, serial_number = {};
    /// So long a chip of FTDI gathers bytes before it hands them on, in ms; the kernel's default is 16.
    std::optional<int> latency_timer_ms = {};
};

/// USB vendor number of Cambridge Research Systems (public udev rules of laboratories).
inline constexpr std::uint16_t crs_vendor_id = 0x0861;

/// "/dev/ttyACM0 (0861:1001 ColorCAL)".
std::string describe(const SerialPortInfo& port);

/// What is to be known of a latency timer of more than a millisecond and how it is set, as the end of a
/// sentence; empty where there is none. SerialPort asks for one millisecond while it has the port.
std::string latency_note(const SerialPortInfo& port);

/// Whose serial chips Cedrus and many makers of trigger cables use: Future Technology Devices International.
inline constexpr std::uint16_t ftdi_vendor_id = 0x0403;

/// Ports that the system names so, by number: of the CDC class ("ttyACM"), or behind a chip that makes a
/// serial line of USB ("ttyUSB"). Reads sysfs; opens no port. Never throws: what
/// cannot be read is left out. The folders are the system's unless a caller keeps them elsewhere.
std::vector<SerialPortInfo> serial_ports(const std::filesystem::path& devices = "/dev",
                                         const std::filesystem::path& sysfs = "/sys",
                                         std::string_view prefix = "ttyACM");

} // namespace overt
