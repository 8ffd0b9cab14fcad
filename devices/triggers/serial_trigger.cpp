#include "devices/triggers/serial_trigger.h"

#include <fmt/format.h>

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

} // namespace overt
