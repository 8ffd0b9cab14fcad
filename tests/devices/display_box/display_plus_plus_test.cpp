#include <catch2/catch.hpp>

#include "tests/devices/display_box/box_bench.h"

using namespace overt;
using namespace overt::test;
using Catch::Matchers::Contains;

TEST_CASE("a box is known whatever ends its lines, whatever noise is about, and while it streams", "[unit]") {
    for (const char* end : {"\n\r", "\r", "\r\n", "\n", "\r\r\n\n"})
        for (const char* noise :
             {"", "\r\n", "x#Prod\r", "#ProductType", "$touch;9.12;100;200;1;\r", "#Unknown;7;\r\xff\xfe"})
            for (const bool streaming : {false, true}) {
                Bench bench;
                bench.box.model.line_end = end;
                bench.box.model.before_reply = noise;
                if (streaming)
                    bench.box.stream_from_now();
                const BoxIdentity identity = bench.open().identity();
                INFO(printable(end) << " after " << printable(noise));
                CHECK(identity.product == "Display++");
                CHECK(identity.serial_number == "DPP-0042");
                CHECK(identity.firmware_date == "Mar 14 2018");
                CHECK(identity.port == "/dev/ttyACM0");
            }
}

TEST_CASE("half a command that another program left in the box does not hide it", "[unit]") {
    Bench bench;
    bench.box.model.receive("$GetVideoLi", 0.0);
    CHECK(bench.open().identity().product == "Display++");
}

TEST_CASE(
    "a reply that does not come is an error in two seconds that names port, command and what came instead",
    "[unit]") {
    for (const char* command : {"SerialNumber", "FirmwareDate", "VideoFrameRate"}) {
        Bench bench;
        bench.box.model.silent_on = {command};
        const std::string message = message_of([&] { bench.open().video_rate_hz(); });
        CHECK_THAT(message, Contains("/dev/ttyACM0") && Contains(command) && Contains("but nothing"));
    }
    Bench bench;
    auto display = bench.open();
    bench.box.far.answer = [](std::string_view) { return std::string("?bad command\r"); };
    const SessionTime asked = bench.clock.now();
    CHECK_THAT(message_of([&] { display.video_rate_hz(); }), Contains("?bad command"));
    CHECK(to_seconds(bench.clock.now() - asked) == Approx(2.0).margin(0.01));
}

TEST_CASE("an answer that comes too late is not taken for that to the next question", "[unit]") {
    Bench bench;
    auto display = bench.open();
    bench.box.far.delay = 2200ms;
    CHECK_THROWS_AS(display.video_rate_hz(), DeviceError);
    bench.clock.wait_until(bench.clock.now() + 1s);
    bench.box.far.delay = 2ms;
    bench.box.model.rate_hz = 100.0;
    CHECK(display.video_rate_hz() == 100.0);

    // Half of it came before the question and half after.
    bench.box.far.send(bench.clock.now(), "#VideoFrameRate;50.0");
    bench.box.far.send(bench.clock.now() + 1ms, "00;Hz;\r");
    CHECK(display.video_rate_hz() == 100.0);
}

TEST_CASE("neither a stream nor a reply without end holds a question up", "[unit]") {
    Bench bench;
    auto display = bench.open();
    SECTION("a stream") {
        display.start_status();
        bench.box.model.silent_on = {"VideoFrameRate"};
        const SessionTime asked = bench.clock.now();
        CHECK_THAT(message_of([&] { display.video_rate_hz(); }), Contains("lines of a stream"));
        CHECK(to_seconds(bench.clock.now() - asked) == Approx(2.0).margin(0.01));
    }
    SECTION("a reply without end") {
        const SessionTime asked = bench.clock.now();
        bench.box.far.send(asked + 1ms, "#VideoFrameRate;");
        for (int i = 1; i < 100; ++i)
            bench.box.far.send(asked + i * 100ms, "1");
        bench.box.model.silent_on = {"VideoFrameRate"};
        CHECK_THAT(message_of([&] { display.video_rate_hz(); }), Contains("no end of \"#VideoFrameRate;\""));
        CHECK(to_seconds(bench.clock.now() - asked) == Approx(5.0).margin(0.01));
    }
}

