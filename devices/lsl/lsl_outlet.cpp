#include "devices/lsl/lsl_outlet.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <limits>

#include <fmt/format.h>

#include "devices/triggers/marker_device.h"
#include "experiment/base/error.h"

namespace overt {
namespace {

/// Six minutes, as liblsl advises.
constexpr std::int32_t outlet_buffered_s = 360;

/// Values of one eye in the stream of gaze.
enum GazeChannel : std::size_t { gaze_x, gaze_y, gaze_pupil, gaze_confidence, channels_an_eye };
constexpr std::size_t time_channel = 2 * channels_an_eye;
constexpr std::size_t gaze_channels = time_channel + 1;

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

LslOwned<LslStreamInfo> new_stream(const LslLibrary& lsl, const char* name, const char* type, int channels,
                                   double rate_hz, LslFormat format, const std::string& session) {
    const std::string source = fmt::format("{} {}", name, session);
    LslOwned<LslStreamInfo> info(lsl.create_streaminfo(name, type, channels, rate_hz,
                                                       static_cast<std::int32_t>(format), source.c_str()),
                                 LslRelease{&lsl});
    if (!info)
        throw DeviceError(fmt::format("The stream \"{}\" of the Lab Streaming Layer cannot be made.", name));
    return info;
}

LslOwned<LslStreamOutlet> new_outlet(const LslLibrary& lsl, LslStreamInfo* info) {
    LslOwned<LslStreamOutlet> outlet(lsl.create_outlet(info, 0, outlet_buffered_s), LslRelease{&lsl});
    if (!outlet)
        throw DeviceError(
            fmt::format("The stream \"{}\" of the Lab Streaming Layer cannot be opened: see whether "
                        "TCP ports from 16572 on are free.",
                        lsl.get_name(info)));
    return outlet;
}

void describe_channel(const LslLibrary& lsl, LslXml* channels, const std::string& label, const char* eye,
                      const char* type, const char* unit) {
    LslXml* const channel = lsl.append_child(channels, "channel");
    lsl.append_child_value(channel, "label", label.c_str());
    lsl.append_child_value(channel, "eye", eye);
    lsl.append_child_value(channel, "type", type);
    lsl.append_child_value(channel, "unit", unit);
    lsl.append_child_value(channel, "coordinate_system", "screen");
}

} // namespace

LslMarkerOutlet::LslMarkerOutlet(std::shared_ptr<const LslLibrary> library, const std::string& session,
                                 const Clock& clock)
    : library_(std::move(library)), outlet_(nullptr, LslRelease{library_.get()}), clock_(clock),
      name_("Lab Streaming Layer, stream \"overt\"") {
    const LslOwned<LslStreamInfo> info =
        new_stream(*library_, "overt", "Markers", 1, 0.0, LslFormat::string, session);
    outlet_ = new_outlet(*library_, info.get());
}

bool LslMarkerOutlet::send(const Marker& marker) noexcept {
    std::array<char, longest_marker + 1> text{};
    if (marker.text.empty())
        std::to_chars(text.data(), text.data() + longest_marker, marker.code);
    else
        std::memcpy(text.data(), marker.text.data(), std::min(marker.text.size(), longest_marker));
    const char* values[] = {text.data()};
    const double age_s = to_seconds(clock_.now() - marker.at);
    return library_->push_sample_strtp(outlet_.get(), values, library_->local_clock() - age_s, 1) == 0;
}

/// Passes items on, and samples to the outlet as well.
class LslGazeRelay::Tap final : public TrackerItemSink {
  public:
    explicit Tap(LslGazeRelay& relay) : relay_(relay) { values_.fill(no_value); }

    void begin(TrackerItemSink& sink) noexcept { sink_ = &sink; }

    void put(const TrackerItem& item) noexcept override {
        sink_->put(item);
        if (const auto* sample = std::get_if<GazeSample>(&item)) {
            if (has_values_ && sample->sampled_at != at_)
                push();
            has_values_ = true;
            at_ = sample->sampled_at;
            values_[time_channel] = static_cast<double>(at_.time_since_epoch().count()) * 1e-6;
            double* const eye = values_of(sample->eye);
            eye[gaze_x] = sample->gaze ? sample->gaze->x_px : no_value;
            eye[gaze_y] = sample->gaze ? sample->gaze->y_px : no_value;
            eye[gaze_pupil] = sample->pupil_area > 0.0f ? static_cast<double>(sample->pupil_area) : no_value;
        } else if (const auto* detail = std::get_if<SampleDetail>(&item);
                   detail && has_values_ && detail->sampled_at == at_ && detail->confidence) {
            values_of(detail->eye)[gaze_confidence] = static_cast<double>(*detail->confidence);
        } else if (const auto* pair = std::get_if<ClockPair>(&item)) {
            relay_.offset_.take(*pair);
        }
    }

