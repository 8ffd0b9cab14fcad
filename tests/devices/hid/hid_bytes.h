/// Report descriptors for tests, written item by item, and a device in memory.
#pragma once

#include <cstdint>
#include <cstring>
#include <deque>
#include <initializer_list>
#include <map>
#include <string>
#include <vector>

#include "devices/hid/hid_driver.h"
#include "devices/host/clocks.h"

namespace overt::test {

/// Writes short items with as many bytes as the number needs.
class DescriptorText {
  public:
    DescriptorText& item(int tag, std::int64_t value, int length = 0) {
        if (length == 0)
            length = value >= -128 && value <= 127 ? 1 : value >= -32768 && value <= 32767 ? 2 : 4;
        add(tag | (length == 4 ? 3 : length));
        for (int i = 0; i < length; ++i)
            add(static_cast<int>(static_cast<std::uint64_t>(value) >> (8 * i)));
        return *this;
    }
    DescriptorText& item(int tag) {
        add(tag);
        return *this;
    }
    DescriptorText& page(int value) { return item(0x04, value, value > 127 ? 2 : 1); }
    DescriptorText& usage(int value) { return item(0x08, value, value > 127 ? 2 : 1); }
    DescriptorText& open(int use, int type) { return usage(use).item(0xA0, type); }
    DescriptorText& close() { return item(0xC0); }
    DescriptorText& id(int value) { return item(0x84, value); }
    DescriptorText& logical(std::int64_t low, std::int64_t high) { return item(0x14, low).item(0x24, high); }
    DescriptorText& size(int bits, int count) { return item(0x74, bits).item(0x94, count); }
    DescriptorText& unit(int unit, int exponent) { return item(0x64, unit, 2).item(0x54, exponent & 0xF, 1); }
    DescriptorText& input(int flags) { return item(0x80, flags); }
    DescriptorText& feature(int flags) { return item(0xB0, flags); }
    /// A gaze point in tenths of a millimetre: 16 bits for each of its axes.
    DescriptorText& gaze_point(std::initializer_list<int> axes = {0x21, 0x22}) {
        unit(0x11, -2).logical(-10'000, 10'000).size(16, static_cast<int>(axes.size())).open(0x24, 0);
        for (const int axis : axes)
            usage(axis);
        return input(0x02).close();
    }

    std::vector<std::byte> bytes;

