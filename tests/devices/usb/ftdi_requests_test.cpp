/// What the line over a serial chip asks of libusb, and what it makes of the answers: chips of the test's own
/// take the library's place while there are any, for this program.
#include <algorithm>
#include <array>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <libusb.h>

#include "devices/usb/ftdi_line.h"
#include "experiment/base/error.h"
#include "tests/support/counted_clock.h"
#include "tests/support/next_function.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

namespace {

struct StandingChip {
    std::uint16_t vendor = 0x0403, product = 0x6001;
    std::string name = "RB-740", serial = "AB12";
    int open_error = 0, descriptor_error = 0, driver = 0;
};

/// What a transfer brings, and how it ends.
struct BroughtPacket {
    std::string bytes;
    libusb_transfer_status status = LIBUSB_TRANSFER_COMPLETED;
};

class UsbStandIn {
  public:
    UsbStandIn() { now = this; }
    ~UsbStandIn() { now = nullptr; }
    UsbStandIn(const UsbStandIn&) = delete;
    UsbStandIn& operator=(const UsbStandIn&) = delete;

    int note(const std::string& word, const std::string& rest = {}) {
        asked.push_back(word + rest);
        const auto found = errors.find(word);
        return found == errors.end() ? 0 : found->second;
    }
    StandingChip& chip(libusb_device* device) const {
        return *const_cast<StandingChip*>(reinterpret_cast<const StandingChip*>(device));
    }
    StandingChip& chip(libusb_device_handle* handle) const {
        return *reinterpret_cast<StandingChip*>(handle);
    }
    /// Hands over what has arrived.
    void finish() {
        if (!under_way || brought.empty())
            return;
        libusb_transfer* const transfer = std::exchange(under_way, nullptr);
        const BroughtPacket packet = brought.front();
        brought.pop_front();
        packet.bytes.copy(reinterpret_cast<char*>(transfer->buffer), packet.bytes.size());
        transfer->actual_length = static_cast<int>(packet.bytes.size());
        transfer->status = packet.status;
        transfer->callback(transfer);
    }
    int times(const std::string& word) const {
        return static_cast<int>(std::count(asked.begin(), asked.end(), word));
    }

    std::vector<StandingChip> chips{{}};
    std::vector<std::string> asked;
    std::map<std::string, int> errors;
    int packet_bytes = 64, submit_error = 0, events_error = 0;
    libusb_transfer* under_way = nullptr;
    std::deque<BroughtPacket> brought;
    struct Written {
        int error = 0, bytes = 0;
    };
    std::deque<Written> written; ///< of each attempt; then all is taken
    std::string taken;
    std::vector<libusb_device*> list;
    static inline UsbStandIn* now = nullptr;
};

const std::vector<std::string> settings_of_19200_baud{
    "control 40 0 0 1 500",     "control 40 9 1 1 500",   "control 40 4 8 1 500", "control 40 2 0 1 500",
    "control 40 3 32924 0 500", "control 40 1 771 1 500", "control 40 0 1 1 500", "control 40 0 2 1 500"};

} // namespace

