#include "devices/hid/hid_gaze.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace overt {
namespace {

constexpr std::uint16_t eye_page = 0x12;
constexpr HidUsage eye_tracker{eye_page, 0x01}, tracking_data{eye_page, 0x10},
    sensor_timestamp{eye_page, 0x20}, gaze_point{eye_page, 0x24}, left_eye{eye_page, 0x25},
    right_eye{eye_page, 0x26}, screen_width{eye_page, 0x204}, screen_height{eye_page, 0x205},
    sampling_frequency{eye_page, 0x300}, configuration_status{eye_page, 0x301}, mode_request{eye_page, 0x400};

// Bits of the mode request.
constexpr std::int64_t wants_gaze = 1, wants_eyes = 2;

constexpr std::uint32_t second = 0x1001, hertz = 0xF001;

/// X, Y and Z of this page, or of the Generic Desktop page: 0 to 2; nothing for other usages.
std::optional<std::size_t> axis_of(HidUsage usage) {
    if (usage.page == eye_page && usage.id >= 0x21 && usage.id <= 0x23)
        return usage.id - 0x21u;
    if (usage.page == 0x01 && usage.id >= 0x30 && usage.id <= 0x32)
        return usage.id - 0x30u;
    return std::nullopt;
}

std::optional<double> millimetres_in(const std::optional<HidField>& field,
                                     std::span<const std::byte> report) noexcept {
    if (!field)
        return std::nullopt;
    const auto value = hid_value(*field, report);
    // Drivers were seen to fill a coordinate that they do not know with the largest number there is.
    if (!value || *value == std::numeric_limits<std::int32_t>::max())
        return std::nullopt;
    return hid_millimetres(*field, *value);
}

std::optional<glm::vec3> place_in(const std::array<std::optional<HidField>, 3>& place,
                                  std::span<const std::byte> report) noexcept {
    const auto x = millimetres_in(place[0], report), y = millimetres_in(place[1], report),
               z = millimetres_in(place[2], report);
    if (!x || !y || !z)
        return std::nullopt;
    return glm::vec3(static_cast<float>(*x), static_cast<float>(*y), static_cast<float>(*z));
}

} // namespace

std::optional<HidGazeLayout> HidGazeLayout::find(const HidDescriptor& descriptor, std::string& why) {
    HidGazeLayout layout;
    layout.has_ids_ = descriptor.has_report_ids;
    bool has_tracker = false, has_length = true;
    for (const HidField& field : descriptor.fields) {
        if (!descriptor.is_within(field, eye_tracker))
            continue;
        has_tracker = true;
        if (field.kind == HidReportKind::feature) {
            for (const auto& [usage, member] : {std::pair{configuration_status, &layout.readiness_},
                                                {sampling_frequency, &layout.frequency_},
                                                {screen_width, &layout.screen_width_},
                                                {screen_height, &layout.screen_height_},
                                                {mode_request, &layout.mode_}})
                if (field.usage == usage && field.report_id != 0)
                    *member = field;
            continue;
        }
        if (field.kind != HidReportKind::input || !descriptor.is_within(field, tracking_data))
            continue;
        if (field.usage == sensor_timestamp) {
            layout.time_.push_back(field);
            continue;
        }
        const auto axis = axis_of(field.usage);
        if (!axis)
            continue;
        for (const auto& [collection, place] :
             {std::pair{gaze_point, &layout.gaze_}, {left_eye, &layout.left_}, {right_eye, &layout.right_}})
            if (descriptor.is_within(field, collection)) {
                (*place)[*axis] = field;
                if (collection == gaze_point) {
                    layout.report_id_ = field.report_id;
                    has_length = has_length && is_length(field);
                }
            }
    }
    if (!has_tracker)
        why = "it is no eye tracker (usage page 0x12)";
    else if (!layout.gaze_[0] || !layout.gaze_[1])
        why = "its reports have no gaze point";
    else if (!has_length)
        why = "its gaze point is in no unit of length";
    else if (layout.gaze_[0]->report_id != layout.gaze_[1]->report_id)
        why = "its gaze point is spread over two reports";
    else {
        std::erase_if(layout.time_,
                      [&](const HidField& field) { return field.report_id != layout.report_id_; });
        // One number, or as many bytes as one has.
        std::size_t bits = 0;
        for (const HidField& field : layout.time_)
            bits += field.bit_size;
        if (bits > 64)
            layout.time_.clear();
        // Without a unit of time the usage's own: microseconds.
        if (!layout.time_.empty() && layout.time_[0].unit == second)
            layout.time_unit_us_ = std::pow(10.0, 6 + layout.time_[0].unit_exponent);
        return layout;
    }
    return std::nullopt;
}

std::optional<HidGazeReport> HidGazeLayout::read(std::span<const std::byte> report) const noexcept {
    if (report.empty() || (has_ids_ && std::to_integer<std::uint8_t>(report[0]) != report_id_))
        return std::nullopt;
    // A report that ends before its gaze point tells nothing.
    if (!hid_value(*gaze_[0], report) || !hid_value(*gaze_[1], report))
        return std::nullopt;
    HidGazeReport told;
    std::uint64_t ticks = 0;
    std::size_t shift = 0;
    bool has_time = !time_.empty();
    for (const HidField& field : time_) {
        const auto part = hid_value(field, report);
        if (!part)
            has_time = false;
        else
            ticks |= (static_cast<std::uint64_t>(*part) &
                      (field.bit_size < 64 ? (std::uint64_t{1} << field.bit_size) - 1 : ~std::uint64_t{0}))
                     << shift;
        shift += field.bit_size;
    }
    // Half a million years, in microseconds: beyond it arithmetic with times would overflow.
    constexpr double latest_us = 9e15;
    if (const double us = static_cast<double>(ticks) * time_unit_us_; has_time && us < latest_us)
        told.at = tracker_time(time_unit_us_ == 1.0 ? static_cast<std::int64_t>(ticks) : std::llround(us));
    const auto x = millimetres_in(gaze_[0], report), y = millimetres_in(gaze_[1], report);
    if (x && y)
        told.gaze_mm = glm::dvec2(*x, *y);
    told.left_mm = place_in(left_, report);
    told.right_mm = place_in(right_, report);
    return told;
}

HidTrackerReadiness HidGazeLayout::readiness(std::span<const std::byte> status) const noexcept {
    const auto value = readiness_ ? hid_value(*readiness_, status) : std::nullopt;
    return value && *value >= 1 && *value <= 4 ? static_cast<HidTrackerReadiness>(*value)
                                               : HidTrackerReadiness::unknown;
}

std::optional<double> HidGazeLayout::sampling_hz(std::span<const std::byte> status) const noexcept {
    const auto value = frequency_ ? hid_value(*frequency_, status) : std::nullopt;
    if (!value || *value <= 0)
        return std::nullopt;
    return frequency_->unit == hertz ? hid_physical(*frequency_, *value) : static_cast<double>(*value);
}

std::optional<glm::dvec2> HidGazeLayout::screen_mm(std::span<const std::byte> configuration) const noexcept {
    const auto width = millimetres_in(screen_width_, configuration),
               height = millimetres_in(screen_height_, configuration);
    if (!width || !height || !(*width > 0.0) || !(*height > 0.0))
        return std::nullopt;
    return glm::dvec2(*width, *height);
}

void HidGazeLayout::request_gaze(std::span<std::byte> control) const noexcept {
    if (mode_)
        put_hid_value(*mode_, wants_gaze | wants_eyes, control);
}

} // namespace overt
