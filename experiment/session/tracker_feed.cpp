#include "experiment/session/tracker_feed.h"

#include <utility>

#include "experiment/base/error.h"
#include "experiment/clock_map.h"

namespace overt {

namespace {

/// Readings of both clocks at each end of a presentation.
constexpr int clock_readings = 8;

constexpr std::size_t items_of_a_poll = 4096, most_readings = 4096;

} // namespace

TrackerFeed::TrackerFeed(EyeTracker& tracker) : tracker_(tracker), items_(items_of_a_poll) {
    readings_.reserve(most_readings);
}

bool TrackerFeed::start_recording(SessionTime now) {
    const TrackerDescription description = tracker_.description();
    yield_.begin(description.sample_rate_hz, description.both_eyes ? 2 : 1);
    began_ = ended_ = now;
    doubled_count_ = 0;
    last_at_ = {};
    state_ = RecordingState::running;
    why_lost_.clear();
    has_recorded_ = false;
    try {
        tracker_.start_recording();
    } catch (const DeviceError& error) {
        why_lost_ = error.what();
        state_ = RecordingState::lost;
        return false;
    }
    has_recorded_ = true;
    return true;
}

void TrackerFeed::stop_recording(SessionTime now) {
    ended_ = now;
    if (has_recorded_)
        tracker_.stop_recording();
}

void TrackerFeed::look_at_state() noexcept {
    if (state_ == RecordingState::running)
        state_ = tracker_.recording_state();
}

std::optional<SessionDuration> TrackerFeed::take_jump() noexcept {
    return std::exchange(jump_, std::nullopt);
}

void TrackerFeed::take_items(int trial, SessionLog& log, GazeWatch* gaze_watch) noexcept {
    std::size_t taken = 0;
    do {
        taken = tracker_.poll(items_);
        for (std::size_t i = 0; i < taken; ++i)
            take(trial, items_[i], log, gaze_watch);
    } while (taken == items_.size());
}

void TrackerFeed::take(int trial, const TrackerItem& item, SessionLog& log, GazeWatch* gaze_watch) noexcept {
    if (const auto* sample = std::get_if<GazeSample>(&item)) {
        std::optional<TrackerTime>& last_at = last_at_[sample->eye == Eye::left ? 0 : 1];
        if (last_at == sample->sampled_at) {
            ++doubled_count_;
            return;
        }
        last_at = sample->sampled_at;
        yield_.take(*sample);
        log.sample(trial, *sample);
        if (gaze_watch)
            gaze_watch->take(*sample);
    } else if (const auto* pair = std::get_if<ClockPair>(&item)) {
        watch(*pair);
        log.clock_pair(*pair);
    } else {
        log.tracker_item(trial, item);
    }
}

void TrackerFeed::read_clocks(SessionLog& log) noexcept {
    if (!tracker_.measures_gaze())
        return;
    for (int i = 0; i < clock_readings; ++i)
        if (const std::optional<ClockPair> pair = tracker_.read_clocks()) {
            watch(*pair);
            log.clock_pair(*pair);
        }
}

/// Two readings in a row that agree with each other and not with the one before tell of a jump; one alone
/// may have been delayed.
void TrackerFeed::watch(const ClockPair& pair) noexcept {
    if (const std::optional<SessionDuration> jump = steady_ ? clock_jump(*steady_, pair) : std::nullopt) {
        if (!suspect_ || clock_jump(*suspect_, pair)) {
            suspect_ = pair;
            return;
        }
        jump_ = jump;
        readings_.clear();
        readings_.push_back(*suspect_);
    }
    steady_ = pair;
    suspect_.reset();
    if (readings_.size() == most_readings)
        readings_.erase(readings_.begin(), readings_.begin() + most_readings / 2);
    readings_.push_back(pair);
}

} // namespace overt
