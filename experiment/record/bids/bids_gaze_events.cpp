#include "experiment/record/bids/bids_gaze_events.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "experiment/base/json_text.h"
#include "experiment/record/asc/asc_trial.h"
#include "experiment/record/bids/bids_names.h"
#include "experiment/record/read/tracker_facts.h"
#include "experiment/record/tables/export_tables.h"
#include "experiment/record/tables/gaze_event_rows.h"
#include "experiment/record/tables/joined_cells.h"
#include "experiment/record/tables/table_writer.h"

namespace overt {
namespace {

using Kind = GazeEvent::Kind;

struct PhysioEvent : TrackerEventRow {
    bool is_of_eye;
    std::optional<bool> has_blink; ///< of a saccade: whether a blink lies in it
};

std::string message_of(const GazeEvent& event) {
    switch (event.kind) {
    case Kind::button:
        return "BUTTON " + event.text;
    case Kind::input:
        return "INPUT " + event.text;
    case Kind::started:
        return "START";
    case Kind::ended:
        return "END";
    default:
        return event.text;
    }
}

RowLayout<PhysioEvent> physio_events_layout(const PupilWords& pupil) {
    RowLayout<PhysioEvent> layout{
        "",
        "",
        {
            {{"onset", "Begin of the event by the tracker's own clock, as the timestamps of the samples",
              "us"},
             [](auto& row) { return microseconds_of(row.event.start); }},
            {{"duration", "From the begin of the first to the end of the last sample in it", "s"},
             [](auto& to, auto& row) {
                 row.is_of_eye ? to.fixed(1e-6 * static_cast<double>(row.event.duration.count()), 6)
                               : to.integer(0);
             }},
            {{"trial_type",
              "What the eye did; n/a of messages",
              "",
              {{"fixation", "the eye rested"},
               {"saccade", "the eye jumped"},
               {"blink", "there was no pupil"}}},
             [](auto& row) { return when(row.is_of_eye, name_of(row.event.kind)); }},
            {{"blink", "Whether a blink lies in a saccade", "", {{"0", "no"}, {"1", "yes: it may be none"}}},
             &PhysioEvent::has_blink},
            {{"message", "Text sent to the tracker or by it; BUTTON and INPUT are its own ports"},
             [](auto& row) { return when(!row.is_of_eye, message_of(row.event)); }},
        }};
    layout.add<TrackerEventRow>(
        event_value_columns("pixel", pupil.unit == "mm" ? "mm" : "arbitrary", pupil.meaning));
    return layout;
}

/// When the trial and its screens began, in the tracker's time.
std::vector<GazeEvent> begins_of(const TrialRecord& trial, const ClockMap& clock_map) {
    std::vector<GazeEvent> messages;
    const auto add = [&](SessionTime time, std::string text) {
        GazeEvent event;
        event.start = event.end = clock_map.to_other(time);
        event.text = std::move(text);
        messages.push_back(std::move(event));
    };
    add(trial.started, fmt::format("TRIALID {}", trial.trial.index + 1));
    for (const auto& [word, at] : screens_of(trial))
        add(at, std::string(word));
    return messages;
}

/// In the order of their begins.
void write_events(TableWriter& to, const RowLayout<PhysioEvent>& layout, std::vector<GazeEvent> events,
                  Eye eye) {
    std::erase_if(events, [&](const GazeEvent& event) {
        return event.kind == Kind::note || (is_eye_event(event.kind) && event.eye != eye);
    });
    std::stable_sort(events.begin(), events.end(),
                     [](const GazeEvent& a, const GazeEvent& b) { return a.start < b.start; });
    const auto has_blink = [&](const GazeEvent& saccade) {
        const auto from =
            std::lower_bound(events.begin(), events.end(), saccade.start,
                             [](const GazeEvent& event, TrackerTime time) { return event.start < time; });
        for (auto other = from; other != events.end() && other->start <= saccade.end; ++other)
            if (other->kind == Kind::blink && other->end <= saccade.end)
                return true;
        return false;
    };
    for (const GazeEvent& event : events)
        layout.write(to, {{event},
                          is_eye_event(event.kind),
                          event.kind == Kind::saccade ? std::optional(has_blink(event)) : std::nullopt});
}

} // namespace

void write_bids_gaze_events(const SessionRecord& record, int run, Eye eye,
                            const std::filesystem::path& stem) {
    const RowLayout<PhysioEvent> layout = physio_events_layout(pupil_words(record, run));
    TableWriter writer(stem.string() + ".tsv.gz", layout.table(), TableFormat::tsv, Packing::gzip,
                       TableWriter::Header::none);
    const bool is_imported = record.gaze_source(run).has_value();
    const std::optional<ClockMap> clock_map = record.clock_map(run);
    std::vector<GazeEvent> events;
    const auto take = [&](const GazeEvent& event) { events.push_back(event); };
    if (is_imported)
        record.read_gaze_events_before(take);
    for (const TrialRecord& trial : record.trials()) {
        if (trial.sitting != run)
            continue;
        record.read_gaze_events(trial, take);
        if (is_imported) {
            record.read_gaze_events_after(trial, take);
        } else if (clock_map) {
            for (GazeEvent& begin : begins_of(trial, *clock_map))
                events.push_back(std::move(begin));
        }
    }
    write_events(writer, layout, std::move(events), eye);
    writer.close();

    nlohmann::ordered_json json;
    json["TaskName"] = bids_task_name(record.header());
    json["Description"] = is_imported
                              ? "Events and messages as the eye tracker recorded them."
                              : "When trials and their screens began, by the tracker's clock: computed from "
                                "readings of both clocks.";
    if (const std::string origin = sentence_on(record.event_origin(run)); !origin.empty())
        json["Description"] = json["Description"].get<std::string>() + " " + origin;
    json["OnsetSource"] = "timestamp";
    nlohmann::ordered_json columns = nlohmann::ordered_json::array();
    for (const TableColumn& column : layout.table().columns)
        columns.push_back(column.name);
    json["Columns"] = std::move(columns);
    json.update(describe_columns(layout.table().columns, TableFormat::tsv));
    write_text_file(stem.string() + ".json", json_text(json));
}

} // namespace overt
