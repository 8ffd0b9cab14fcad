#include "experiment/record/asc/asc_trial.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <tuple>

#include <fmt/format.h>

#include "experiment/base/utf8_text.h"
#include "experiment/factors.h"
#include "experiment/record/asc/asc_survey.h"
#include "experiment/record/asc/asc_words.h"
#include "experiment/record/preview_file.h"
#include "experiment/record/tables/shared_columns.h"

namespace overt {
namespace {

using Kind = GazeEvent::Kind;

/// What a trial is of, as names and values. Of what further slots show the names begin with the slot's:
/// "right.object".
std::vector<std::pair<std::string, std::string>> variables_of(const SessionHeader& header,
                                                              const Trial& trial) {
    const auto id = [](const auto& list, int index) { return list[static_cast<std::size_t>(index)].id; };
    std::vector<std::pair<std::string, std::string>> variables{{"task", id(header.tasks, trial.task)}};
    for (const StimulusColumn& column : stimulus_columns_of(header))
        variables.emplace_back(column.what.name, column.level_of(trial.stimulus).name);
    if (!trial.beside.empty())
        variables.emplace_back("slot", id(header.slots, trial.slot));
    for (const auto& [stimulus, slot] : trial.beside)
        for (const StimulusColumn& column : stimulus_columns_of(header))
            variables.emplace_back(id(header.slots, slot) + "." + column.what.name,
                                   column.level_of(stimulus).name);
    for (const TrialLevel& of : trial.levels)
        variables.emplace_back(of.factor, of.level);
    if (!trial.correct.empty())
        variables.emplace_back(correct_answer, trial.correct);
    if (trial.role != TrialRole::trial)
        variables.emplace_back("role", name_of(trial.role));
    return variables;
}

/// A message of an interest area, and when it is sent; nothing: it holds for all the trial.
struct AreaMessage {
    std::optional<SessionTime> at;
    std::string text;
};

/// The slots of a trial that shows several stimuli, as the interest areas of EyeLink Data Viewer: number,
/// left, top, right, bottom, name. Before it from when until when, in milliseconds after the message, the
/// latter with a minus sign: once for each step that lights the slot. Of sessions whose trials have no steps
/// they hold all the trial; of an attempt that was cut off nobody knows when its slots were lit.
std::vector<AreaMessage> interest_areas(const SessionHeader& header, const TrialRecord& trial) {
    std::vector<AreaMessage> messages;
    for (std::size_t i = 0; i < trial.trial.shown_count() && !trial.trial.beside.empty(); ++i) {
        const RecordedSlot& slot = header.slots[static_cast<std::size_t>(trial.trial.shown(i).slot)];
        const glm::ivec2 end = slot.origin_px + slot.size_px;
        const std::string box = fmt::format("RECTANGLE {} {} {} {} {} {}", i + 1, slot.origin_px.x,
                                            slot.origin_px.y, end.x, end.y, slot.id);
        const bool has_steps = std::ranges::any_of(
            trial.outcome.steps, [](const AttemptStep& step) { return step.kind == "show"; });
        if (!has_steps && trial.has_outcome())
            messages.push_back({{}, "!V IAREA " + box});
        for (const auto& [from, until] : trial.seen_in(i).lit_spans())
            if (const long ms = std::lround(1e3 * to_seconds(until - from)); ms > 0)
                messages.push_back({from, fmt::format("!V IAREA 0 -{} {}", ms, box)});
    }
    return messages;
}

std::vector<GazeEvent> events_of(const SessionRecord& record, const TrialRecord& trial) {
    std::vector<GazeEvent> events;
    record.read_gaze_events(trial, [&](const GazeEvent& event) { events.push_back(event); });
    return events;
}

} // namespace

TrackerTime AscTrial::rounded(TrackerTime at) const {
    return layout_.fractional_times ? at : TrackerTime(std::chrono::milliseconds(asc_milliseconds(at)));
}

AscTrial::Line AscTrial::line_of(GazeEvent event, bool begins_an_event) const {
    const bool ends = event.kind == Kind::ended || (is_eye_event(event.kind) && !begins_an_event);
    const TrackerTime at = is_eye_event(event.kind) && !begins_an_event ? event.end : event.start;
    return {{rounded(at), ends, begins_an_event}, at, begins_an_event, std::move(event)};
}

AscTrial::Line AscTrial::message_at(TrackerTime at, std::string text) const {
    GazeEvent event;
    event.start = event.end = at;
    event.text = std::move(text);
    return line_of(std::move(event));
}

TrackerTime AscTrial::latest(TrackerTime at) const {
    for (const Line& line : lines_)
        at = std::max(at, line.at);
    return at;
}

bool AscTrial::has(std::string_view word) const {
    return std::any_of(lines_.begin(), lines_.end(), [&](const Line& line) {
        return line.event.kind == Kind::message && Words(line.event.text).next() == word;
    });
}

std::optional<TrackerTime> AscTrial::last() const {
    return lines_.empty() ? std::nullopt : std::optional(rounded(latest(lines_.front().at)));
}

/// No line stands among samples that are later than a line after it: the file's order is kept.
void AscTrial::settle_places() {
    for (std::size_t i = lines_.size(); i-- > 1;)
        lines_[i - 1].place = std::min(lines_[i - 1].place, lines_[i].place);
}

/// The lines in the order in which the file had them, and a begin for each fixation, saccade and blink,
/// before the first line that is later.
void AscTrial::keep(std::vector<GazeEvent> events) {
    for (GazeEvent& event : events)
        lines_.push_back(line_of(std::move(event)));
    settle_places();
    struct Begin {
        std::size_t before;
        Line line;
    };
    std::vector<Begin> begins;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
        if (!is_eye_event(lines_[i].event.kind))
            continue;
        Line begin = line_of(lines_[i].event, true);
        const auto end = lines_.begin() + static_cast<std::ptrdiff_t>(i);
        const auto later =
            std::upper_bound(lines_.begin(), end, begin.place,
                             [](const Place& place, const Line& line) { return place < line.place; });
        begins.push_back({static_cast<std::size_t>(later - lines_.begin()), std::move(begin)});
    }
    // A blink lies in a saccade.
    std::stable_sort(begins.begin(), begins.end(), [](const Begin& a, const Begin& b) {
        const auto key = [](const Begin& begin) {
            return std::tuple(begin.before, begin.line.at, begin.line.event.kind != Kind::saccade);
        };
        return key(a) < key(b);
    });
    std::vector<Line> merged;
    merged.reserve(lines_.size() + begins.size());
    auto begin = begins.begin();
    for (std::size_t i = 0; i < lines_.size(); ++i) {
        for (; begin != begins.end() && begin->before <= i; ++begin)
            merged.push_back(std::move(begin->line));
        merged.push_back(std::move(lines_[i]));
    }
    lines_ = std::move(merged);
    settle_places();
}

