#include "devices/opengaze/opengaze_tracker.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "devices/opengaze/opengaze_calibration.h"
#include "devices/tracker/sample_rate_watch.h"
#include "devices/tracker/tracker_device.h"
#include "experiment/base/error.h"
#include "experiment/calibration/own_calibration.h"

namespace overt {
namespace {

/// What a session wants in each record. The first are needed; without the others something is left out.
struct WantedField {
    const char* id;
    bool is_needed;
};
constexpr WantedField wanted_fields[] = {
    {"ENABLE_SEND_TIME", true},       {"ENABLE_SEND_POG_LEFT", true},   {"ENABLE_SEND_POG_RIGHT", true},
    {"ENABLE_SEND_POG_BEST", true},   {"ENABLE_SEND_COUNTER", false},   {"ENABLE_SEND_TIME_TICK", false},
    {"ENABLE_SEND_EYE_LEFT", false},  {"ENABLE_SEND_EYE_RIGHT", false}, {"ENABLE_SEND_PUPILMM", false},
    {"ENABLE_SEND_USER_DATA", false},
};

/// Over so many records the rate is measured, and the counter's frequency proven.
constexpr std::size_t rate_records = 30;
constexpr SessionDuration rate_patience = std::chrono::seconds(3);

constexpr SessionDuration marking_time = std::chrono::milliseconds(20);
constexpr SessionDuration stopping_time = std::chrono::milliseconds(500);

std::string text_of(const std::optional<OpenGazeAnswer>& answer, std::string_view name) {
    if (!answer || !answer->is_granted)
        return {};
    return std::string(answer->message().value(name).value_or(""));
}

/// Records in a second, by the median interval; 0 for fewer than three.
double rate_of(const std::vector<double>& times_s) {
    std::vector<double> intervals;
    std::optional<double> before_s;
    for (const double time_s : times_s) {
        if (before_s)
            intervals.push_back(time_s - *before_s);
        before_s = time_s;
    }
    if (intervals.size() < 2)
        return 0.0;
    const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
    std::ranges::nth_element(intervals, middle);
    return *middle > 0.0 ? 1.0 / *middle : 0.0;
}

} // namespace

OpenGazeTracker::OpenGazeTracker(OpenGazeSettings settings, const Clock& clock, LineOpener open)
    : settings_(std::move(settings)), clock_(clock), open_(std::move(open)) {
    if (!open_)
        open_ = [this] {
            return std::make_unique<TcpLine>(settings_.server, "Open Gaze server (Gazepoint Control)", clock_,
                                             clock_.now() + settings_.timeouts.connect);
        };
}

OpenGazeTracker::~OpenGazeTracker() = default;

void OpenGazeTracker::require(std::string_view id, std::string_view values, std::string_view what) {
    const std::optional<OpenGazeAnswer> answer = link_->set(id, values);
    if (!answer)
        throw DeviceError(fmt::format("The eye tracker's server at {} does not answer to {}; start Gazepoint "
                                      "Control anew, and see whether another program listens there.",
                                      link_->name(), id));
    if (!answer->is_granted)
        throw DeviceError(
            fmt::format("The eye tracker's server at {} refuses {}, by which {}; update Gazepoint "
                        "Control.",
                        link_->name(), id, what));
}

void OpenGazeTracker::choose_records() {
    for (const auto& [id, is_needed] : wanted_fields) {
        if (is_needed)
            require(id, "STATE=\"1\"", "gaze is told");
        else
            link_->set(id, "STATE=\"1\"");
    }
}

void OpenGazeTracker::choose_screen() {
    if (!settings_.screen_origin_px)
        return;
    require("SCREEN_SIZE",
            fmt::format("X=\"{}\" Y=\"{}\" WIDTH=\"{}\" HEIGHT=\"{}\"", settings_.screen_origin_px->x,
                        settings_.screen_origin_px->y, wish_.screen.screen_px.x, wish_.screen.screen_px.y),
            "the screen is chosen");
}

std::string OpenGazeTracker::identity() {
    // The first question tells whether somebody is there who speaks this language.
    const std::optional<OpenGazeAnswer> product = link_->get("PRODUCT_ID");
    if (!product)
        throw DeviceError(
            fmt::format("What listens at {} does not speak the Open Gaze API: it does not answer "
                        "to PRODUCT_ID; name the address of Gazepoint Control.",
                        link_->name()));
    std::string model = text_of(link_->get("COMPANY_ID"), "VALUE");
    const auto add = [&model](std::string_view before, const std::string& text) {
        if (!text.empty())
            model += fmt::format("{}{}{}", model.empty() ? "" : " ", before, text);
    };
    add("", text_of(product, "VALUE"));
    add("serial number ", text_of(link_->get("SERIAL_ID"), "VALUE"));
    add("API ", text_of(link_->get("API_ID"), "VALUE"));
    const std::optional<OpenGazeAnswer> screen = link_->get("SCREEN_SIZE");
    if (const std::string width = text_of(screen, "WIDTH"); !width.empty())
        add("tracking a screen of ", fmt::format("{} x {} px", width, text_of(screen, "HEIGHT")));
    return model;
}

double OpenGazeTracker::measure_rate() {
    std::optional<double> told_hz;
    if (const std::optional<OpenGazeAnswer> answer = link_->get("TIME_TICK_FREQUENCY"))
        told_hz = answer->message().number("FREQ");
    std::vector<OpenGazeRecord> records;
    stream(true);
    const SessionTime give_up = clock_.now() + rate_patience;
    while (records.size() < rate_records && !link_->lost() && clock_.now() < give_up)
        link_->pump(
            give_up,
            [&records](const OpenGazeMessage& message) {
                if (message.kind == OpenGazeMessage::Kind::record)
                    records.push_back(read_opengaze_record(message));
            },
            [] {});
    stream(false);
    std::vector<double> times_s;
    for (const OpenGazeRecord& record : records)
        if (record.time_s)
            times_s.push_back(*record.time_s);
    const double rate_hz = rate_of(times_s);
    if (rate_hz <= 0.0)
        throw DeviceError(
            fmt::format("The eye tracker's server at {} sends no records with times ({} came in "
                        "{} s); see whether Gazepoint Control finds its camera.",
                        link_->name(), records.size(), to_seconds(rate_patience)));
    tracker_clock_.use_ticks(proven_tick_hz(told_hz, records.front(), records.back()));
    return rate_hz;
}

TrackerDescription OpenGazeTracker::connect(const TrackerWish& wish) {
    wish_ = wish;
    link_.reset();
    link_ = std::make_unique<OpenGazeLink>(open_(), clock_, settings_.timeouts);
    // A program that was killed may have left the stream on.
    link_->set("ENABLE_SEND_DATA", "STATE=\"0\"");
    choose_screen();
    TrackerDescription description;
    description.model = identity();
    choose_records();
    const double measured_hz = measure_rate();
    // The rate that the server names, where it is the one that comes.
    const std::optional<OpenGazeAnswer> product = link_->get("PRODUCT_ID");
    const double told_hz = product ? product->message().number("RATE").value_or(0.0) : 0.0;
    description.name = "Open Gaze";
    description.sample_rate_hz = is_same_rate(told_hz, measured_hz) ? told_hz : measured_hz;
    description.told_rate_hz = told_hz;
    description.eye = wish.eye;
    description.both_eyes = wish.both_eyes && settings_.point == TrackedPoint::eyes;
    marks_.begin(from_seconds(1.0 / measured_hz));
    samples_.emplace(wish, settings_.point, settings_.longest_delay);
    return description;
}

SetupOutcome OpenGazeTracker::set_up(SetupScreen& setup_screen) {
    OVERT_EXPECTS(link_);
    return calibrate_opengaze(*link_, setup_screen, {settings_, wish_, clock_});
}

void OpenGazeTracker::stream(bool on) {
    require("ENABLE_SEND_DATA", on ? "STATE=\"1\"" : "STATE=\"0\"", "records are sent");
}

void OpenGazeTracker::start() {
    OVERT_EXPECTS(link_ && samples_);
    link_->forget();
    samples_->begin();
    stream(true);
    started_ = clock_.now();
}

void OpenGazeTracker::stop() noexcept {
    link_->send_set("ENABLE_SEND_DATA", "STATE=\"0\"", clock_.now() + stopping_time);
    // What is under way belongs to the recording that ends.
    bool is_quiet = false;
    const SessionTime give_up = clock_.now() + stopping_time;
    while (!is_quiet && !link_->lost() && clock_.now() < give_up)
        link_->pump(
            give_up,
            [&is_quiet](const OpenGazeMessage& message) {
                is_quiet = is_quiet || message.kind == OpenGazeMessage::Kind::acknowledged ||
                           message.kind == OpenGazeMessage::Kind::refused;
            },
            [] {});
}

RecordingState OpenGazeTracker::read(TrackerItemSink& sink, SessionTime deadline) noexcept {
    link_->pump(
        deadline,
        [&](const OpenGazeMessage& message) {
            if (message.kind != OpenGazeMessage::Kind::record)
                return;
            samples_->take(read_opengaze_record(message), clock_.now(), tracker_clock_, sink);
            if (const std::optional<std::string_view> user = message.value("USER"))
                marks_.borne(*user);
        },
        [&] { samples_->take_noise(sink); });
    const SessionTime last = samples_->last_arrival().value_or(started_);
    if (!link_->lost() && clock_.now() - last < settings_.timeouts.silence)
        return RecordingState::running;
    sink.put(TrackerGap{TrackerGap::Reason::connection, samples_->last_time(), 0});
    return RecordingState::lost;
}

void OpenGazeTracker::send(const TrackerMark& mark) noexcept {
    if (!link_)
        return;
    const SessionTime now = clock_.now();
    link_->send_set("USER_DATA", fmt::format("VALUE=\"{}\" DUR=\"1\"", marks_.add(mark.text, now)),
                    now + marking_time);
}

std::vector<std::string> OpenGazeTracker::finish(const std::string&, const EyeTracker::FileProgress&) {
    std::vector<std::string> said;
    if (marks_.frames_left_out() + marks_.others_left_out() > 0)
        said.push_back(
            fmt::format("too many messages came between two records of Gazepoint: {} of frames and {} "
                        "others were left out of its user data; the session's record has all of them",
                        marks_.frames_left_out(), marks_.others_left_out()));
    return said;
}

OpenGazeSettings opengaze_settings_of(const Protocol& protocol) {
    OpenGazeSettings settings;
    settings.server = parse_network_address(protocol.tracker.address, settings.server);
    settings.point = protocol.tracker.point;
    const ScreenGeometry screen = screen_geometry_of(protocol);
    for (const ScreenPoint target :
         calibration_targets(protocol.calibration.points, protocol.calibration.area, screen))
        settings.calibration_points.emplace_back(target.x_px / screen.screen_px.x,
                                                 target.y_px / screen.screen_px.y);
    return settings;
}

template <> TrackerDevice tracker_device_of<kind_called<TrackerKind>("opengaze")>() {
    return {.make_driver = [](const TrackerParts& parts) -> std::unique_ptr<TrackerDriver> {
                return std::make_unique<OpenGazeTracker>(opengaze_settings_of(parts.protocol), parts.clock);
            },
            .can_do = "60 or 150 Hz of both eyes, calibrates itself; its clock is known to 50 ms",
            .look_for = [] { return served_here(OpenGazeSettings{}.server, "Gazepoint Control"); }};
}

} // namespace overt