// They take the place of the library's for this program.
extern "C" {
int libusb_init(libusb_context** context) {
    if (!UsbStandIn::now)
        return next_function<decltype(libusb_init)>("libusb_init")(context);
    *context = reinterpret_cast<libusb_context*>(UsbStandIn::now);
    return UsbStandIn::now->note("init");
}
void libusb_exit(libusb_context* context) {
    if (!UsbStandIn::now)
        return next_function<decltype(libusb_exit)>("libusb_exit")(context);
    UsbStandIn::now->note("exit");
}
ssize_t libusb_get_device_list(libusb_context* context, libusb_device*** list) {
    if (!UsbStandIn::now)
        return next_function<decltype(libusb_get_device_list)>("libusb_get_device_list")(context, list);
    UsbStandIn& usb = *UsbStandIn::now;
    if (const int error = usb.note("list"))
        return error;
    usb.list.clear();
    for (StandingChip& chip : usb.chips)
        usb.list.push_back(reinterpret_cast<libusb_device*>(&chip));
    *list = usb.list.data();
    return static_cast<ssize_t>(usb.list.size());
}
void libusb_free_device_list(libusb_device** list, int unreferenced) {
    if (!UsbStandIn::now)
        return next_function<decltype(libusb_free_device_list)>("libusb_free_device_list")(list,
                                                                                           unreferenced);
    UsbStandIn::now->note(unreferenced == 1 ? "free list" : "keep devices");
}
int libusb_get_device_descriptor(libusb_device* device, libusb_device_descriptor* descriptor) {
    if (!UsbStandIn::now)
        return next_function<decltype(libusb_get_device_descriptor)>("libusb_get_device_descriptor")(
            device, descriptor);
    const StandingChip& chip = UsbStandIn::now->chip(device);
    *descriptor = {};
    descriptor->idVendor = chip.vendor;
    descriptor->idProduct = chip.product;
    descriptor->iManufacturer = 7;
    descriptor->iProduct = chip.name.empty() ? 0 : 2;
    descriptor->iSerialNumber = chip.serial.empty() ? 0 : 3;
    return chip.descriptor_error;
}
int libusb_open(libusb_device* device, libusb_device_handle** handle) {
    if (!UsbStandIn::now)
        return next_function<decltype(libusb_open)>("libusb_open")(device, handle);
    const StandingChip& chip = UsbStandIn::now->chip(device);
    UsbStandIn::now->note("open ", chip.serial);
    if (chip.open_error == 0)
        *handle = reinterpret_cast<libusb_device_handle*>(device);
    return chip.open_error;
}
void libusb_close(libusb_device_handle* handle) {
    if (!UsbStandIn::now)
        return next_function<decltype(libusb_close)>("libusb_close")(handle);
    UsbStandIn::now->note("close ", UsbStandIn::now->chip(handle).serial);
}
libusb_device* libusb_get_device(libusb_device_handle* handle) {
    if (!UsbStandIn::now)
        return next_function<decltype(libusb_get_device)>("libusb_get_device")(handle);
    return reinterpret_cast<libusb_device*>(handle);
}
int libusb_get_string_descriptor_ascii(libusb_device_handle* handle, std::uint8_t index, unsigned char* text,
                                       int room) {
    if (!UsbStandIn::now)
        return next_function<decltype(libusb_get_string_descriptor_ascii)>(
            "libusb_get_string_descriptor_ascii")(handle, index, text, room);
    const StandingChip& chip = UsbStandIn::now->chip(handle);
    const std::string& said = index == 2 ? chip.name : chip.serial;
    if (said == "unreadable")
        return LIBUSB_ERROR_PIPE;
    return static_cast<int>(said.copy(reinterpret_cast<char*>(text), static_cast<std::size_t>(room)));
}
int libusb_kernel_driver_active(libusb_device_handle* handle, int interface) {
    if (!UsbStandIn::now)
        return next_function<decltype(libusb_kernel_driver_active)>("libusb_kernel_driver_active")(handle,
                                                                                                   interface);
    return interface == 0 ? UsbStandIn::now->chip(handle).driver : LIBUSB_ERROR_NOT_FOUND;
}
int libusb_claim_interface(libusb_device_handle* handle, int interface) {
    if (!UsbStandIn::now)
        return next_function<decltype(libusb_claim_interface)>("libusb_claim_interface")(handle, interface);
    return UsbStandIn::now->note("claim", interface == 0 ? "" : " another");
}
int libusb_release_interface(libusb_device_handle* handle, int interface) {
    if (!UsbStandIn::now)
        return next_function<decltype(libusb_release_interface)>("libusb_release_interface")(handle,
                                                                                             interface);
    return UsbStandIn::now->note("release", interface == 0 ? "" : " another");
}
int libusb_control_transfer(libusb_device_handle* handle, std::uint8_t kind, std::uint8_t request,
                            std::uint16_t value, std::uint16_t index, unsigned char* data,
                            std::uint16_t length, unsigned timeout) {
    if (!UsbStandIn::now)
        return next_function<decltype(libusb_control_transfer)>("libusb_control_transfer")(
            handle, kind, request, value, index, data, length, timeout);
    return UsbStandIn::now->note(fmt::format("control {:02x} {} {} {} {}{}", kind, request, value, index,
                                             timeout, data || length > 0 ? " with data" : ""));
}
libusb_transfer* libusb_alloc_transfer(int packets) {
    if (!UsbStandIn::now)
        return next_function<decltype(libusb_alloc_transfer)>("libusb_alloc_transfer")(packets);
    UsbStandIn::now->note(packets == 0 ? "allocate" : "allocate packets");
    return new libusb_transfer{};
}
void libusb_free_transfer(libusb_transfer* transfer) {
    if (!UsbStandIn::now)
        return next_function<decltype(libusb_free_transfer)>("libusb_free_transfer")(transfer);
    UsbStandIn::now->note("free");
    delete transfer;
}
int libusb_submit_transfer(libusb_transfer* transfer) {
    if (!UsbStandIn::now)
        return next_function<decltype(libusb_submit_transfer)>("libusb_submit_transfer")(transfer);
    UsbStandIn& usb = *UsbStandIn::now;
    usb.note(fmt::format("submit {:02x} {} {}", transfer->endpoint, transfer->length, transfer->timeout));
    if (usb.submit_error == 0)
        usb.under_way = transfer;
    return usb.submit_error;
}
int libusb_cancel_transfer(libusb_transfer* transfer) {
    if (!UsbStandIn::now)
        return next_function<decltype(libusb_cancel_transfer)>("libusb_cancel_transfer")(transfer);
    UsbStandIn& usb = *UsbStandIn::now;
    usb.note("cancel");
    usb.brought.assign(1, {"", LIBUSB_TRANSFER_CANCELLED});
    return 0;
}
int libusb_handle_events_completed(libusb_context* context, int* completed) {
    if (!UsbStandIn::now)
        return next_function<decltype(libusb_handle_events_completed)>("libusb_handle_events_completed")(
            context, completed);
    UsbStandIn& usb = *UsbStandIn::now;
    usb.note("events");
    if (usb.events_error == 0 && usb.times("events") > 1) // one that brought something else
        usb.finish();
    return usb.events_error;
}
int libusb_handle_events_timeout_completed(libusb_context* context, timeval* wait, int* completed) {
    if (!UsbStandIn::now)
        return next_function<decltype(libusb_handle_events_timeout_completed)>(
            "libusb_handle_events_timeout_completed")(context, wait, completed);
    UsbStandIn::now->note(fmt::format("look {} {}", wait->tv_sec, wait->tv_usec));
    UsbStandIn::now->finish();
    return 0;
}
int libusb_get_max_packet_size(libusb_device* device, unsigned char endpoint) {
    if (!UsbStandIn::now)
        return next_function<decltype(libusb_get_max_packet_size)>("libusb_get_max_packet_size")(device,
                                                                                                 endpoint);
    return endpoint == 0x81 ? UsbStandIn::now->packet_bytes : 8;
}
int libusb_bulk_transfer(libusb_device_handle* handle, unsigned char endpoint, unsigned char* bytes,
                         int length, int* done, unsigned timeout) {
    if (!UsbStandIn::now)
        return next_function<decltype(libusb_bulk_transfer)>("libusb_bulk_transfer")(handle, endpoint, bytes,
                                                                                     length, done, timeout);
    UsbStandIn& usb = *UsbStandIn::now;
    usb.note(fmt::format("write {:02x} {} {}", endpoint, length, timeout));
    UsbStandIn::Written end{0, length};
    if (!usb.written.empty()) {
        end = usb.written.front();
        usb.written.pop_front();
    }
    *done = end.bytes;
    usb.taken.append(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(std::max(end.bytes, 0)));
    return end.error;
}
}

