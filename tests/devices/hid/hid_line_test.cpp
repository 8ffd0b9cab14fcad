// What is asked of the library hidapi, and what its devices are taken for.
#include "devices/hid/hid_line.h"

#include <array>
#include <cerrno>
#include <deque>
#include <utility>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <hidapi/hidapi.h>

#include "devices/hid/hid_driver.h"
#include "devices/tracker/tracker_device.h"
#include "experiment/base/error.h"
#include "tests/devices/tracker/row_parts.h"
#include "tests/support/next_function.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;

namespace {

/// HID devices as hidapi tells them, of the test's own: one entry for each collection.
struct HidStandIn {
    HidStandIn() { now = this; }
    ~HidStandIn() { now = nullptr; }
    HidStandIn(const HidStandIn&) = delete;
    HidStandIn& operator=(const HidStandIn&) = delete;

    void add(const char* path, std::uint16_t product, HidUsage usage, const wchar_t* name,
             const wchar_t* serial = L"S1", const wchar_t* maker = L"Maker") {
        hid_device_info& info = entries.emplace_back();
        info.path = const_cast<char*>(path);
        info.vendor_id = 0x1209;
        info.product_id = product;
        info.usage_page = usage.page;
        info.usage = usage.id;
        info.product_string = const_cast<wchar_t*>(name);
        info.serial_number = const_cast<wchar_t*>(serial);
        info.manufacturer_string = const_cast<wchar_t*>(maker);
    }
    std::vector<std::string> taken() { return std::exchange(asked, {}); }

    std::deque<hid_device_info> entries;
    std::vector<std::string> asked;
    std::string can_be_opened;
    int gives = 0, error = 0; ///< what the next call gives
    static inline HidStandIn* now = nullptr;
};

hid_device* standing_device() { return reinterpret_cast<hid_device*>(HidStandIn::now); }
std::string told_device(const hid_device* device) {
    return device == reinterpret_cast<hid_device*>(HidStandIn::now) ? "" : " of another device";
}

} // namespace

// They take the place of the library's for this program.
extern "C" {
hid_device_info* hid_enumerate(unsigned short vendor, unsigned short product) {
    if (!HidStandIn::now)
        return next_function<decltype(hid_enumerate)>("hid_enumerate")(vendor, product);
    auto& entries = HidStandIn::now->entries;
    HidStandIn::now->asked.push_back(fmt::format("enumerate {} {}", vendor, product));
    for (std::size_t i = 0; i < entries.size(); ++i)
        entries[i].next = i + 1 < entries.size() ? &entries[i + 1] : nullptr;
    return entries.empty() ? nullptr : &entries.front();
}
void hid_free_enumeration(hid_device_info* first) {
    if (!HidStandIn::now)
        return next_function<decltype(hid_free_enumeration)>("hid_free_enumeration")(first);
    HidStandIn::now->asked.emplace_back("free");
}
hid_device* hid_open_path(const char* path) {
    if (!HidStandIn::now)
        return next_function<decltype(hid_open_path)>("hid_open_path")(path);
    HidStandIn::now->asked.push_back(std::string("open ") + path);
    errno = HidStandIn::now->error;
    return HidStandIn::now->can_be_opened == path ? standing_device() : nullptr;
}
void hid_close(hid_device* device) {
    if (!HidStandIn::now)
        return next_function<decltype(hid_close)>("hid_close")(device);
    HidStandIn::now->asked.push_back("close" + told_device(device));
}
int hid_read_timeout(hid_device* device, unsigned char* data, std::size_t length, int ms) {
    if (!HidStandIn::now)
        return next_function<decltype(hid_read_timeout)>("hid_read_timeout")(device, data, length, ms);
    HidStandIn::now->asked.push_back(fmt::format("read {} {}{}", length, ms, told_device(device)));
    if (HidStandIn::now->gives > 0)
        data[0] = 0x5A;
    return HidStandIn::now->gives;
}
int hid_write(hid_device* device, const unsigned char* data, std::size_t length) {
    if (!HidStandIn::now)
        return next_function<decltype(hid_write)>("hid_write")(device, data, length);
    HidStandIn::now->asked.push_back(fmt::format("write {} {}{}", data[0], length, told_device(device)));
    return HidStandIn::now->gives;
}
int hid_get_feature_report(hid_device* device, unsigned char* data, std::size_t length) {
    if (!HidStandIn::now)
        return next_function<decltype(hid_get_feature_report)>("hid_get_feature_report")(device, data,
                                                                                         length);
    HidStandIn::now->asked.push_back(fmt::format("get {} {}{}", data[0], length, told_device(device)));
    return HidStandIn::now->gives;
}
int hid_send_feature_report(hid_device* device, const unsigned char* data, std::size_t length) {
    if (!HidStandIn::now)
        return next_function<decltype(hid_send_feature_report)>("hid_send_feature_report")(device, data,
                                                                                           length);
    HidStandIn::now->asked.push_back(fmt::format("send {} {}{}", data[0], length, told_device(device)));
    return HidStandIn::now->gives;
}
}

