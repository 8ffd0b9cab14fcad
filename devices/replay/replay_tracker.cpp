#include "devices/replay/replay_tracker.h"

#include <utility>

#include <fmt/format.h>

#include "devices/tracker/tracker_device.h"
#include "experiment/base/counted.h"
#include "experiment/base/error.h"
#include "experiment/ports/trial_mark.h"

namespace overt {

namespace {

constexpr SessionDuration drift_window = std::chrono::milliseconds(100);

/// The last sample before the end may lie behind it by the rounding of the clock's line.
constexpr TrackerClock::duration rounding = std::chrono::microseconds(100);

constexpr std::string_view onset_mark = "SYNCTIME";
constexpr std::string_view object_mark = "!V TRIAL_VAR object ";
constexpr std::string_view material_mark = "!V TRIAL_VAR material ";

std::string listed(const std::set<int>& trials) {
    std::string text;
    for (const int trial : trials)
        text += fmt::format("{}{}", text.empty() ? "" : ", ", trial + 1);
    return text;
}

} // namespace

ReplayTracker::ReplayTracker(const std::filesystem::path& recording, Clock& clock)
    : recording_path_(recording), source_(recording), clock_(&clock) {}

TrackerDescription ReplayTracker::description() const {
    const TrackerDescription& recorded = source_.record().header().tracker;
    return {"replay", recorded.sample_rate_hz, source_.eye(), source_.both_eyes(),
            fmt::format("gaze of {}, by {}", recording_path_.filename().string(), recorded.name)};
}

SetupOutcome ReplayTracker::set_up(SetupScreen&) {
    const std::optional<RecordedCalibration> recorded = source_.calibration(++set_ups_);
    if (!recorded)
        return {SetupOutcome::Kind::done, std::nullopt, "replay", "the recording tells of no validation"};
    return {SetupOutcome::Kind::done, recorded->validation, recorded->method, {}};
}

void ReplayTracker::load() {
    if (trial_ && !replayed_)
        replayed_ = source_.attempt_at(*trial_, attempts_[*trial_]);
}

DriftOutcome ReplayTracker::drift_check(ScreenPoint) {
    clock_->wait_until(clock_->now() + drift_window);
    load();
    if (!replayed_ || !replayed_->drift)
        return {};
    return {DriftOutcome::Kind::measured, *replayed_->drift};
}

std::optional<ClockPair> ReplayTracker::read_clocks() noexcept {
    const SessionTime now = clock_->now();
    return ClockPair{now, source_.clock().to_other(now), now};
}

void ReplayTracker::start_recording() {
    if (!is_told_trials_) {
        trial_ = 0;
        attempts_[0] = 1;
    }
    load();
    if (trial_ && !replayed_)
        missing_.insert(*trial_);
    next_ = 0;
    end_.reset();
    forward_.reset();
    recording_ = true;
    const bool is_told_onset = is_told_trials_ && replayed_ && replayed_->onset;
    if (replayed_ && !is_told_onset && !replayed_->items.empty()) {
        TrackerItem first = replayed_->items.front();
        align(put_forward(first, {}), tracker_now());
    }
}

void ReplayTracker::stop_recording() {
    if (recording_)
        end_ = tracker_now() + rounding;
    recording_ = false;
}

std::size_t ReplayTracker::poll(std::span<TrackerItem> into) noexcept {
    if (!replayed_ || !forward_)
        return 0;
    const TrackerTime latest = recording_ ? tracker_now() : *end_;
    std::size_t taken = 0;
    while (taken < into.size() && next_ < replayed_->items.size()) {
        into[taken] = replayed_->items[next_];
        if (put_forward(into[taken], *forward_) > latest)
            break;
        ++taken;
        ++next_;
    }
    return taken;
}

/// What is shown at the onset aligns the gaze; what is said of a trial at its end tells whether it was the
/// same trial.
void ReplayTracker::mark(const TrackerMark& mark) noexcept {
    if (begins_trial(mark.text)) {
        is_told_trials_ = true;
        trial_ = trial_of_mark(mark.text);
        if (trial_)
            ++attempts_[*trial_];
        replayed_.reset();
        return;
    }
    if (!replayed_)
        return;
    if (mark.text == onset_mark && replayed_->onset && recording_)
        align(*replayed_->onset, source_.clock().to_other(mark.at));
    const auto differs = [&](std::string_view prefix, const std::string& recorded) {
        return mark.text.starts_with(prefix) && !recorded.empty() &&
               mark.text.substr(prefix.size()) != recorded;
    };
    if (differs(object_mark, replayed_->object) || differs(material_mark, replayed_->material))
        unlike_.insert(*trial_);
}

std::vector<std::string> ReplayTracker::finish(const std::string&, const FileProgress&) {
    std::vector<std::string> said;
    if (!missing_.empty())
        said.push_back(fmt::format("{} of the recording had no gaze to be played back: {}",
                                   counted(missing_.size(), "trial"), listed(missing_)));
    if (!unlike_.empty())
        said.push_back(
            fmt::format("{} showed another stimulus than the recording's: {}. The places on the "
                        "surface are not where the observer looked; the same --seed and --observer "
                        "give the same order",
                        counted(unlike_.size(), "trial"), listed(unlike_)));
    return said;
}

template <> TrackerDevice tracker_device_of<kind_called<TrackerKind>("replay")>() {
    return {.make_tracker = [](const TrackerParts& parts) -> std::unique_ptr<EyeTracker> {
        if (parts.protocol.calibration.by == CalibratedBy::overt)
            throw InputError(
                "the gaze that the eye tracker \"replay\" plays back is calibrated already: leave out "
                "[calibration] by = \"overt\"");
        return std::make_unique<ReplayTracker>(parts.protocol.tracker.address, parts.clock);
    }};
}

} // namespace overt
