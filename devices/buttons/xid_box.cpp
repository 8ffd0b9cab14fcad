#include "devices/buttons/xid_box.h"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include "devices/buttons/button_box_device.h"
#include "devices/link/serial_port_search.h"
#include "devices/usb/serial_line.h"
#include "experiment/base/error.h"

namespace overt {
namespace {

using namespace std::chrono_literals;

constexpr SessionDuration xid_exchange = 30ms;
constexpr int xid_exchanges = 3;

std::uint32_t little_endian(const unsigned char* bytes) noexcept {
    return std::uint32_t{bytes[0]} | std::uint32_t{bytes[1]} << 8 | std::uint32_t{bytes[2]} << 16 |
           std::uint32_t{bytes[3]} << 24;
}

std::vector<std::string> serial_lines_found() {
    std::vector<std::string> lines;
    for (const SerialPortInfo& port : serial_ports("/dev", "/sys", "ttyUSB"))
        lines.push_back(fmt::format(
            "{}: a serial line{}{}", describe(port),
            port.vendor_id == ftdi_vendor_id ? ", of kind xid if it is a box of Cedrus; not asked" : "",
            latency_note(port)));
    try {
        for (const FtdiChip& chip : ftdi_chips())
            if (!chip.has_tty)
                lines.push_back(fmt::format("{}: a serial chip without a port, address {}; not asked",
                                            describe(chip), chip.address()));
    } catch (const Error& error) {
        lines.emplace_back(error.what());
    }
    return lines;
}

} // namespace

void XidParser::drop(std::size_t count) noexcept {
    std::memmove(bytes_.data(), bytes_.data() + count, size_ - count);
    size_ -= count;
}

std::size_t XidParser::feed(std::span<const char> bytes) noexcept {
    const std::size_t taken = std::min(bytes.size(), bytes_.size() - size_);
    std::memcpy(bytes_.data() + size_, bytes.data(), taken);
    size_ += taken;
    return taken;
}

std::optional<XidKey> XidParser::next() noexcept {
    while (size_ > 0) {
        // Bits 2 and 3 of a port are never set.
        if (bytes_[0] == 'k') {
            if (size_ < 2)
                return std::nullopt;
            const unsigned info = bytes_[1];
            if ((info & 0x0C) == 0) {
                if (size_ < 6)
                    return std::nullopt;
                const unsigned number = info >> 5;
                const XidKey key{number == 0 ? 8 : static_cast<int>(number), static_cast<int>(info & 0x0F),
                                 (info & 0x10) != 0, little_endian(bytes_.data() + 2)};
                drop(6);
                return key;
            }
        } else if (bytes_[0] == 'o') {
            if (size_ < 4)
                return std::nullopt;
            if (bytes_[3] == '0' || bytes_[3] == '1') {
                if (size_ < 9)
                    return std::nullopt;
                const XidKey key{bytes_[2], bytes_[1], bytes_[3] == '1', little_endian(bytes_.data() + 4)};
                drop(9);
                return key;
            }
        }
        drop(1);
    }
    return std::nullopt;
}

int xid_button(const XidIdentity& identity, int key) noexcept {
    constexpr std::array<int, 9> rb_530{0, 1, 0, 2, 3, 4, 5, 0, 0}, rb_830{0, 4, 5, 2, 3, 6, 7, 1, 8};
    // Models of Riponda have the layouts, and the model numbers, of the RB boxes that they replace.
    const bool has_rb_layout = identity.product == '2' || identity.product == '5';
    if (key < 1 || key > 8 || !has_rb_layout)
        return key;
    const int place = identity.model == '1'   ? rb_530[static_cast<std::size_t>(key)]
                      : identity.model == '3' ? rb_830[static_cast<std::size_t>(key)]
                                              : key;
    return place == 0 ? key : place;
}

XidBox::XidBox(const std::string& port, const Opener& open, Clock& clock)
    : clock_(&clock), line_(port, open, clock) {
    line_.send("e5"); // its clock at zero
    read_clocks();
    flush();
}

void XidBox::flush() noexcept {
    line_.flush();
    parser_.clear();
}

void XidBox::read_clocks() {
    for (int i = 0; i < xid_exchanges; ++i) {
        flush(); // a key that comes now would stand before the answer
        const SessionTime before = clock_->now();
        const std::string answer = line_.ask("_e5", 7, xid_exchange);
        if (answer.size() != 7 || !answer.starts_with("_e5"))
            continue;
        times_.add_exchange(before, little_endian(reinterpret_cast<const unsigned char*>(answer.data()) + 3),
                            clock_->now());
        has_clock_ = true;
    }
    if (line_.lost())
        throw DeviceError(fmt::format("The response box at {} is gone: {}.", line_.name(), line_.loss()));
}

ButtonBoxDescription XidBox::description() const {
    return {"xid",
            fmt::format("{}, product {}, model {}, firmware {}, {} baud", line_.name(),
                        line_.identity().product, line_.identity().model, line_.identity().firmware,
                        line_.baud()),
            has_clock_};
}

void XidBox::begin() {
    // Firmware of the first generation does not tell its clock; then changes are timed by when they were
    // fetched.
    if (has_clock_)
        read_clocks();
    flush();
    looked_ = clock_->now();
}

std::size_t XidBox::poll(std::span<ButtonChange> into) noexcept {
    const SessionTime now = clock_->now();
    std::size_t taken = 0;
    std::array<char, 64> piece;
    for (;;) {
        while (taken < into.size()) {
            const auto key = parser_.next();
            if (!key)
                break;
            if (key->port == 0)
                into[taken++] =
                    times_.of(xid_button(line_.identity(), key->key), key->is_down, key->ms, looked_, now);
        }
        if (taken == into.size())
            return taken;
        const std::size_t count = line_.read(piece, now);
        if (count == 0)
            break;
        parser_.feed(std::span(piece).first(count));
    }
    looked_ = now;
    return taken;
}

template <> ButtonBoxDevice button_box_device_of<kind_called<ButtonBoxKind>("xid")>() {
    return {.open = [](const ButtonBoxParts& parts) -> std::unique_ptr<ButtonBox> {
                return std::make_unique<XidBox>(
                    xid_port(parts.settings.address),
                    [&clock = parts.clock](const std::string& port, int baud) {
                        return open_serial_line(port, clock, baud);
                    },
                    parts.clock);
            },
            .look_for = serial_lines_found};
}

} // namespace overt
