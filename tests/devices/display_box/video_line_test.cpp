#include <cstdlib>

#include <catch2/catch.hpp>
#include <fmt/format.h>

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

namespace {

/// A line in which no pixel is like another.
std::vector<RgbBytes> unlike_pixels(int count) {
    std::vector<RgbBytes> pixels;
    for (int i = 0; i < count; ++i)
        pixels.push_back({static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(7 * i),
                          static_cast<std::uint8_t>(255 - i)});
    return pixels;
}

/// The picture moved to the right by so many pixels; what comes in from beside is black.
std::vector<RgbBytes> moved_by(const std::vector<RgbBytes>& pixels, int shift) {
    std::vector<RgbBytes> moved(pixels.size(), RgbBytes{0, 0, 0});
    for (int i = 0; i < static_cast<int>(pixels.size()); ++i)
        if (i - shift >= 0 && i - shift < static_cast<int>(pixels.size()))
            moved[static_cast<std::size_t>(i)] = pixels[static_cast<std::size_t>(i - shift)];
    return moved;
}

} // namespace

TEST_CASE("a line that is moved by up to eight pixels is told as that, with its direction", "[unit]") {
    const std::vector<RgbBytes> sent = unlike_pixels(40);
    for (int shift = -9; shift <= 9; ++shift) {
        CAPTURE(shift);
        VideoLineReport report;
        compare_video_line({5, sent}, {moved_by(sent, shift), moved_by(sent, shift)}, report);
        CHECK(report.readings == 2);
        CHECK(report.bytes == 2 * 40 * 3);
        REQUIRE(report.lines.size() == 1);
        CHECK(report.lines[0].line == 5);
        CHECK(report.lines[0].readings == 2);
        CHECK_FALSE(report.lines[0].is_unsteady);
        CHECK((report.changed == 0) == (shift == 0));
        CHECK(report.lines[0].changed == report.changed);
        if (shift == 0) {
            CHECK(report.lines[0].description() == "as drawn");
        } else if (std::abs(shift) <= 8) {
            CHECK(report.shift_px == shift);
            const std::string words =
                fmt::format("moved {} px to the {}", std::abs(shift), shift > 0 ? "right" : "left");
            CHECK(report.lines[0].description() == words);
            CHECK_THAT(report.description(), Contains("the lines are " + words + ":"));
        } else {
            CHECK_FALSE(report.shift_px);
            CHECK(report.lines[0].description() ==
                  fmt::format("{} bytes changed for good in 2 readings", report.changed));
        }
    }
    // Of a line that is shorter than the shift, and of one colour alone, nothing is said.
    VideoLineReport shorter;
    compare_video_line({1, unlike_pixels(1)}, {{RgbBytes{9, 9, 9}}}, shorter);
    CHECK(shorter.changed == 3);
    CHECK_FALSE(shorter.shift_px);
    VideoLineReport plain;
    const std::vector<RgbBytes> grey(20, RgbBytes{80, 80, 80});
    std::vector<RgbBytes> other = grey;
    other[0] = {81, 80, 80};
    compare_video_line({1, grey}, {other}, plain);
    CHECK(plain.changed == 1);
    CHECK_FALSE(plain.shift_px);
    REQUIRE(plain.changes.size() == 1);
    CHECK(plain.changes[0].pixel == 0);
    CHECK(plain.changes[0].channel == 0);
    CHECK(plain.changes[0].sent == 80);
    CHECK(plain.changes[0].received == 81);
}

TEST_CASE("readings of a line that differ are no shift, and the first changes alone are kept", "[unit]") {
    const std::vector<RgbBytes> sent = unlike_pixels(40);
    VideoLineReport report;
    compare_video_line({1, sent}, {moved_by(sent, 1), moved_by(sent, 2)}, report);
    CHECK_FALSE(report.shift_px);
    CHECK_FALSE(report.lines[0].shift_px);
    CHECK(report.lines[0].is_unsteady);
    CHECK(report.unsteady_lines == 1);
    CHECK(report.lines[0].description() ==
          fmt::format("{} bytes changed, differently each time in 2 readings", report.changed));
    CHECK_THAT(report.description(), Contains("1 lines came differently each time"));
    CHECK(report.changes.size() == VideoLineReport::most_changes);
    // A second line that is moved otherwise takes the shift back, and one that is not leaves its own.
    VideoLineReport two;
    compare_video_line({1, sent}, {moved_by(sent, 1)}, two);
    CHECK(two.shift_px == 1);
    compare_video_line({2, sent}, {moved_by(sent, -1)}, two);
    CHECK_FALSE(two.shift_px);
    CHECK(two.lines[1].shift_px == -1);
    CHECK(VideoLineReport().description() == "no video line was read back");
}

TEST_CASE("what is wrong with a video line is told with its number and place", "[unit]") {
    CHECK_THAT(parse_video_line("1;2;3;4;5;256;", 2).fault, Contains("number 6 of 6 is \"256\""));
    CHECK_THAT(parse_video_line("x;2;3;4;5;6;", 2).fault, Contains("number 1 of 6 is \"x\""));
    CHECK(parse_video_line("0;255;0;0;0;255;", 2).pixels == std::vector<RgbBytes>{{0, 255, 0}, {0, 0, 255}});
}
