#include "devices/hid/hid_driver.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <deque>
#include <utility>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <hidapi/hidapi.h>

#include "devices/tracker/tracker_device.h"
#include "experiment/base/error.h"
#include "tests/devices/hid/hid_bytes.h"
#include "tests/devices/tracker/row_parts.h"
#include "tests/support/kept_items.h"
#include "tests/support/next_function.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;

namespace {

HidDeviceInfo tracker_info() {
    HidDeviceInfo info;
    info.path = "/dev/hidraw0";
    info.vendor_id = 0x1209;
    info.product_id = 0x0e7e;
    info.product = "Mock Eye Tracker";
    info.serial_number = "MET-0001";
    info.usages = {{0x12, 0x10}, {0x12, 0x01}};
    return info;
}

std::vector<std::byte> gaze_report(std::uint64_t us, std::int32_t x_um, std::int32_t y_um,
                                   std::int32_t left_z_um = 600'000) {
    std::vector<std::byte> report(53);
    report[0] = std::byte{0x10};
    const std::int32_t places[11] = {x_um, y_um, -30'000, 1'000, left_z_um, 30'000, 2'000, 610'000, 0, 0, 0};
    std::memcpy(report.data() + 1, &us, 8);
    std::memcpy(report.data() + 9, places, 44);
    return report;
}

struct TrackerBench {
    VirtualClock clock;
    HidFarEnd far{clock};
    KeptItems kept;
    TrackerWish wish;
    HidTrackerSettings settings;

    TrackerBench() {
        // A screen of 500 mm by 250 mm, ready, 500 Hz.
        far.features[0x12] = bytes_of({0x12, 0x20, 0xA1, 0x07, 0, 0x90, 0xD0, 0x03, 0});
        far.features[0x13] = bytes_of({0x13, 1, 0xF4, 0x01});
        wish.screen.screen_px = {1000, 500};
        wish.eye = Eye::left;
    }
    HidDriver driver() {
        return {settings, clock, system_with(far, tracker_info(), eye_tracker_descriptor())};
    }
};

} // namespace

TEST_CASE("a HID eye tracker tells its rate and screen, and is asked to send gaze", "[unit]") {
    TrackerBench bench;
    HidDriver driver = bench.driver();
    const TrackerDescription granted = driver.connect(bench.wish);
    CHECK(granted.sample_rate_hz == 500.0);
    CHECK_FALSE(granted.both_eyes);
    CHECK(granted.model == "Mock Eye Tracker 1209:0e7e MET-0001");
    REQUIRE(bench.far.features_sent.size() == 1);
    CHECK(bench.far.features_sent[0] == bytes_of({0x14, 3}));
}

TEST_CASE("reports of a HID eye tracker are gaze in pixels by the screen that it was calibrated for",
          "[unit]") {
    TrackerBench bench;
    bench.far.arriving.push_back({SessionTime(0ms), gaze_report(1, 1, 1)}); // before the recording
    HidDriver driver = bench.driver();
    driver.connect(bench.wish);
    driver.start();
    bench.far.arriving.push_back({SessionTime(10ms), gaze_report(7'000'000'000'123, 250'000, 125'000)});
    bench.far.arriving.push_back({SessionTime(12ms), gaze_report(7'000'000'002'123, -10'000, 0)});
    bench.far.arriving.push_back(
        {SessionTime(14ms), gaze_report(7'000'000'004'123, 2'147'483'647, 0, 2'147'483'647)});
    CHECK(driver.read(bench.kept, SessionTime(100ms)) == RecordingState::running);
    CHECK(driver.read(bench.kept, SessionTime(100ms)) == RecordingState::running);
    CHECK(driver.read(bench.kept, SessionTime(100ms)) == RecordingState::running);
    const auto samples = bench.kept.all<GazeSample>();
    REQUIRE(samples.size() == 3);
    CHECK(samples[0].sampled_at == tracker_time(7'000'000'000'123));
    CHECK(samples[0].eye == Eye::left);
    REQUIRE(samples[0].gaze);
    CHECK(samples[0].gaze->x_px == Approx(500.0)); // half of a screen of 500 mm, whatever the protocol's is
    CHECK(samples[0].gaze->y_px == Approx(250.0));
    REQUIRE(samples[1].gaze);
    CHECK(samples[1].gaze->x_px == Approx(-20.0));
    CHECK_FALSE(samples[2].gaze); // it says that it does not know
    const auto details = bench.kept.all<SampleDetail>();
    REQUIRE(details.size() == 2);
    CHECK(details[0].eye_mm.value().z == Approx(600.0));
    const auto bounds = bench.kept.all<ClockPair>();
    REQUIRE(bounds.size() == 1);
    CHECK(bounds[0].after == SessionTime(10ms));
    CHECK(bounds[0].before == SessionTime(-40ms));
    CHECK(bounds[0].other == samples[0].sampled_at);
}

TEST_CASE("the largest number there is means that a HID eye tracker does not know a place", "[unit]") {
    // Even where the descriptor would let it be one.
    const HidDescriptor descriptor = parse_report_descriptor(eye_tracker_descriptor(2'147'483'647));
    std::string why;
    const auto layout = HidGazeLayout::find(descriptor, why);
    REQUIRE(layout);
    CHECK(layout->read(gaze_report(1, 2'147'483'646, 0)).value().gaze_mm);
    const auto unknown = layout->read(gaze_report(1, 2'147'483'647, 0, 2'147'483'647));
    REQUIRE(unknown);
    CHECK_FALSE(unknown->gaze_mm);
    CHECK_FALSE(unknown->left_mm);
    CHECK(unknown->right_mm);
}

TEST_CASE("other reports, reports that are cut off and times beyond all are passed over", "[unit]") {
    TrackerBench bench;
    HidDriver driver = bench.driver();
    driver.connect(bench.wish);
    driver.start();
    auto cut = gaze_report(1, 1, 1);
    cut.resize(16);
    auto other = gaze_report(1, 1, 1);
    other[0] = std::byte{0x11};
    bench.far.arriving.push_back({SessionTime(1ms), cut});
    bench.far.arriving.push_back({SessionTime(2ms), other});
    bench.far.arriving.push_back({SessionTime(3ms), gaze_report(~std::uint64_t{0}, 0, 0)});
    while (bench.clock.now() < SessionTime(10ms))
        driver.read(bench.kept, SessionTime(10ms));
    const auto samples = bench.kept.all<GazeSample>();
    REQUIRE(samples.size() == 1);
    CHECK(samples[0].sampled_at == tracker_time(3000)); // by our clock
}

TEST_CASE("a HID eye tracker that is unplugged is lost, and can be plugged in again", "[unit]") {
    TrackerBench bench;
    HidDriver driver = bench.driver();
    driver.connect(bench.wish);
    driver.start();
    bench.far.unplugged = true;
    CHECK(driver.read(bench.kept, SessionTime(5ms)) == RecordingState::lost);
    CHECK_THROWS_WITH(driver.connect(bench.wish), Catch::Contains("No HID eye tracker"));
    bench.far.unplugged = false;
    driver.connect(bench.wish);
    driver.start();
    CHECK(driver.read(bench.kept, SessionTime(9ms)) == RecordingState::running);
}

TEST_CASE("a HID eye tracker that is not ready, or none, says what is to be done", "[unit]") {
    TrackerBench bench;
    SECTION("calibrated by its maker's program") {
        bench.far.features[0x13][1] = std::byte{4};
        CHECK_THROWS_WITH(bench.driver().connect(bench.wish),
                          Catch::Contains("calibrated to the observer first"));
    }
    SECTION("told its screen") {
        bench.far.features[0x13][1] = std::byte{3};
        CHECK_THROWS_WITH(bench.driver().connect(bench.wish), Catch::Contains("told its screen first"));
    }
    SECTION("never ready") {
        bench.far.features[0x13][1] = std::byte{2};
        CHECK_THROWS_WITH(bench.driver().connect(bench.wish), Catch::Contains("after 5 s"));
        CHECK(bench.clock.now() < SessionTime(6s));
    }
    SECTION("a keyboard") {
        HidDriver driver({"1209:0e7e"}, bench.clock,
                         system_with(bench.far, tracker_info(), keyboard_descriptor()));
        CHECK_THROWS_WITH(driver.connect(bench.wish), Catch::Contains("it is no eye tracker"));
    }
    SECTION("another device") {
        bench.settings.device = "1209:ffff";
        CHECK_THROWS_WITH(bench.driver().connect(bench.wish),
                          Catch::Contains("No HID device 1209:ffff") && Catch::Contains("Mock Eye Tracker"));
    }
    SECTION("a wrong name") {
        bench.settings.device = "eyetracker";
        CHECK_THROWS_AS(bench.driver().connect(bench.wish), InputError);
    }
    SECTION("it refuses") {
        bench.far.takes_features = false;
        CHECK_THROWS_WITH(bench.driver().connect(bench.wish), Catch::Contains("does not take the request"));
    }
    SECTION("it says nothing of itself") {
        bench.far.features.clear();
        CHECK(bench.driver().connect(bench.wish).sample_rate_hz == bench.wish.rate_hz);
    }
}

TEST_CASE("HID devices are named by vendor and product in hexadecimal", "[unit]") {
    CHECK(hid_numbers("1209:0e7e") == std::pair<std::uint16_t, std::uint16_t>(0x1209, 0x0e7e));
    CHECK_FALSE(hid_numbers("1209"));
    CHECK_FALSE(hid_numbers("12099:1"));
    CHECK_FALSE(hid_numbers("1209:0e7e "));
    CHECK_FALSE(hid_numbers(""));
}

TEST_CASE("places in the page of pointers, times in other units and eyes by themselves are read by their "
          "descriptor",
          "[unit]") {
    DescriptorText text;
    text.page(0x12).open(0x01, 1).open(0x10, 2).id(0x20);
    text.usage(0x20).logical(0, 2'147'483'647).size(32, 1).unit(0x1001, -3).input(0x02); // milliseconds
    text.unit(0x11, -2).logical(-10'000, 10'000).item(0x74, 16); // a tenth of a millimetre
    text.open(0x24, 0).page(0x01).usage(0x30).usage(0x31).item(0x94, 2).input(0x02).close();
    text.page(0x12)
        .open(0x26, 0)
        .page(0x01)
        .usage(0x30)
        .usage(0x31)
        .usage(0x32)
        .item(0x94, 3)
        .input(0x02)
        .close();
    text.close().close();
    const HidDescriptor descriptor = parse_report_descriptor(text.bytes);
    std::string why;
    const auto layout = HidGazeLayout::find(descriptor, why);
    INFO(why);
    REQUIRE(layout);
    const auto report = [](int id, std::uint32_t ms, std::array<int, 5> tenths) {
        std::vector<std::byte> bytes{static_cast<std::byte>(id)};
        for (int i = 0; i < 4; ++i)
            bytes.push_back(static_cast<std::byte>((ms >> (8 * i)) & 0xFF));
        for (const int value : tenths)
            for (int i = 0; i < 2; ++i)
                bytes.push_back(static_cast<std::byte>((static_cast<unsigned>(value) >> (8 * i)) & 0xFF));
        return bytes;
    };
    const auto told = layout->read(report(0x20, 123'456, {100, -250, 1, 2, 6500}));
    REQUIRE(told);
    CHECK(told->at == tracker_time(123'456'000));
    REQUIRE(told->gaze_mm);
    CHECK(told->gaze_mm->x == Approx(10.0));
    CHECK(told->gaze_mm->y == Approx(-25.0));
    CHECK_FALSE(told->left_mm);
    REQUIRE(told->right_mm);
    CHECK(told->right_mm->x == Approx(0.1f));
    CHECK(told->right_mm->y == Approx(0.2f));
    CHECK(told->right_mm->z == Approx(650.0f));
    CHECK_FALSE(layout->read(report(0x21, 1, {1, 1, 1, 1, 1})));
    CHECK_FALSE(layout->read({}));
    // Beyond its range a place is not known, and the rest is told.
    const auto off = layout->read(report(0x20, 1, {10'001, 5, 1, 2, 3}));
    REQUIRE(off);
    CHECK_FALSE(off->gaze_mm);
    CHECK(off->right_mm);
    CHECK(off->at == tracker_time(1'000));
}

TEST_CASE("a HID eye tracker's rate is its own where it tells one, and has five seconds to be ready",
          "[unit]") {
    TrackerBench bench;
    bench.wish.rate_hz = 90.0;
    bench.far.features[0x13] = bytes_of({0x13, 1, 1, 0}); // 1 Hz
    CHECK(bench.driver().connect(bench.wish).sample_rate_hz == 1.0);
    bench.far.features[0x13] = bytes_of({0x13, 1, 0, 0});
    CHECK(bench.driver().connect(bench.wish).sample_rate_hz == 90.0);
    bench.far.features[0x13] = bytes_of({0x13, 2, 0, 0}); // sets itself up
    const SessionTime before = bench.clock.now();
    CHECK_THROWS_WITH(bench.driver().connect(bench.wish),
                      Catch::Contains("still setting itself up after 5 s"));
    CHECK(bench.clock.now() - before >= 5s);
    CHECK(bench.clock.now() - before <= 5050ms);
}

TEST_CASE("arrivals bound a HID eye tracker's clock at the first report, and each half second after it",
          "[unit]") {
    TrackerBench bench;
    bench.settings.longest_delay = 40ms;
    HidDriver driver = bench.driver();
    driver.connect(bench.wish);
    bench.far.arriving.push_back({bench.clock.now(), gaze_report(1, 1000, 2000)}); // before the recording
    driver.start();
    const SessionTime began = bench.clock.now();
    for (const SessionDuration at : {3ms, 400ms, 502ms, 503ms, 504ms}) {
        bench.far.arriving.push_back({began + at, gaze_report(1000, 1000, 2000)});
        bench.clock.wait_until(began + at);
        CHECK(driver.read(bench.kept, bench.clock.now()) == RecordingState::running);
    }
    CHECK(bench.kept.all<GazeSample>().size() == 5);
    const auto pairs = bench.kept.all<ClockPair>();
    REQUIRE(pairs.size() == 2);
    CHECK(pairs[0].after - began >= 3ms);
    CHECK(pairs[0].after - began < 4ms);
    CHECK(pairs[0].after - pairs[0].before == 40ms);
    CHECK(pairs[1].after - pairs[0].after >= 500ms);
    CHECK(pairs[1].after - pairs[0].after < 502ms);
    // What waits is read without waiting more, and no longer than the deadline is waited for it.
    const SessionTime asked = bench.clock.now();
    CHECK(driver.read(bench.kept, asked + 7ms) == RecordingState::running);
    CHECK(bench.clock.now() - asked >= 7ms);
    CHECK(bench.clock.now() - asked < 8ms);
}

TEST_CASE("a HID device is named by its path or numbers, and what is there is listed where it is not",
          "[unit]") {
    TrackerBench bench;
    for (const char* const name : {"", "1209:0e7e", "1209:0E7E", "/dev/hidraw0"}) {
        bench.settings.device = name;
        CHECK_NOTHROW(bench.driver().connect(bench.wish));
    }
    for (const char* const name : {"1209:0e7f", "1208:0e7e", "/dev/hidraw1"}) {
        bench.settings.device = name;
        CHECK_THROWS_WITH(
            bench.driver().connect(bench.wish),
            std::string("No HID device ") + name +
                " is plugged in. HID devices that are: /dev/hidraw0 (1209:0e7e Mock Eye Tracker).");
    }
    bench.settings.device = "1209";
    CHECK_THROWS_AS(bench.driver().connect(bench.wish), InputError);
    CHECK(hid_numbers("0:ffff") == std::pair<std::uint16_t, std::uint16_t>(0, 0xFFFF));
    CHECK_FALSE(hid_numbers("0:10000"));
    CHECK_FALSE(hid_numbers(":1"));
    CHECK_FALSE(hid_numbers("1:"));
}

TEST_CASE("a HID eye tracker's time in several numbers is one, whatever the signs of its parts", "[unit]") {
    for (const int bits : {8, 16, 32}) {
        DescriptorText text;
        text.page(0x12).open(0x01, 1).open(0x10, 2).id(0x20);
        text.usage(0x20)
            .logical(-(std::int64_t{1} << (bits - 1)), (std::int64_t{1} << (bits - 1)) - 1)
            .size(bits, 2)
            .input(0x02);
        text.unit(0x11, -2)
            .logical(-10'000, 10'000)
            .size(16, 2)
            .open(0x24, 0)
            .usage(0x21)
            .usage(0x22)
            .input(0x02)
            .close();
        text.close().close();
        std::string why;
        const auto layout = HidGazeLayout::find(parse_report_descriptor(text.bytes), why);
        INFO(why);
        REQUIRE(layout);
        std::vector<std::byte> report{std::byte{0x20}};
        for (int i = 0; i < bits / 8; ++i)
            report.push_back(std::byte{0xFF});
        report.push_back(std::byte{1});
        for (int i = 1; i < bits / 8; ++i)
            report.push_back(std::byte{0});
        report.resize(report.size() + 4);
        const auto told = layout->read(report);
        REQUIRE(told);
        CHECK(told->at == tracker_time((std::int64_t{1} << (bits + 1)) - 1));
    }
}

TEST_CASE("a time in another report than the gaze is not that of the gaze", "[unit]") {
    DescriptorText text;
    text.page(0x12).open(0x01, 1).open(0x10, 2).id(0x21);
    text.usage(0x20).logical(0, 2'147'483'647).size(32, 1).input(0x02);
    text.id(0x20)
        .unit(0x11, -2)
        .logical(-10'000, 10'000)
        .size(16, 2)
        .open(0x24, 0)
        .usage(0x21)
        .usage(0x22)
        .input(0x02)
        .close();
    text.close().close();
    std::string why;
    const auto layout = HidGazeLayout::find(parse_report_descriptor(text.bytes), why);
    INFO(why);
    REQUIRE(layout);
    const auto told = layout->read(bytes_of({0x20, 1, 0, 2, 0}));
    REQUIRE(told);
    CHECK_FALSE(told->at);
    CHECK(told->gaze_mm);
    CHECK_FALSE(layout->read(bytes_of({0x21, 1, 0, 2, 0})));
}

TEST_CASE("a HID eye tracker's place is known where all its numbers are, and its time where it has 64 bits",
          "[unit]") {
    const HidDescriptor descriptor = parse_report_descriptor(eye_tracker_descriptor(2'147'483'647));
    std::string why;
    const auto layout = HidGazeLayout::find(descriptor, why);
    REQUIRE(layout);
    for (std::size_t unknown = 0; unknown < 8; ++unknown) {
        CAPTURE(unknown); // of gaze x and y, the left eye's x, y and z, and the right one's
        auto report = gaze_report(1, 1000, 2000);
        const std::int32_t none = 2'147'483'647;
        std::memcpy(report.data() + 9 + 4 * unknown, &none, 4);
        const auto told = layout->read(report);
        REQUIRE(told);
        CHECK(told->gaze_mm.has_value() == (unknown >= 2));
        CHECK(told->left_mm.has_value() == (unknown < 2 || unknown >= 5));
        CHECK(told->right_mm.has_value() == (unknown < 5));
    }
    for (const int more_bits : {0, 1, 8}) {
        DescriptorText text;
        text.page(0x12).open(0x01, 1).open(0x10, 2).id(0x20);
        text.usage(0x20).logical(0, 255).size(8, 8).input(0x02);
        if (more_bits > 0)
            text.usage(0x20).logical(0, 1).size(more_bits, 1).input(0x02);
        if (more_bits % 8 != 0)
            text.size(8 - more_bits, 1).input(0x03);
        text.unit(0x11, -2)
            .logical(-10'000, 10'000)
            .size(16, 2)
            .open(0x24, 0)
            .usage(0x21)
            .usage(0x22)
            .input(0x02)
            .close();
        text.close().close();
        const auto found = HidGazeLayout::find(parse_report_descriptor(text.bytes), why);
        INFO(why);
        REQUIRE(found);
        std::vector<std::byte> report(more_bits == 0 ? 13 : 14);
        report[0] = std::byte{0x20};
        report[1] = std::byte{7};
        report[6] = std::byte{1}; // 2 to the 40th
        CHECK(found->tells_time() == (more_bits == 0));
        CHECK(found->read(report).value().at ==
              (more_bits == 0 ? std::optional(tracker_time(7 + (std::int64_t{1} << 40))) : std::nullopt));
    }
}

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
    // Of a gaze point both coordinates are needed.
    for (const int only : {0x21, 0x22}) {
        DescriptorText text;
        text.page(0x12).open(0x01, 1).open(0x10, 2).id(0x20);
        text.unit(0x11, -2)
            .logical(-10'000, 10'000)
            .size(16, 1)
            .open(0x24, 0)
            .usage(only)
            .input(0x02)
            .close();
        text.close().close();
        std::string why;
        CHECK_FALSE(HidGazeLayout::find(parse_report_descriptor(text.bytes), why));
        CHECK(why == "its reports have no gaze point");
    }
}

TEST_CASE("what a HID eye tracker says of itself counts from what can be on", "[unit]") {
    std::string why;
    const auto layout = HidGazeLayout::find(parse_report_descriptor(eye_tracker_descriptor()), why);
    REQUIRE(layout);
    const HidTrackerReadiness told[] = {HidTrackerReadiness::unknown,
                                        HidTrackerReadiness::ready,
                                        HidTrackerReadiness::configuring,
                                        HidTrackerReadiness::screen_setup_needed,
                                        HidTrackerReadiness::user_calibration_needed,
                                        HidTrackerReadiness::unknown,
                                        HidTrackerReadiness::unknown};
    for (int value = 0; value < 7; ++value)
        CHECK(layout->readiness(bytes_of({0x13, value, 0, 0})) == told[value]);
    // Half a millimetre is a screen, nothing is none.
    const auto screen = [&](int width_um, int height_um) {
        return layout
            ->screen_mm(bytes_of(
                {0x12, width_um & 0xFF, width_um >> 8, 0, 0, height_um & 0xFF, height_um >> 8, 0, 0}))
            .has_value();
    };
    CHECK(screen(500, 500));
    CHECK_FALSE(screen(0, 500));
    CHECK_FALSE(screen(500, 0));
    // A rate in hertz has the descriptor's power of ten, and one without a unit is as it stands.
    for (const int unit : {0xF001, 0}) {
        DescriptorText text;
        text.page(0x12).open(0x01, 1).open(0x10, 2).id(0x20);
        text.unit(0x11, -2)
            .logical(-10'000, 10'000)
            .size(16, 2)
            .open(0x24, 0)
            .usage(0x21)
            .usage(0x22)
            .input(0x02)
            .close();
        text.close();
        text.open(0x13, 2)
            .id(0x13)
            .unit(unit, 2)
            .logical(0, 255)
            .size(8, 1)
            .usage(0x300)
            .feature(0x82)
            .close();
        text.close();
        const auto found = HidGazeLayout::find(parse_report_descriptor(text.bytes), why);
        INFO(why);
        REQUIRE(found);
        CHECK(found->sampling_hz(bytes_of({0x13, 5})) == (unit == 0 ? 5.0 : 500.0));
        CHECK_FALSE(found->sampling_hz(bytes_of({0x13, 0})));
    }
}

TEST_CASE("each recording of a HID eye tracker begins with a bound of its clock", "[unit]") {
    TrackerBench bench;
    HidDriver driver = bench.driver();
    driver.connect(bench.wish);
    for (int recording = 1; recording <= 3; ++recording) {
        driver.start();
        bench.far.arriving.push_back({bench.clock.now() + 1ms, gaze_report(1000, 1000, 2000)});
        driver.read(bench.kept, bench.clock.now() + 2ms);
        CHECK(bench.kept.all<ClockPair>().size() == static_cast<std::size_t>(recording));
    }
}
