#include "devices/usb/ftdi_line.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>

#include <fmt/format.h>
#include <libusb.h>

#include "devices/link/serial_port_search.h"
#include "experiment/base/error.h"

namespace overt {

/// Of this file alone. It has a name since FtdiLine::Chip, which has one, is made of it.
namespace ftdi {

using namespace std::chrono_literals;

/// Requests of the chip, as the Linux kernel's ftdi_sio has them; all vendor requests to the device.
enum Request : std::uint8_t {
    reset = 0,
    modem_lines = 1,
    flow_control = 2,
    speed = 3,
    data_format = 4,
    latency = 9
};
constexpr std::uint8_t to_chip = LIBUSB_REQUEST_TYPE_VENDOR; ///< outward, to the device
constexpr std::uint16_t first_line = 1; ///< of chips with several; those with one do not look at it
constexpr std::uint16_t all = 0, arrived = 1, leaving = 2, eight_bits = 8, latency_ms = 1;
constexpr std::uint16_t both_lines_up = 0x0303; ///< DTR and RTS, from which some boxes take their power
constexpr unsigned char endpoint_in = 0x81, endpoint_out = 0x02;
constexpr unsigned control_patience_ms = 500;
/// The longest packet of a chip at full speed is 64 bytes, at high speed 512.
constexpr std::size_t longest_packet = 512;
/// How long a look for what has arrived waits at most before it looks at the time again.
constexpr timeval short_wait{0, 500};

class Usb {
  public:
    Usb() {
        if (const int error = libusb_init(&context_); error != 0)
            throw DeviceError(fmt::format("USB cannot be had: {}", libusb_strerror(error)));
    }
    ~Usb() { libusb_exit(context_); }
    Usb(const Usb&) = delete;
    Usb& operator=(const Usb&) = delete;

    libusb_context* get() const { return context_; }

