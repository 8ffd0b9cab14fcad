#include <catch2/catch.hpp>

#include "tests/devices/display_box/box_bench.h"

using namespace overt;
using namespace overt::test;
using Catch::Matchers::Contains;

TEST_CASE("a video line comes as the box received it", "[unit]") {
    Bench bench;
    bench.box.model.video = ramp;
    auto display = bench.open();
    for (const int pixels : {1, 2, 256, 1920}) {
        const auto line = display.read_video_line(7, pixels);
        REQUIRE(line.size() == static_cast<std::size_t>(pixels));
        for (int pixel = 0; pixel < pixels; ++pixel)
            CHECK(line[static_cast<std::size_t>(pixel)] == ramp(7, pixel));
    }
}

TEST_CASE("a video line that is cut, too long or no numbers is refused", "[unit]") {
    for (const char* reply : {"1;2;3;4;5;", "1;2;3;4;5;6;7;", "1;2;3;4;5;256;", "1;2;3;4;;6;",
                              "1;2;3;4;-5;6;", "1;2;3;4;5x;6;", ""}) {
        const VideoLine line = parse_video_line(reply, 2);
        INFO(reply);
        CHECK(line.pixels.empty());
        CHECK_FALSE(line.fault.empty());
    }
    CHECK(parse_video_line("1;02;003;4;5;6", 2).pixels == std::vector<RgbBytes>{{1, 2, 3}, {4, 5, 6}});
}

TEST_CASE("an unchanged picture passes the check and the mode is set again after it", "[unit]") {
    Bench bench;
    bench.box.model.video = ramp;
    auto display = bench.open();
    display.set_mode(BoxMode::color_plus_plus);
    const VideoLineReport report = display.check_video([] { return drawn_ramps({1, 2, 600}); });
    CHECK(report.good());
    CHECK(report.readings == 9);
    CHECK(report.bytes == 9 * 256 * 3);
    CHECK_THAT(report.description(), Contains("arrived as they were drawn"));
    CHECK(display.mode() == BoxMode::color_plus_plus);
    CHECK(bench.box.model.mode == "colorPlusPlus");
}

TEST_CASE("the check names each changed byte, finds a shift of the picture, and finds dithering", "[unit]") {
    Bench bench;
    auto display = bench.open();
    SECTION("one byte") {
        bench.box.model.video = [](int line, int pixel) {
            RgbBytes bytes = ramp(line, pixel);
            if (line == 2 && pixel == 17)
                bytes[1] = 1;
            return bytes;
        };
        const auto report = display.check_video([] { return drawn_ramps({1, 2}); }, 1);
        CHECK(report.changed == 1);
        CHECK_FALSE(report.shift_px);
        CHECK_THAT(report.description(),
                   Contains("line 2, pixel 17, green: sent 238, received 1") && Contains("gamma"));
    }
    SECTION("one pixel at the edge of a line of one colour, which is no shift") {
        bench.box.model.video = [](int, int pixel) {
            return pixel == 0 ? RgbBytes{9, 9, 9} : RgbBytes{5, 5, 5};
        };
        const auto report = display.check_video([] {
            return std::vector<DrawnLine>{{1, std::vector<RgbBytes>(64, RgbBytes{5, 5, 5})}};
        });
        CHECK(report.changed == 9);
        CHECK_FALSE(report.shift_px);
    }
    SECTION("shift") {
        for (const int shift : {1, -2, 8}) {
            bench.box.model.video = [shift](int line, int pixel) {
                return pixel < shift || pixel >= 256 + shift ? RgbBytes{} : ramp(line, pixel - shift);
            };
            const auto report = display.check_video([] { return drawn_ramps({1, 5}); });
            CHECK_FALSE(report.good());
            CHECK(report.shift_px == shift);
        }
    }
    SECTION("dithering") {
        int reading = 0;
        bench.box.model.video = [&reading](int line, int pixel) {
            RgbBytes bytes = ramp(line, pixel);
            if (pixel == 100)
                bytes[0] = static_cast<std::uint8_t>(bytes[0] + reading++ % 2);
            return bytes;
        };
        const auto report = display.check_video([] { return drawn_ramps({1}); });
        CHECK(report.unsteady_lines == 1);
        CHECK_THAT(report.description(), Contains("dithering"));
    }
}
