/// What is done with any bytes as a HID device: its report descriptor (two bytes of length, then so many) and
/// a report. Shared by the fuzzer and by a test with damaged ones; nothing may come of it but a DeviceError
/// for the descriptor.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "devices/buttons/hid_button_box.h"
#include "devices/hid/hid_gaze.h"
#include "experiment/base/error.h"

namespace overt::test {

/// Whether the descriptor was understood.
inline bool take_any_hid(std::span<const std::byte> bytes) {
    if (bytes.size() < 2)
        return false;
    const std::size_t length = std::to_integer<std::size_t>(bytes[0]) | std::to_integer<std::size_t>(bytes[1])
                                                                            << 8;
    bytes = bytes.subspan(2);
    const auto descriptor_bytes = bytes.first(std::min(length, bytes.size()));
    const auto report = bytes.subspan(descriptor_bytes.size());
    try {
        const HidDescriptor descriptor = parse_report_descriptor(descriptor_bytes);
        for (const HidField& field : descriptor.fields) {
            const auto value = hid_value(field, report);
            OVERT_EXPECTS(value.has_value() == (field.bit_offset + field.bit_size <= 8 * report.size()));
            if (!value)
                continue;
            hid_physical(field, *value);
            hid_millimetres(field, *value);
            // What is written is read again.
            std::vector<std::byte> copy(report.begin(), report.end());
            put_hid_value(field, *value, copy);
            OVERT_EXPECTS(std::ranges::equal(copy, report));
        }
        std::string why;
        if (const auto layout = HidGazeLayout::find(descriptor, why)) {
            layout->read(report);
            layout->readiness(report);
            layout->sampling_hz(report);
            layout->screen_mm(report);
        }
        HidButtons buttons(descriptor);
        int changes = 0;
        buttons.take(report, [&](int, bool is_down) { changes += is_down ? 1 : -1; });
        OVERT_EXPECTS(changes >= 0); // nothing was down before
        return true;
    } catch (const DeviceError&) {
        return false;
    }
}

} // namespace overt::test