  private:
    libusb_context* context_ = nullptr;
};

struct CloseDevice {
    void operator()(libusb_device_handle* device) const { libusb_close(device); }
};
using OpenDevice = std::unique_ptr<libusb_device_handle, CloseDevice>;

std::string text_of(libusb_device_handle* device, std::uint8_t index) {
    std::array<unsigned char, 256> text{};
    const int length =
        index == 0 ? 0 : libusb_get_string_descriptor_ascii(device, index, text.data(), text.size());
    return {reinterpret_cast<const char*>(text.data()), static_cast<std::size_t>(std::max(length, 0))};
}

struct FoundChip {
    FtdiChip chip;
    OpenDevice device; ///< null: it may not be opened
    int error = 0;     ///< why
};

std::vector<FoundChip> find_chips(const Usb& usb) {
    libusb_device** devices = nullptr;
    const auto count = libusb_get_device_list(usb.get(), &devices);
    if (count < 0)
        throw DeviceError(fmt::format("USB cannot be had: {}", libusb_strerror(static_cast<int>(count))));
    std::vector<FoundChip> found;
    for (std::ptrdiff_t i = 0; i < count; ++i) {
        libusb_device_descriptor descriptor{};
        if (libusb_get_device_descriptor(devices[i], &descriptor) != 0 ||
            descriptor.idVendor != ftdi_vendor_id)
            continue;
        FoundChip& one = found.emplace_back();
        one.chip.product_id = descriptor.idProduct;
        libusb_device_handle* handle = nullptr;
        one.error = libusb_open(devices[i], &handle);
        one.device.reset(handle);
        if (one.error != 0)
            continue;
        one.chip.product = text_of(handle, descriptor.iProduct);
        one.chip.serial_number = text_of(handle, descriptor.iSerialNumber);
        one.chip.has_tty = libusb_kernel_driver_active(handle, 0) == 1;
    }
    libusb_free_device_list(devices, 1);
    return found;
}

/// Product and serial number, if it is to have one.
std::pair<std::uint16_t, std::string> parse_address(const std::string& address) {
    const std::string prefix = fmt::format("usb:{:04x}:", ftdi_vendor_id);
    std::uint16_t product = 0;
    if (address.starts_with(prefix)) {
        const char *const begin = address.data() + prefix.size(), *const end =
                                                                      address.data() + address.size();
        const auto [after, error] = std::from_chars(begin, end, product, 16);
        if (error == std::errc() && after == begin + 4 && (after == end || *after == ':'))
            return {product, after == end ? "" : std::string(after + 1, end)};
    }
    throw InputError(
        fmt::format("\"{}\" is no USB serial chip: write {}6001, with four digits of its product, "
                    "and its serial number after another colon where there are several",
                    address, prefix));
}

FoundChip find_chip(const Usb& usb, const std::string& address) {
    const auto [product, serial] = parse_address(address);
    std::vector<FoundChip> fitting;
    std::string there;
    for (FoundChip& one : find_chips(usb)) {
        there += (there.empty() ? "" : ", ") + describe(one.chip);
        // One that may not be opened does not tell its serial number: it may be the one.
        if (one.chip.product_id == product &&
            (serial.empty() || one.chip.serial_number == serial || one.error == LIBUSB_ERROR_ACCESS))
            fitting.push_back(std::move(one));
    }
    if (fitting.empty())
        throw DeviceError(fmt::format("No USB serial chip {} is plugged in. Chips of FTDI that are: {}.",
                                      address, there.empty() ? "none" : there));
    if (fitting.size() > 1)
        throw DeviceError(fmt::format(
            "There are several USB serial chips {}: {}. Name one with its serial number.", address, there));
    FoundChip found = std::move(fitting.front());
    if (found.error == LIBUSB_ERROR_ACCESS)
        throw DeviceError(fmt::format("You may not open {}: install assets/udev/70-overt.rules in "
                                      "/etc/udev/rules.d and plug it in anew.",
                                      address));
    if (found.error != 0)
        throw DeviceError(fmt::format("{} cannot be opened: {}.", address, libusb_strerror(found.error)));
    if (found.chip.has_tty)
        throw DeviceError(
            fmt::format("The kernel's driver has {} as a serial port: name that, such as /dev/ttyUSB0.",
                        describe(found.chip)));
    return found;
}

} // namespace ftdi

using namespace ftdi;

std::string FtdiChip::address() const {
    return fmt::format("usb:{:04x}:{:04x}{}{}", ftdi_vendor_id, product_id, serial_number.empty() ? "" : ":",
                       serial_number);
}

std::string describe(const FtdiChip& chip) {
    return chip.product.empty() ? chip.address() : fmt::format("{} ({})", chip.address(), chip.product);
}

std::vector<FtdiChip> ftdi_chips() {
    const Usb usb;
    std::vector<FtdiChip> chips;
    for (FoundChip& one : find_chips(usb))
        chips.push_back(std::move(one.chip));
    return chips;
}

std::optional<FtdiSpeed> ftdi_speed(int baud) {
    constexpr int slowest = 184, fastest = 3'000'000, base = 8 * fastest;
    constexpr std::array<unsigned, 8> encoded_eighths{0, 3, 2, 4, 1, 5, 6, 7};
    if (baud < slowest || baud > fastest)
        return std::nullopt;
    const auto eighths = static_cast<unsigned>((base + baud / 2) / baud);
    unsigned divisor = eighths >> 3 | encoded_eighths[eighths & 7] << 14;
    // Its two fastest speeds are exceptions.
    if (divisor == 1)
        divisor = 0;
    else if (divisor == 0x4001)
        divisor = 1;
    return FtdiSpeed{static_cast<std::uint16_t>(divisor & 0xFFFF), static_cast<std::uint16_t>(divisor >> 16)};
}

/// The open chip, and a transfer that is always under way for what it sends.
class FtdiLine::Chip {
  public:
    Chip(const std::string& address, int baud) : found_(find_chip(usb_, address)) {
        const auto chip_speed = ftdi_speed(baud);
        if (!chip_speed)
            throw DeviceError(fmt::format("{} cannot have {} baud: 184 to 3,000,000.", address, baud));
        if (const int error = libusb_claim_interface(device(), 0); error != 0)
            throw DeviceError(fmt::format("{} cannot be had: {}. Is another program using it?", address,
                                          libusb_strerror(error)));
        const auto ask = [&](Request request, std::uint16_t value, std::uint16_t index) {
            if (const int error = libusb_control_transfer(device(), to_chip, request, value, index, nullptr,
                                                          0, control_patience_ms);
                error < 0)
                throw DeviceError(
                    fmt::format("{} does not take its settings: {}.", address, libusb_strerror(error)));
        };
        ask(reset, all, first_line);
        ask(latency, latency_ms, first_line);
        ask(data_format, eight_bits, first_line);
        ask(flow_control, 0, first_line);
        ask(speed, chip_speed->value, chip_speed->index);
        ask(modem_lines, both_lines_up, first_line);
        ask(reset, arrived, first_line);
        ask(reset, leaving, first_line);
        transfer_ = libusb_alloc_transfer(0);
        libusb_fill_bulk_transfer(transfer_, device(), endpoint_in, packet_.data(),
                                  static_cast<int>(packet_.size()), &Chip::on_packet, this, 0);
        packet_bytes_ = std::max(libusb_get_max_packet_size(libusb_get_device(device()), endpoint_in), 64);
        submit();
    }
    ~Chip() {
        if (is_under_way_)
            libusb_cancel_transfer(transfer_);
        while (is_under_way_ && libusb_handle_events_completed(usb_.get(), nullptr) == 0) {
        }
        libusb_free_transfer(transfer_);
        libusb_release_interface(device(), 0);
    }
    Chip(const Chip&) = delete;
    Chip& operator=(const Chip&) = delete;

