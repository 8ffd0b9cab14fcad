/// Fixations, saccades and blinks of a session, and what else its tracker said.
#include <set>

#include <fmt/format.h>

#include "experiment/events/event_detector.h"
#include "experiment/record/gaze_rows.h"
#include "experiment/record/read/session_record.h"
#include "experiment/record/read/settings_words.h"
#include "experiment/record/sql.h"

namespace overt {
namespace {

constexpr std::size_t samples_at_once = 65536;

/// Gives events on to a function.
class EventTaker final : public EventListener {
  public:
    explicit EventTaker(const std::function<void(const GazeEvent&)>& take) : take_(take) {}
    void detected(const GazeEvent& event) override { take_(event); }

  private:
    const std::function<void(const GazeEvent&)>& take_;
};

} // namespace

std::string sentence_on(const SessionRecord::EventOrigin& origin) {
    using From = SessionRecord::EventOrigin::From;
    if (origin.from == From::nobody)
        return "";
    if (origin.from == From::tracker)
        return "Fixations, saccades and blinks are those of the eye tracker itself.";
    return fmt::format("Fixations, saccades and blinks were found {}, by the detector of {}, version {}: {}.",
                       origin.from == From::recording ? "while the session was recorded"
                                                      : "afterwards, in the recorded samples",
                       origin.detection.name, origin.detection.version,
                       settings_in_words(origin.detection.parameters));
}

void SessionRecord::read_gaze_events(const TrialRecord& trial,
                                     const std::function<void(const GazeEvent&)>& take) const {
    read_gaze_events_of(trial.id, take);
    if (event_origin(trial.sitting).from != EventOrigin::From::reading)
        return;
    EventTaker taker(take);
    EventDetector detector(EventSettings{}, *gaze_angles(trial.sitting), taker);
    read_samples(trial, samples_at_once, [&](std::span<const GazeSample> samples) {
        for (const GazeSample& sample : samples)
            detector.push(sample);
    });
    detector.finish();
}

void SessionRecord::read_gaze_events_of(std::int64_t trial_id,
                                        const std::function<void(const GazeEvent&)>& take) const {
    reading_session(file_, [&] {
        if (has_table(*database_, "gaze_event"))
            overt::read_gaze_events(*database_, trial_id, take);
    });
}

void SessionRecord::read_gaze_events_before(const std::function<void(const GazeEvent&)>& take) const {
    read_gaze_events_of(0, take);
}

void SessionRecord::read_gaze_events_after(const TrialRecord& trial,
                                           const std::function<void(const GazeEvent&)>& take) const {
    read_gaze_events_of(after_trial(trial.id), take);
}

void SessionRecord::read_gaze_events_outside(const std::function<void(const GazeEvent&)>& take) const {
    read_gaze_events_before(take);
    for (const TrialRecord& trial : trials_)
        read_gaze_events_after(trial, take);
}

SessionRecord::EventOrigin SessionRecord::event_origin(int sitting) const {
    const auto known = event_origins_.find(sitting);
    if (known != event_origins_.end())
        return known->second;
    return event_origins_[sitting] = find_event_origin(sitting);
}

SessionRecord::EventOrigin SessionRecord::find_event_origin(int sitting) const {
    using From = EventOrigin::From;
    const bool is_imported = gaze_source(sitting).has_value();
    return reading_session(file_, [&]() -> EventOrigin {
        if (!is_imported && has_table(*database_, "event_detection"))
            if (const auto detection = read_event_detection(*database_, sitting))
                return {From::recording, *detection};
        if (has_table(*database_, "gaze_event")) {
            Query row(*database_,
                      "SELECT EXISTS (SELECT * FROM gaze_event JOIN trial USING (trial_id) WHERE sitting = ? "
                      "AND kind IN ('fixation', 'saccade', 'blink'))");
            row.bind(1, sitting);
            if (row.step() && row.integer() != 0)
                return {From::tracker, {}};
        }
        if (is_imported && !detects_imports_)
            return {};
        Query samples(*database_,
                      "SELECT EXISTS (SELECT * FROM sample JOIN trial USING (trial_id) WHERE sitting = ?)");
        samples.bind(1, sitting);
        if (!samples.step() || samples.integer() == 0 || !gaze_angles(sitting))
            return {};
        return {From::reading, detection_by({})};
    });
}

std::string SessionRecord::event_origins() const {
    std::set<int> sittings;
    for (const TrialRecord& trial : trials_)
        sittings.insert(trial.sitting);
    std::set<std::string> told;
    std::string sentences;
    for (const int sitting : sittings) {
        const EventOrigin origin = event_origin(sitting);
        const std::string sentence = sentence_on(origin);
        if (told.insert(sentence).second)
            sentences += (sentences.empty() ? "" : " ") + sentence;
    }
    return sentences;
}

std::optional<GazeAngles> SessionRecord::gaze_angles(int sitting) const {
    const ScreenGeometry& screen = header_.display.screen;
    if (screen.viewing_distance_mm > 0.0 && screen.screen_mm.x > 0.0 && screen.screen_mm.y > 0.0 &&
        screen.screen_px.x > 0 && screen.screen_px.y > 0)
        return GazeAngles(screen);
    const std::optional<GazeSource> source = gaze_source(sitting);
    if (source && source->px_per_deg_x.value_or(0.0) > 0.0 && source->px_per_deg_y.value_or(0.0) > 0.0)
        return GazeAngles(*source->px_per_deg_x, *source->px_per_deg_y);
    return std::nullopt;
}

} // namespace overt
