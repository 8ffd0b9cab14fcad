/// Fixations, saccades and blinks of a session, and what else its tracker said.
#include <algorithm>
#include <map>
#include <mutex>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "experiment/events/recording_events.h"
#include "experiment/record/read/import_source.h"
#include "experiment/record/gaze_rows.h"
#include "experiment/record/read/session_record.h"
#include "experiment/record/read/settings_words.h"
#include "experiment/record/sql.h"

namespace overt {
namespace {

constexpr std::size_t samples_at_once = 65536;

/// The settings of a detection that this program noted; nothing if its parameters are not such.
std::optional<EventSettings> settings_of(const EventDetection& detection) {
    const nlohmann::json parameters = nlohmann::json::parse(detection.parameters, nullptr, false);
    if (detection.name != event_detector_name || !parameters.is_object())
        return std::nullopt;
    EventSettings settings;
    for (const EventThreshold& threshold : event_thresholds) {
        const auto value = parameters.find(threshold.key);
        if (value == parameters.end() || !value->is_number())
            return std::nullopt;
        settings.*threshold.setting = value->get<double>();
    }
    return settings;
}

/// Puts each event to the trial that its last sample is of.
class EventsByTrial final : public EventListener {
  public:
    explicit EventsByTrial(std::map<std::int64_t, std::vector<GazeEvent>>& events) : events_(events) {}

    void begin(std::int64_t trial_id, TrackerTime first) { begun_.emplace_back(first, trial_id); }
    void detected(const GazeEvent& event) override {
        // An event is told soon after its end: the trials that matter are the last ones.
        std::size_t i = begun_.size() - 1;
        while (i > 0 && begun_[i].first > event.end)
            --i;
        events_[begun_[i].second].push_back(event);
    }

