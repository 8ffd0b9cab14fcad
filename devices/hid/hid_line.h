/// A HID device of the system, through hidapi's hidraw back end.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "devices/hid/report_descriptor.h"
#include "experiment/ports/clock.h"

namespace overt {

/// A device, and what it says of itself. Texts are UTF-8 and empty where it says nothing.
struct HidDeviceInfo {
    std::string path; ///< such as /dev/hidraw0
    std::uint16_t vendor_id = 0, product_id = 0;
    std::string manufacturer, product, serial_number;
    std::vector<HidUsage> usages; ///< of its collections
};

/// "/dev/hidraw0 (1209:0e7e Mock Eye Tracker)".
std::string describe(const HidDeviceInfo& device);

/// All HID devices, by path, each once. Opens none.
std::vector<HidDeviceInfo> hid_devices();

/// The report descriptor of a device, as the kernel keeps it: hidapi 0.13, that Debian 12 has, does not tell
/// it. Throws DeviceError if it cannot be read. `sysfs`: another folder than the system's, for tests.
std::vector<std::byte> hid_descriptor_of(const std::string& path,
                                         const std::filesystem::path& sysfs = "/sys");

/// Reports from and to a device. Tests put another in its place.
class HidLine {
  public:
    virtual ~HidLine() = default;
    virtual const std::string& name() const noexcept = 0;

    /// The next input report, its id first if there are ids; waits until the deadline for one. Gives the
    /// number of bytes, 0 if none came or the device was lost.
    virtual std::size_t read(std::span<std::byte> into, SessionTime deadline) noexcept = 0;

    /// An output report, its id first (0: none). False if it could not be sent.
    virtual bool write(std::span<const std::byte> report) noexcept = 0;

    /// `report[0]` is the id. Gives the number of bytes that came, 0: none.
    virtual std::size_t get_feature(std::span<std::byte> report) noexcept = 0;
    virtual bool send_feature(std::span<const std::byte> report) noexcept = 0;

    /// It was unplugged. Stays true.
    virtual bool lost() const noexcept = 0;
};

/// Forgets the reports that have come by now, a thousand at most, each into `report`.
void read_away(HidLine& line, std::span<std::byte> report, const Clock& clock) noexcept;

/// Opens a device by its path. Throws DeviceError: not there, no permission (which names the udev rule that
/// gives it). `clock` must go by itself and outlive the line.
std::unique_ptr<HidLine> open_hid(const std::string& path, const Clock& clock);

} // namespace overt