/// In the last recording where there is one, for MNE and eyelinker leave out what stands outside of START and
/// END.
void AscTrial::insert(Line line) {
    const auto of = [](Kind kind) { return [kind](const Line& other) { return other.event.kind == kind; }; };
    const auto started = std::find_if(lines_.begin(), lines_.end(), of(Kind::started));
    const auto ended = std::find_if(lines_.rbegin(), lines_.rend(), of(Kind::ended));
    const auto from = started == lines_.end() ? lines_.begin() : started + 1;
    const auto to = ended == lines_.rend() || ended.base() - 1 < from ? lines_.end() : ended.base() - 1;
    lines_.insert(std::upper_bound(from, to, line.place,
                                   [](const Place& place, const Line& other) { return place < other.place; }),
                  std::move(line));
    settle_places();
}

/// As keep() above, but for those that no file had.
void AscTrial::keep(std::vector<GazeEvent> events, const SessionRecord::EventOrigin& origin) {
    std::vector<GazeEvent> detected;
    if (origin.from == SessionRecord::EventOrigin::From::reading) {
        const auto of_file = std::stable_partition(
            events.begin(), events.end(), [](const GazeEvent& event) { return !is_eye_event(event.kind); });
        detected.assign(of_file, events.end());
        events.erase(of_file, events.end());
    }
    keep(std::move(events));
    insert_detected(std::move(detected));
}

