#include "experiment/record/bids/bids_events.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "experiment/base/error.h"
#include "experiment/record/tables/export_tables.h"
#include "experiment/record/tables/joined_cells.h"
#include "experiment/record/tables/table_writer.h"

namespace overt {
namespace {

using Json = nlohmann::ordered_json;
using Levels = std::vector<std::pair<std::string, std::string>>;

const auto& item(const auto& list, int index) { return list[static_cast<std::size_t>(index)]; }

template <class List> Levels levels_of(const List& list) {
    Levels levels;
    for (const auto& entry : list) {
        const bool is_named = std::any_of(levels.begin(), levels.end(),
                                          [&](const auto& level) { return level.first == entry.id; });
        if (!is_named)
            levels.emplace_back(entry.id, entry.title.empty() ? entry.id : entry.title);
    }
    return levels;
}

Table events_table(const SessionHeader& header) {
    Levels tasks, blocks;
    for (const RecordedTask& task : header.tasks)
        tasks.emplace_back(task.id, task.question.empty() ? task.id : task.question);
    for (const std::string& block : header.blocks)
        blocks.emplace_back(block, "the block of that name");
    return {"",
            "",
            {{"onset", "Begin of the event, from the first gaze sample of the run", "s", {}},
             {"duration", "Until it gave way; n/a where it was cut off", "s", {}},
             {"trial_type",
              "What it was",
              "",
              {{"trial", "an attempt at a trial, from its begin to the answer"},
               {"question", "the screen with the question"},
               {"presentation", "the animated stimulus"},
               {"response", "the screen during the answer"}}},
             {"response_time", "From the onset of the response screen to the end of the answer", "s", {}},
             {"stim_file", "First frame of the animated stimulus, in the folder stimuli", "", {}},
             {"trial", "Position of the trial in the observer's order, from 1", "", {}},
             {"attempt", "Which attempt at this trial, from 1", "", {}},
             {"status",
              "How the attempt ended",
              "",
              {{"completed", "all of it was done"},
               {"aborted", "broken off, or failed and to come again"},
               {"interrupted", "cut off when the program was killed, and the session went on later"},
               {"open", "cut off when the program was killed"}}},
             {"counts",
              "Whether this is the attempt that counts",
              "",
              {{"yes", "completed"},
               {"no", "not completed, or its block was begun again later: the attempt there counts"}}},
             {"block", "The block that the trial is of, where there are blocks", "", std::move(blocks)},
             {"question", "Which question was asked", "", std::move(tasks)},
             {"sculpture", "Which sculpture was shown", "", levels_of(header.sculptures)},
             {"material", "In which material it was shown", "", levels_of(header.materials)},
             {"missed_refreshes", "Refreshes of the display that went by with an old picture", "", {}},
             {"drift_deg", "Gaze error at the drift check", "deg", {}},
             {"answer", "The answer, where it was taken down", "", {}}}};
}

class EventRows {
  public:
    EventRows(const SessionRecord& record, SessionTime zero, const StimulusFile& stimulus_file,
              TableWriter& row)
        : header_(record.header()), zero_(zero), stimulus_file_(stimulus_file), row_(row) {}

    void write(const TrialRecord& trial);

  private:
    /// Onset, duration and what it was; an event that something else ended has no duration.
    void begin(SessionTime from, SessionTime to, std::string_view what) {
        row_.seconds(from - zero_);
        to > from ? row_.seconds(to - from) : row_.missing();
        row_.word(what);
    }
    void end(const TrialRecord& trial);

