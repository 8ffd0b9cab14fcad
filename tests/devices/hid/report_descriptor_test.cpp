#include "devices/hid/report_descriptor.h"

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/base/random.h"
#include "tests/devices/hid/any_hid.h"
#include "tests/devices/hid/hid_bytes.h"

using namespace overt;
using namespace overt::test;

namespace {

const HidField& field_of(const HidDescriptor& descriptor, HidUsage usage, HidUsage within = {}) {
    for (const HidField& field : descriptor.fields)
        if (field.usage == usage && (within == HidUsage{} || descriptor.is_within(field, within)))
            return field;
    throw std::runtime_error("no such field");
}

} // namespace

TEST_CASE("the fields of an eye tracker's descriptor lie where its reports have them", "[unit]") {
    const HidDescriptor descriptor = parse_report_descriptor(eye_tracker_descriptor());
    CHECK(descriptor.has_report_ids);
    CHECK(descriptor.report_bytes(HidReportKind::input, 0x10) == 53); // id, 8 of time, 11 places of 4
    CHECK(descriptor.report_bytes(HidReportKind::feature, 0x13) == 4);
    CHECK(descriptor.report_bytes(HidReportKind::feature, 0x14) == 2);
    CHECK(descriptor.report_bytes(HidReportKind::feature, 0x99) == 0);
    CHECK(descriptor.longest_report_bytes(HidReportKind::input) == 53);
    const HidField& y = field_of(descriptor, {0x12, 0x22}, {0x12, 0x24});
    CHECK(y.bit_offset == 8 * 13);
    CHECK(y.bit_size == 32);
    CHECK(y.logical_minimum == -2'000'000);
    CHECK(is_length(y));
    CHECK(hid_millimetres(y, -1500) == Approx(-1.5)); // micrometres
    CHECK_FALSE(hid_millimetres(y, 2'000'001));
    CHECK(field_of(descriptor, {0x12, 0x23}, {0x12, 0x26}).bit_offset == 8 * 37);
    const HidField& rate = field_of(descriptor, {0x12, 0x300});
    CHECK(rate.logical_maximum == 65535); // written in four bytes
    CHECK(hid_value(rate, bytes_of({0x13, 1, 0xF4, 0xFF})) == 0xFFF4);
    CHECK_FALSE(hid_millimetres(rate, 5)); // hertz are no length
}

TEST_CASE("a keyboard's descriptor has eight modifiers and six keys", "[unit]") {
    const HidDescriptor descriptor = parse_report_descriptor(keyboard_descriptor());
    CHECK_FALSE(descriptor.has_report_ids);
    CHECK(descriptor.report_bytes(HidReportKind::input, 0) == 8);
    REQUIRE(descriptor.fields.size() == 14);
    CHECK(descriptor.fields[7].usage == HidUsage{7, 0xE7});
    CHECK(descriptor.fields[7].bit_offset == 7);
    CHECK_FALSE(descriptor.fields[7].is_array);
    CHECK(descriptor.fields[8].is_array);
    CHECK(descriptor.fields[8].bit_offset == 16);
    CHECK(descriptor.fields[13].last_usage == HidUsage{7, 101});
    CHECK(hid_value(descriptor.fields[9], bytes_of({0, 0, 4, 0x1E, 0, 0, 0, 0})) == 0x1E);
}

TEST_CASE("a game pad's descriptor has axes without a sign and bits for buttons", "[unit]") {
    const HidDescriptor descriptor = parse_report_descriptor(game_pad_descriptor());
    CHECK(descriptor.report_bytes(HidReportKind::input, 0) == 4);
    REQUIRE(descriptor.fields.size() == 12);
    CHECK(descriptor.fields[0].logical_maximum == 255); // one byte, which would be -1 with a sign
    CHECK(hid_value(descriptor.fields[0], bytes_of({200, 0, 0, 0})) == 200);
    CHECK(descriptor.fields[11].usage == HidUsage{9, 10});
    CHECK(hid_value(descriptor.fields[11], bytes_of({0, 0, 0, 2})) == 1);
}

TEST_CASE("numbers are read and written across bytes, with and without a sign", "[unit]") {
    HidField field;
    field.bit_offset = 5;
    field.bit_size = 12;
    field.logical_minimum = -2048;
    std::vector<std::byte> report(4, std::byte{0xFF});
    for (const std::int64_t value : {-2048, -1, 0, 1, 2047}) {
        put_hid_value(field, value, report);
        CHECK(hid_value(field, report) == value);
    }
    CHECK(std::to_integer<int>(report[0] & std::byte{0x1F}) == 0x1F); // neighbours untouched
    CHECK(std::to_integer<int>(report[2] >> 1) == 0x7F);
    field.logical_minimum = 0;
    put_hid_value(field, 4095, report);
    CHECK(hid_value(field, report) == 4095);
    CHECK_FALSE(hid_value(field, std::span(report).first(2)));
    field.bit_offset = 0;
    field.bit_size = 64;
    const auto eight = bytes_of({1, 2, 3, 4, 5, 6, 7, 0x08});
    CHECK(hid_value(field, eight) == 0x0807060504030201);
    field.bit_offset = 1;
    CHECK_FALSE(hid_value(field, eight));
}