/// Fixations, saccades and blinks that no file had, by their times; a blink lies in a saccade.
void AscTrial::insert_detected(std::vector<GazeEvent> events) {
    std::stable_sort(events.begin(), events.end(), [](const GazeEvent& a, const GazeEvent& b) {
        return std::pair(a.start, a.kind != Kind::saccade) < std::pair(b.start, b.kind != Kind::saccade);
    });
    for (const GazeEvent& event : events)
        insert(line_of(event, true));
    std::stable_sort(events.begin(), events.end(),
                     [](const GazeEvent& a, const GazeEvent& b) { return a.end < b.end; });
    for (const GazeEvent& event : events)
        insert(line_of(event));
}

/// What the program took down of a tracker besides, such as a loss of data: as messages, for a line without a
/// time is none of this format.
void AscTrial::insert_told(std::vector<GazeEvent> events) {
    for (GazeEvent& event : events) {
        if (event.kind == Kind::note)
            event.kind = Kind::message;
        insert(line_of(std::move(event)));
    }
}

std::vector<std::pair<std::string_view, SessionTime>> screens_of(const TrialRecord& attempt) {
    const TrialOutcome& outcome = attempt.outcome;
    std::vector<std::pair<std::string_view, SessionTime>> screens{
        {task_screen_message, outcome.task_screen_onset},
        {onset_message, outcome.presentation_onset},
        {end_message, outcome.presentation_end},
        {response_screen_message, outcome.response_screen_onset},
        {response_message, outcome.responded_at}};
    std::erase_if(screens, [&](const auto& screen) { return !attempt.reached(screen.second); });
    return screens;
}

namespace {

/// The messages that say what a trial is of.
std::vector<std::string> condition_texts(const SessionHeader& header, const TrialRecord& trial) {
    std::vector<std::string> texts{fmt::format("CONDITION trial={}", trial.trial.index + 1)};
    for (const auto& [name, value] : variables_of(header, trial.trial)) {
        texts.front() += fmt::format(" {}={}", name, value);
        texts.push_back(fmt::format("!V TRIAL_VAR {} {}", name, value));
    }
    texts.front() += fmt::format(" attempt={}", trial.attempt);
    if (const RecordedStimulus* const stimulus = stimulus_of(header, header.in_slot(trial.trial.shown(0))))
        texts.push_back(fmt::format("!V TRIAL_VAR frames {}", ascii_of(stimulus->source)));
    for (AreaMessage& area : interest_areas(header, trial))
        if (!area.at)
            texts.push_back(std::move(area.text));
    return texts;
}

std::string result_text(const TrialRecord& trial) {
    return trial.counts          ? "TRIAL_RESULT 0"
           : trial.is_superseded ? "TRIAL_RESULT superseded"
                                 : fmt::format("TRIAL_RESULT {}", name_of(trial.status));
}

/// What was answered, and how long after the response screen; empty if nothing was.
std::string answer_text(const TrialRecord& trial) {
    const TrialOutcome& outcome = trial.outcome;
    if (!trial.reached(outcome.responded_at) || !trial.reached(outcome.response_screen_onset))
        return {};
    const double ms = 1e3 * to_seconds(outcome.responded_at - outcome.response_screen_onset);
    return fmt::format("ANSWER response_time_ms={:.3f}{}", ms,
                       outcome.answer.empty() ? "" : " answer=" + outcome.answer);
}

/// When the attempt after this one begins, of the same sitting.
std::optional<SessionTime> next_begin(const SessionRecord& record, const TrialRecord& trial) {
    std::optional<SessionTime> begin;
    for (const TrialRecord& other : record.trials())
        if (other.sitting == trial.sitting && other.id > trial.id && (!begin || other.started < *begin))
            begin = other.started;
    return begin;
}

/// How an attempt ended, and what was answered, for a reader who has a row for each attempt.
std::vector<std::pair<std::string, std::string>> outcomes_of(const TrialRecord& trial) {
    std::vector<std::pair<std::string, std::string>> outcomes{{"attempt", fmt::format("{}", trial.attempt)},
                                                              {"status", std::string(name_of(trial.status))},
                                                              {"counts", trial.counts ? "yes" : "no"}};
    const TrialOutcome& outcome = trial.outcome;
    if (trial.reached(outcome.responded_at) && trial.reached(outcome.response_screen_onset))
        outcomes.emplace_back(
            "response_time_ms",
            fmt::format("{:.3f}", 1e3 * to_seconds(outcome.responded_at - outcome.response_screen_onset)));
    if (!outcome.answer.empty())
        outcomes.emplace_back("answer", outcome.answer);
    for (auto& [name, value] : answer_variables(outcome.given))
        outcomes.emplace_back(std::move(name), ascii_of(value));
    return outcomes;
}

} // namespace

