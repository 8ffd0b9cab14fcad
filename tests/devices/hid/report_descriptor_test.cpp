#include "devices/hid/report_descriptor.h"

#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

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

TEST_CASE("physical numbers lie between their ends as logical ones do, in their unit", "[unit]") {
    HidField field;
    field.logical_minimum = 0;
    field.logical_maximum = 200;
    CHECK(hid_physical(field, 50) == 50.0); // without physical ends they are the logical ones
    field.physical_minimum = -10;
    field.physical_maximum = 30;
    CHECK(hid_physical(field, 0) == Approx(-10.0));
    CHECK(hid_physical(field, 50) == Approx(0.0).margin(1e-12));
    CHECK(hid_physical(field, 200) == Approx(30.0));
    CHECK_FALSE(hid_physical(field, -1));
    CHECK_FALSE(hid_physical(field, 201));
    field.unit_exponent = 2;
    CHECK(hid_physical(field, 200) == Approx(3000.0));
    field.unit_exponent = -3;
    CHECK(hid_physical(field, 200) == Approx(0.03));
    field.physical_minimum = 0;
    CHECK(hid_physical(field, 100) == Approx(0.015));
    field.physical_maximum = 0;
    field.physical_minimum = -40;
    CHECK(hid_physical(field, 100) == Approx(-0.02));
    field.unit_exponent = 0;
    field.unit = 0x11; // cm
    CHECK(hid_millimetres(field, 100) == Approx(-200.0));
    field.unit = 0x13; // in
    CHECK(hid_millimetres(field, 100) == Approx(-20.0 * 25.4));
    field.unit = 0x21;
    CHECK_FALSE(is_length(field));
    CHECK_FALSE(hid_millimetres(field, 100));
    field.logical_maximum = 0; // no range at all
    CHECK(hid_physical(field, 5000) == 5000.0);
}

TEST_CASE("a descriptor's globals hold until they change, and are pushed and popped; locals do not",
          "[unit]") {
    DescriptorText text;
    text.page(0x01).open(0x04, 1);
    text.usage(0x30).logical(-5, 5).unit(0x11, -2).size(4, 1).input(0x02);                           // 0
    text.item(0xA4);                                                                                 // push
    text.page(0x09).usage(1).logical(0, 1).item(0x64, 0, 1).item(0x54, 7, 1).size(1, 3).input(0x02); // 1 to 3
    text.item(0xB4);                                                                                 // pop
    text.usage(0x31).usage(0x32).item(0x94, 3).input(0x06);          // 4 to 6, relative
    text.size(5, 1).input(0x01);                                     // fills up, and is no field
    text.item(0x18, 0x20).item(0x28, 0x21).size(8, 2).feature(0x02); // 7, 8: another report
    text.size(0, 4).usage(0x33).input(0x02);
    text.close();
    const HidDescriptor descriptor = parse_report_descriptor(text.bytes);
    REQUIRE(descriptor.fields.size() == 9);
    std::string all;
    for (const HidField& field : descriptor.fields)
        all += fmt::format("{}.{:x} at {} of {}, {} to {}, 10^{}{}; ", field.usage.page, field.usage.id,
                           field.bit_offset, field.bit_size, field.logical_minimum, field.logical_maximum,
                           field.unit_exponent, field.is_relative ? ", relative" : "");
    CHECK(all == "1.30 at 0 of 4, -5 to 5, 10^-2; 9.1 at 4 of 1, 0 to 1, 10^7; 9.1 at 5 of 1, 0 to 1, 10^7; "
                 "9.1 at 6 of 1, 0 to 1, 10^7; 1.31 at 7 of 4, -5 to 5, 10^-2, relative; "
                 "1.32 at 11 of 4, -5 to 5, 10^-2, relative; 1.32 at 15 of 4, -5 to 5, 10^-2, relative; "
                 "1.20 at 0 of 8, -5 to 5, 10^-2; 1.21 at 8 of 8, -5 to 5, 10^-2; ");
    CHECK(descriptor.report_bytes(HidReportKind::input, 0) == 3); // 24 bits
    CHECK(descriptor.report_bytes(HidReportKind::feature, 0) == 2);
    CHECK(descriptor.collections.size() == 1);
}