TEST_CASE(
    "chips of FTDI are found among what is plugged in, those that may not be opened without their texts",
    "[unit]") {
    UsbStandIn usb;
    usb.chips = {{.vendor = 0x0861, .serial = "other"},
                 {},
                 {.serial = "broken", .descriptor_error = LIBUSB_ERROR_IO},
                 {.product = 0xf1c0, .serial = "shut", .open_error = LIBUSB_ERROR_ACCESS},
                 {.product = 0x6014, .name = "", .serial = "", .driver = 1},
                 {.name = "unreadable", .serial = "X", .driver = LIBUSB_ERROR_NOT_SUPPORTED}};
    const std::vector<FtdiChip> chips = ftdi_chips();
    REQUIRE(chips.size() == 4);
    CHECK(describe(chips[0]) == "usb:0403:6001:AB12 (RB-740)");
    CHECK_FALSE(chips[0].has_tty);
    CHECK(describe(chips[1]) == "usb:0403:f1c0");
    CHECK(describe(chips[2]) == "usb:0403:6014");
    CHECK(chips[2].has_tty);
    CHECK(describe(chips[3]) == "usb:0403:6001:X");
    CHECK_FALSE(chips[3].has_tty);
    CHECK(usb.asked == std::vector<std::string>{"init", "list", "open AB12", "open shut", "open ", "open X",
                                                "free list", "close AB12", "close ", "close X", "exit"});
    usb.asked.clear();
    usb.errors["list"] = LIBUSB_ERROR_NO_MEM;
    CHECK_THROWS_WITH(ftdi_chips(), "USB cannot be had: Insufficient memory");
    CHECK(usb.asked == std::vector<std::string>{"init", "list", "exit"});
    usb.errors = {{"init", LIBUSB_ERROR_OTHER}};
    CHECK_THROWS_WITH(ftdi_chips(), "USB cannot be had: Other error");
}