/// A trial that the session recorded itself.
void AscTrial::write_down(const SessionRecord& record, const TrialRecord& trial,
                          const std::optional<ClockMap>& clock_map, std::optional<TrackerTime> after) {
    const auto span = record.sample_span(trial);
    if (!clock_map && !span)
        return; // nothing says when it was
    const SessionHeader& header = record.header();
    const auto at = [&](SessionTime time) { return clock_map->to_other(time); };
    const TrackerTime first = span ? span->first : at(trial.started);
    const auto add = [&](TrackerTime time, std::string text) {
        lines_.push_back(message_at(time, std::move(text)));
    };
    if (clock_map)
        for (const auto& [word, screen] : screens_of(trial))
            add(at(screen), std::string(word));
    if (clock_map)
        for (const AttemptStep* const step : further_steps(trial))
            add(at(*step->begin),
                fmt::format("STEP {}{}{}", step->kind, step->id.empty() ? "" : " ", step->id));
    if (clock_map)
        for (const AreaMessage& area : interest_areas(header, trial))
            if (area.at)
                add(at(*area.at), area.text);
    if (span) {
        if (const std::string answer = answer_text(trial); !answer.empty())
            add(span->second, answer);
        for (const auto& [name, value] : answer_variables(trial.outcome.given))
            add(span->second, fmt::format("!V TRIAL_VAR {} {}", name, ascii_of(value)));
    }
    // Of response boxes there are lines BUTTON.
    if (clock_map)
        for (const RecordedKeyPress& press : record.key_presses())
            if (press.attempt_id == trial.id && !is_of_box(press))
                add(at(press.at), "KEY " + press.name);
    if (clock_map)
        for (const RecordedButton& button : record.button_changes())
            if (button.attempt_id == trial.id) {
                GazeEvent event;
                event.kind = Kind::button;
                event.start = event.end = at(button.at);
                event.text = fmt::format("{} {}", button.button, button.is_down ? 1 : 0);
                lines_.push_back(line_of(std::move(event)));
            }
    std::stable_sort(lines_.begin(), lines_.end(),
                     [](const Line& a, const Line& b) { return a.place < b.place; });

    // Before START what came before the first sample, and within START and END all the rest, even what came
    // when the tracker had stopped, for readers leave out what stands outside.
    constexpr auto step = std::chrono::milliseconds(1);
    TrackerTime begin = clock_map ? std::min(at(trial.started), first) : first;
    if (after && rounded(begin) <= *after)
        begin = *after + step;
    std::vector<Line> before{message_at(begin, fmt::format("TRIALID {}", trial.trial.index + 1))};
    std::vector<Line> within;
    for (Line& line : lines_)
        (span && line.place.at >= rounded(first) ? within : before).push_back(std::move(line));
    lines_ = std::move(before);
    if (span) {
        add(first, fmt::format("RECCFG CR {:.0f} 2 1 {}", layout_.rate_hz, layout_.eyes()));
        add(first, layout_.eyes() == "LR" ? "ELCLCFG BTABLER" : "ELCLCFG MTABLER");
        const glm::ivec2 screen_px = header.display.screen.screen_px;
        add(first, fmt::format("GAZE_COORDS 0.00 0.00 {}.00 {}.00", screen_px.x - 1, screen_px.y - 1));
        GazeEvent start;
        start.kind = Kind::started;
        start.start = start.end = first;
        start.text = fmt::format(
            "{}{}", layout_.has_left ? (layout_.has_right ? "LEFT RIGHT" : "LEFT") : "RIGHT", usual_tracking);
        lines_.push_back(line_of(std::move(start)));
        add(first, fmt::format("!MODE RECORD CR {:.0f} 2 1 {}", layout_.rate_hz, layout_.eyes()));
    }
    for (const std::string& text : condition_texts(header, trial))
        add(first, text);
    for (Line& line : within)
        lines_.push_back(std::move(line));
    if (span) {
        const auto interval_us = static_cast<std::int64_t>(1e6 / layout_.rate_hz);
        GazeEvent end;
        end.kind = Kind::ended;
        end.start = end.end =
            rounded(span->second) + std::max(TrackerClock::duration(std::chrono::milliseconds(1)),
                                             TrackerClock::duration(interval_us));
        lines_.push_back(line_of(std::move(end)));
    }
    // Before the next attempt begins, if that leaves time.
    TrackerTime result = latest(first) + step;
    if (const auto next = clock_map ? next_begin(record, trial) : std::nullopt)
        result = std::min(result, std::max(latest(first), at(*next) - step));
    add(result, result_text(trial));
    settle_places();
}