  private:
    std::map<std::int64_t, std::vector<GazeEvent>>& events_;
    std::vector<std::pair<TrackerTime, std::int64_t>> begun_;
};

} // namespace

/// What is found in a sitting's samples.
struct SessionRecord::FoundEvents {
    EventSettings settings;
    EventDetection detection;
    bool are_found = false;
    std::map<std::int64_t, std::vector<GazeEvent>> by_trial; ///< by the trial_id that samples are under
};

/// What is to be found, and was found so far; for all readers that work together.
struct SessionRecord::FindingEvents {
    bool in_imports = false;
    std::optional<ChosenThresholds> everywhere;
    std::mutex mutex; ///< of what follows
    std::map<int, FoundEvents> found;
    std::mutex clock_mutex;
    std::map<int, std::optional<ClockMap>> clock_maps; ///< by sitting, once asked for
};

std::string sentence_on(const SessionRecord::EventOrigin& origin) {
    using From = SessionRecord::EventOrigin::From;
    if (origin.from == From::nobody)
        return "";
    if (origin.from == From::tracker)
        return "Fixations, saccades and blinks are those of the eye tracker itself.";
    if (origin.from == From::no_angles)
        return "Fixations, saccades and blinks were not looked for, because angles are unknown: the session "
               "says "
               "neither how large its screen is and how far away it was, nor the tracker's pixels per "
               "degree. "
               "Import the recording again with --screen-mm and --distance-mm.";
    return fmt::format("Fixations, saccades and blinks were found {}, by the detector of {}, version {}: {}.",
                       origin.from == From::recording ? "while the session was recorded"
                                                      : "afterwards, in the recorded samples",
                       origin.detection.name, origin.detection.version,
                       settings_in_words(origin.detection.parameters));
}

void SessionRecord::detect_events_of_imports() {
    finding_ = std::make_shared<FindingEvents>();
    finding_->in_imports = true;
    event_origins_.clear();
}

void SessionRecord::detect_events(const ChosenThresholds& chosen) {
    finding_ = std::make_shared<FindingEvents>();
    finding_->everywhere = chosen;
    event_origins_.clear();
}

void SessionRecord::detect_events_as(const SessionRecord& other) {
    finding_ = other.finding_;
    event_origins_.clear();
}

// Each trial asks for it, and it is made of all readings of the sitting.
std::optional<ClockMap> SessionRecord::clock_map(int sitting) const {
    const std::scoped_lock lock(finding_->clock_mutex);
    const auto known = finding_->clock_maps.find(sitting);
    if (known != finding_->clock_maps.end())
        return known->second;
    const std::vector<ClockPair> pairs = clock_pairs(sitting);
    return finding_->clock_maps[sitting] =
               pairs.empty() ? std::nullopt : std::optional<ClockMap>(ClockMap(pairs));
}

void SessionRecord::make_ready_to_find() { finding_ = std::make_shared<FindingEvents>(); }

void SessionRecord::read_sitting(int sitting, const std::function<void(std::int64_t, TrackerTime)>& begin,
                                 const std::function<void(std::span<const GazeSample>, bool)>& take) const {
    std::vector<TrackerTime> starts; // of the tracker's own recordings
    const auto note_starts = [&](std::int64_t trial_id) {
        read_gaze_events_of(trial_id, [&](const GazeEvent& event) {
            if (event.kind == GazeEvent::Kind::started)
                starts.push_back(event.start);
        });
    };
    for (const TrialRecord& trial : trials_)
        if (trial.sitting == sitting)
            for (const std::int64_t id : {trial.id, after_trial(trial.id)})
                note_starts(id);
    auto next_start = starts.begin();
    std::optional<TrackerTime> last;
    const auto read = [&](std::int64_t trial_id) {
        bool is_first = true;
        read_samples_of(trial_id, samples_at_once, [&](std::span<const GazeSample> samples) {
            if (is_first) {
                // Where the tracker's clock went back, what was open is ended before its next trial begins.
                if (last && samples.front().sampled_at < *last)
                    take({}, true);
                begin(trial_id, samples.front().sampled_at);
            }
            is_first = false;
            std::size_t from = 0;
            for (std::size_t i = 0; i < samples.size(); ++i) {
                const TrackerTime at = samples[i].sampled_at;
                bool begins = false;
                for (; next_start != starts.end() && *next_start <= at; ++next_start)
                    begins |= last && *next_start > *last;
                if (begins) {
                    take(samples.subspan(from, i - from), false);
                    take({}, true);
                    from = i;
                }
                last = at;
            }
            take(samples.subspan(from), false);
        });
    };
    for (const TrialRecord& trial : trials_)
        if (trial.sitting == sitting)
            for (const std::int64_t id : {trial.id, after_trial(trial.id)})
                read(id);
}

const SessionRecord::FoundEvents& SessionRecord::found_events(int sitting, bool with_events) const {
    const std::scoped_lock lock(finding_->mutex);
    auto known = finding_->found.find(sitting);
    if (known == finding_->found.end()) {
        FoundEvents found;
        const std::optional<EventDetection> noted = reading_session(file_, [&] {
            return has_table(database(), "event_detection") ? read_event_detection(database(), sitting)
                                                            : std::nullopt;
        });
        const std::optional<EventSettings> as_noted = noted ? settings_of(*noted) : std::nullopt;
        if (as_noted && !finding_->everywhere) {
            found.settings = *as_noted;
            found.detection = {noted->name, event_detector_version, noted->parameters};
        } else {
            const RecordingThresholds thresholds = thresholds_for(
                [&](const TakeGaze& take) {
                    read_sitting(
                        sitting, [](std::int64_t, TrackerTime) {}, take);
                },
                *gaze_angles(sitting), finding_->everywhere.value_or(ChosenThresholds{}));
            found.settings = thresholds.settings;
            found.detection = detection_by(thresholds.settings, thresholds.measured);
        }
        known = finding_->found.emplace(sitting, std::move(found)).first;
    }
    FoundEvents& found = known->second;
    if (with_events && !found.are_found) {
        EventsByTrial by_trial(found.by_trial);
        find_events(
            [&](const TakeGaze& take) {
                read_sitting(
                    sitting, [&](std::int64_t id, TrackerTime first) { by_trial.begin(id, first); }, take);
            },
            *gaze_angles(sitting), found.settings, by_trial);
        found.are_found = true;
    }
    return found;
}

bool SessionRecord::is_found_now(int sitting) const {
    return event_origin(sitting).from == EventOrigin::From::reading;
}

void SessionRecord::read_gaze_events_in(int sitting, std::int64_t trial_id,
                                        const std::function<void(const GazeEvent&)>& take) const {
    if (!is_found_now(sitting))
        return read_gaze_events_of(trial_id, take);
    read_gaze_events_of(trial_id, [&](const GazeEvent& event) {
        if (!is_eye_event(event.kind))
            take(event);
    });
    const FoundEvents& found = found_events(sitting, true);
    if (const auto events = found.by_trial.find(trial_id); events != found.by_trial.end())
        for (const GazeEvent& event : events->second)
            take(event);
}

void SessionRecord::read_gaze_events(const TrialRecord& trial,
                                     const std::function<void(const GazeEvent&)>& take) const {
    read_gaze_events_in(trial.sitting, trial.id, take);
}

void SessionRecord::read_gaze_events_of(std::int64_t trial_id,
                                        const std::function<void(const GazeEvent&)>& take) const {
    reading_session(file_, [&] {
        if (has_table(database(), "gaze_event"))
            overt::read_gaze_events(database(), trial_id, take);
    });
}

void SessionRecord::read_gaze_events_before(const std::function<void(const GazeEvent&)>& take) const {
    // They are of the sitting whose gaze was imported, the only one that has such.
    const auto imported = std::ranges::find_if(
        trials_, [&](const TrialRecord& trial) { return gaze_source(trial.sitting).has_value(); });
    read_gaze_events_in(imported == trials_.end() ? 0 : imported->sitting, 0, take);
}

void SessionRecord::read_gaze_events_after(const TrialRecord& trial,
                                           const std::function<void(const GazeEvent&)>& take) const {
    read_gaze_events_in(trial.sitting, after_trial(trial.id), take);
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
    const bool is_imported = gaze_source(sitting).has_value(), is_foreign = import_source(*this).has_value();
    const auto has_rows = [&](const char* sql) {
        Query row(database(), sql);
        row.bind(1, sitting);
        return row.step() && row.integer() != 0;
    };
    const EventOrigin on_record = reading_session(file_, [&]() -> EventOrigin {
        const bool has_samples =
            has_rows("SELECT EXISTS (SELECT * FROM sample JOIN trial USING (trial_id) WHERE sitting = ?)");
        if (finding_->everywhere && has_samples)
            return {From::reading, {}};
        if (has_table(database(), "event_detection"))
            if (const auto detection = read_event_detection(database(), sitting))
                return {is_imported || is_foreign ? From::reading : From::recording, *detection};
        if (has_table(database(), "gaze_event") &&
            has_rows("SELECT EXISTS (SELECT * FROM gaze_event JOIN trial USING (trial_id) WHERE sitting = ? "
                     "AND kind IN ('fixation', 'saccade', 'blink'))"))
            return {From::tracker, {}};
        return {has_samples && (!is_imported || finding_->in_imports) ? From::reading : From::nobody, {}};
    });
    if (on_record.from != From::reading)
        return on_record;
    if (!gaze_angles(sitting))
        return {From::no_angles, {}};
    const FoundEvents& found = found_events(sitting, false);
    return {From::reading, found.detection, found.settings};
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
