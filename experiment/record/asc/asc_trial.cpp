#include "experiment/record/asc/asc_trial.h"

#include <algorithm>
#include <tuple>

#include <fmt/format.h>

namespace overt {
namespace {

using Kind = GazeEvent::Kind;

std::string text_at(const auto& list, int index, std::string_view what) {
    return fmt::format("{}={}", what, list[static_cast<std::size_t>(index)].id);
}

} // namespace

bool AscTrial::has(std::string_view word) const {
    return std::any_of(lines_.begin(), lines_.end(), [&](const Line& line) {
        return line.event.kind == Kind::message && line.event.text.starts_with(word);
    });
}

int AscTrial::count(Kind kind) const {
    return static_cast<int>(std::count_if(lines_.begin(), lines_.end(),
                                          [&](const Line& line) { return line.event.kind == kind; }));
}

void AscTrial::add_message(std::int64_t ms, int recording, std::string text) {
    Line line{ms, recording, false, false, {}};
    line.event.text = std::move(text);
    lines_.push_back(std::move(line));
}

void AscTrial::add_kept(const SessionRecord& record, const TrialRecord& trial) {
    int recording = 0;
    record.read_gaze_events(trial, [&](const GazeEvent& event) {
        recording += event.kind == Kind::started;
        if (is_eye_event(event.kind)) {
            lines_.push_back({asc_milliseconds(event.start), recording, false, true, event});
            lines_.push_back({asc_milliseconds(event.end), recording, true, false, event});
        } else {
            lines_.push_back(
                {asc_milliseconds(event.start), recording, event.kind == Kind::ended, false, event});
        }
    });
}

/// pymovements takes the screen's size for that of the last RECCFG, and fails if there was none.
void AscTrial::add_setup(std::int64_t first, glm::ivec2 screen_px, const AscLayout& layout) {
    const auto coordinates = std::find_if(lines_.begin(), lines_.end(), [](const Line& line) {
        return line.event.kind == Kind::message && line.event.text.starts_with("GAZE_COORDS");
    });
    const bool has_coordinates = coordinates != lines_.end();
    if (!has("RECCFG")) {
        Line setup{first, 0, false, false, {}};
        setup.event.text = fmt::format("RECCFG CR {:.0f} 2 1 {}", layout.rate_hz, layout.eyes());
        if (has_coordinates) {
            setup.ms = coordinates->ms;
            setup.recording = coordinates->recording;
        }
        lines_.insert(coordinates, std::move(setup));
        if (!has("ELCLCFG"))
            add_message(first, 0, layout.eyes() == "LR" ? "ELCLCFG BTABLER" : "ELCLCFG MTABLER");
    }
    if (!has_coordinates)
        add_message(first, 0,
                    fmt::format("GAZE_COORDS 0.00 0.00 {}.00 {}.00", screen_px.x - 1, screen_px.y - 1));
}

/// A trial's first samples may be of a recording that began with a trial before, or in a file without START.
void AscTrial::begin_recording(std::int64_t first, const AscLayout& layout) {
    const auto kept = std::find_if(lines_.begin(), lines_.end(),
                                   [](const Line& line) { return line.event.kind == Kind::started; });
    if (kept != lines_.end() && kept->ms <= first)
        return;
    // Eye events lie in the recording, from its very first sample on.
    for (Line& line : lines_)
        line.recording += line.recording > 0 || line.ms > first || is_eye_event(line.event.kind);
    Line start{first, 1, false, false, {}};
    start.event.kind = Kind::started;
    lines_.push_back(start);
    if (!has("!MODE"))
        add_message(first, 1, fmt::format("!MODE RECORD CR {:.0f} 2 1 {}", layout.rate_hz, layout.eyes()));
}

/// Readers pair each START with an END; eyelinker fails on two ENDs after one START.
void AscTrial::end_recordings(std::int64_t after_last) {
    const int recordings = count(Kind::started);
    for (int recording = 1; recording <= recordings; ++recording) {
        const auto is_of = [&](const Line& line) { return line.recording == recording; };
        if (std::any_of(lines_.begin(), lines_.end(),
                        [&](const Line& line) { return is_of(line) && line.event.kind == Kind::ended; }))
            continue;
        const auto next = std::find_if(lines_.begin(), lines_.end(), [&](const Line& line) {
            return line.recording == recording + 1 && line.event.kind == Kind::started;
        });
        Line end{after_last, recording, true, false, {}};
        if (next != lines_.end()) {
            end.ms = next->ms;
            end.after_samples = false;
        } else {
            for (const Line& line : lines_)
                end.ms = is_of(line) ? std::max(end.ms, line.ms) : end.ms;
        }
        end.event.kind = Kind::ended;
        lines_.push_back(end);
    }
}

void AscTrial::add_condition(const SessionRecord& record, const TrialRecord& trial, std::int64_t ms,
                             int recording) {
    const SessionHeader& header = record.header();
    const std::string task = text_at(header.tasks, trial.trial.task, "task"),
                      sculpture = text_at(header.sculptures, trial.trial.condition.sculpture, "sculpture"),
                      material = text_at(header.materials, trial.trial.condition.material, "material");
    add_message(ms, recording,
                fmt::format("CONDITION trial={} {} {} {} attempt={}", trial.trial.index + 1, task, sculpture,
                            material, trial.attempt));
    for (const std::string& variable : {task, sculpture, material}) {
        const std::size_t sign = variable.find('=');
        add_message(ms, recording,
                    fmt::format("!V TRIAL_VAR {} {}", variable.substr(0, sign), variable.substr(sign + 1)));
    }
}

void AscTrial::add_missing(const SessionRecord& record, const TrialRecord& trial,
                           const std::optional<ClockMap>& clock_map, const AscLayout& layout) {
    const SessionHeader& header = record.header();
    const TrialOutcome& outcome = trial.outcome;
    const auto span = record.sample_span(trial);
    if (!clock_map && !span && lines_.empty())
        return; // nothing says when it was
    const std::int64_t first = span              ? asc_milliseconds(span->first)
                               : !lines_.empty() ? lines_.front().ms
                                                 : asc_milliseconds(clock_map->to_other(trial.started));
    const bool was_presented = !header.stimuli.empty();
    const auto at = [&](SessionTime time) { return asc_milliseconds(clock_map->to_other(time)); };
    // A screen that the attempt did not get to has no time.
    const auto add_screen = [&](std::string_view word, SessionTime time, int recording) {
        if (was_presented && clock_map && time > trial.started && trial.has_outcome() && !has(word))
            add_message(at(time), recording, std::string(word));
    };

    if (span)
        begin_recording(first, layout);
    const auto interval_ms = std::max<std::int64_t>(1, static_cast<std::int64_t>(1000.0 / layout.rate_hz));
    end_recordings(span ? asc_milliseconds(span->second) + interval_ms : first);
    if (!has("TRIALID"))
        add_message(was_presented && clock_map ? std::min(at(trial.started), first) : first, 0,
                    fmt::format("TRIALID {}", trial.trial.index + 1));
    add_screen(task_screen_message, outcome.task_screen_onset, 0);
    if (span)
        add_setup(first, header.display.screen.screen_px, layout);
    // In the recording, for MNE and eyelinker leave out what stands before START and after END.
    if (was_presented && !has("CONDITION"))
        add_condition(record, trial, first, count(Kind::started) > 0 ? 1 : 0);
    add_screen(onset_message, outcome.presentation_onset, 1);
    add_screen(end_message, outcome.presentation_end, 1);
    add_screen(response_screen_message, outcome.response_screen_onset, 1);
    add_screen(response_message, outcome.responded_at, 1);
    if (was_presented && !has("TRIAL_RESULT")) {
        std::int64_t last = first;
        for (const Line& line : lines_)
            last = std::max(last, line.ms);
        add_message(last + 1, 1,
                    trial.counts          ? "TRIAL_RESULT 0"
                    : trial.is_superseded ? "TRIAL_RESULT superseded"
                                          : fmt::format("TRIAL_RESULT {}", name_of(trial.status)));
    }
}

AscTrial::AscTrial(const SessionRecord& record, const TrialRecord& trial,
                   const std::optional<ClockMap>& clock_map, const AscLayout& layout) {
    add_kept(record, trial);
    add_missing(record, trial, clock_map, layout);
    std::stable_sort(lines_.begin(), lines_.end(), [](const Line& a, const Line& b) {
        return std::tuple(a.recording, a.ms, a.after_samples, a.begins_an_event) <
               std::tuple(b.recording, b.ms, b.after_samples, b.begins_an_event);
    });
}

void AscTrial::write(AscWriter& writer, const Line& line) {
    switch (line.event.kind) {
    case Kind::fixation:
    case Kind::saccade:
    case Kind::blink:
        return line.begins_an_event ? writer.event_begin(line.event) : writer.event_end(line.event);
    case Kind::message:
        return writer.message(line.ms, line.event.text);
    case Kind::button:
    case Kind::input:
        return writer.port(line.event);
    case Kind::started:
        return writer.start(line.ms, line.event.text);
    case Kind::ended:
        return writer.end(line.ms, line.event.text);
    case Kind::note:
        return writer.note(line.event.text);
    }
}

void AscTrial::write_until(AscWriter& writer, std::span<const GazeSample> instant) {
    const std::int64_t ms = asc_milliseconds(instant.front().sampled_at);
    while (written_ < lines_.size()) {
        Line& line = lines_[written_];
        if (line.ms > ms || (line.ms == ms && line.after_samples))
            return;
        // The file's START may name fewer eyes than its samples have; one that was added names none.
        if (line.event.kind == Kind::started) {
            if (line.event.text.empty())
                line.event.text = writer.layout().eye_names();
            for (const GazeSample& sample : instant)
                line.event.text += sample.eye == Eye::left ? " LEFT" : " RIGHT";
        }
        write(writer, line);
        ++written_;
    }
}

void AscTrial::finish(AscWriter& writer) {
    while (written_ < lines_.size())
        write(writer, lines_[written_++]);
}

std::vector<std::pair<std::string_view, SessionTime>> screens_of(const TrialRecord& attempt) {
    const TrialOutcome& outcome = attempt.outcome;
    std::vector<std::pair<std::string_view, SessionTime>> screens{
        {task_screen_message, outcome.task_screen_onset},
        {onset_message, outcome.presentation_onset},
        {end_message, outcome.presentation_end},
        {response_screen_message, outcome.response_screen_onset},
        {response_message, outcome.responded_at}};
    // Screens that an attempt did not get to have no time.
    std::erase_if(screens, [&](const auto& screen) {
        return !attempt.has_outcome() || screen.second <= attempt.started;
    });
    return screens;
}

} // namespace overt