    libusb_device_handle* device() const { return found_.device.get(); }
    int loss() const { return loss_; }
    void lose(int error) noexcept {
        if (loss_ == 0)
            loss_ = error;
    }

    /// Lets libusb hand over what has arrived; does not wait, or a short while.
    void look(bool waits) noexcept {
        timeval wait = waits ? short_wait : timeval{0, 0};
        libusb_handle_events_timeout_completed(usb_.get(), &wait, nullptr);
    }

    std::size_t take(std::span<char> into) noexcept {
        std::size_t taken = 0;
        while (taken < into.size() && at_ < filled_) {
            // Each packet of the transfer begins with the status.
            const std::size_t in_packet = at_ % static_cast<std::size_t>(packet_bytes_);
            if (in_packet < ftdi_status_bytes) {
                at_ += ftdi_status_bytes - in_packet;
                continue;
            }
            const std::size_t count = std::min(
                {into.size() - taken, filled_ - at_, static_cast<std::size_t>(packet_bytes_) - in_packet});
            std::memcpy(into.data() + taken, packet_.data() + at_, count);
            taken += count;
            at_ += count;
        }
        if (at_ >= filled_ && !is_under_way_ && loss_ == 0)
            submit();
        return taken;
    }

  private:
    void submit() noexcept {
        at_ = filled_ = 0;
        const int error = libusb_submit_transfer(transfer_);
        is_under_way_ = error == 0;
        if (error != 0)
            lose(error);
    }

    static void LIBUSB_CALL on_packet(libusb_transfer* transfer) {
        auto& chip = *static_cast<Chip*>(transfer->user_data);
        chip.is_under_way_ = false;
        chip.filled_ = static_cast<std::size_t>(transfer->actual_length);
        if (transfer->status == LIBUSB_TRANSFER_NO_DEVICE || transfer->status == LIBUSB_TRANSFER_ERROR ||
            transfer->status == LIBUSB_TRANSFER_STALL)
            chip.lose(transfer->status == LIBUSB_TRANSFER_NO_DEVICE ? LIBUSB_ERROR_NO_DEVICE
                                                                    : LIBUSB_ERROR_IO);
    }

    Usb usb_;
    FoundChip found_;
    libusb_transfer* transfer_ = nullptr;
    std::array<unsigned char, longest_packet> packet_{};
    int packet_bytes_ = 64;
    std::size_t at_ = 0, filled_ = 0;
    bool is_under_way_ = false;
    int loss_ = 0;
};

FtdiLine::FtdiLine(const std::string& address, const Clock& clock, int baud)
    : name_(address), clock_(&clock), chip_(std::make_unique<Chip>(address, baud)) {}

FtdiLine::~FtdiLine() = default;

bool FtdiLine::lost() const noexcept { return chip_->loss() != 0; }

std::string FtdiLine::loss() const { return lost() ? libusb_strerror(chip_->loss()) : ""; }

bool FtdiLine::write(std::string_view bytes, SessionTime deadline) noexcept {
    while (!bytes.empty() && !lost()) {
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - clock_->now());
        // For libusb 0 means without end.
        const auto patience_ms = static_cast<unsigned>(std::clamp<std::int64_t>(left.count(), 1, 10'000));
        int written = 0;
        const int error = libusb_bulk_transfer(
            chip_->device(), endpoint_out, reinterpret_cast<unsigned char*>(const_cast<char*>(bytes.data())),
            static_cast<int>(bytes.size()), &written, patience_ms);
        bytes.remove_prefix(static_cast<std::size_t>(std::max(written, 0)));
        if (error != 0 && error != LIBUSB_ERROR_TIMEOUT)
            chip_->lose(error);
        else if (clock_->now() >= deadline)
            break;
    }
    return bytes.empty();
}

std::size_t FtdiLine::read(std::span<char> into, SessionTime deadline) noexcept {
    for (bool waits = false;; waits = true) {
        chip_->look(waits);
        if (const std::size_t taken = chip_->take(into); taken > 0)
            return taken;
        if (lost() || clock_->now() >= deadline)
            return 0;
    }
}

} // namespace overt