TEST_CASE("a chip is named by its product and its serial number, and else refused with what is there",
          "[unit]") {
    UsbStandIn usb;
    CountedClock clock;
    const auto refused = [&](const std::string& address) {
        std::string why;
        try {
            const FtdiLine line(address, clock, 19200);
        } catch (const Error& error) {
            why = error.what();
        }
        return why;
    };
    for (const char* const right : {"usb:0403:6001", "usb:0403:6001:AB12", "usb:0403:6001:"})
        CHECK(refused(right).empty());
    for (const char* const wrong :
         {"", "usb:", "usb:0403:", "usb:0403:600", "usb:0403:60011", "usb:0403:600x", "usb:0403:6001AB12",
          "usb:0404:6001", "xsb:0403:6001", "usb:0403:-601"})
        CHECK_THAT(refused(wrong),
                   Contains(std::string("\"") + wrong + "\" is no USB serial chip: write usb:0403:6001"));
    CHECK(refused("usb:0403:6001:ZZ") == "No USB serial chip usb:0403:6001:ZZ is plugged in. Chips of FTDI "
                                         "that are: usb:0403:6001:AB12 (RB-740).");
    usb.chips = {{.vendor = 1}};
    CHECK_THAT(refused("usb:0403:6001"), Contains("that are: none."));
    usb.chips = {{}, {.product = 0x6002}, {.serial = "CD"}};
    CHECK(refused("usb:0403:6001") ==
          "There are several USB serial chips usb:0403:6001: usb:0403:6001:AB12 (RB-740), usb:0403:6002:AB12 "
          "(RB-740), usb:0403:6001:CD (RB-740). Name one with its serial number.");
    CHECK(refused("usb:0403:6001:CD").empty());
    CHECK(refused("usb:0403:6002").empty());
    usb.chips = {{.open_error = LIBUSB_ERROR_ACCESS}};
    for (const char* const shut : {"usb:0403:6001", "usb:0403:6001:ZZ"})
        CHECK(refused(shut) == fmt::format("You may not open {}: install assets/udev/70-overt.rules in "
                                           "/etc/udev/rules.d and plug it in anew.",
                                           shut));
    usb.chips = {{.open_error = LIBUSB_ERROR_BUSY}};
    CHECK(refused("usb:0403:6001") == "usb:0403:6001 cannot be opened: Resource busy.");
    CHECK_THAT(refused("usb:0403:6001:AB12"), Contains("No USB serial chip"));
    usb.chips = {{.driver = 1}};
    CHECK(refused("usb:0403:6001") == "The kernel's driver has usb:0403:6001:AB12 (RB-740) as a serial port: "
                                      "name that, such as /dev/ttyUSB0.");
    usb.chips = {{}};
    CHECK_THROWS_WITH(FtdiLine("usb:0403:6001", clock, 183),
                      Contains("cannot have 183 baud: 184 to 3,000,000"));
    CHECK_FALSE(ftdi_speed(183));
    CHECK(ftdi_speed(184) == FtdiSpeed{0x3FB0, 1});
}

