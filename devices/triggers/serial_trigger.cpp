#include "devices/triggers/serial_trigger.h"

#include <filesystem>

#include <fmt/format.h>

#include "devices/link/serial_port_search.h"
#include "devices/triggers/marker_device.h"
#include "devices/usb/serial_line.h"

namespace overt {
namespace {

/// A byte at 1200 baud takes 8 ms; a port that takes none for longer is stuck.
constexpr SessionDuration writing_time = std::chrono::milliseconds(50);

} // namespace

SerialTrigger::SerialTrigger(std::unique_ptr<ByteTransport> line, const Clock& clock)
    : line_(std::move(line)), clock_(clock), name_(fmt::format("serial port {}", line_->name())) {
    rest(); // whatever a program before left raised
}

bool SerialTrigger::write(std::uint8_t byte) noexcept {
    const char bytes[] = {static_cast<char>(byte)};
    return line_->write({bytes, 1}, clock_.now() + writing_time);
}

std::string SerialTrigger::fault() const {
    return line_->lost() ? line_->loss() : "the port did not take them in time";
}

template <> MarkerDevice marker_device_of<kind_called<MarkerOutputKind>("serial")>() {
    return {.open = [](const MarkerParts& parts) -> std::unique_ptr<MarkerOutput> {
                return std::make_unique<SerialTrigger>(
                    open_serial_line(parts.settings.address, parts.clock, parts.settings.baud), parts.clock);
            },
            .look_for =
                [] {
                    std::vector<std::string> lines;
                    for (int i = 0; i < 4; ++i) {
                        std::error_code absent;
                        const std::string port = fmt::format("/dev/parport{}", i);
                        if (std::filesystem::exists(port, absent))
                            lines.push_back(fmt::format("{}: kind parallel", port));
                    }
                    for (const SerialPortInfo& port : serial_ports("/dev", "/sys", "ttyUSB"))
                        lines.push_back(fmt::format("{}: kind serial", describe(port)));
                    return lines;
                }};
}

} // namespace overt
