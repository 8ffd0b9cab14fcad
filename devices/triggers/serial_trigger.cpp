#include "devices/triggers/serial_trigger.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
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

namespace {

std::string why_not_taken(const ByteTransport& line) {
    return line.lost() ? line.loss() : "the port did not take them in time";
}

} // namespace

std::string SerialTrigger::fault() const { return why_not_taken(*line_); }

SerialText::SerialText(std::unique_ptr<ByteTransport> line, const Clock& clock, bool sends_codes)
    : line_(std::move(line)), clock_(clock), sends_codes_(sends_codes),
      name_(fmt::format("serial port {}, lines of text", line_->name())) {}

bool SerialText::send(const Marker& marker) noexcept {
    std::array<char, longest_marker + 1> bytes;
    std::size_t count = 0;
    if (sends_codes_ || marker.text.empty()) {
        count = static_cast<std::size_t>(
            std::to_chars(bytes.data(), bytes.data() + longest_marker, marker.code).ptr - bytes.data());
    } else {
        count = std::min(marker.text.size(), longest_marker);
        std::memcpy(bytes.data(), marker.text.data(), count);
    }
    bytes[count++] = '\n';
    return line_->write({bytes.data(), count}, clock_.now() + writing_time);
}

std::string SerialText::fault() const { return why_not_taken(*line_); }

template <> MarkerDevice marker_device_of<kind_called<MarkerOutputKind>("serial")>() {
    return {.open = [](const MarkerParts& parts) -> std::unique_ptr<MarkerOutput> {
                const MarkerOutputSettings& settings = parts.settings;
                auto line = open_serial_line(settings.address, parts.clock, settings.baud);
                if (settings.as_text)
                    return std::make_unique<SerialText>(std::move(line), parts.clock,
                                                        !settings.codes.empty());
                return std::make_unique<SerialTrigger>(std::move(line), parts.clock);
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
                        lines.push_back(fmt::format("{}: kind serial{}", describe(port), latency_note(port)));
                    return lines;
                }};
}

} // namespace overt