TEST_CASE("a chip is asked for its settings in their order, and given back as it was", "[unit]") {
    UsbStandIn usb;
    CountedClock clock;
    {
        const FtdiLine line("usb:0403:6001", clock, 19200);
        CHECK(line.name() == "usb:0403:6001");
        std::vector<std::string> wanted{"init", "list", "open AB12", "free list", "claim"};
        wanted.insert(wanted.end(), settings_of_19200_baud.begin(), settings_of_19200_baud.end());
        wanted.insert(wanted.end(), {"allocate", "submit 81 512 0"});
        CHECK(usb.asked == wanted);
        usb.asked.clear();
    }
    CHECK(usb.asked ==
          std::vector<std::string>{"cancel", "events", "events", "free", "release", "close AB12", "exit"});
    // A chip that is gone brings nothing any more.
    usb.asked.clear();
    usb.events_error = LIBUSB_ERROR_NO_DEVICE;
    { const FtdiLine line("usb:0403:6001", clock, 19200); }
    CHECK(usb.times("events") == 1);
    CHECK(usb.times("free") == 1);
    usb.events_error = 0;
    usb.under_way = nullptr;
    // Nothing is under way where nothing could be begun.
    usb.asked.clear();
    usb.submit_error = LIBUSB_ERROR_IO;
    {
        const FtdiLine line("usb:0403:6001", clock, 19200);
        CHECK(line.lost());
        CHECK(line.loss() == "Input/Output Error");
    }
    CHECK(usb.times("cancel") == 0);
    CHECK(usb.times("events") == 0);
    usb.submit_error = 0;
    for (const std::string& setting : settings_of_19200_baud) {
        usb.asked.clear();
        usb.errors = {{setting, LIBUSB_ERROR_PIPE}};
        CHECK_THROWS_WITH(FtdiLine("usb:0403:6001", clock, 19200),
                          "usb:0403:6001 does not take its settings: Pipe error.");
        CHECK(usb.times("allocate") == 0);
        usb.errors = {{setting, 3}}; // bytes, and no error
        CHECK_NOTHROW(FtdiLine("usb:0403:6001", clock, 19200));
    }
    usb.asked.clear();
    usb.errors = {{"claim", LIBUSB_ERROR_BUSY}};
    CHECK_THROWS_WITH(FtdiLine("usb:0403:6001", clock, 19200),
                      "usb:0403:6001 cannot be had: Resource busy. Is another program using it?");
    CHECK(usb.asked ==
          std::vector<std::string>{"init", "list", "open AB12", "free list", "claim", "close AB12", "exit"});
}

TEST_CASE("what a chip sends is read without the status that begins each packet, however little is taken",
          "[unit]") {
    for (const int packet_bytes : {64, 512, 8, int{LIBUSB_ERROR_NOT_FOUND}}) {
        const std::size_t packet = packet_bytes == 512 ? 512 : 64;
        for (const std::size_t room : {1u, 3u, 62u, 500u}) {
            CAPTURE(packet_bytes, room);
            UsbStandIn usb;
            usb.packet_bytes = packet_bytes;
            CountedClock clock;
            FtdiLine line("usb:0403:6001", clock);
            std::string told, all;
            for (int i = 0; i < 400; ++i)
                told += static_cast<char>('a' + i % 26);
            std::string bytes;
            for (std::size_t at = 0; at < told.size(); at += packet - 2)
                bytes += "\x01\x60" + told.substr(at, packet - 2);
            usb.brought = {{"\x01\x60"}, {bytes}, {""}, {"\x01\x60"}, {"\x01\x60z"}};
            std::vector<char> some(room);
            while (all.size() < told.size() + 1) {
                const std::size_t count = line.read(some, clock.time + 1s);
                REQUIRE(count > 0);
                REQUIRE(count <= room);
                all.append(some.data(), count);
            }
            CHECK(all == told + "z");
            CHECK(usb.times("submit 81 512 0") == 6);
            CHECK(line.loss().empty());
            CHECK_FALSE(line.lost());
        }
    }
}

