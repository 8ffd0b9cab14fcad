#include "devices/link/serial_port_search.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <string_view>

#include <fmt/format.h>

#include "experiment/base/text_number.h"

namespace overt {
namespace {

namespace fs = std::filesystem;

std::string first_line(const fs::path& file) {
    std::ifstream stream(file);
    std::string line;
    std::getline(stream, line);
    return line;
}

/// The number after the prefix, nothing for other names.
std::optional<int> port_number(const std::string& name, std::string_view prefix) {
    return name.starts_with(prefix) ? number_in<int>(std::string_view(name).substr(prefix.size()))
                                    : std::nullopt;
}

void collect_names(const fs::path& folder, std::string_view prefix, std::map<int, std::string>& names) {
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        if (const auto number = port_number(name, prefix))
            names.emplace(*number, name);
    }
}

/// The tty belongs to a USB interface, which lies within the USB device: the first folder upward that has an
/// idVendor.
void read_usb_device(const fs::path& tty, SerialPortInfo& port) {
    std::error_code error;
    fs::path folder = fs::canonical(tty, error);
    for (; !error && folder.has_relative_path(); folder = folder.parent_path()) {
        std::error_code absent;
        if (!port.latency_timer_ms && fs::exists(folder / "latency_timer", absent))
            port.latency_timer_ms = number_in<int>(first_line(folder / "latency_timer"));
        if (!fs::exists(folder / "idVendor", absent))
            continue;
        port.vendor_id = number_in<std::uint16_t>(first_line(folder / "idVendor"), 16);
        port.product_id = number_in<std::uint16_t>(first_line(folder / "idProduct"), 16);
        port.manufacturer = first_line(folder / "manufacturer");
        port.product = first_line(folder / "product");
        port.serial_number = first_line(folder / "serial");
        return;
    }
}

} // namespace

std::string describe(const SerialPortInfo& port) {
    std::string identity;
    if (port.vendor_id && port.product_id)
        identity = fmt::format("{:04x}:{:04x}", *port.vendor_id, *port.product_id);
    if (!port.product.empty())
        identity += (identity.empty() ? "" : " ") + port.product;
    return identity.empty() ? port.path : fmt::format("{} ({})", port.path, identity);
}

std::string latency_note(const SerialPortInfo& port) {
    if (port.latency_timer_ms.value_or(0) <= 1)
        return {};
    return fmt::format(
        ", its chip gathers bytes for up to {} ms (latency_timer): overt asks for 1 ms while it "
        "has the port; for other programs echo 1 | sudo tee "
        "/sys/bus/usb-serial/devices/{}/latency_timer",
        *port.latency_timer_ms, fs::path(port.path).filename().string());
}

std::vector<SerialPortInfo> serial_ports(const fs::path& devices, const fs::path& sysfs,
                                         std::string_view prefix) {
    std::map<int, std::string> names;
    collect_names(sysfs / "class/tty", prefix, names);
    collect_names(devices, prefix, names); // a container may have the node and no sysfs
    std::vector<SerialPortInfo> ports;
    for (const auto& [number, name] : names) {
        std::error_code absent;
        if (!fs::exists(devices / name, absent))
            continue;
        SerialPortInfo& port = ports.emplace_back();
        port.path = (devices / name).string();
        read_usb_device(sysfs / "class/tty" / name, port);
    }
    return ports;
}

} // namespace overt
