#include "experiment/record/read/gaze_answer.h"

#include <algorithm>

namespace overt {

namespace {

constexpr SessionDuration oldest_sample = std::chrono::milliseconds(50);
constexpr std::size_t samples_in_piece = 4096;

std::optional<GazeOfAnswer> last_sample(const SessionRecord& record, const TrialRecord& trial,
                                        const ClockMap& clock_map, SessionTime pressed) {
    const Eye eye = record.header().tracker.eye;
    std::optional<GazeOfAnswer> last;
    record.read_samples(trial, samples_in_piece, [&](std::span<const GazeSample> piece) {
        for (const GazeSample& sample : piece) {
            const SessionTime at = clock_map.to_session(sample.sampled_at).time;
            if (sample.eye != eye || at > pressed)
                continue;
            last = sample.gaze ? std::optional(GazeOfAnswer{*sample.gaze, at}) : std::nullopt;
        }
    });
    return last && pressed - last->at <= oldest_sample ? last : std::nullopt;
}

std::optional<GazeOfAnswer> last_fixation(const SessionRecord& record, const TrialRecord& trial,
                                          const ClockMap& clock_map, SessionTime pressed) {
    const Eye eye = record.header().tracker.eye;
    std::optional<GazeOfAnswer> last;
    SessionTime last_start;
    record.read_gaze_events(trial, [&](const GazeEvent& event) {
        if (event.kind != GazeEvent::Kind::fixation || event.eye.value_or(eye) != eye || !event.place)
            return;
        const SessionTime start = clock_map.to_session(event.start).time,
                          end = clock_map.to_session(event.end).time;
        if (start > pressed || (last && start < last_start))
            return;
        last_start = start;
        last = GazeOfAnswer{*event.place, std::min(end, pressed)};
    });
    return last;
}

} // namespace

std::optional<GazeOfAnswer> gaze_of_answer(const SessionRecord& record, const TrialRecord& trial,
                                           const GivenAnswer& given) {
    if (given.is_missed || !given.answered_at)
        return std::nullopt;
    const bool is_by_gaze = given.value == pointed_by_gaze;
    if (!is_by_gaze && given.value != pointed_by_fixation)
        return std::nullopt;
    const std::optional<ClockMap> clock_map = record.clock_map(trial);
    if (!clock_map)
        return std::nullopt;
    return is_by_gaze ? last_sample(record, trial, *clock_map, *given.answered_at)
                      : last_fixation(record, trial, *clock_map, *given.answered_at);
}

} // namespace overt
