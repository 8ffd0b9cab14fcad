#include "devices/hid/hid_driver.h"

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "tests/devices/hid/hid_bytes.h"
#include "tests/support/kept_items.h"

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