TEST_CASE("HID devices are told once each, by their paths, with all their collections", "[unit]") {
    HidStandIn hid;
    CHECK(hid_devices().empty());
    CHECK(hid.taken() == std::vector<std::string>{"enumerate 0 0", "free"});
    hid.add("/dev/hidraw2", 0x0001, {0x0C, 0x01}, L"Remote", nullptr, nullptr);
    hid.add("/dev/hidraw1", 0x0e7e, {0x12, 0x10}, L"K\u00e4stchen \u20ac \U0001F441");
    hid.add("/dev/hidraw1", 0x0e7e, {0x12, 0x01}, L"another", L"other");
    hid.add("/dev/hidraw1", 0x0e7e, {0x01, 0x06}, L"another");
    const std::vector<HidDeviceInfo> devices = hid_devices();
    REQUIRE(devices.size() == 2);
    CHECK(devices[0].path == "/dev/hidraw1");
    CHECK(devices[0].vendor_id == 0x1209);
    CHECK(devices[0].product_id == 0x0e7e);
    CHECK(devices[0].product == "K\u00e4stchen \u20ac \U0001F441");
    CHECK(devices[0].serial_number == "S1");
    CHECK(devices[0].manufacturer == "Maker");
    CHECK(devices[0].usages == std::vector<HidUsage>{{0x12, 0x10}, {0x12, 0x01}, {0x01, 0x06}});
    CHECK(is_eye_tracker(devices[0]));
    CHECK(devices[1].usages == std::vector<HidUsage>{{0x0C, 0x01}});
    CHECK(devices[1].serial_number.empty());
    CHECK_FALSE(is_eye_tracker(devices[1]));
    CHECK(describe(devices[1]) == "/dev/hidraw2 (1209:0001 Remote)");
    HidDeviceInfo nameless;
    nameless.path = "/dev/hidraw3";
    CHECK(describe(nameless) == "/dev/hidraw3 (0000:0000)");
    nameless.manufacturer = "Maker";
    CHECK(describe(nameless) == "/dev/hidraw3 (0000:0000 Maker)");
    const auto look_for = tracker_device_of<kind_called<TrackerKind>("hid")>().look_for;
    CHECK(look_for() == "Maker K\u00e4stchen \u20ac \U0001F441 at /dev/hidraw1");
    hid.add("/dev/hidraw4", 2, {0x12, 0x01}, L"B", nullptr, L"A");
    CHECK(look_for() == "Maker K\u00e4stchen \u20ac \U0001F441 at /dev/hidraw1; A B at /dev/hidraw4");
    hid.entries.clear();
    CHECK(look_for() == "none is connected");
    // A character that is none stands as such.
    hid.add("/dev/hidraw1", 1, {0x12, 0x01}, L"a\x7F\x80\x7FF\x800\xD7FF\xD800\xDFFF\xE000\x110000z");
    CHECK(hid_devices().at(0).product == "a\x7F\xC2\x80\xDF\xBF\xE0\xA0\x80\xED\x9F\xBF\xEF\xBF\xBD"
                                         "\xEF\xBF\xBD\xEE\x80\x80\xEF\xBF\xBDz");
}