    /// What was read is whole.
    void end() noexcept {
        if (has_values_)
            push();
    }

  private:
    double* values_of(Eye eye) noexcept {
        return eye == Eye::left ? values_.data() : values_.data() + channels_an_eye;
    }

    void push() noexcept {
        const std::optional<SessionTime> measured = relay_.offset_.session_time_of(at_);
        // Not known better than the readings tell, but never after it has come.
        const double age_s = measured ? std::max(0.0, to_seconds(relay_.clock_.now() - *measured)) : 0.0;
        relay_.library_->push_sample_dtp(relay_.outlet_.get(), values_.data(),
                                         relay_.library_->local_clock() - age_s, 1);
        values_.fill(no_value);
        has_values_ = false;
    }

    LslGazeRelay& relay_;
    TrackerItemSink* sink_ = nullptr;
    std::array<double, gaze_channels> values_;
    bool has_values_ = false;
    TrackerTime at_{};
};

LslGazeRelay::LslGazeRelay(std::unique_ptr<TrackerDriver> tracker, std::shared_ptr<const LslLibrary> library,
                           std::string session, const Clock& clock)
    : tracker_(std::move(tracker)), library_(std::move(library)), session_(std::move(session)), clock_(clock),
      outlet_(nullptr, LslRelease{library_.get()}), tap_(std::make_unique<Tap>(*this)) {}

LslGazeRelay::~LslGazeRelay() = default;

TrackerDescription LslGazeRelay::connect(const TrackerWish& wish) {
    TrackerDescription description = tracker_->connect(wish);
    // Made anew: its rate and its tracker may be others, and its clock.
    offset_ = {};
    outlet_.reset();
    const LslOwned<LslStreamInfo> info =
        new_stream(*library_, "overt gaze", "Gaze", gaze_channels, description.sample_rate_hz,
                   LslFormat::double64, session_);
    LslXml* const desc = library_->get_desc(info.get());
    library_->append_child_value(desc, "manufacturer", description.name.c_str());
    library_->append_child_value(desc, "model", description.model.c_str());
    LslXml* const channels = library_->append_child(desc, "channels");
    for (const char* eye : {"left", "right"}) {
        describe_channel(*library_, channels, fmt::format("{}_x", eye), eye, "ScreenX", "pixels");
        describe_channel(*library_, channels, fmt::format("{}_y", eye), eye, "ScreenY", "pixels");
        describe_channel(*library_, channels, fmt::format("{}_pupil", eye), eye, "Diameter", "tracker");
        describe_channel(*library_, channels, fmt::format("{}_confidence", eye), eye, "Confidence", "");
    }
    describe_channel(*library_, channels, "tracker_time", "both", "Time", "seconds");
    outlet_ = new_outlet(*library_, info.get());
    return description;
}

std::optional<ClockPair> LslGazeRelay::read_clocks() noexcept {
    const std::optional<ClockPair> pair = tracker_->read_clocks();
    if (pair)
        offset_.take(*pair);
    return pair;
}

RecordingState LslGazeRelay::read(TrackerItemSink& sink, SessionTime deadline) noexcept {
    tap_->begin(sink);
    const RecordingState state = tracker_->read(*tap_, deadline);
    tap_->end();
    return state;
}

template <> MarkerDevice marker_device_of<kind_called<MarkerOutputKind>("lsl")>() {
    return {.open = [](const MarkerParts& parts) -> std::unique_ptr<MarkerOutput> {
                return std::make_unique<LslMarkerOutlet>(load_lsl({}), parts.session,
                                                         parts.clock);
            },
            .look_for = []() -> std::vector<std::string> {
                try {
                    load_lsl({});
                    return {"Lab Streaming Layer: its library is there, kind lsl"};
                } catch (const Error& error) {
                    return {fmt::format("Lab Streaming Layer: {}", error.what())};
                }
            }};
}

} // namespace overt
