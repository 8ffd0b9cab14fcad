#include "devices/pupil/pupil_tracker.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "devices/tracker/tracker_device.h"
#include "devices/tracker/tracker_seconds.h"
#include "experiment/base/error.h"
#include "experiment/stimulus/gaze_tags.h"

namespace overt {
namespace {

constexpr std::string_view calibration_topic = "notify.calibration.";
constexpr std::string_view pupil_topic = "pupil.", gaze_topic = "gaze.";

constexpr SessionDuration rate_time = std::chrono::seconds(1);
constexpr SessionDuration calibration_slice = std::chrono::milliseconds(20);
constexpr SessionDuration marking_time = std::chrono::milliseconds(20);
constexpr SessionDuration clock_time = std::chrono::milliseconds(500);

/// In one call of read(), so that marks are sent in between even when much has gathered.
constexpr int messages_at_once = 256;

std::string packed(const nlohmann::json& map) {
    std::string bytes;
    nlohmann::json::to_msgpack(map, bytes);
    return bytes;
}

/// How often something comes by its own times; what is not later than all before is told a second time, or is
/// dropped when it is recorded.
class CountedTimes {
  public:
    void take(double time_s) {
        if (count_ > 0 && time_s <= last_s_)
            return;
        if (count_++ == 0)
            first_s_ = time_s;
        last_s_ = time_s;
    }
    int count() const { return count_; }
    /// 0 for fewer than three.
    double rate_hz() const { return count_ < 3 ? 0.0 : (count_ - 1) / (last_s_ - first_s_); }