TEST_CASE("values go from the logical to the physical range, times the power of ten", "[unit]") {
    HidField field;
    field.logical_minimum = 0;
    field.logical_maximum = 1000;
    field.physical_minimum = -50;
    field.physical_maximum = 50;
    field.unit = 0x13; // inches
    field.unit_exponent = -1;
    CHECK(hid_physical(field, 0) == Approx(-5.0));
    CHECK(hid_physical(field, 750) == Approx(2.5));
    CHECK(hid_millimetres(field, 750) == Approx(63.5));
    CHECK_FALSE(hid_physical(field, 1001));
}

TEST_CASE("push and pop, long items, usages of four bytes and pages that come late are understood",
          "[unit]") {
    DescriptorText text;
    text.page(0x01).open(0x04, 1).logical(0, 1).size(1, 1);
    text.item(0xA4).size(16, 2).unit(0x11, -2).item(0xB4); // what is pushed comes back
    text.bytes.insert(text.bytes.end(), {std::byte{0xFE}, std::byte{3}, std::byte{0x42}, std::byte{0xC0},
                                         std::byte{0xC0}, std::byte{0xC0}}); // a long item, to be skipped
    text.item(0x08, 0x00090003, 4).usage(0x33).page(0x12).input(0x02).close();
    const HidDescriptor descriptor = parse_report_descriptor(text.bytes);
    REQUIRE(descriptor.fields.size() == 1);
    CHECK(descriptor.fields[0].usage == HidUsage{9, 3});
    CHECK(descriptor.fields[0].bit_size == 1);
    CHECK(descriptor.fields[0].unit == 0);
}

TEST_CASE("fewer usages than fields: the last one goes on; of more, the first ones count", "[unit]") {
    DescriptorText text;
    text.page(0x09).open(1, 1).logical(0, 1).size(1, 4).usage(1).usage(2).input(0x02);
    text.size(1, 2).item(0x18, 10).item(0x28, 13).input(0x02).close();
    const HidDescriptor descriptor = parse_report_descriptor(text.bytes);
    std::vector<int> ids;
    for (const HidField& field : descriptor.fields)
        ids.push_back(field.usage.id);
    CHECK(ids == std::vector<int>{1, 2, 2, 2, 10, 11});
}

TEST_CASE("report descriptors that make no sense are refused with the byte", "[unit]") {
    const auto refused = [](const DescriptorText& text, const char* why) {
        CHECK_THROWS_WITH(parse_report_descriptor(text.bytes), Catch::Contains(why));
    };
    refused(DescriptorText().close(), "byte 0: a collection ends that was not begun");
    refused(DescriptorText().open(1, 1), "a collection is not ended");
    refused(DescriptorText().item(0xB4), "a pop has no push");
    refused(DescriptorText().item(0xA4), "a push has no pop");
    refused(DescriptorText().id(0), "0 is no report id");
    refused(DescriptorText().size(1, 8).usage(1).input(2).id(3), "some reports have an id");
    refused(DescriptorText().size(65, 1).usage(1).input(2), "65 bits");
    refused(DescriptorText().item(0x74, 32).item(0x94, 0x7FFFFFFF, 4).input(2), "more than 16384 bytes");
    refused(DescriptorText().item(0x18, 5).item(0x28, 4), "ends before it begins");
    DescriptorText deep;
    for (int i = 0; i < 100; ++i)
        deep.open(1, 0);
    refused(deep, "too many collections");
    DescriptorText pushes;
    for (int i = 0; i < 100; ++i)
        pushes.item(0xA4);
    refused(pushes, "too many pushes");
    DescriptorText cut;
    cut.item(0x24, 70'000);
    cut.bytes.pop_back();
    refused(cut, "cut off");
    DescriptorText fields;
    for (int i = 0; i < 200; ++i)
        fields.size(1, 127).usage(1).input(2);
    refused(fields, "more than 12288 fields");
    CHECK_THROWS_AS(parse_report_descriptor(std::vector<std::byte>(4097)), DeviceError);
    CHECK(parse_report_descriptor({}).fields.empty());
}

TEST_CASE("damaged report descriptors are refused or understood, and reports are read within their length",
          "[unit]") {
    RandomStream random(4, "damaged descriptor");
    const std::vector<std::byte> descriptor = eye_tracker_descriptor();
    std::vector<std::byte> whole{std::byte(descriptor.size() & 0xFF), std::byte(descriptor.size() >> 8)};
    whole.insert(whole.end(), descriptor.begin(), descriptor.end());
    whole.resize(whole.size() + 53, std::byte{0x10});
    REQUIRE(take_any_hid(whole));
    int refused = 0;
    for (int round = 0; round < 3000; ++round) {
        std::vector<std::byte> bytes = whole;
        for (int i = 0; i < 3; ++i)
            bytes[2 + random.below(static_cast<std::uint32_t>(descriptor.size()))] =
                static_cast<std::byte>(random.below(256));
        refused += take_any_hid(bytes) ? 0 : 1;
    }
    CHECK(refused > 0);
    CHECK(refused < 3000);
}
