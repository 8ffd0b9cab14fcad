#include "devices/hid/hid_driver.h"

#include <algorithm>

#include <fmt/format.h>

#include "devices/tracker/tracker_device.h"
#include "experiment/base/error.h"
#include "experiment/base/text_number.h"

namespace overt {
namespace {

using namespace std::chrono_literals;

constexpr HidUsage eye_tracker_usage{0x12, 0x01};
constexpr SessionDuration ready_patience = 5s, between_looks = 50ms, between_bounds = 500ms;

} // namespace

std::optional<std::pair<std::uint16_t, std::uint16_t>> hid_numbers(std::string_view text) {
    const std::size_t colon = std::min(text.find(':'), text.size());
    const auto vendor = number_in<std::uint16_t>(text.substr(0, colon), 16),
               product = number_in<std::uint16_t>(text.substr(std::min(colon + 1, text.size())), 16);
    return vendor && product ? std::optional(std::pair(*vendor, *product)) : std::nullopt;
}

HidDriver::HidDriver(HidTrackerSettings settings, Clock& clock, HidSystem system)
    : settings_(std::move(settings)), clock_(&clock), system_(std::move(system)) {}

HidDeviceInfo HidDriver::find() const {
    const std::string& wished = settings_.device;
    const auto numbers = hid_numbers(wished);
    if (!wished.empty() && !wished.starts_with('/') && !numbers)
        throw InputError(
            fmt::format("\"{}\" is no HID device: write a path such as /dev/hidraw0, or vendor and product "
                        "such as 1209:0e7e",
                        wished));
    const std::vector<HidDeviceInfo> devices = system_.devices();
    for (const HidDeviceInfo& device : devices) {
        const bool is_it = wished.empty() ? is_eye_tracker(device)
                           : numbers      ? std::pair(device.vendor_id, device.product_id) == *numbers
                                          : device.path == wished;
        if (is_it)
            return device;
    }
    std::string there;
    for (const HidDeviceInfo& device : devices)
        there += (there.empty() ? "" : ", ") + describe(device);
    throw DeviceError(fmt::format("{} is plugged in. HID devices that are: {}.",
                                  wished.empty() ? std::string("No HID eye tracker (usage page 0x12)")
                                                 : fmt::format("No HID device {}", wished),
                                  there.empty() ? "none" : there));
}

std::vector<std::byte> HidDriver::feature(const HidDescriptor& descriptor, std::uint8_t report_id) {
    if (report_id == 0)
        return {};
    std::vector<std::byte> report(descriptor.report_bytes(HidReportKind::feature, report_id));
    if (report.empty())
        return report;
    report[0] = std::byte{report_id};
    report.resize(line_->get_feature(report));
    return report;
}

void HidDriver::wait_until_ready(const HidDescriptor& descriptor) {
    const SessionTime until = clock_->now() + ready_patience;
    for (;;) {
        const std::vector<std::byte> status = feature(descriptor, layout_->status_report());
        rate_hz_ = layout_->sampling_hz(status).value_or(0.0);
        switch (layout_->readiness(status)) {
        case HidTrackerReadiness::screen_setup_needed:
            throw DeviceError(
                fmt::format("{} has to be told its screen first, with its maker's program.", line_->name()));
        case HidTrackerReadiness::user_calibration_needed:
            throw DeviceError(fmt::format(
                "{} has to be calibrated to the observer first, with its maker's program.", line_->name()));
        case HidTrackerReadiness::configuring:
            break;
        default:
            return;
        }
        if (clock_->now() >= until)
            throw DeviceError(fmt::format("{} is still setting itself up after 5 s.", line_->name()));
        clock_->wait_until(clock_->now() + between_looks);
    }
}

TrackerDescription HidDriver::connect(const TrackerWish& wish) {
    line_.reset();
    const HidDeviceInfo device = find();
    const HidDescriptor descriptor = parse_report_descriptor(system_.descriptor(device.path));
    std::string why;
    layout_ = HidGazeLayout::find(descriptor, why);
    if (!layout_)
        throw DeviceError(fmt::format("{} cannot be used as an eye tracker: {}.", describe(device), why));
    line_ = system_.open(device.path, *clock_);
    report_.assign(descriptor.longest_report_bytes(HidReportKind::input), std::byte{0});
    wait_until_ready(descriptor);
    const auto screen_mm = layout_->screen_mm(feature(descriptor, layout_->configuration_report()));
    const glm::dvec2 size_mm = screen_mm.value_or(wish.screen.screen_mm);
    px_per_mm_ = glm::dvec2(wish.screen.screen_px) / size_mm;
    eye_ = wish.eye;
    if (const std::uint8_t id = layout_->control_report()) {
        std::vector<std::byte> control(descriptor.report_bytes(HidReportKind::feature, id));
        control.at(0) = std::byte{id};
        layout_->request_gaze(control);
        if (!line_->send_feature(control))
            throw DeviceError(fmt::format("{} does not take the request to send gaze.", line_->name()));
    }
    TrackerDescription description;
    description.name = "hid";
    description.sample_rate_hz = rate_hz_ > 0.0 ? rate_hz_ : wish.rate_hz;
    description.eye = wish.eye;
    description.model = fmt::format("{} {:04x}:{:04x} {}", device.product, device.vendor_id,
                                    device.product_id, device.serial_number);
    return description;
}

void HidDriver::start() {
    read_away(*line_, report_, *clock_);
    if (line_->lost())
        throw DeviceError(fmt::format("{} was unplugged.", line_->name()));
    bound_due_ = clock_->now();
}

void HidDriver::deliver(const HidGazeReport& report, SessionTime arrived, TrackerItemSink& sink) noexcept {
    GazeSample sample;
    // A device without a clock is timed by ours.
    sample.sampled_at = report.at.value_or(
        TrackerTime(std::chrono::floor<TrackerClock::duration>(arrived.time_since_epoch())));
    sample.eye = eye_;
    if (report.gaze_mm)
        sample.gaze = ScreenPoint{report.gaze_mm->x * px_per_mm_.x, report.gaze_mm->y * px_per_mm_.y};
    sink.put(sample);
    if (const auto& eye_mm = eye_ == Eye::left ? report.left_mm : report.right_mm) {
        SampleDetail detail;
        detail.sampled_at = sample.sampled_at;
        detail.eye = eye_;
        detail.eye_mm = eye_mm;
        sink.put(detail);
    }
    if (arrived >= bound_due_) {
        sink.put(ClockPair{arrived - settings_.longest_delay, sample.sampled_at, arrived});
        bound_due_ = arrived + between_bounds;
    }
}

RecordingState HidDriver::read(TrackerItemSink& sink, SessionTime deadline) noexcept {
    SessionTime until = deadline;
    while (const std::size_t count = line_->read(report_, until)) {
        const SessionTime arrived = clock_->now();
        if (const auto report = layout_->read(std::span(report_).first(std::min(count, report_.size()))))
            deliver(*report, arrived, sink);
        if (arrived >= deadline)
            break;
        until = arrived; // what else is there already, without waiting
    }
    return line_->lost() ? RecordingState::lost : RecordingState::running;
}

bool is_eye_tracker(const HidDeviceInfo& device) {
    return std::ranges::find(device.usages, eye_tracker_usage) != device.usages.end();
}

template <> TrackerDevice tracker_device_of<kind_called<TrackerKind>("hid")>() {
    return {.make_driver = [](const TrackerParts& parts) -> std::unique_ptr<TrackerDriver> {
                HidTrackerSettings settings;
                settings.device = parts.protocol.tracker.address;
                return std::make_unique<HidDriver>(settings, parts.clock);
            },
            .can_do = "what its descriptor says; overt calibrates",
            .look_for =
                [] {
                    std::string found;
                    for (const HidDeviceInfo& device : hid_devices())
                        if (is_eye_tracker(device))
                            found += fmt::format("{}{} {} at {}", found.empty() ? "" : "; ",
                                                 device.manufacturer, device.product, device.path);
                    return found.empty() ? "none is connected" : found;
                }};
}

} // namespace overt