  private:
    int count_ = 0;
    double first_s_ = 0.0, last_s_ = 0.0;
};

/// Pupil time of a session time, in seconds.
double pupil_time_s(SessionTime at, const ClockPair& clocks) {
    const SessionTime middle = clocks.before + (clocks.after - clocks.before) / 2;
    return to_seconds(clocks.other) + to_seconds(at - middle);
}

} // namespace

PupilTracker::PupilTracker(PupilSettings settings, const Clock& clock)
    : settings_(std::move(settings)), clock_(clock),
      surface_topic_(fmt::format("surfaces.{}", settings_.surface)) {}

PupilTracker::~PupilTracker() { end_recording(); }

bool PupilTracker::end_recording() noexcept {
    return !link_ || !std::exchange(is_recording_, false) ||
           link_->ask("r", clock_.now() + settings_.patience).has_value();
}

bool PupilTracker::tell(const char* subject, std::string_view content) noexcept {
    return link_->notify(subject, content, clock_.now() + settings_.patience);
}

TrackerDescription PupilTracker::connect(const TrackerWish& wish) {
    wish_ = wish;
    link_.reset();
    link_ = std::make_unique<PupilLink>(settings_.remote, clock_, settings_.patience);
    TrackerDescription description;
    description.name = "Pupil Core";
    description.model =
        fmt::format("Pupil Capture {}", link_->ask("v", clock_.now() + settings_.patience).value_or(""));
    last_clocks_ = read_clocks();
    if (!last_clocks_)
        throw DeviceError(
            fmt::format("Pupil Capture at {} does not tell its time; update it and its plugin Pupil Remote.",
                        link_->name()));
    tell("start_plugin", packed({{"subject", "start_plugin"},
                                 {"name", "Annotation_Capture"},
                                 {"args", nlohmann::json::object()}}));
    const Rates rates = measure_rates();
    description.sample_rate_hz = rates.gaze_hz > 0.0 ? rates.gaze_hz : rates.camera_hz;
    description.told_rate_hz = rates.camera_hz;
    description.eye = wish.eye;
    description.both_eyes = wish.both_eyes;
    const SurfaceOnScreen whole{{0.0, 0.0},
                                static_cast<double>(wish.screen.screen_px.x),
                                static_cast<double>(wish.screen.screen_px.y)};
    samples_.emplace(wish, settings_.surface_place.value_or(whole), settings_.least_confidence);
    return description;
}

PupilTracker::Rates PupilTracker::measure_rates() {
    // Gaze is told once Pupil Capture is calibrated, and on the surface while its markers are seen; the eye's
    // camera tells in any case.
    for (const std::string& topic : {std::string(pupil_topic), std::string(gaze_topic), surface_topic_})
        link_->subscribe(topic);
    CountedTimes camera, gaze, on_surface;
    PupilMessage message;
    const SessionTime give_up = clock_.now() + settings_.patience;
    SessionTime end = give_up;
    while (clock_.now() < end && link_->receive(message, end)) {
        if (message.topic == surface_topic_) {
            read_surface(message.content, [&](const SurfaceGaze& each) { on_surface.take(each.time_s); });
        } else if (message.topic.starts_with(gaze_topic)) {
            if (const std::optional<double> time_s = read_gaze_time(message.content))
                gaze.take(*time_s);
        } else if (const auto pupil = read_pupil_datum(message.content); pupil && pupil->eye == wish_.eye) {
            if (camera.count() == 0)
                end = std::min(give_up, clock_.now() + rate_time);
            camera.take(pupil->time_s);
        }
    }
    for (const std::string& topic : {std::string(pupil_topic), std::string(gaze_topic), surface_topic_})
        link_->unsubscribe(topic);
    if (camera.count() < 3)
        throw DeviceError(fmt::format(
            "Pupil Capture at {} tells nothing of the {} eye; switch on the detection "
            "of eye {} in it, or name the other eye.",
            link_->name(), wish_.eye == Eye::left ? "left" : "right", wish_.eye == Eye::left ? 1 : 0));
    return {camera.rate_hz(), on_surface.count() > 2 ? on_surface.rate_hz() : gaze.rate_hz()};
}

SetupOutcome PupilTracker::set_up(SetupScreen& setup_screen) {
    OVERT_EXPECTS(link_);
    const std::string topic(calibration_topic);
    link_->subscribe(topic);
    drop_published();
    setup_screen.show_text(
        "Pupil Capture calibrates: the observer looks at its targets.\nEscape breaks off.");
    if (!link_->ask("C", clock_.now() + settings_.patience))
        throw DeviceError(fmt::format("Pupil Capture at {} does not answer; start it again and connect anew.",
                                      link_->name()));
    SetupOutcome outcome;
    outcome.method = "tracker";
    outcome.kind = SetupOutcome::Kind::failed;
    outcome.message = "Pupil Capture did not end its calibration in time";
    const SessionTime give_up = clock_.now() + settings_.calibration_time;
    bool is_over = false, is_cancelled = false;
    while (!is_over && !is_cancelled && clock_.now() < give_up) {
        PupilMessage message;
        while (!is_over && link_->receive(message, SessionTime())) {
            is_over = message.topic == "notify.calibration.successful" ||
                      message.topic == "notify.calibration.failed";
            if (message.topic == "notify.calibration.successful")
                outcome.kind = SetupOutcome::Kind::done;
            if (is_over)
                outcome.message = outcome.kind == SetupOutcome::Kind::done
                                      ? "Pupil Capture tells no error of its calibration"
                                      : "Pupil Capture could not calibrate: its own window says why";
        }
        is_cancelled = setup_screen.wants_out();
        if (!is_over)
            setup_screen.wait(calibration_slice);
    }
    if (!is_over)
        link_->ask("c", clock_.now() + settings_.patience);
    link_->unsubscribe(topic);
    setup_screen.clear();
    if (!is_over && is_cancelled)
        return {SetupOutcome::Kind::cancelled, {}, {}, "the calibration was broken off"};
    return outcome;
}

void PupilTracker::drop_published() noexcept {
    PupilMessage message;
    for (int i = 0; i < 10'000 && link_->receive(message, SessionTime()); ++i) {
    }
}

void PupilTracker::start() {
    OVERT_EXPECTS(link_ && samples_);
    const SessionTime deadline = clock_.now() + settings_.patience;
    last_clocks_ = read_clocks();
    if (!last_clocks_)
        throw DeviceError(fmt::format("Pupil Capture at {} does not answer; start it again and connect anew.",
                                      link_->name()));
    if (settings_.record && !is_recording_)
        is_recording_ = link_->ask(fmt::format("R {}", wish_.file_name), deadline).has_value();
    drop_published();
    samples_->begin();
    has_started_ = true;
    last_arrival_ = clock_.now();
    link_->subscribe(std::string(pupil_topic));
    link_->subscribe(surface_topic_);
}

void PupilTracker::stop() noexcept {
    link_->unsubscribe(std::string(pupil_topic));
    link_->unsubscribe(surface_topic_);
}

void PupilTracker::take_published(const PupilMessage& message, TrackerItemSink& sink) noexcept {
    if (message.topic == surface_topic_) { // and not one whose name only begins so
        has_surface_ = true;
        if (!read_surface(message.content, [&](const SurfaceGaze& gaze) { samples_->take(gaze, sink); }))
            samples_->take_noise(sink);
    } else if (message.topic.starts_with(pupil_topic)) {
        if (const std::optional<PupilDatum> pupil = read_pupil_datum(message.content))
            samples_->take(*pupil);
        else
            samples_->take_noise(sink);
    }
}

RecordingState PupilTracker::read(TrackerItemSink& sink, SessionTime deadline) noexcept {
    PupilMessage message;
    for (int i = 0; i < messages_at_once && link_->receive(message, i == 0 ? deadline : SessionTime()); ++i) {
        last_arrival_ = clock_.now();
        take_published(message, sink);
    }
    if (clock_.now() - last_arrival_ < settings_.silence)
        return RecordingState::running;
    sink.put(TrackerGap{TrackerGap::Reason::connection, samples_->last_time(), 0});
    return RecordingState::lost;
}

std::optional<ClockPair> PupilTracker::read_clocks() noexcept {
    const std::optional<ClockPair> pair = link_->read_clocks(clock_.now() + clock_time);
    if (pair)
        last_clocks_ = pair;
    return pair;
}

void PupilTracker::send(const TrackerMark& mark) noexcept {
    if (!link_ || !last_clocks_)
        return;
    // What is no ASCII could be no UTF-8 either, which the library would throw for.
    std::string label(mark.text);
    for (char& each : label)
        if (each < ' ' || each > '~')
            each = '?';
    link_->publish("annotation",
                   packed({{"topic", "annotation"},
                           {"label", label},
                           {"timestamp", pupil_time_s(mark.at, *last_clocks_)},
                           {"duration", 0.0}}),
                   clock_.now() + marking_time);
}

std::vector<std::string> PupilTracker::finish(const std::string&, const EyeTracker::FileProgress&) {
    std::vector<std::string> said;
    if (!end_recording())
        said.emplace_back("Pupil Capture did not answer when its recording was to end: end it in its window");
    if (samples_ && has_started_ && !has_surface_)
        said.push_back(
            fmt::format("no gaze came on the surface \"{}\": see in Pupil Capture that a surface of "
                        "that name is defined and that its markers are found",
                        settings_.surface));
    return said;
}

PupilSettings pupil_settings_of(const Protocol& protocol) {
    PupilSettings settings;
    settings.remote = parse_network_address(protocol.tracker.address, settings.remote);
    settings.surface = protocol.tracker.surface;
    settings.least_confidence = protocol.tracker.least_confidence;
    const std::vector<TagPlace> tags =
        gaze_tags_of(screen_geometry_of(protocol), protocol.display, slot_places(protocol));
    if (!tags.empty()) {
        const TaggedArea area = tagged_area(tags);
        settings.surface_place = {{area.origin_px.x, area.origin_px.y}, area.size_px.x, area.size_px.y};
    }
    return settings;
}

template <> TrackerDevice tracker_device_of<kind_called<TrackerKind>("pupil")>() {
    return {
        .make_driver = [](const TrackerParts& parts) -> std::unique_ptr<TrackerDriver> {
            return std::make_unique<PupilTracker>(pupil_settings_of(parts.protocol), parts.clock);
        },
        .can_do =
            "30 to 200 Hz of both eyes, calibrates itself without telling errors, keeps a recording of its "
            "own",
        .look_for = [] { return served_here(PupilSettings{}.remote, "Pupil Capture"); }};
}

} // namespace overt
