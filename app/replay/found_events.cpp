#include "app/replay/found_events.h"

#include <fmt/format.h>

#include "experiment/base/counted.h"
#include "experiment/events/event_detector.h"

namespace overt {

namespace {

class EventList final : public EventListener {
  public:
    void detected(const GazeEvent& event) override { events.push_back(event); }
    std::vector<GazeEvent> events;
};

std::string in_words(const GazeEvent& event) {
    const auto us = [](TrackerTime time) { return time.time_since_epoch().count(); };
    std::string words =
        fmt::format("{} from {} to {} us", name_of(event.kind), us(event.start), us(event.end));
    if (event.place)
        words += fmt::format(" at {}, {} px", event.place->x_px, event.place->y_px);
    return words;
}

std::vector<GazeEvent> recorded_events(const SessionRecord& record, const TrialRecord& trial) {
    std::vector<GazeEvent> events;
    record.read_gaze_events(trial, [&](const GazeEvent& event) {
        if (is_eye_event(event.kind))
            events.push_back(event);
    });
    return events;
}

} // namespace

void compare_found_events(const SessionRecord& record, const EventSettings& settings, ReplayReport& report) {
    constexpr std::size_t piece = 4096;
    EventList found;
    EventDetector detector(settings, GazeAngles(record.header().display.screen), found);
    std::size_t events = 0;
    bool others = false;
    for (const TrialRecord& trial : record.trials()) {
        const SessionRecord::EventOrigin origin = record.event_origin(trial.sitting);
        if (origin.from != SessionRecord::EventOrigin::From::recording ||
            origin.detection != detection_by(settings)) {
            others = true;
            continue;
        }
        if (!trial.has_outcome())
            continue; // its last event was not complete
        found.events.clear();
        record.read_samples(trial, piece, [&](std::span<const GazeSample> samples) {
            for (const GazeSample& sample : samples)
                detector.push(sample);
        });
        detector.finish();
        const std::vector<GazeEvent> recorded = recorded_events(record, trial);
        events += recorded.size();
        if (recorded == found.events)
            continue;
        std::size_t at = 0;
        while (at < recorded.size() && at < found.events.size() && recorded[at] == found.events[at])
            ++at;
        const auto told = [&](const std::vector<GazeEvent>& list) {
            return at < list.size() ? in_words(list[at]) : "none";
        };
        report.differences.push_back({"gaze_event", trial.trial.index, trial.attempt,
                                      fmt::format("eye movement {}", at + 1), "all", told(recorded),
                                      told(found.events)});
        break;
    }
    if (events > 0)
        report.compared.push_back(
            fmt::format("{}, found again in the recorded samples",
                        counted(events, "fixation, saccade or blink", "fixations, saccades and blinks")));
    if (others)
        report.not_compared.emplace_back(
            "fixations, saccades and blinks of the tracker, or of another version of the method");
}

} // namespace overt