TEST_CASE("a HID line asks hidapi for whole milliseconds, and is lost when a reading fails", "[unit]") {
    HidStandIn hid;
    hid.can_be_opened = "/dev/hidraw7";
    VirtualClock clock(SessionTime(10s));
    using Words = std::vector<std::string>;
    {
        const auto line = open_hid("/dev/hidraw7", clock);
        CHECK(line->name() == "/dev/hidraw7");
        CHECK(hid.taken() == Words{"open /dev/hidraw7"});
        std::array<std::byte, 12> report{};
        hid.gives = 9;
        CHECK(line->read(report, SessionTime(10s + 2500us)) == 9);
        CHECK(report[0] == std::byte{0x5A});
        CHECK(line->read(report, SessionTime(9s)) == 9); // past: not waited for
        CHECK(line->read(report, SessionTime(10s)) == 9);
        CHECK(line->read(report, SessionTime(100h)) == 9);
        CHECK(hid.taken() == Words{"read 12 3", "read 12 0", "read 12 0", "read 12 3600000"});
        CHECK(line->read({}, SessionTime(11s)) == 0);
        CHECK(hid.taken().empty());
        report[0] = std::byte{7};
        CHECK(line->write(report));
        CHECK(line->get_feature(report) == 9);
        CHECK(line->send_feature(report));
        CHECK(hid.taken() == Words{"write 7 12", "get 7 12", "send 7 12"});
        hid.gives = 0;
        CHECK(line->read(report, SessionTime(10s)) == 0);
        CHECK(line->write(report));
        CHECK(line->get_feature(report) == 0);
        CHECK(line->send_feature(report));
        CHECK_FALSE(line->lost());
        hid.gives = -1;
        CHECK_FALSE(line->write(report));
        CHECK(line->get_feature(report) == 0);
        CHECK_FALSE(line->send_feature(report));
        CHECK_FALSE(line->lost());
        CHECK(line->read(report, SessionTime(10s)) == 0);
        CHECK(line->lost());
        hid.gives = 9;
        hid.taken();
        CHECK(line->read(report, SessionTime(10s)) == 0);
        CHECK_FALSE(line->write(report));
        CHECK(line->get_feature(report) == 0);
        CHECK_FALSE(line->send_feature(report));
        CHECK(hid.taken().empty()); // of what is lost nothing is asked
    }
    CHECK(hid.taken() == Words{"close"});
    const TemporaryFolder folder;
    CHECK_THROWS_WITH(open_hid((folder.path() / "none").string(), clock),
                      Catch::Contains("There is no HID device") && Catch::Contains("Is it plugged in?"));
    const std::string file = folder.file("hidraw0", "").string();
    hid.error = EBUSY;
    CHECK_THROWS_WITH(open_hid(file, clock), file + " cannot be opened: Device or resource busy.");
}

TEST_CASE("a HID device's descriptor is read whole, of up to 4096 bytes", "[unit]") {
    const TemporaryFolder folder;
    for (const std::size_t bytes : {1u, 100u, 4096u, 4097u, 5000u}) {
        folder.file("class/hidraw/hidraw3/device/report_descriptor", std::string(bytes, 'x'));
        // One more than there can be, so that it is refused.
        CHECK(hid_descriptor_of("/dev/hidraw3", folder.path()) ==
              std::vector<std::byte>(std::min<std::size_t>(bytes, 4097), std::byte{'x'}));
    }
    folder.file("class/hidraw/hidraw3/device/report_descriptor", "");
    CHECK_THROWS_WITH(hid_descriptor_of("/dev/hidraw3", folder.path()),
                      Catch::Contains("The report descriptor of /dev/hidraw3 cannot be read from " +
                                      folder.path().string()));
    CHECK_THROWS_AS(hid_descriptor_of("/dev/hidraw4", folder.path()), DeviceError);
}

TEST_CASE("reports that have come are forgotten, a thousand at most", "[unit]") {
    HidStandIn hid;
    hid.can_be_opened = "/dev/hidraw7";
    VirtualClock clock(SessionTime(10s));
    const auto line = open_hid("/dev/hidraw7", clock);
    std::array<std::byte, 8> report{};
    hid.taken();
    read_away(*line, report, clock);
    CHECK(hid.taken() == std::vector<std::string>{"read 8 0"});
    hid.gives = 8;
    read_away(*line, report, clock);
    CHECK(hid.taken() == std::vector<std::string>(1000, "read 8 0"));
}

TEST_CASE("the row of HID trackers takes the device from the protocol", "[unit]") {
    HidStandIn hid;
    RowParts parts;
    parts.protocol.tracker.address = "1234:abcd";
    CHECK_THROWS_WITH(parts.driver<kind_called<TrackerKind>("hid")>()->connect({}),
                      Catch::Contains("No HID device 1234:abcd is plugged in. HID devices that are: none."));
}