    const SessionHeader& header_;
    SessionTime zero_;
    const StimulusFile& stimulus_file_;
    TableWriter& row_;
};

void EventRows::end(const TrialRecord& trial) {
    const Condition condition = trial.trial.condition;
    row_.integer(trial.trial.index + 1).integer(trial.attempt).word(name_of(trial.status));
    row_.word(trial.counts ? "yes" : "no");
    const auto block = static_cast<std::size_t>(trial.trial.block);
    block < header_.blocks.size() ? row_.text(header_.blocks[block]) : row_.missing();
    row_.text(item(header_.tasks, trial.trial.task).id)
        .text(item(header_.sculptures, condition.sculpture).id)
        .text(item(header_.materials, condition.material).id);
}

void EventRows::write(const TrialRecord& trial) {
    const TrialOutcome& outcome = trial.outcome;
    const bool is_open = !trial.has_outcome();
    // Screens that the attempt did not get to have no time.
    const auto was = [&](SessionTime time) { return !is_open && time > trial.started; };
    begin(trial.started, was(outcome.responded_at) ? outcome.responded_at : trial.started, "trial");
    row_.missing(2);
    end(trial);
    is_open ? row_.missing() : row_.integer(outcome.missed_refreshes);
    !is_open&& outcome.drift ? row_.fixed(outcome.drift->value, angle_decimals) : row_.missing();
    is_open ? row_.missing() : row_.text(outcome.answer);
    row_.end_row();
    if (was(outcome.task_screen_onset)) {
        begin(outcome.task_screen_onset, outcome.task_screen_onset, "question");
        row_.missing(2);
        end(trial);
        row_.missing(3).end_row();
    }
    if (was(outcome.presentation_onset)) {
        begin(outcome.presentation_onset, outcome.presentation_end, "presentation");
        const std::string file = stimulus_file_(trial.trial.condition);
        row_.missing().text(file);
        end(trial);
        row_.missing(3).end_row();
    }
    if (was(outcome.response_screen_onset)) {
        begin(outcome.response_screen_onset, outcome.responded_at, "response");
        was(outcome.responded_at) ? row_.seconds(outcome.responded_at - outcome.response_screen_onset)
                                  : row_.missing();
        row_.missing();
        end(trial);
        row_.missing(3).end_row();
    }
}

Json screen_of(const SessionRecord& record) {
    const RecordedDisplay& display = record.header().display;
    const ScreenGeometry& screen = display.screen;
    if (screen.viewing_distance_mm <= 0.0 || screen.screen_mm.x <= 0.0 || screen.screen_mm.y <= 0.0)
        throw InputError(
            fmt::format("{}: the size of the screen or its distance is not known, and BIDS requires "
                        "both. Import the recording again with --screen-mm and --distance-mm.",
                        record.directory().string()));
    Json json{{"ScreenDistance", 1e-3 * screen.viewing_distance_mm},
              {"ScreenOrigin", {"top", "left"}},
              {"ScreenResolution", {screen.screen_px.x, screen.screen_px.y}},
              {"ScreenSize", {1e-3 * screen.screen_mm.x, 1e-3 * screen.screen_mm.y}},
              {"SoftwareName", "overt"},
              {"SoftwareVersion", record.header().program.version}};
    if (display.refresh_hz > 0.0)
        json["ScreenRefreshRate"] = display.refresh_hz;
    return json;
}

} // namespace

void write_bids_events(const SessionRecord& record, int run, std::optional<SessionTime> zero,
                       const StimulusFile& stimulus_file, const std::filesystem::path& stem) {
    const SessionHeader& header = record.header();
    const Json screen = screen_of(record);
    const Table table = events_table(header);
    TableWriter writer(stem.string() + ".tsv", table, TableFormat::tsv, Packing::none,
                       TableWriter::Header::names);
    EventRows rows(record, zero.value_or(SessionTime()), stimulus_file, writer);
    for (const TrialRecord& trial : record.trials())
        if (trial.sitting == run)
            rows.write(trial);
    writer.close();

    std::string questions;
    for (const RecordedTask& task : header.tasks)
        questions += (questions.empty() ? "" : "\n") + task.question;
    Json json;
    json["TaskName"] = header.protocol.title.empty() ? header.protocol.name : header.protocol.title;
    json["TaskDescription"] = "Questions about animated sculptures, each asked before its presentation and "
                              "answered after it";
    json["Instructions"] = questions.empty() ? "none" : questions;
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
    json.update(describe_columns(table.columns, TableFormat::tsv));
    write_text_file(stem.string() + ".json", json_text(json));
}

} // namespace overt
