#include "devices/tobii/tobii_driver.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "devices/tobii/tobii_calibration.h"
#include "devices/tracker/tracker_device.h"
#include "experiment/base/error.h"
#include "experiment/calibration/own_calibration.h"

namespace overt {
namespace {

using namespace std::chrono_literals;

constexpr SessionDuration between_looks = 1ms, between_bounds = 500ms;

/// By how much the tracker's display area may differ from the protocol's screen: what a ruler misses.
constexpr double screen_tolerance = 0.03;

/// Times of neighbouring measurements further apart than so many periods have missing ones between them.
constexpr double longest_step = 1.75;

std::string identity(const TobiiLibrary& library, TobiiEyeTracker* tracker) {
    return fmt::format("{} {}", tobii_text(library, library.get_model, tracker),
                       tobii_text(library, library.get_serial_number, tracker));
}

/// The library keeps the trackers themselves.
std::vector<TobiiEyeTracker*> find_trackers(const TobiiLibrary& library) {
    TobiiEyeTrackers* found = nullptr;
    if (const TobiiStatus status = library.find_all_eyetrackers(&found); status != tobii_ok || !found)
        throw DeviceError(fmt::format("Tobii's library does not look for eye trackers ({}).",
                                      describe_tobii_status(status)));
    std::vector<TobiiEyeTracker*> trackers(found->trackers, found->trackers + found->count);
    library.free_eyetrackers(found);
    return trackers;
}

std::string listed(const TobiiLibrary& library, const std::vector<TobiiEyeTracker*>& trackers) {
    std::string text;
    for (TobiiEyeTracker* tracker : trackers)
        text += fmt::format("{}{} at {}", text.empty() ? "" : ", ", identity(library, tracker),
                            tobii_text(library, library.get_address, tracker));
    return text.empty() ? "none" : text;
}

} // namespace

TobiiDriver::TobiiDriver(TobiiSettings settings, Clock& clock)
    : settings_(std::move(settings)), clock_(clock) {}

TobiiDriver::~TobiiDriver() { disconnect(); }

void TobiiDriver::disconnect() noexcept {
    if (TobiiEyeTracker* const connected = std::exchange(tracker_, nullptr))
        inbox_->close(*library_, connected);
}

TobiiEyeTracker* TobiiDriver::find_tracker() const {
    const std::string& wished = settings_.device;
    if (wished.find("://") != std::string::npos) {
        TobiiEyeTracker* tracker = nullptr;
        const TobiiStatus status = library_->get_eyetracker(wished.c_str(), &tracker);
        if (status == tobii_ok && tracker)
            return tracker;
        throw DeviceError(
            fmt::format("There is no eye tracker at {} ({}): see that it has power and that its "
                        "network cable is plugged in.",
                        wished, describe_tobii_status(status)));
    }
    const std::vector<TobiiEyeTracker*> found = find_trackers(*library_);
    std::vector<TobiiEyeTracker*> fitting;
    std::ranges::copy_if(found, std::back_inserter(fitting), [&](TobiiEyeTracker* tracker) {
        return wished.empty() || tobii_text(*library_, library_->get_serial_number, tracker) == wished;
    });
    if (fitting.size() == 1)
        return fitting.front();
    if (fitting.empty())
        throw DeviceError(fmt::format(
            "{} is found. Trackers that are: {}. See that it has power, that it is plugged in, and that the "
            "service of its driver runs; on a network its address can be named.",
            wished.empty() ? "No eye tracker of Tobii's"
                           : fmt::format("No eye tracker of Tobii's {}", wished),
            listed(*library_, found)));
    throw DeviceError(fmt::format("Several eye trackers of Tobii's are found: {}. Name the serial number or "
                                  "the address of one in [tracker] address.",
                                  listed(*library_, fitting)));
}

std::int32_t TobiiDriver::capabilities() const {
    std::int32_t bits = 0;
    const TobiiStatus status = library_->get_capabilities(tracker_, &bits);
    if (status != tobii_ok)
        throw DeviceError(
            fmt::format("The eye tracker does not tell what it can do ({}).", describe_tobii_status(status)));
    if (!(bits & tobii_has_gaze) || !(bits & tobii_calibrates_on_screen))
        throw DeviceError(fmt::format("{} does not measure gaze on a screen: it is no tracker for this.",
                                      identity(*library_, tracker_)));
    return bits;
}

void TobiiDriver::require_screen() const {
    TobiiDisplayArea area{};
    if (const TobiiStatus status = library_->get_display_area(tracker_, &area); status != tobii_ok)
        throw DeviceError(fmt::format("The eye tracker does not tell its display area ({}).",
                                      describe_tobii_status(status)));
    const glm::dvec2 screen = wish_.screen.screen_mm;
    const auto differs = [](double told, double wished) {
        return !(std::abs(told - wished) <= screen_tolerance * wished);
    };
    if (differs(area.width_mm, screen.x) || differs(area.height_mm, screen.y))
        throw DeviceError(fmt::format(
            "The eye tracker's display area is {:.0f} x {:.0f} mm, and the protocol's screen {:.0f} x "
            "{:.0f} mm: set the area in Tobii's Eye Tracker Manager, or the size in [display].",
            area.width_mm, area.height_mm, screen.x, screen.y));
}

double TobiiDriver::rate() const {
    float hz = 0.0f;
    const TobiiStatus status = library_->get_gaze_output_frequency(tracker_, &hz);
    if (status != tobii_ok || !(hz > 0.0f))
        throw DeviceError(fmt::format("The eye tracker does not tell its sampling rate ({}).",
                                      describe_tobii_status(status)));
    return hz;
}

double TobiiDriver::choose_rate() const {
    TobiiFrequencies* offered = nullptr;
    const TobiiStatus status = library_->get_all_gaze_output_frequencies(tracker_, &offered);
    if (status != tobii_ok || !offered || offered->count == 0)
        throw DeviceError(fmt::format("The eye tracker does not tell its sampling rates ({}).",
                                      describe_tobii_status(status)));
    // Of two as near, the higher.
    const auto distance = [this](float hz) {
        return std::pair(std::abs(static_cast<double>(hz) - wish_.rate_hz), -hz);
    };
    const float nearest = *std::ranges::min_element(offered->hz, offered->hz + offered->count, {}, distance);
    library_->free_gaze_output_frequencies(offered);
    if (rate() != static_cast<double>(nearest)) {
        const TobiiStatus set = library_->set_gaze_output_frequency(tracker_, nearest);
        if (set != tobii_ok)
            throw DeviceError(fmt::format("The eye tracker does not take a sampling rate of {} Hz ({}).",
                                          nearest, describe_tobii_status(set)));
    }
    return rate();
}

TrackerDescription TobiiDriver::connect(const TrackerWish& wish) {
    disconnect();
    wish_ = wish;
    if (!library_) {
        library_ = load_tobii(settings_.library);
        inbox_ = std::make_unique<TobiiInbox>(library_->version().major);
    }
    TobiiEyeTracker* const found = find_tracker();
    tracker_ = found;
    const std::int32_t bits = capabilities();
    require_screen();
    description_ = {};
    description_.name = "tobii";
    description_.eye = wish.eye;
    description_.both_eyes = wish.both_eyes;
    description_.sample_rate_hz = choose_rate();
    const TobiiVersion& version = library_->version();
    description_.model = fmt::format("{}, firmware {}, SDK {}.{}.{}", identity(*library_, found),
                                     tobii_text(*library_, library_->get_firmware_version, found),
                                     version.major, version.minor, version.revision);
    has_been_asked_for_time_ = false;
    inbox_->open(*library_, found, bits & tobii_has_external_signal);
    return description_;
}

SetupOutcome TobiiDriver::set_up(SetupScreen& setup_screen) {
    OVERT_EXPECTS(tracker_);
    return calibrate_tobii(library_, tracker_, setup_screen, settings_, wish_);
}

void TobiiDriver::start() {
    OVERT_EXPECTS(tracker_);
    // Somebody may have changed it with another program since.
    require_screen();
    if (const double hz = rate(); hz != description_.sample_rate_hz)
        throw DeviceError(fmt::format("The eye tracker measures at {} Hz and not at {} Hz, as was agreed: "
                                      "another program has changed it.",
                                      hz, description_.sample_rate_hz));
    inbox_->forget_news();
    last_us_ = 0;
    is_clock_back_ = false;
    port_.reset();
    if (const TobiiStatus status = inbox_->begin_gaze(*library_, tracker_); status != tobii_ok)
        throw DeviceError(
            fmt::format("The eye tracker does not begin to send gaze ({}).", describe_tobii_status(status)));
    last_arrival_ = bound_due_ = clock_.now();
}

void TobiiDriver::stop() noexcept {
    if (tracker_)
        inbox_->end_gaze(*library_, tracker_);
}

void TobiiDriver::deliver(const TobiiMeasurement& measured, TrackerItemSink& sink) noexcept {
    const TrackerTime at = tracker_time(measured.device_us);
    const double steps =
        static_cast<double>(measured.device_us - last_us_) * 1e-6 * description_.sample_rate_hz;
    if (last_us_ > 0 && steps <= 0.0) {
        // Its clock went back: such measurements have no place among the others.
        if (!std::exchange(is_clock_back_, true))
            sink.put(TrackerGap{TrackerGap::Reason::unreadable, tracker_time(last_us_), 0});
        return;
    }
    is_clock_back_ = false;
    last_arrival_ = clock_.now();
    if (last_us_ > 0 && steps > longest_step)
        sink.put(TrackerGap{TrackerGap::Reason::connection, tracker_time(last_us_), std::llround(steps) - 1});
    last_us_ = measured.device_us;
    for (const Eye eye : {Eye::left, Eye::right}) {
        if (!wish_.both_eyes && eye != wish_.eye)
            continue;
        const TobiiEyeValues& values = measured.eyes[static_cast<std::size_t>(eye)];
        GazeSample sample;
        sample.sampled_at = at;
        sample.eye = eye;
        if (values.on_display)
            sample.gaze = ScreenPoint{values.on_display->x * static_cast<double>(wish_.screen.screen_px.x),
                                      values.on_display->y * static_cast<double>(wish_.screen.screen_px.y)};
        sample.pupil_area = values.pupil_mm.value_or(0.0f);
        sink.put(sample);
        if (values.eye_mm) {
            SampleDetail detail;
            detail.sampled_at = at;
            detail.eye = eye;
            detail.eye_mm = {values.eye_mm->x, values.eye_mm->y, values.eye_mm->z};
            sink.put(detail);
        }
    }
    if (!has_been_asked_for_time_ && last_arrival_ >= bound_due_) {
        sink.put(ClockPair{last_arrival_ - settings_.longest_delay, at, last_arrival_});
        bound_due_ = last_arrival_ + between_bounds;
    }
}

void TobiiDriver::deliver(const TobiiPort& port, TrackerItemSink& sink) noexcept {
    const bool is_known = port_ == port.value;
    port_ = port.value;
    if (!port.is_initial && !is_known)
        sink.put(TrackerInput{tracker_time(port.device_us), port.value});
}

bool TobiiDriver::deliver_news(TrackerItemSink& sink) noexcept {
    bool came = false;
    for (TobiiNews news; inbox_->next(news); came = true) {
        if (const auto* measured = std::get_if<TobiiMeasurement>(&news))
            deliver(*measured, sink);
        else if (const auto* port = std::get_if<TobiiPort>(&news))
            deliver(*port, sink);
        else
            sink.put(TrackerGap{TrackerGap::Reason::overflow, tracker_time(last_us_), 0});
    }
    if (const std::int64_t overflow = inbox_->take_overflow())
        sink.put(TrackerGap{TrackerGap::Reason::overflow, tracker_time(last_us_), overflow});
    return came;
}

RecordingState TobiiDriver::read(TrackerItemSink& sink, SessionTime deadline) noexcept {
    for (;;) {
        const bool came = deliver_news(sink);
        const SessionTime now = clock_.now();
        if (inbox_->is_connection_lost() || now - last_arrival_ > settings_.silence) {
            sink.put(TrackerGap{TrackerGap::Reason::connection, tracker_time(last_us_), 0});
            return RecordingState::lost;
        }
        if (came || now >= deadline)
            return RecordingState::running;
        // The library has its own threads, and no way to wait for them that ends at a time.
        clock_.wait_until(std::min(deadline, now + between_looks));
    }
}

std::optional<ClockPair> TobiiDriver::read_clocks() noexcept {
    TobiiTimeSync sync{};
    if (!tracker_ || !inbox_->next(sync))
        return std::nullopt;
    // The library's own clock is read between two readings of ours.
    const SessionTime before = clock_.now();
    std::int64_t system_us = 0;
    if (library_->get_system_time_stamp(&system_us) != tobii_ok ||
        sync.response_system_us < sync.request_system_us || sync.response_system_us > system_us)
        return std::nullopt;
    const SessionTime after = clock_.now();
    has_been_asked_for_time_ = true;
    // Its times are whole microseconds.
    using std::chrono::microseconds;
    return ClockPair{before - microseconds(system_us - sync.request_system_us + 1),
                     tracker_time(sync.device_us),
                     after - microseconds(system_us - sync.response_system_us) + microseconds(1)};
}

std::vector<std::string> TobiiDriver::finish(const std::string&, const EyeTracker::FileProgress&) {
    std::vector<std::string> said = inbox_ ? inbox_->take_complaints() : std::vector<std::string>();
    disconnect();
    return said;
}

std::string tobii_trackers_found() {
    const std::shared_ptr<const TobiiLibrary> library = load_tobii({});
    const TobiiVersion& version = library->version();
    return fmt::format("its library is there, version {}.{}.{}; trackers that it finds: {}", version.major,
                       version.minor, version.revision, listed(*library, find_trackers(*library)));
}

template <> TrackerDevice tracker_device_of<kind_called<TrackerKind>("tobii")>() {
    return {.make_driver = [](const TrackerParts& parts) -> std::unique_ptr<TrackerDriver> {
                TobiiSettings settings;
                settings.device = parts.protocol.tracker.address;
                settings.calibration_points =
                    calibration_targets(parts.protocol.calibration.points, parts.protocol.calibration.area,
                                        screen_geometry_of(parts.protocol));
                settings.target = Degrees{parts.protocol.calibration.target_deg};
                return std::make_unique<TobiiDriver>(settings, parts.clock);
            },
            .can_do = "30 to 1200 Hz of both eyes, calibrates itself, tells changes of its input port",
            .look_for = tobii_trackers_found};
}

} // namespace overt