TEST_CASE("an answer that is no rate is refused", "[unit]") {
    for (const char* rate : {"", "fast", "1e400", "nan", "-3", "12 0", "100000"}) {
        Bench bench;
        auto display = bench.open();
        bench.box.far.answer = [rate](std::string_view) {
            return fmt::format("#VideoFrameRate;{};\r", rate);
        };
        CHECK_THAT(message_of([&] { display.video_rate_hz(); }), Contains("is no rate"));
    }
}

TEST_CASE("a change of mode returns when the box is back and its rate is steady", "[unit]") {
    Bench bench;
    bench.box.model.mode_change_s = 1.5; // silent, then as long again unsteady
    auto display = bench.open();
    CHECK_FALSE(display.mode());
    const ModeSwitch change = display.set_mode(BoxMode::mono_plus_plus);
    CHECK(change.rate_hz == 120.0);
    CHECK(to_seconds(change.settled_after) > 3.0);
    CHECK(to_seconds(change.settled_after) < 4.5);
    CHECK(bench.box.model.mode == "monoPlusPlus");
    CHECK(display.mode() == BoxMode::mono_plus_plus);
    display.set_mode(BoxMode::color_plus_plus);
    CHECK(bench.box.model.mode == "colorPlusPlus");
    for (const char* spelling : {"colorPlusPlus", "colourPlusPlus"}) // no box is known to take both
        CHECK(std::ranges::count(bench.box.model.commands, spelling) == 1);
}

TEST_CASE("a box that does not settle after a change of mode is an error that says what was seen", "[unit]") {
    Bench bench;
    auto display = bench.open();
    bench.box.model.rate_hz = 0.0; // no video signal
    const SessionTime begun = bench.clock.now();
    CHECK_THAT(message_of([&] { display.set_mode(BoxMode::color_plus_plus); }), Contains("0.000;Hz"));
    CHECK(to_seconds(bench.clock.now() - begun) < 11.5);
    CHECK_FALSE(display.mode());
}

TEST_CASE("closing switches back to Bits++ only if something else was switched to", "[unit]") {
    Bench bench;
    bench.open();
    CHECK(std::ranges::count(bench.box.model.commands, "BitsPlusPlus") == 0);
    for (const BoxMode mode : {BoxMode::mono_plus_plus, BoxMode::color_plus_plus}) {
        bench.open().set_mode(mode);
        CHECK(bench.box.model.mode == "BitsPlusPlus");
    }
    bench.open().read_video_line(1, 4); // calls up the status screen
    CHECK(bench.box.model.mode == "BitsPlusPlus");
}

TEST_CASE("dithering and the gamma table are set as the box spells it, and only file names are let through",
          "[unit]") {
    Bench bench;
    auto display = bench.open();
    display.disable_temporal_dithering();
    display.select_gamma_table("13bitLinearLUT.txt");
    CHECK(bench.box.model.dithering == "OFF");
    CHECK(bench.box.model.gamma_table == "13bitLinearLUT.txt");
    for (const char* name : {"", "a b", "x]\r$USB_massStorage", "../config.xml;", "é"})
        CHECK_THROWS_AS(display.select_gamma_table(name), InputError);
    CHECK(bench.box.model.gamma_table == "13bitLinearLUT.txt");
}

TEST_CASE("an unplugged box is an error at a question and a state while its stream runs", "[unit]") {
    Bench bench;
    auto display = bench.open();
    display.set_mode(BoxMode::color_plus_plus);
    display.start_status();
    bench.box.far.unplugged = true;
    std::array<ArrivedStatus, 8> samples;
    while (display.poll_status(samples) > 0) {
    }
    CHECK(display.lost());
    CHECK_THAT(message_of([&] { display.video_rate_hz(); }), Contains("unplugged by the test"));
}

TEST_CASE("a box that takes no bytes is an error", "[unit]") {
    Bench bench;
    auto display = bench.open();
    bench.box.far.takes_bytes = false;
    CHECK_THAT(message_of([&] { display.disable_temporal_dithering(); }), Contains("did not take"));
}