TEST_CASE("nothing is waited for at first, then shortly, up to the deadline", "[unit]") {
    UsbStandIn usb;
    CountedClock clock;
    FtdiLine line("usb:0403:6001", clock);
    std::array<char, 8> some{};
    usb.asked.clear();
    CHECK(line.read(some, clock.time) == 0);
    CHECK(usb.asked == std::vector<std::string>{"look 0 0"});
    usb.asked.clear();
    clock.reading = 1ms;
    CHECK(line.read(some, clock.time + 3ms) == 0);
    CHECK(usb.asked == std::vector<std::string>{"look 0 0", "look 0 500", "look 0 500"});
    usb.asked.clear();
    CHECK(line.read(std::span<char>(), clock.time) == 0);
    CHECK(usb.asked.size() == 1);
}

TEST_CASE("a chip is lost when it is unplugged or fails, for the first reason, and not when nothing came",
          "[unit]") {
    const std::pair<libusb_transfer_status, std::string> ends[] = {
        {LIBUSB_TRANSFER_NO_DEVICE, "No such device (it may have been disconnected)"},
        {LIBUSB_TRANSFER_ERROR, "Input/Output Error"},
        {LIBUSB_TRANSFER_STALL, "Input/Output Error"},
        {LIBUSB_TRANSFER_TIMED_OUT, ""},
        {LIBUSB_TRANSFER_OVERFLOW, ""},
        {LIBUSB_TRANSFER_CANCELLED, ""}};
    for (const auto& [status, why] : ends) {
        CAPTURE(status);
        UsbStandIn usb;
        CountedClock clock;
        FtdiLine line("usb:0403:6001", clock);
        usb.brought = {{"\x01\x60last", status}};
        std::array<char, 8> some{};
        CHECK(line.read(some, clock.time) == 4);
        CHECK(line.loss() == why);
        CHECK(line.lost() == !why.empty());
        // What arrived before its end was read; then there is nothing any more.
        CHECK(usb.times("submit 81 512 0") == (why.empty() ? 2 : 1));
        CHECK(line.read(some, clock.time + (why.empty() ? 0s : 1000s)) == 0);
        CHECK(line.write("x", clock.time + 1s) == why.empty());
        CHECK(usb.taken == (why.empty() ? "x" : ""));
        usb.written = {{LIBUSB_ERROR_PIPE, 0}};
        line.write("x", clock.time + 1s);
        CHECK(line.loss() == (why.empty() ? "Pipe error" : why));
    }
}

TEST_CASE("bytes are written again from where they were taken, until the deadline", "[unit]") {
    UsbStandIn usb;
    CountedClock clock;
    FtdiLine line("usb:0403:6001", clock);
    const auto write = [&](std::string_view bytes, SessionDuration left) {
        usb.asked.clear();
        usb.taken.clear();
        return line.write(bytes, clock.time + left);
    };
    using Words = std::vector<std::string>;
    CHECK(write("hello", 3200us));
    CHECK(usb.asked == Words{"write 02 5 4"});
    CHECK(usb.taken == "hello");
    CHECK(write("", 1s));
    CHECK(usb.asked.empty());
    CHECK(write("hello", 1h));
    CHECK(usb.asked == Words{"write 02 5 10000"});
    CHECK(write("hello", -1s)); // at least tried
    CHECK(usb.asked == Words{"write 02 5 1"});
    usb.written = {{LIBUSB_ERROR_TIMEOUT, 2}, {0, 1}};
    CHECK(write("hello", 1ms));
    CHECK(usb.asked == Words{"write 02 5 1", "write 02 3 1", "write 02 2 1"});
    CHECK(usb.taken == "hello");
    usb.written = {{LIBUSB_ERROR_TIMEOUT, -1}};
    CHECK_FALSE(write("hello", 0s));
    CHECK(usb.asked == Words{"write 02 5 1"});
    CHECK_FALSE(line.lost());
    usb.written = {{LIBUSB_ERROR_TIMEOUT, 0}, {LIBUSB_ERROR_NO_DEVICE, 3}};
    CHECK_FALSE(write("hello", 1s));
    CHECK(usb.asked == Words{"write 02 5 1000", "write 02 5 1000"});
    CHECK(line.lost());
    CHECK_FALSE(write("hello", 1s));
    CHECK(usb.asked.empty());
}