  private:
    void add(int value) { bytes.push_back(static_cast<std::byte>(value & 0xFF)); }
};

/// An eye tracker as the published descriptors of such devices have it: time in eight bytes, places in
/// micrometres, status, screen and mode as features.
inline std::vector<std::byte> eye_tracker_descriptor(std::int64_t reach_um = 2'000'000) {
    DescriptorText text;
    text.page(0x12).open(0x01, 1).open(0x10, 2).id(0x10);
    text.usage(0x20).logical(0, 255).size(8, 8).unit(0x1001, -6).input(0x82);
    text.unit(0x11, -4).logical(-reach_um, reach_um).item(0x74, 32);
    for (const auto& [collection, axes] : {std::pair{0x24, 2}, {0x25, 3}, {0x26, 3}, {0x27, 3}}) {
        text.open(collection, 0);
        for (int axis = 0; axis < axes; ++axis)
            text.usage(0x21 + axis);
        text.item(0x94, axes).input(0x02).close();
    }
    text.close();
    text.open(0x12, 2)
        .id(0x12)
        .logical(0, 2'000'000)
        .size(32, 1)
        .usage(0x204)
        .feature(0x02)
        .usage(0x205)
        .feature(0x02)
        .close();
    text.open(0x13, 2).id(0x13).unit(0, 0).logical(0, 4).size(8, 1).usage(0x301).feature(0x82);
    text.logical(0, 0xFFFF).item(0x74, 16).unit(0xF001, 0).usage(0x300).feature(0x82).close();
    text.open(0x14, 2).id(0x14).unit(0, 0).logical(0, 7).item(0x74, 8).usage(0x400).feature(0x82).close();
    text.close();
    return text.bytes;
}

/// What that tracker sends: the time, the gaze, and both eyes, of which the left one's distance matters.
inline std::vector<std::byte> gaze_report(std::uint64_t us, std::int32_t x_um, std::int32_t y_um,
                                          std::int32_t left_z_um = 600'000) {
    std::vector<std::byte> report(53);
    report[0] = std::byte{0x10};
    const std::int32_t places[11] = {x_um, y_um, -30'000, 1'000, left_z_um, 30'000, 2'000, 610'000, 0, 0, 0};
    std::memcpy(report.data() + 1, &us, 8);
    std::memcpy(report.data() + 9, places, 44);
    return report;
}

/// A keyboard with eight bytes a report: modifiers, one unused, six keys that are down (HID 1.11, appendix
/// B).
inline std::vector<std::byte> keyboard_descriptor() {
    DescriptorText text;
    text.page(0x01).open(0x06, 1);
    text.page(0x07).item(0x18, 0xE0, 1).item(0x28, 0xE7, 1).logical(0, 1).size(1, 8).input(0x02);
    text.size(8, 1).input(0x01);
    text.size(8, 6).item(0x14, 0).item(0x24, 101).page(0x07).item(0x18, 0, 1).item(0x28, 101, 1).input(0x00);
    return text.close().bytes;
}

/// A game pad: two axes of 8 bits and ten buttons, filled up to whole bytes.
inline std::vector<std::byte> game_pad_descriptor() {
    DescriptorText text;
    text.page(0x01)
        .open(0x05, 1)
        .usage(0x30)
        .usage(0x31)
        .item(0x14, 0)
        .item(0x24, 255, 1)
        .size(8, 2)
        .input(0x02);
    text.page(0x09).item(0x18, 1).item(0x28, 10).logical(0, 1).size(1, 10).input(0x02).size(6, 1).input(0x03);
    return text.close().bytes;
}

/// Bytes given as numbers.
inline std::vector<std::byte> bytes_of(std::initializer_list<int> numbers) {
    std::vector<std::byte> bytes;
    for (const int number : numbers)
        bytes.push_back(static_cast<std::byte>(number));
    return bytes;
}

/// What is on a device's side; outlives its lines.
struct HidFarEnd {
    explicit HidFarEnd(VirtualClock& session_clock) : clock(session_clock) {}
    VirtualClock& clock;
    struct Arrival {
        SessionTime at;
        std::vector<std::byte> report;
    };
    std::deque<Arrival> arriving;
    std::map<int, std::vector<std::byte>> features; ///< by id, the id first
    std::vector<std::vector<std::byte>> written, features_sent;
    std::function<void(std::span<const std::byte>)> on_write;
    bool unplugged = false, takes_features = true;
    int opened = 0;
};

class InMemoryHidLine final : public HidLine {
  public:
    explicit InMemoryHidLine(HidFarEnd& far_end) : far_(far_end) {}
    const std::string& name() const noexcept override { return name_; }
    std::size_t read(std::span<std::byte> into, SessionTime deadline) noexcept override {
        is_lost_ = is_lost_ || far_.unplugged;
        if (is_lost_)
            return 0;
        if (far_.arriving.empty() || far_.arriving.front().at > std::max(deadline, far_.clock.now())) {
            far_.clock.wait_until(deadline);
            return 0;
        }
        far_.clock.wait_until(far_.arriving.front().at);
        const std::vector<std::byte> report = std::move(far_.arriving.front().report);
        far_.arriving.pop_front();
        std::copy_n(report.begin(), std::min(report.size(), into.size()), into.begin());
        return std::min(report.size(), into.size());
    }
    bool write(std::span<const std::byte> report) noexcept override {
        far_.written.emplace_back(report.begin(), report.end());
        if (far_.on_write)
            far_.on_write(report);
        return !far_.unplugged;
    }
    std::size_t get_feature(std::span<std::byte> report) noexcept override {
        const auto found = far_.features.find(std::to_integer<int>(report[0]));
        if (found == far_.features.end())
            return 0;
        std::copy_n(found->second.begin(), std::min(found->second.size(), report.size()), report.begin());
        return std::min(found->second.size(), report.size());
    }
    bool send_feature(std::span<const std::byte> report) noexcept override {
        far_.features_sent.emplace_back(report.begin(), report.end());
        return far_.takes_features;
    }
    bool lost() const noexcept override { return is_lost_; }

  private:
    HidFarEnd& far_;
    bool is_lost_ = false;
    std::string name_ = "/dev/hidraw0";
};

/// A computer at which this one device is plugged in.
inline HidSystem system_with(HidFarEnd& far_end, const HidDeviceInfo& info,
                             std::vector<std::byte> descriptor) {
    HidSystem system;
    system.devices = [info, &far_end] {
        return far_end.unplugged ? std::vector<HidDeviceInfo>{} : std::vector{info};
    };
    system.descriptor = [descriptor = std::move(descriptor)](const std::string&) { return descriptor; };
    system.open = [&far_end](const std::string&, const Clock&) -> std::unique_ptr<HidLine> {
        ++far_end.opened;
        return std::make_unique<InMemoryHidLine>(far_end);
    };
    return system;
}

} // namespace overt::test