TEST_CASE("collections lie within each other up to 64 deep, and as many beside each other as may be",
          "[unit]") {
    const auto nested = [](int depth) {
        DescriptorText text;
        text.page(0x01);
        for (int i = 0; i < depth; ++i)
            text.open(0x04, 1);
        for (int i = 0; i < depth; ++i)
            text.close();
        return text.bytes;
    };
    CHECK(parse_report_descriptor(nested(64)).collections.size() == 64);
    CHECK_THROWS_AS(parse_report_descriptor(nested(65)), DeviceError);
    DescriptorText beside;
    beside.page(0x01).open(0x04, 1);
    for (int i = 0; i < 200; ++i)
        beside.open(0x02, 0).close();
    beside.close();
    const HidDescriptor descriptor = parse_report_descriptor(beside.bytes);
    CHECK(descriptor.collections.size() == 201);
    for (std::size_t i = 1; i < descriptor.collections.size(); ++i)
        CHECK(descriptor.collections[i].parent == 0);
    DescriptorText pushes;
    for (int i = 0; i < 65; ++i)
        pushes.item(0xA4);
    CHECK_THROWS_AS(parse_report_descriptor(pushes.bytes), DeviceError);
    for (const int wrong : {0, 256}) {
        DescriptorText id;
        CHECK_THROWS_AS(parse_report_descriptor(id.item(0x84, wrong, 2).bytes), DeviceError);
    }
    DescriptorText wide;
    wide.page(0x01).usage(0x30).size(65, 1).input(0x02);
    CHECK_THROWS_AS(parse_report_descriptor(wide.bytes), DeviceError);
    DescriptorText fits;
    fits.page(0x01).usage(0x30).size(64, 1).input(0x02);
    CHECK(parse_report_descriptor(fits.bytes).fields.size() == 1);
    DescriptorText long_report;
    long_report.page(0x01).usage(0x30).size(32, 4096).input(0x02);
    CHECK(parse_report_descriptor(long_report.bytes).report_bytes(HidReportKind::input, 0) == 16384);
    long_report.size(1, 1).input(0x02);
    CHECK_THROWS_AS(parse_report_descriptor(long_report.bytes), DeviceError);
}

TEST_CASE("a descriptor that is too long is refused with how long it is", "[unit]") {
    CHECK_THROWS_WITH(parse_report_descriptor(std::vector<std::byte>(4097)),
                      Catch::Contains("it has 4097 bytes, and 4096 are the most there can be"));
    // An item of nothing but zeros has no meaning: 4096 of them are none.
    CHECK(parse_report_descriptor(std::vector<std::byte>(4096)).fields.empty());
}

