#include "devices/buttons/xid_line.h"

#include <algorithm>
#include <array>
#include <chrono>

#include <fmt/format.h>

#include "devices/link/serial_port_search.h"
#include "devices/usb/serial_line.h"
#include "experiment/base/error.h"

namespace overt {
namespace {

constexpr SessionDuration xid_patience = std::chrono::milliseconds(200);
constexpr SessionDuration between_bytes = std::chrono::milliseconds(1);

} // namespace

std::string xid_port(const std::string& address) {
    if (!address.empty())
        return address;
    for (const SerialPortInfo& port : serial_ports("/dev", "/sys", "ttyUSB"))
        if (port.vendor_id == ftdi_vendor_id)
            return port.path;
    for (const FtdiChip& chip : ftdi_chips())
        if (!chip.has_tty)
            return chip.address();
    throw DeviceError(
        "No USB serial port (/dev/ttyUSB*) and no chip without one is such as boxes of Cedrus have: is the "
        "box plugged in? Name its port with address.");
}

XidLine::XidLine(const std::string& port, const Opener& open, Clock& clock) : clock_(&clock) {
    if (!find(port, open))
        throw DeviceError(
            fmt::format("Nothing that speaks XID answers at {}. Is it switched on, and set to XID "
                        "(on RB boxes by the switches at the back)?",
                        port));
    const auto told = [&](std::string_view command) {
        const std::string answer = ask(command, 1, xid_patience);
        return answer.empty() ? '?' : answer[0];
    };
    identity_ = {told("_d2"), told("_d3"), told("_d4")};
}

bool XidLine::find(const std::string& port, const Opener& open) {
    for (const int baud : {115200, 19200, 9600, 57600, 38400}) {
        line_.reset(); // one at a time
        line_ = open(port, baud);
        baud_ = baud;
        flush();
        const std::string answer = ask("_c1", 5, xid_patience);
        if (!answer.starts_with("_xid"))
            continue;
        if (answer != "_xid0") {
            send("c10"); // into the mode in which keys come as packets
            clock_->wait_until(clock_->now() + between_bytes);
            flush();
        }
        return true;
    }
    return false;
}

bool XidLine::try_send(std::string_view bytes) noexcept {
    const bool is_slow = identity_.firmware == '1' || identity_.firmware == '?';
    if (!is_slow)
        return line_->write({bytes.data(), bytes.size()}, clock_->now() + xid_patience);
    // Devices with the first firmware lose bytes that follow each other closely.
    for (const char& byte : bytes) {
        if (!line_->write({&byte, 1}, clock_->now() + xid_patience))
            return false;
        clock_->wait_until(clock_->now() + between_bytes);
    }
    return true;
}

void XidLine::send(std::string_view bytes) {
    if (!try_send(bytes))
        throw DeviceError(fmt::format("The device at {} takes no commands: {}.", line_->name(),
                                      line_->lost() ? line_->loss() : "time-out"));
}

std::string XidLine::ask(std::string_view command, std::size_t bytes, SessionDuration patience) {
    send(command);
    const SessionTime deadline = clock_->now() + patience;
    std::string answer;
    std::array<char, 64> piece;
    while (answer.size() < bytes && clock_->now() < deadline && !line_->lost()) {
        const std::size_t count =
            line_->read(std::span(piece).first(std::min(piece.size(), bytes - answer.size())), deadline);
        answer.append(piece.data(), count);
    }
    return answer;
}

void XidLine::flush() noexcept { read_away(*line_, clock_->now()); }

} // namespace overt