/// What a file whose gaze became that of a trial does not say of it.
void AscTrial::add_missing(const SessionRecord& record, const TrialRecord& trial,
                           const std::optional<ClockMap>& clock_map) {
    const SessionHeader& header = record.header();
    const auto span = record.sample_span(trial);
    if (!span && lines_.empty())
        return;
    const TrackerTime first =
        span && (lines_.empty() || span->first < lines_.front().at) ? span->first : lines_.front().at;
    const bool is_named =
        std::any_of(lines_.begin(), lines_.end(), [](const Line& line) { return is_trial_id(line.event); });
    if (!is_named) {
        lines_.insert(lines_.begin(), message_at(first, fmt::format("TRIALID {}", trial.trial.index + 1)));
        settle_places();
    }
    if (header.stimuli.empty())
        return; // of a recording made elsewhere, which says itself what was shown
    const bool says_conditions = has("CONDITION");
    if (!says_conditions)
        for (const std::string& text : condition_texts(header, trial))
            insert(message_at(span ? span->first : first, text));
    if (clock_map)
        for (const auto& [word, screen] : screens_of(trial))
            if (!has(word) && !(word == end_message && has(earlier_end_message)))
                insert(message_at(clock_map->to_other(screen), std::string(word)));
    if (clock_map && !says_conditions)
        for (const AreaMessage& area : interest_areas(header, trial))
            if (area.at)
                insert(message_at(clock_map->to_other(*area.at), area.text));
    if (!has("TRIAL_RESULT"))
        lines_.push_back(message_at(latest(span ? span->second : first) + std::chrono::milliseconds(1),
                                    result_text(trial)));
}

