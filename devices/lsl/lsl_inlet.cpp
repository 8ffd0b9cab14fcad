#include "devices/lsl/lsl_inlet.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "devices/lsl/lsl_known_apps.h"
#include "devices/tracker/tracker_device.h"
#include "devices/tracker/tracker_seconds.h"
#include "experiment/base/error.h"

namespace overt {
namespace {

constexpr std::int32_t buffered_s = 60;
constexpr int most_channels = 1024;
constexpr int samples_at_once = 4096;
constexpr SessionDuration rate_time = std::chrono::seconds(1);

/// What liblsl's documents promise of a correction where it tells no uncertainty: "below 1 ms".
constexpr double untold_uncertainty_s = 1e-3;

std::string text_of(const char* text) { return text ? text : ""; }

std::vector<LslChannel> channels_of(const LslLibrary& lsl, LslStreamInfo* info) {
    std::vector<LslChannel> channels;
    const auto count = static_cast<std::size_t>(lsl.get_channel_count(info));
    LslXml* each = lsl.child(lsl.child(lsl.get_desc(info), "channels"), "channel");
    for (; channels.size() < count && !lsl.empty(each); each = lsl.next_sibling_n(each, "channel")) {
        const auto value = [&](const char* name) { return text_of(lsl.child_value_n(each, name)); };
        channels.push_back(
            {value("label"), value("eye"), value("type"), value("unit"), value("coordinate_system")});
    }
    channels.resize(count);
    return channels;
}

} // namespace

LslInlet::LslInlet(LslInletSettings settings, const Clock& clock)
    : settings_(std::move(settings)), clock_(clock) {}

LslInlet::~LslInlet() = default;

std::string LslInlet::identity(LslStreamInfo* info) const {
    const std::string source = text_of(library_->get_source_id(info));
    return fmt::format("{} on {}{}{}, liblsl {}", name_, text_of(library_->get_hostname(info)),
                       source.empty() ? "" : ", source ", source, library_->version());
}

TrackerDescription LslInlet::connect(const TrackerWish& wish) {
    if (!library_)
        library_ = load_lsl(settings_.library);
    const LslOwned<LslStreamInfo> found = find_lsl_stream(*library_, settings_.stream, settings_.patience);
    name_ = fmt::format("\"{}\"", text_of(library_->get_name(found.get())));
    const std::int32_t format = library_->get_channel_format(found.get());
    const int count = library_->get_channel_count(found.get());
    if (format == static_cast<std::int32_t>(LslFormat::string) || count < 1 || count > most_channels)
        throw DeviceError(
            fmt::format("The stream {} carries no numbers that could be gaze ({} channels, format {}); name "
                        "another stream.",
                        name_, count, format));
    // Lost streams are told and not waited for: what becomes of the trial is the session's to say.
    inlet_ = {library_->create_inlet(found.get(), buffered_s, 0, 0), LslRelease{library_.get()}};
    if (!inlet_)
        throw DeviceError(fmt::format("The stream {} cannot be connected to.", name_));
    std::int32_t error{};
    const LslOwned<LslStreamInfo> info(
        library_->get_fullinfo(inlet_.get(), to_seconds(settings_.patience), &error),
        LslRelease{library_.get()});
    if (!info || error != 0)
        throw DeviceError(fmt::format("The stream {} does not tell what is in it (error {}): see whether a "
                                      "firewall lets TCP ports 16572 to 16604 through.",
                                      name_, error));
    const std::vector<LslChannel> channels = channels_of(*library_, info.get());
    const LslKnownApp known =
        with_known_app(settings_.layout, text_of(library_->get_name(info.get())), channels);
    layout_.emplace(channels, known.settings, wish, name_);
    values_.assign(static_cast<std::size_t>(count), 0.0);
    is_lost_ = false;
    library_->open_stream(inlet_.get(), to_seconds(settings_.patience), &error);
    if (error != 0)
        throw DeviceError(
            fmt::format("The stream {} does not begin to send ({}); see whether its program runs.", name_,
                        error == lsl_lost ? "it is gone" : "no answer in time"));
    const double nominal_hz = library_->get_nominal_srate(info.get());
    is_regular_ = nominal_hz > 0.0;
    TrackerDescription description;
    description.name = "Lab Streaming Layer";
    description.model = identity(info.get());
    if (!known.app.empty())
        description.model += fmt::format(", channels as {} has them", known.app);
    description.sample_rate_hz = measure_rate();
    description.told_rate_hz = nominal_hz;
    description.eye = layout_->eye();
    description.both_eyes = layout_->measures_both_eyes();
    // The first correction takes its time; it is better spent here than in a recording.
    library_->time_correction(inlet_.get(), to_seconds(settings_.patience), &error);
    return description;
}

SetupOutcome LslInlet::set_up(SetupScreen&) {
    SetupOutcome outcome;
    outcome.method = "the tracker's own program, before the session";
    outcome.message = fmt::format("by the program that sends the stream {}, before the session", name_);
    return outcome;
}

double LslInlet::measure_rate() {
    std::vector<TrackerTime> times;
    SessionTime end = clock_.now() + settings_.patience;
    while (clock_.now() < end && !is_lost_) {
        const std::optional<TrackerTime> time = pull(to_seconds(end - clock_.now()));
        if (!time)
            continue;
        if (times.empty())
            end = std::min(end, clock_.now() + rate_time);
        times.push_back(*time);
    }
    if (times.empty())
        throw DeviceError(
            fmt::format("The stream {} sends nothing; see whether its tracker measures.", name_));
    // A stream's own word is what somebody once wrote into a program.
    const double span_s = std::chrono::duration<double>(times.back() - times.front()).count();
    return times.size() > 2 && span_s > 0.0 ? static_cast<double>(times.size() - 1) / span_s : 1.0;
}

std::optional<TrackerTime> LslInlet::pull(double timeout_s) noexcept {
    std::int32_t error{};
    const double time_s = library_->pull_sample_d(
        inlet_.get(), values_.data(), static_cast<std::int32_t>(values_.size()), timeout_s, &error);
    is_lost_ = is_lost_ || error == lsl_lost;
    if (error != 0 || time_s == 0.0)
        return std::nullopt;
    return tracker_time_of_seconds(time_s);
}

void LslInlet::start() {
    OVERT_EXPECTS(inlet_);
    // The stream stays open from connecting on, since liblsl takes one that was closed for lost when it is
    // opened again. What came between recordings belongs to none.
    const SessionTime give_up = clock_.now() + settings_.patience;
    while (pull(0.0) && clock_.now() < give_up) {
    }
    if (is_lost_)
        throw DeviceError(
            fmt::format("The stream {} is gone; start its program again and connect anew.", name_));
    last_arrival_ = clock_.now();
    last_time_ = {};
}

RecordingState LslInlet::read(TrackerItemSink& sink, SessionTime deadline) noexcept {
    double timeout_s = std::max(0.0, to_seconds(deadline - clock_.now()));
    for (int i = 0; i < samples_at_once; ++i) {
        const std::optional<TrackerTime> time = pull(timeout_s);
        timeout_s = 0.0;
        if (!time)
            break;
        last_arrival_ = clock_.now();
        last_time_ = *time;
        layout_->take(values_, *time, sink);
    }
    const SessionDuration limit = is_regular_ ? settings_.silence : settings_.irregular_silence;
    if (!is_lost_ && clock_.now() - last_arrival_ < limit)
        return RecordingState::running;
    sink.put(TrackerGap{TrackerGap::Reason::connection, last_time_, 0});
    return RecordingState::lost;
}

std::optional<ClockPair> LslInlet::read_clocks() noexcept {
    std::int32_t error{};
    double remote_s{}, uncertainty_s = untold_uncertainty_s;
    const double correction_s =
        library_->time_correction_ex
            ? library_->time_correction_ex(inlet_.get(), &remote_s, &uncertainty_s, 0.5, &error)
            : library_->time_correction(inlet_.get(), 0.5, &error);
    if (error != 0 || !std::isfinite(correction_s) || !std::isfinite(uncertainty_s) || uncertainty_s > 10.0)
        return std::nullopt;
    // liblsl's own clock is read between two readings of ours; the correction leads from the stream's to it.
    const SessionTime before = clock_.now();
    const double local_s = library_->local_clock();
    const SessionTime after = clock_.now();
    if (!library_->time_correction_ex)
        remote_s = local_s - correction_s;
    const double since_s = remote_s + correction_s - local_s;
    const std::optional<TrackerTime> remote = tracker_time_of_seconds(remote_s);
    if (!remote || !(std::abs(since_s) < 3600.0))
        return std::nullopt;
    return ClockPair{before + from_seconds(since_s - uncertainty_s), *remote,
                     after + from_seconds(since_s + uncertainty_s)};
}

template <> TrackerDevice tracker_device_of<kind_called<TrackerKind>("lsl")>() {
    return {.make_driver = [](const TrackerParts& parts) -> std::unique_ptr<TrackerDriver> {
                const TrackerSettings& keys = parts.protocol.tracker;
                LslInletSettings settings;
                settings.stream = parse_lsl_choice(keys.address);
                for (const std::string& channel : keys.channels)
                    settings.layout.assignments.push_back(parse_lsl_assignment(channel));
                settings.layout.unit = keys.unit;
                settings.layout.y_is_up = keys.y_is_up;
                settings.layout.least_confidence = keys.least_confidence;
                settings.layout.missing = keys.missing;
                return std::make_unique<LslInlet>(settings, parts.clock);
            },
            .can_do = "what the stream has; its maker's program or overt calibrates",
            .look_for =
                [] {
                    load_lsl({});
                    return std::string("its library is there");
                },
            .is_calibrated_elsewhere = true};
}

} // namespace overt
