#include "devices/hid/hid_line.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include <fmt/format.h>
#include <hidapi.h>
#include <unistd.h>

#include "experiment/base/error.h"

namespace overt {
namespace {

std::string utf8_of_wide(const wchar_t* text) {
    std::string utf8;
    for (; text && *text; ++text) {
        // NOLINTNEXTLINE(bugprone-signed-char-misuse): it has the bits of a whole character
        auto code = static_cast<std::uint32_t>(*text);
        if (code > 0x10FFFF || (code >= 0xD800 && code < 0xE000))
            code = 0xFFFD;
        if (code < 0x80) {
            utf8 += static_cast<char>(code);
        } else if (code < 0x800) {
            utf8 += static_cast<char>(0xC0 | (code >> 6));
            utf8 += static_cast<char>(0x80 | (code & 0x3F));
        } else if (code < 0x10000) {
            utf8 += static_cast<char>(0xE0 | (code >> 12));
            utf8 += static_cast<char>(0x80 | ((code >> 6) & 0x3F));
            utf8 += static_cast<char>(0x80 | (code & 0x3F));
        } else {
            utf8 += static_cast<char>(0xF0 | (code >> 18));
            utf8 += static_cast<char>(0x80 | ((code >> 12) & 0x3F));
            utf8 += static_cast<char>(0x80 | ((code >> 6) & 0x3F));
            utf8 += static_cast<char>(0x80 | (code & 0x3F));
        }
    }
    return utf8;
}

/// The library, ready to be called.
void begin_hidapi() {
    static const bool is_ready = hid_init() == 0;
    if (!is_ready)
        throw DeviceError("The library hidapi does not begin, so no HID device can be used.");
}

class HidapiLine final : public HidLine {
  public:
    HidapiLine(hid_device* device, std::string path, const Clock& clock)
        : device_(device), path_(std::move(path)), clock_(clock) {}
    ~HidapiLine() override { hid_close(device_); }
    HidapiLine(const HidapiLine&) = delete;
    HidapiLine& operator=(const HidapiLine&) = delete;

    const std::string& name() const noexcept override { return path_; }

    std::size_t read(std::span<std::byte> into, SessionTime deadline) noexcept override {
        if (is_lost_ || into.empty())
            return 0;
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - clock_.now()).count();
        const int count =
            hid_read_timeout(device_, reinterpret_cast<unsigned char*>(into.data()), into.size(),
                             static_cast<int>(std::clamp<std::int64_t>(left, 0, 3'600'000)));
        is_lost_ = count < 0;
        return is_lost_ ? 0 : static_cast<std::size_t>(count);
    }
    bool write(std::span<const std::byte> report) noexcept override {
        return !is_lost_ &&
               hid_write(device_, reinterpret_cast<const unsigned char*>(report.data()), report.size()) >= 0;
    }
    std::size_t get_feature(std::span<std::byte> report) noexcept override {
        if (is_lost_)
            return 0;
        const int count =
            hid_get_feature_report(device_, reinterpret_cast<unsigned char*>(report.data()), report.size());
        return count > 0 ? static_cast<std::size_t>(count) : 0;
    }
    bool send_feature(std::span<const std::byte> report) noexcept override {
        return !is_lost_ &&
               hid_send_feature_report(device_, reinterpret_cast<const unsigned char*>(report.data()),
                                       report.size()) >= 0;
    }
    bool lost() const noexcept override { return is_lost_; }

  private:
    hid_device* device_;
    std::string path_;
    const Clock& clock_;
    bool is_lost_ = false;
};

} // namespace

void read_away(HidLine& line, std::span<std::byte> report, const Clock& clock) noexcept {
    constexpr int most_reports = 1000;
    int reports = 0;
    while (reports < most_reports && line.read(report, clock.now()) > 0)
        ++reports;
}

std::string describe(const HidDeviceInfo& device) {
    const std::string& words = device.product.empty() ? device.manufacturer : device.product;
    return fmt::format("{} ({:04x}:{:04x}{}{})", device.path, device.vendor_id, device.product_id,
                       words.empty() ? "" : " ", words);
}

std::vector<HidDeviceInfo> hid_devices() {
    begin_hidapi();
    std::vector<HidDeviceInfo> devices;
    hid_device_info* const first = hid_enumerate(0, 0);
    // The library tells a device once for each of its collections.
    for (const hid_device_info* one = first; one; one = one->next) {
        const HidUsage usage{one->usage_page, one->usage};
        const auto known = std::ranges::find(devices, std::string(one->path), &HidDeviceInfo::path);
        if (known != devices.end()) {
            known->usages.push_back(usage);
            continue;
        }
        devices.push_back({one->path,
                           one->vendor_id,
                           one->product_id,
                           utf8_of_wide(one->manufacturer_string),
                           utf8_of_wide(one->product_string),
                           utf8_of_wide(one->serial_number),
                           {usage}});
    }
    hid_free_enumeration(first);
    std::ranges::sort(devices, {}, &HidDeviceInfo::path);
    return devices;
}

std::vector<std::byte> hid_descriptor_of(const std::string& path, const std::filesystem::path& sysfs) {
    const std::filesystem::path file =
        sysfs / "class/hidraw" / std::filesystem::path(path).filename() / "device/report_descriptor";
    std::ifstream stream(file, std::ios::binary);
    std::vector<std::byte> bytes(most_descriptor_bytes + 1);
    stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(stream.gcount()));
    if (bytes.empty())
        throw DeviceError(
            fmt::format("The report descriptor of {} cannot be read from {}.", path, file.string()));
    return bytes;
}

std::unique_ptr<HidLine> open_hid(const std::string& path, const Clock& clock) {
    begin_hidapi();
    if (hid_device* device = hid_open_path(path.c_str()))
        return std::make_unique<HidapiLine>(device, path, clock);
    if (access(path.c_str(), F_OK) != 0)
        throw DeviceError(fmt::format("There is no HID device {}. Is it plugged in?", path));
    if (access(path.c_str(), R_OK | W_OK) != 0)
        throw DeviceError(
            fmt::format("{} cannot be opened: this user has no right to it. Install the rule that comes "
                        "with overt: sudo cp assets/udev/70-overt.rules /etc/udev/rules.d/, then "
                        "sudo udevadm control --reload, and plug the device in anew.",
                        path));
    throw DeviceError(fmt::format("{} cannot be opened: {}.", path, std::strerror(errno)));
}

} // namespace overt
