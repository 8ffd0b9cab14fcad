#include "experiment/record/bids/bids_events.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "experiment/base/error.h"
#include "experiment/base/json_text.h"
#include "experiment/base/plain_text.h"
#include "experiment/record/bids/bids_names.h"
#include "experiment/record/preview_file.h"
#include "experiment/record/tables/attempt_cells.h"
#include "experiment/record/tables/export_tables.h"
#include "experiment/record/tables/table_writer.h"

namespace overt {
namespace {

using Json = nlohmann::ordered_json;
using Levels = std::vector<std::pair<std::string, std::string>>;

constexpr std::string_view presentation_event = "presentation";

/// An attempt at a trial, or a screen that it got to.
struct BidsEvent {
    const TrialRecord* attempt;
    std::string_view what;
    SessionTime from, to; ///< the same where something else ended it
    std::optional<SessionDuration> response_time = {};
    std::string stimulus_file = {};
    const TrialRecord* ended = nullptr;  ///< the attempt, where the event is all of it and it has an outcome
    std::string value = {}, device = {}; ///< of a button or a marker
    const GivenAnswer* given = nullptr;  ///< of a response by keys, the mouse or a box
    operator const TrialRecord&() const { return *attempt; }
};

/// A cell of the attempt's outcome.
auto of_ended(auto of) {
    return [of](const BidsEvent& row) { return of_maybe(row.ended, of); };
}

constexpr int setting_decimals_of_event = 9;

/// Of an answer that was given by keys, the mouse or a box, or missed.
auto of_given(auto of) {
    return [of](const BidsEvent& row) { return of_maybe(row.given, of); };
}

/// What was set with a gauge: an angle of it, which may not be known.
auto of_gauge(auto angle) {
    return [angle](const BidsEvent& row) -> std::optional<Fixed> {
        if (!row.given || !row.given->gauge || row.given->is_missed)
            return std::nullopt;
        const std::optional<Degrees> degrees = angle(*row.given->gauge);
        return degrees ? std::optional(Fixed{degrees->value, angle_decimals}) : std::nullopt;
    };
}
auto true_angle(Degrees Attitude::*angle) {
    return of_gauge([angle](const GaugeAnswer& gauge) {
        return gauge.truth ? std::optional(*gauge.truth.*angle) : std::nullopt;
    });
}

/// What was set to match: a number of the first column, or of the second.
auto of_setting(std::size_t axis, auto number) {
    return [axis, number](const BidsEvent& row) -> std::optional<Fixed> {
        if (!row.given || row.given->settings.size() <= axis)
            return std::nullopt;
        const std::optional<double> value = number(row.given->settings[axis]);
        return value ? std::optional(Fixed{*value, setting_decimals_of_event}) : std::nullopt;
    };
}

/// Of sessions in which something was set to match.
std::vector<RowLayout<BidsEvent>::Column> setting_columns(bool has_second) {
    std::vector<RowLayout<BidsEvent>::Column> columns;
    for (std::size_t axis = 0; axis < (has_second ? 2u : 1u); ++axis) {
        const std::string name = axis == 0 ? "setting" : "second_setting";
        const std::string of = axis == 0 ? "along the first column" : "along the second column";
        columns.push_back(
            {{name, fmt::format("Level that was set to match, {}; n/a: it was not accepted", of)},
             [axis](const BidsEvent& row) {
                 const bool is_given =
                     row.given && !row.given->is_missed && row.given->settings.size() > axis;
                 return Fixed{is_given ? std::optional(row.given->settings[axis].final) : std::nullopt,
                              setting_decimals_of_event};
             }});
        columns.push_back(
            {{name + "_start", fmt::format("Level that it began with, {}", of)},
             of_setting(axis, [](const MatchSetting& set) { return std::optional(set.start); })});
        columns.push_back({{name + "_reference", fmt::format("Level of the stimulus beside it, {}", of)},
                           of_setting(axis, [](const MatchSetting& set) { return set.reference; })});
    }
    return columns;
}

/// Of sessions whose protocols name places on surfaces.
std::vector<RowLayout<BidsEvent>::Column> gauge_columns() {
    const std::string tilt = "direction on the screen in which it leans, from the right counter-clockwise";
    return {
        {{"slant_deg", "Of the normal that was set with a gauge, its angle from the line of sight", "deg"},
         of_gauge([](const GaugeAnswer& gauge) { return std::optional(gauge.set.slant); })},
        {{"tilt_deg", "The " + tilt, "deg"},
         of_gauge([](const GaugeAnswer& gauge) { return std::optional(gauge.set.tilt); })},
        {{"true_slant_deg", "The same angle of the surface's own normal", "deg"},
         true_angle(&Attitude::slant)},
        {{"true_tilt_deg", "Of the surface's own normal, the " + tilt, "deg"}, true_angle(&Attitude::tilt)},
        {{"deviation_deg", "Between both normals", "deg"},
         of_gauge([](const GaugeAnswer& gauge) { return gauge.deviation(); })},
    };
}

/// Of sessions with such answers.
std::vector<RowLayout<BidsEvent>::Column> answer_columns() {
    return {
        {{"response", "What was answered, by its meaning; n/a: missed"},
         of_given([](const GivenAnswer& given) { return given.is_missed ? std::string() : given.value; })},
        {{"response_id",
          "Which answer, as the protocol calls it; of a scale with several items with the item"},
         of_given([](const GivenAnswer& given) {
             return given.item.empty() ? given.id : fmt::format("{}/{}", given.id, given.item);
         })},
        {{"response_key", "The key by which it was given, or accepted"},
         of_given([](const GivenAnswer& given) { return given.key; })},
        {{"response_number", "The answer of a scale, or a number that was typed"},
         of_given([](const GivenAnswer& given) {
             return Fixed{given.number, 6};
         })},
        {{"correct",
          "Whether it was correct",
          "",
          {{"1", "yes"}, {"0", "no"}, {"n/a", "missed, or nothing is correct"}}},
         [](const BidsEvent& row) {
             return row.given && row.given->is_correct ? std::optional(*row.given->is_correct ? 1 : 0)
                                                       : std::nullopt;
         }},
    };
}

/// `header` must outlive it.
RowLayout<BidsEvent> events_layout(const SessionHeader& header, SessionTime zero,
                                   const std::optional<ClockMap>& clock_map, bool has_given_answers,
                                   std::size_t settings) {
    Levels tasks, blocks;
    for (const RecordedTask& task : header.tasks)
        tasks.emplace_back(task.id, task.question.empty() ? task.id : plain_line_of(task.question));
    for (const std::string& block : header.blocks)
        blocks.emplace_back(block, "the block of that name");
    RowLayout<BidsEvent> layout{
        "",
        "",
        {
            {{"onset", "Begin of the event by the session's clock, from the first gaze sample of the run",
              "s"},
             [zero](auto& row) { return row.from - zero; }},
            {{"duration", "Until it gave way; n/a where it was cut off", "s"},
             [](auto& row) { return when(row.to > row.from, row.to - row.from); }},
            {{"trial_type",
              "What it was",
              "",
              {{"trial", "an attempt at a trial, from its begin to the answer"},
               {"question", "the screen with the question"},
               {"presentation", "the stimulus"},
               {"response", "the answer: of a spoken one the screen during it, of others the instant"},
               {"answer", "the screen on which it is answered by keys, the mouse or a box"},
               {"text", "words that are no question"},
               {"fixation", "a target to be looked at"},
               {"blank", "the background alone"},
               {"mask", "noise where the stimulus stands"},
               {"feedback", "words by what was answered"},
               {"drift_check", "the target by which the tracker's drift is measured"},
               {"button", "a button of a response box was pressed"},
               {"key", "a key of a keyboard was pressed"},
               {"marker", "another device was told of an event"}}},
             &BidsEvent::what},
            {{"response_time",
              "Of a spoken answer, from the onset of its screen to its end; of others, from what the "
              "protocol "
              "lets it count from; negative: before that; n/a: missed",
              "s"},
             &BidsEvent::response_time},
            {{"stim_file", "First frame of the stimulus, in the folder stimuli"}, &BidsEvent::stimulus_file},
            {{"tracker_onset",
              "Begin of the event by the tracker's own clock, as the timestamps of the samples; by the line "
              "through the readings of both clocks. The two clocks run apart: onsets are by the session's",
              "us"},
             [clock_map](auto& row) {
                 return of_maybe(clock_map,
                                 [&](auto& map) { return microseconds_of(map.to_other(row.from)); });
             }},
            {{"trial", "Position of the trial in the observer's order, from 1"}, number_of_trial},
            {{"attempt", "Which attempt at this trial, from 1"}, attempt_number},
            {{"status",
              "How the attempt ended",
              "",
              {{"completed", "all of it was done"},
               {"aborted", "broken off, or failed and to come again"},
               {"interrupted", "cut off when the program was killed, and the session went on later"},
               {"open", "cut off when the program was killed"}}},
             attempt_status},
            {{"counts",
              "Whether this is the attempt that counts",
              "",
              {{"yes", "completed"},
               {"no", "not completed, or its block was begun again later: the attempt there counts"}}},
             attempt_counts},
            {{"block", "The block that the trial is of, where there are blocks", "", blocks},
             block_of(header)},
            {{"task", "Which task the trial was of", "", tasks}, task_of(header)},
            {{"question", "The question as it was asked"}, question_of(header)},
        }};
    std::vector<StimulusColumn> stimulus = stimulus_columns_of(header);
    for (StimulusColumn& column : stimulus) {
        for (auto& [level, meaning] : column.what.levels)
            if (meaning.empty())
                meaning = level;
        layout.add<BidsEvent>({{column.what, [column](TableCells& to, const BidsEvent& row) {
                                    put_level(to, column.level_of(row.attempt->trial.stimulus));
                                }}});
    }
    auto own = own_columns<RowLayout<BidsEvent>::Column>(header);
    for (auto& column : own)
        if (column.what.name == correct_answer)
            column.what.name = "correct_answer"; // BIDS has "correct" say whether an answer was
    layout.add<BidsEvent>(std::move(own));
    layout.add<BidsEvent>({
        {{"frames", "How the frames that were shown had been made"},
         [&header](const TrialRecord& attempt) {
             return of_maybe(stimulus_of(header, header.in_slot(attempt.trial.shown(0))),
                             &RecordedStimulus::source);
         }},
        {timing_column(), timing_of(header)},
        {{"missed_refreshes",
          "Refreshes of the display that went by with an old picture; n/a also where timing is unproven"},
         of_ended(missed_refreshes_of(header))},
        {{"drift_deg", "Gaze error at the drift check", "deg"}, of_ended(attempt_drift)},
        {{"value",
          "Of a button or a key, its name; of a marker, its code, or its text where it has none; of a "
          "step of the trial, its id"},
         [](auto& row) { return when(!row.value.empty(), row.value); }},
        {{"device", "The response box, or the output of markers, as the protocol calls it; or keyboard"},
         &BidsEvent::device},
        {{"answer", "The answer, where it was taken down"},
         of_ended([](auto& attempt) { return attempt.outcome.answer; })},
    });
    if (has_given_answers)
        layout.add<BidsEvent>(answer_columns());
    if (settings > 0)
        layout.add<BidsEvent>(setting_columns(settings > 1));
    if (!header.points.empty())
        layout.add<BidsEvent>(gauge_columns());
    if (const SharedColumns shared(header); shared.has_slots)
        layout.add<BidsEvent>({{shared.slot, [&header](auto& row) {
                                    return when(row.what == presentation_event,
                                                item(header.slots, row.attempt->trial.slot).id);
                                }}});
    return layout;
}

/// Until the answer; of an imported trial that tells of none, until its result or its last sample.
SessionTime end_of(const SessionRecord& record, const TrialRecord& trial,
                   const std::optional<ClockMap>& clock_map) {
    if (trial.reached(trial.outcome.responded_at))
        return trial.outcome.responded_at;
    if (!clock_map || !record.gaze_source(trial.sitting))
        return trial.started;
    std::optional<TrackerTime> end;
    record.read_gaze_events(trial, [&](const GazeEvent& event) {
        if (event.kind == GazeEvent::Kind::message && event.text.starts_with("TRIAL_RESULT"))
            end = event.start;
    });
    if (!end)
        if (const auto span = record.sample_span(trial))
            end = span->second;
    return end ? std::max(clock_map->to_session(*end).time, trial.started) : trial.started;
}

/// `seen`: where the presentations of a trial with several go, which events point to.
void add_events(std::vector<BidsEvent>& to, const TrialRecord& trial, SessionTime end,
                const StimulusFile& stimulus_file, std::deque<TrialRecord>& seen) {
    const TrialOutcome& outcome = trial.outcome;
    const auto was = [&](SessionTime time) { return trial.reached(time); };
    to.push_back({.attempt = &trial,
                  .what = "trial",
                  .from = trial.started,
                  .to = end,
                  .ended = trial.has_outcome() ? &trial : nullptr});
    if (was(outcome.task_screen_onset))
        to.push_back({&trial, "question", outcome.task_screen_onset, outcome.task_screen_onset});
    for (std::size_t i = 0; was(outcome.presentation_onset) && i < trial.trial.shown_count(); ++i) {
        const TrialRecord& shown = i == 0 ? trial : seen.emplace_back(trial.seen_in(i));
        std::vector<std::pair<SessionTime, SessionTime>> spans = shown.lit_spans();
        if (outcome.steps.empty())
            spans.emplace_back(outcome.presentation_onset, outcome.presentation_end);
        for (const auto& [onset, dark] : spans)
            to.push_back({&shown, presentation_event, onset, dark, {}, stimulus_file(shown.trial.stimulus)});
    }
    for (const GivenAnswer& given : outcome.given) {
        // What was missed stands where it could last have been given.
        const std::optional<SessionTime> at = given.answered_at  ? given.answered_at
                                              : given.window_end ? given.window_end
                                                                 : given.window_onset;
        if (at)
            to.push_back({.attempt = &trial,
                          .what = "response",
                          .from = *at,
                          .to = *at,
                          .response_time = given.response_time(),
                          .device = given.device,
                          .given = &given});
    }
    if (!outcome.given.empty()) {
        for (const AttemptStep& step : outcome.steps)
            if (step.kind == "answer" && step.begin)
                to.push_back({.attempt = &trial,
                              .what = "answer",
                              .from = *step.begin,
                              .to = step.end.value_or(*step.begin),
                              .value = step.id});
    } else if (was(outcome.response_screen_onset)) {
        std::optional<SessionDuration> response_time;
        if (was(outcome.responded_at))
            response_time = outcome.responded_at - outcome.response_screen_onset;
        to.push_back(
            {&trial, "response", outcome.response_screen_onset, outcome.responded_at, response_time});
    }
    for (const AttemptStep* const step : further_steps(trial))
        if (step->kind != "show") // which are presentations
            to.push_back({.attempt = &trial,
                          .what = step->kind,
                          .from = *step->begin,
                          .to = step->end.value_or(*step->begin),
                          .value = step->id});
}

/// Presses of buttons and keys in an attempt, and markers of it that were sent.
void add_devices(std::vector<BidsEvent>& to, const TrialRecord& trial,
                 const std::vector<RecordedButton>& buttons, const std::vector<RecordedKeyPress>& presses,
                 const std::vector<RecordedMarker>& markers) {
    for (const RecordedKeyPress& press : presses)
        if (press.attempt_id == trial.id && !is_of_box(press))
            to.push_back({.attempt = &trial,
                          .what = "key",
                          .from = press.at,
                          .to = press.at,
                          .value = press.name,
                          .device = press.device});
    for (const RecordedButton& button : buttons)
        if (button.attempt_id == trial.id && button.is_down)
            to.push_back({.attempt = &trial,
                          .what = "button",
                          .from = button.at,
                          .to = button.at,
                          .value = button.name,
                          .device = button.box});
    for (const RecordedMarker& marker : markers)
        if (marker.attempt_id == trial.id && marker.is_sent)
            to.push_back({.attempt = &trial,
                          .what = "marker",
                          .from = marker.at,
                          .to = marker.at,
                          .value = marker.code ? fmt::format("{}", marker.code) : marker.text,
                          .device = marker.output});
}

/// To the micrometre, as the nearest number to what is written: 0.3929, and not 0.39289999999999997.
double metres(double mm) { return std::round(1000.0 * mm) / 1e6; }

Json screen_of(const SessionRecord& record) {
    const RecordedDisplay& display = record.header().display;
    const ScreenGeometry& screen = display.screen;
    if (screen.viewing_distance_mm <= 0.0 || screen.screen_mm.x <= 0.0 || screen.screen_mm.y <= 0.0)
        throw InputError(
            fmt::format("{}: the size of the screen or its distance is not known, and BIDS requires "
                        "both. Import the recording again with --screen-mm and --distance-mm.",
                        record.directory().string()));
    Json json{{"ScreenDistance", metres(screen.viewing_distance_mm)},
              {"ScreenOrigin", {"top", "left"}},
              {"ScreenResolution", {screen.screen_px.x, screen.screen_px.y}},
              {"ScreenSize", {metres(screen.screen_mm.x), metres(screen.screen_mm.y)}}};
    // By which the stimuli were shown: nobody knows of a recording made elsewhere.
    if (!was_recorded_elsewhere(record.header())) {
        json["SoftwareName"] = "overt";
        json["SoftwareVersion"] = record.header().program.version;
    }
    if (display.refresh_hz > 0.0)
        json["ScreenRefreshRate"] = display.refresh_hz;
    return json;
}

} // namespace

void write_bids_events(const SessionRecord& record, int run, std::optional<SessionTime> zero,
                       const StimulusFile& stimulus_file, const std::filesystem::path& stem) {
    const SessionHeader& header = record.header();
    const Json screen = screen_of(record);
    const std::optional<ClockMap> clock_map = record.clock_map(run);
    const bool has_given_answers = std::ranges::any_of(
        record.trials(), [](const TrialRecord& trial) { return !trial.outcome.given.empty(); });
    std::size_t settings = 0; ///< columns that were set along, at most
    for (const TrialRecord& trial : record.trials())
        for (const GivenAnswer& given : trial.outcome.given)
            settings = std::max(settings, given.settings.size());
    const RowLayout<BidsEvent> layout =
        events_layout(header, zero.value_or(SessionTime()), clock_map, has_given_answers, settings);
    TableWriter writer(stem.string() + ".tsv", layout.table(), TableFormat::tsv, Packing::none,
                       TableWriter::Header::names);
    std::vector<BidsEvent> events;
    std::deque<TrialRecord> seen;
    const std::vector<RecordedButton> buttons = record.button_changes();
    const std::vector<RecordedKeyPress> presses = record.key_presses();
    const std::vector<RecordedMarker> markers = record.markers();
    for (const TrialRecord& trial : record.trials()) {
        if (trial.sitting != run)
            continue;
        add_events(events, trial, end_of(record, trial, clock_map), stimulus_file, seen);
        add_devices(events, trial, buttons, presses, markers);
    }
    std::stable_sort(events.begin(), events.end(),
                     [](const BidsEvent& a, const BidsEvent& b) { return a.from < b.from; });
    for (const BidsEvent& event : events)
        layout.write(writer, event);
    writer.close();

    std::string questions;
    for (const RecordedTask& task : header.tasks)
        questions += (questions.empty() ? "" : "\n") + plain_line_of(task.question);
    Json json;
    json["TaskName"] = bids_task_name(header);
    if (was_recorded_elsewhere(header)) {
        json["TaskDescription"] = "Not known: the recording was made with another program, and imported";
        json["Instructions"] = "n/a";
    } else {
        json["TaskDescription"] = "Animated objects are looked at; what is asked of each is asked before its "
                                  "presentation and answered after it";
        json["Instructions"] = questions.empty() ? "none" : questions;
    }
    constexpr std::pair<std::string_view, const char*> institution[] = {
        {"institution_name", "InstitutionName"},
        {"institution_address", "InstitutionAddress"},
        {"department", "InstitutionalDepartmentName"}};
    for (const auto& [key, name] : institution)
        for (const RecordedDatasetEntry& said : header.dataset)
            if (said.key == key)
                json[name] = said.value;
    json["StimulusPresentation"] = screen;
    json["SessionTimeOfOnsetZero"] = {{"Description", "What onset 0 is by the clock of the session"},
                                      {"Units", "s"},
                                      {"Value", to_seconds(zero.value_or(SessionTime()))}};
    json.update(describe_columns(layout.table().columns, TableFormat::tsv));
    write_text_file(stem.string() + ".json", json_text(json));
}

} // namespace overt