TEST_CASE("as many bits and fields as may be are read, and one more is refused", "[unit]") {
    const auto refusal = [](const DescriptorText& text) {
        try {
            parse_report_descriptor(text.bytes);
        } catch (const DeviceError& error) {
            const std::string why = error.what();
            return why.substr(why.rfind(": ") + 2);
        }
        return std::string();
    };
    // 16 KiB of padding, in one item or several, with and without an id's byte.
    CHECK(refusal(DescriptorText().item(0x74, 32).item(0x94, 4096, 4).input(1)) == "");
    CHECK(refusal(DescriptorText().item(0x74, 32).item(0x94, 4097, 4).input(1)) ==
          "a report has more than 16384 bytes.");
    CHECK(refusal(DescriptorText().item(0x74, 32).item(0x94, 4095, 4).input(1).item(0x94, 1).input(1)) == "");
    CHECK_FALSE(
        refusal(DescriptorText().item(0x74, 32).item(0x94, 4095, 4).input(1).item(0x94, 2).input(1)).empty());
    CHECK(refusal(DescriptorText().id(1).item(0x74, 8).item(0x94, 16383, 4).input(1)) == "");
    CHECK_FALSE(refusal(DescriptorText().id(1).item(0x74, 8).item(0x94, 16384, 4).input(1)).empty());
    // 12,288 fields, over all reports.
    const auto fields = [&](int inputs, int features) {
        return refusal(DescriptorText()
                           .page(9)
                           .item(0x74, 1)
                           .item(0x94, inputs, 4)
                           .usage(1)
                           .input(2)
                           .item(0x94, features, 4)
                           .usage(1)
                           .feature(2));
    };
    CHECK(fields(12'288, 0) == "");
    CHECK(fields(12'000, 288) == "");
    CHECK(fields(12'000, 289) == "there are more than 12288 fields.");
    CHECK_FALSE(fields(12'289, 0).empty());
    // A field of 64 bits, and padding of any.
    for (const int bits : {1, 64, 65, 100}) {
        CHECK((refusal(DescriptorText().page(9).item(0x74, bits).item(0x94, 1).usage(1).input(2)) == "") ==
              (bits <= 64));
        CHECK(refusal(DescriptorText().item(0x74, bits).item(0x94, 1).input(1)) == "");
    }
    for (const int id : {1, 255})
        CHECK(refusal(DescriptorText().item(0x84, id, 2)) == "");
    for (const int id : {0, 256})
        CHECK(refusal(DescriptorText().item(0x84, id, 2)) == std::to_string(id) + " is no report id.");
    // Pushes, of which 64 may wait.
    DescriptorText pushes;
    for (int i = 0; i < 64; ++i)
        pushes.item(0xA4);
    CHECK(refusal(pushes) == "a push has no pop.");
    CHECK(refusal(DescriptorText(pushes).item(0xA4)) == "too many pushes.");
    for (int i = 0; i < 64; ++i)
        pushes.item(0xB4);
    CHECK(refusal(pushes) == "");
    CHECK(refusal(pushes.item(0xB4)) == "a pop has no push.");
    // What is cut off.
    for (const std::vector<std::byte>& cut :
         {bytes_of({0x05}), bytes_of({0x06, 1}), bytes_of({0x07, 1, 2, 3}), bytes_of({0xFE}),
          bytes_of({0xFE, 2, 0, 1}), bytes_of({0xFE, 1, 0})})
        CHECK_THROWS_WITH(parse_report_descriptor(cut), Catch::Contains("byte 0: the item is cut off"));
    CHECK_NOTHROW(parse_report_descriptor(bytes_of({0xFE, 2, 0, 1, 2})));
    CHECK_NOTHROW(parse_report_descriptor(bytes_of({0xFE, 0, 0})));
}

TEST_CASE("the powers of ten of a unit go from -8 to 7, and its lengths are centimetres and inches",
          "[unit]") {
    for (int exponent = -8; exponent <= 7; ++exponent) {
        const auto descriptor = parse_report_descriptor(DescriptorText()
                                                            .page(9)
                                                            .unit(0x11, exponent)
                                                            .logical(0, 100)
                                                            .item(0x74, 8)
                                                            .item(0x94, 1)
                                                            .usage(1)
                                                            .input(2)
                                                            .bytes);
        REQUIRE(descriptor.fields.size() == 1);
        CHECK(descriptor.fields[0].unit_exponent == exponent);
        CHECK(hid_millimetres(descriptor.fields[0], 3) == Approx(30.0 * std::pow(10.0, exponent)));
    }
    for (const auto& [unit, mm] :
         {std::pair(0x11, 10.0), {0x13, 25.4}, {0x12, 0.0}, {0x14, 0.0}, {0x10, 0.0}, {0x00, 0.0}}) {
        HidField field;
        field.unit = static_cast<std::uint32_t>(unit);
        CHECK(is_length(field) == (mm > 0.0));
        CHECK(hid_millimetres(field, 2).value_or(0.0) == 2.0 * mm);
    }
    // Null values lie outside of the range, whose ends are values.
    HidField field;
    field.logical_minimum = -5;
    field.logical_maximum = 5;
    for (const int value : {-6, -5, 0, 5, 6})
        CHECK(hid_physical(field, value).has_value() == (value >= -5 && value <= 5));
    field.logical_minimum = field.logical_maximum = 0; // no range
    CHECK(hid_physical(field, 7) == 7.0);
    field.logical_maximum = 10;
    field.physical_maximum = 100; // from 0
    CHECK(hid_physical(field, 3) == Approx(30.0));
    field.physical_maximum = 0;
    field.physical_minimum = -100; // to 0
    CHECK(hid_physical(field, 3) == Approx(-70.0));
}

TEST_CASE("what cannot be read of a descriptor is told with the byte at which its item begins", "[unit]") {
    const auto refusal = [](std::initializer_list<int> bytes) -> std::string {
        try {
            parse_report_descriptor(bytes_of(bytes));
        } catch (const DeviceError& error) {
            const std::string said = error.what(), head = "The HID report descriptor cannot be read, byte ";
            CHECK(said.starts_with(head));
            return said.substr(head.size());
        }
        return "";
    };
    CHECK(refusal({}).empty());
    CHECK(refusal({0xB4}) == "0: a pop has no push.");
    CHECK(refusal({0x05, 0x01, 0xB4}) == "2: a pop has no push.");
    CHECK(refusal({0xA4, 0xB4}).empty());
    CHECK(refusal({0xA4}) == "0: a push has no pop.");
    CHECK(refusal({0xC0}) == "0: a collection ends that was not begun.");
    CHECK(refusal({0xA1, 0x01}) == "0: a collection is not ended.");
    CHECK(refusal({0xA1, 0x01, 0xC0}).empty());
    CHECK(refusal({0x05, 0x01, 0xA1, 0x01, 0xC0, 0xC0}) == "5: a collection ends that was not begun.");
    CHECK(refusal({0x05}) == "0: the item is cut off.");
    CHECK(refusal({0x05, 0x01, 0x06, 0x01}) == "2: the item is cut off.");
    CHECK(refusal({0xFE, 0x02, 0x00, 0x01, 0x02, 0x05, 0x01}).empty()); // a long item
    CHECK(refusal({0xFE, 0x02, 0x00, 0x01}) == "0: the item is cut off.");
    CHECK(refusal({0xFE, 0x00, 0x00, 0xB4}) == "3: a pop has no push.");
    CHECK(refusal({0x85, 0x00}) == "0: 0 is no report id.");
    CHECK(refusal({0x85, 0xFF}).empty());
    CHECK(refusal({0x86, 0x00, 0x01}) == "0: 256 is no report id.");
    CHECK(refusal({0x75, 0x08, 0x95, 0x01, 0x09, 0x01, 0x81, 0x02, 0x85, 0x01}) ==
          "8: some reports have an id and others have none.");
    CHECK(refusal({0x19, 0x05, 0x29, 0x04}) == "2: a range of usages ends before it begins.");
    CHECK(refusal({0x19, 0x05, 0x29, 0x05}).empty());
    CHECK(refusal({0x29, 0x04}).empty()); // an end alone is none
    CHECK(refusal({0x75, 0x41, 0x95, 0x01, 0x09, 0x01, 0x81, 0x02}) ==
          "6: a field has 65 bits, and 64 are the most that can be read.");
    CHECK(refusal({0x75, 0x40, 0x95, 0x01, 0x09, 0x01, 0x81, 0x02}).empty());
    std::vector<std::byte> deep(65, std::byte{0xA4});
    CHECK_THROWS_WITH(parse_report_descriptor(deep), Catch::EndsWith("byte 64: too many pushes."));
    deep.back() = std::byte{0xB4};
    deep.insert(deep.end(), 63, std::byte{0xB4});
    CHECK_NOTHROW(parse_report_descriptor(deep));
    std::vector<std::byte> within;
    for (int i = 0; i < 64; ++i)
        within.insert(within.end(), {std::byte{0xA1}, std::byte{0x00}});
    within.insert(within.end(), 64, std::byte{0xC0});
    CHECK(parse_report_descriptor(within).collections.size() == 64);
    within.insert(within.begin(), {std::byte{0xA1}, std::byte{0x00}});
    CHECK_THROWS_WITH(parse_report_descriptor(within),
                      Catch::EndsWith("byte 128: too many collections within each other."));
}

TEST_CASE("a field has the physical ends that stand before it, the lower one first, with their signs",
          "[unit]") {
    const auto ends = [](std::int64_t low, std::int64_t high) {
        DescriptorText text;
        text.page(0x01).open(0x04, 1).logical(0, 1000).item(0x34, low).item(0x44, high);
        text.size(16, 1).usage(0x30).input(0x02).close();
        const HidDescriptor descriptor = parse_report_descriptor(text.bytes);
        REQUIRE(descriptor.fields.size() == 1);
        return std::pair(descriptor.fields[0].physical_minimum, descriptor.fields[0].physical_maximum);
    };
    CHECK(ends(5, 300) == std::pair<std::int64_t, std::int64_t>(5, 300));
    CHECK(ends(-100, 100) == std::pair<std::int64_t, std::int64_t>(-100, 100));
    CHECK(ends(0, 7) == std::pair<std::int64_t, std::int64_t>(0, 7));
}
