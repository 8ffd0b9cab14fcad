#include "devices/buttons/hid_button_box.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "devices/buttons/box_times.h"
#include "devices/buttons/button_box_device.h"
#include "devices/buttons/hid_box_search.h"
#include "experiment/base/error.h"

namespace overt {
namespace {

constexpr std::uint16_t button_page = 0x09, keyboard_page = 0x07;
constexpr int error_roll_over = 1, last_error = 3; ///< usages 1 to 3 of a keyboard are no keys

int number_of(HidUsage usage) noexcept {
    return usage.page == keyboard_page ? first_key_number + usage.id : usage.id;
}

} // namespace

HidButtons::HidButtons(const HidDescriptor& descriptor) : has_ids_(descriptor.has_report_ids) {
    const auto add = [&](int number, std::uint8_t report_id) {
        if (std::ranges::find(states_, number, &State::number) == states_.end())
            states_.push_back({number, report_id});
    };
    for (const HidField& field : descriptor.fields) {
        const bool is_button = field.usage.page == button_page || field.usage.page == keyboard_page;
        if (field.kind != HidReportKind::input || field.is_constant || !is_button ||
            field.last_usage.id < field.usage.id || field.last_usage.id - field.usage.id > 1024)
            continue;
        fields_.push_back(field);
        for (std::uint32_t id = field.usage.id; id <= field.last_usage.id; ++id) {
            const bool is_no_key = field.is_array && field.usage.page == keyboard_page && id <= last_error;
            if (id != 0 && !is_no_key)
                add(number_of({field.usage.page, static_cast<std::uint16_t>(id)}), field.report_id);
        }
    }
    std::ranges::sort(states_, {}, &State::number);
}

bool HidButtons::read(std::span<const std::byte> report) noexcept {
    if (report.empty())
        return false;
    const std::uint8_t id = has_ids_ ? std::to_integer<std::uint8_t>(report[0]) : std::uint8_t{0};
    for (const HidField& field : fields_)
        if (field.report_id == id) {
            const auto value = hid_value(field, report);
            if (!value) // cut off
                return false;
            if (field.is_array && field.usage.page == keyboard_page && *value == error_roll_over)
                return false;
        }
    bool is_known = false;
    for (State& state : states_)
        if (state.report_id == id)
            state.is_down = false;
    for (const HidField& field : fields_) {
        if (field.report_id != id)
            continue;
        is_known = true;
        const std::int64_t value = *hid_value(field, report);
        HidUsage usage = field.usage;
        if (field.is_array) {
            // An element holds which of the usages is down, counted from its logical minimum.
            const std::int64_t which = field.usage.id + value - field.logical_minimum;
            if (value < field.logical_minimum || which > field.last_usage.id || which < 0)
                continue;
            usage.id = static_cast<std::uint16_t>(which);
        } else if (value == 0) {
            continue;
        }
        const auto state = std::ranges::lower_bound(states_, number_of(usage), {}, &State::number);
        if (state != states_.end() && state->number == number_of(usage))
            state->is_down = true;
    }
    return is_known;
}

void HidButtons::read_away(HidLine& line, std::span<std::byte> report, Clock& clock) {
    for (int i = 0; i < 1000; ++i) {
        const std::size_t count = line.read(report, clock.now());
        if (count == 0)
            break;
        take(report.first(std::min(count, report.size())), [](int, bool) {});
    }
    if (line.lost())
        throw DeviceError(fmt::format("{} was unplugged.", line.name()));
}

std::string hid_button_name(int button) {
    const int key = button - first_key_number;
    if (key < 0)
        return fmt::format("{}", button);
    // Usage page Keyboard, as printed on an American keyboard.
    if (key >= 0x04 && key <= 0x1D)
        return std::string(1, static_cast<char>('a' + key - 0x04));
    if (key >= 0x1E && key <= 0x26)
        return std::string(1, static_cast<char>('1' + key - 0x1E));
    constexpr std::array<std::pair<int, const char*>, 11> named{{{0x27, "0"},
                                                                 {0x28, "enter"},
                                                                 {0x29, "escape"},
                                                                 {0x2A, "backspace"},
                                                                 {0x2B, "tab"},
                                                                 {0x2C, "space"},
                                                                 {0x4F, "right"},
                                                                 {0x50, "left"},
                                                                 {0x51, "down"},
                                                                 {0x52, "up"},
                                                                 {0x58, "keypad enter"}}};
    for (const auto& [number, name] : named)
        if (number == key)
            return name;
    return fmt::format("key {}", key);
}

HidButtonBox::HidButtonBox(std::unique_ptr<HidLine> line, const HidDescriptor& descriptor, std::string model,
                           Clock& clock)
    : line_(std::move(line)), clock_(&clock), model_(std::move(model)), buttons_(descriptor),
      report_(descriptor.longest_report_bytes(HidReportKind::input)) {
    if (!buttons_.has_any())
        throw DeviceError(fmt::format("{} has neither buttons nor keys.", line_->name()));
    held_.reserve(2048);
    begin();
}

void HidButtonBox::begin() {
    buttons_.read_away(*line_, report_, *clock_);
    held_.clear();
    looked_ = clock_->now();
}

std::size_t HidButtonBox::poll(std::span<ButtonChange> into) noexcept {
    const SessionTime now = clock_->now();
    std::size_t taken = 0;
    for (;;) {
        while (taken < into.size() && given_ < held_.size())
            into[taken++] = held_[given_++];
        if (taken == into.size())
            return taken;
        held_.clear();
        given_ = 0;
        const std::size_t count = line_->read(report_, now);
        if (count == 0)
            break;
        buttons_.take(
            std::span(report_).first(std::min(count, report_.size())), [&](int number, bool is_down) {
                if (held_.size() < held_.capacity())
                    held_.push_back(BoxTimes::arrival(number, is_down, looked_, now, usb_transport));
            });
    }
    looked_ = now;
    return taken;
}

template <> ButtonBoxDevice button_box_device_of<kind_called<ButtonBoxKind>("hid")>() {
    return {.open = [](const ButtonBoxParts& parts) -> std::unique_ptr<ButtonBox> {
        const HidDeviceInfo device = find_hid_box(parts.settings);
        return std::make_unique<HidButtonBox>(open_hid(device.path, parts.clock),
                                              parse_report_descriptor(hid_descriptor_of(device.path)),
                                              describe(device), parts.clock);
    }};
}

} // namespace overt
