#include "devices/buttons/hid_knob.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "devices/buttons/box_times.h"
#include "devices/buttons/button_box_device.h"
#include "devices/buttons/hid_box_search.h"
#include "experiment/base/error.h"

namespace overt {
namespace {

constexpr std::uint16_t desktop_page = 0x01;
constexpr std::uint16_t multi_axis_controller = 0x08, rotation_x = 0x33, rotation_z = 0x35, dial_usage = 0x37,
                        wheel_usage = 0x38;
constexpr HidUsage mouse_collection{desktop_page, 0x02};

std::vector<HidField> knob_fields(const HidDescriptor& descriptor, std::initializer_list<std::uint16_t> ids) {
    std::vector<HidField> fields;
    for (const HidField& field : descriptor.fields)
        if (field.kind == HidReportKind::input && !field.is_constant && !field.is_array &&
            field.usage.page == desktop_page && std::ranges::find(ids, field.usage.id) != ids.end())
            fields.push_back(field);
    return fields;
}

/// A mouse has a wheel, too, which is the window's.
std::vector<HidField> dial_fields(const HidDescriptor& descriptor) {
    std::vector<HidField> fields = knob_fields(descriptor, {dial_usage, wheel_usage});
    std::erase_if(fields, [&](const HidField& field) {
        return !field.is_relative || descriptor.is_within(field, mouse_collection);
    });
    return fields;
}

/// Towards 0; a sum that misses a step by its rounding has it.
double whole_of(double steps) noexcept {
    constexpr double rounding = 1e-9;
    return std::trunc(steps + std::copysign(rounding, steps));
}

HidDeviceInfo find_knob(const ButtonBoxSettings& settings) {
    if (!settings.address.empty())
        return find_hid_box(settings);
    for (HidDeviceInfo& device : hid_devices())
        if (is_spacemouse(device))
            return device;
    throw DeviceError("No 3D mouse is plugged in, or none that may be opened.");
}

ButtonBoxDevice knob_device() {
    return {.open = [](const ButtonBoxParts& parts) -> std::unique_ptr<ButtonBox> {
        const HidDeviceInfo device = find_knob(parts.settings);
        return std::make_unique<HidKnob>(open_hid(device.path, parts.clock),
                                         parse_report_descriptor(hid_descriptor_of(device.path)),
                                         describe(device), parts.settings, parts.clock);
    }};
}

} // namespace

void KnobAxis::hold(double deflection, double full_steps_s, double dead_zone, SessionTime at) noexcept {
    go_on(at);
    const double beyond = std::clamp((std::abs(deflection) - dead_zone) / (1.0 - dead_zone), 0.0, 1.0);
    steps_s_ = std::copysign(beyond, deflection) * full_steps_s;
    gone_to_ = at;
    held_until_ = at + longest_hold;
    if (steps_s_ == 0.0)
        steps_ = whole_of(steps_);
}

void KnobAxis::go_on(SessionTime now) noexcept {
    const SessionTime until = std::min(now, held_until_);
    if (until > gone_to_)
        steps_ += steps_s_ * to_seconds(until - gone_to_);
    gone_to_ = std::max(gone_to_, until);
}

int KnobAxis::take_steps() noexcept {
    constexpr double most = 1e6; // no hand, and no report, has more at once
    const double whole = whole_of(std::clamp(steps_, -most, most));
    steps_ -= whole;
    return static_cast<int>(whole);
}

bool is_dial(const HidDescriptor& descriptor) { return !dial_fields(descriptor).empty(); }

/// Of Logitech, which made the older ones, and of 3Dconnexion; not all that these make are such.
bool is_spacemouse(const HidDeviceInfo& device) {
    return (device.vendor_id == 0x046d || device.vendor_id == 0x256f) &&
           std::ranges::find(device.usages, HidUsage{desktop_page, multi_axis_controller}) !=
               device.usages.end();
}

HidKnob::HidKnob(std::unique_ptr<HidLine> line, const HidDescriptor& descriptor, std::string model,
                 const ButtonBoxSettings& settings, Clock& clock)
    : line_(std::move(line)), clock_(&clock), model_(std::move(model)), settings_(settings),
      has_ids_(descriptor.has_report_ids),
      turns_(is_dial() ? dial_fields(descriptor) : knob_fields(descriptor, {rotation_z})),
      tilts_(is_dial() ? std::vector<HidField>() : knob_fields(descriptor, {rotation_x})),
      buttons_(descriptor), report_(descriptor.longest_report_bytes(HidReportKind::input)) {
    if (turns_.empty())
        throw DeviceError(fmt::format("{} has no {}.", line_->name(),
                                      is_dial() ? "dial or wheel that tells turns"
                                                : "value of rotation about its own axis"));
    held_.reserve(2048);
    begin();
}

bool HidKnob::is_dial() const noexcept { return settings_.kind == kind_called<ButtonBoxKind>("dial"); }

void HidKnob::begin() {
    buttons_.read_away(*line_, report_, *clock_);
    held_.clear();
    given_ = 0;
    turn_.forget();
    tilt_.forget();
    looked_ = clock_->now();
}

void HidKnob::take(std::span<const std::byte> report, SessionTime now) noexcept {
    if (report.empty())
        return;
    const std::uint8_t id = has_ids_ ? std::to_integer<std::uint8_t>(report[0]) : std::uint8_t{0};
    const auto take_axis = [&](const std::vector<HidField>& fields, KnobAxis& axis, double full_steps_s) {
        for (const HidField& field : fields) {
            const std::optional<std::int64_t> value =
                field.report_id == id ? hid_value(field, report) : std::nullopt;
            if (!value)
                continue;
            if (is_dial()) {
                axis.add(settings_.steps_per_count * static_cast<double>(*value));
                continue;
            }
            const auto full = static_cast<double>(std::max(
                {std::abs(field.logical_minimum), std::abs(field.logical_maximum), std::int64_t{1}}));
            axis.hold(static_cast<double>(*value) / full, full_steps_s, settings_.dead_zone, now);
        }
    };
    take_axis(turns_, turn_, settings_.full_turn_steps_s);
    take_axis(tilts_, tilt_, settings_.full_tilt_steps_s);
}

void HidKnob::note_turns(SessionTime now) noexcept {
    const int turned = turn_.take_steps(), tilted = tilt_.take_steps();
    if ((turned == 0 && tilted == 0) || held_.size() == held_.capacity())
        return;
    ButtonChange change = BoxTimes::arrival(-1, false, looked_, now, usb_transport);
    change.turn_steps = turned;
    change.tilt_steps = tilted;
    held_.push_back(change);
}

std::size_t HidKnob::poll(std::span<ButtonChange> into) noexcept {
    const SessionTime now = clock_->now();
    std::size_t taken = 0;
    const auto give = [&] {
        while (taken < into.size() && given_ < held_.size())
            into[taken++] = held_[given_++];
        if (given_ == held_.size()) {
            held_.clear();
            given_ = 0;
        }
    };
    give();
    while (taken < into.size()) {
        const std::size_t count = line_->read(report_, now);
        if (count == 0)
            break;
        const std::span<const std::byte> report = std::span(report_).first(std::min(count, report_.size()));
        take(report, now);
        note_turns(now);
        buttons_.take(report, [&](int number, bool is_down) {
            if (held_.size() < held_.capacity())
                held_.push_back(BoxTimes::arrival(number, is_down, looked_, now, usb_transport));
        });
        give();
    }
    turn_.go_on(now);
    tilt_.go_on(now);
    note_turns(now);
    give();
    looked_ = now;
    return taken;
}

template <> ButtonBoxDevice button_box_device_of<kind_called<ButtonBoxKind>("dial")>() {
    return knob_device();
}

template <> ButtonBoxDevice button_box_device_of<kind_called<ButtonBoxKind>("spacemouse")>() {
    return knob_device();
}

} // namespace overt