/// The parser of OpenSesame's users knows a trial by start_trial and end_trial, and cuts samples by phases.
void AscTrial::frame_for_opensesame(const SessionRecord& record, const TrialRecord& trial) {
    if (lines_.empty() || has("start_trial"))
        return;
    const auto named =
        std::find_if(lines_.begin(), lines_.end(), [](const Line& line) { return is_trial_id(line.event); });
    const TrackerTime begin = named == lines_.end() ? lines_.front().at : named->at;
    std::vector<Line> first{message_at(begin, fmt::format("start_trial {}", trial.trial.index + 1))};
    if (!record.header().stimuli.empty())
        for (const auto& [name, value] : variables_of(record.header(), trial.trial))
            first.push_back(message_at(begin, fmt::format("var {} {}", name, value)));
    lines_.insert(named == lines_.end() ? lines_.begin() : named + 1, first.begin(), first.end());
    for (const auto& [word, phase] : {std::pair{onset_message, "start_phase presentation"},
                                      std::pair{end_message, "end_phase presentation"}}) {
        const auto found = std::find_if(lines_.begin(), lines_.end(), [word = word](const Line& line) {
            return line.event.kind == Kind::message && Words(line.event.text).next() == word;
        });
        if (found != lines_.end())
            lines_.insert(found + 1, message_at(found->at, phase));
    }
    const TrackerTime end = latest(begin);
    if (!record.header().stimuli.empty())
        for (const auto& [name, value] : outcomes_of(trial))
            lines_.push_back(message_at(end, fmt::format("var {} {}", name, value)));
    lines_.push_back(message_at(end, "end_trial"));
    settle_places();
}

AscTrial::AscTrial(const SessionRecord& record, const TrialRecord& trial,
                   const std::optional<ClockMap>& clock_map, const AscLayout& layout, Messages messages,
                   std::optional<TrackerTime> after)
    : layout_(layout) {
    if (record.gaze_source(trial.sitting)) {
        keep(events_of(record, trial), record.event_origin(trial.sitting));
        add_missing(record, trial, clock_map);
    } else {
        write_down(record, trial, clock_map, after);
        std::vector<GazeEvent> told = events_of(record, trial), detected;
        const auto of_eye = std::stable_partition(
            told.begin(), told.end(), [](const GazeEvent& event) { return !is_eye_event(event.kind); });
        detected.assign(of_eye, told.end());
        told.erase(of_eye, told.end());
        insert_told(std::move(told));
        insert_detected(std::move(detected));
    }
    if (messages.of_opensesame)
        frame_for_opensesame(record, trial);
}

AscTrial::AscTrial(std::vector<GazeEvent> events, const SessionRecord::EventOrigin& origin,
                   const AscLayout& layout)
    : layout_(layout) {
    keep(std::move(events), origin);
}

namespace {

void write_event(AscRecordings& to, const GazeEvent& event, bool begins_an_event,
                 std::span<const GazeSample> next) {
    switch (event.kind) {
    case Kind::fixation:
    case Kind::saccade:
    case Kind::blink:
        return begins_an_event ? to.writer().event_begin(event) : to.writer().event_end(event);
    case Kind::message:
        return to.message(event.start, event.text);
    case Kind::button:
    case Kind::input:
        return to.writer().port(event);
    case Kind::started:
        return to.start(event.start, event.text, next);
    case Kind::ended:
        return to.end(event.start, event.text);
    case Kind::note:
        return to.writer().note(event.text);
    }
}

} // namespace

void AscTrial::write_until(AscRecordings& to, std::span<const GazeSample> instant) {
    const TrackerTime now = rounded(instant.front().sampled_at);
    for (; written_ < lines_.size(); ++written_) {
        const Line& line = lines_[written_];
        if (line.place.at > now || (line.place.at == now && line.place.after_samples))
            return;
        write_event(to, line.event, line.begins_an_event, instant);
    }
}

void AscTrial::finish(AscRecordings& to) {
    for (; written_ < lines_.size(); ++written_)
        write_event(to, lines_[written_].event, lines_[written_].begins_an_event, {});
}

} // namespace overt
