// What reports of HID eye trackers say by their descriptor.
#include "devices/hid/hid_gaze.h"

#include <array>
#include <cstring>

#include <catch2/catch.hpp>

#include "tests/devices/hid/hid_bytes.h"

using namespace overt;
using namespace overt::test;

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

TEST_CASE("a HID eye tracker's time in several numbers is one, whatever the signs of its parts", "[unit]") {
    for (const int bits : {8, 16, 32}) {
        DescriptorText text;
        text.page(0x12).open(0x01, 1).open(0x10, 2).id(0x20);
        text.usage(0x20)
            .logical(-(std::int64_t{1} << (bits - 1)), (std::int64_t{1} << (bits - 1)) - 1)
            .size(bits, 2)
            .input(0x02);
        text.gaze_point();
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
    text.id(0x20).gaze_point();
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
        text.gaze_point();
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
        text.gaze_point();
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

TEST_CASE("of a gaze point both coordinates are needed", "[unit]") {
    for (const int only : {0x21, 0x22}) {
        DescriptorText text;
        text.page(0x12).open(0x01, 1).open(0x10, 2).id(0x20);
        text.gaze_point({only});
        text.close().close();
        std::string why;
        CHECK_FALSE(HidGazeLayout::find(parse_report_descriptor(text.bytes), why));
        CHECK(why == "its reports have no gaze point");
    }
}
