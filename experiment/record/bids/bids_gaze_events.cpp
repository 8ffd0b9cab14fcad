#include "experiment/record/bids/bids_gaze_events.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "experiment/record/asc/asc_trial.h"
#include "experiment/record/tables/export_tables.h"
#include "experiment/record/tables/joined_cells.h"
#include "experiment/record/tables/table_writer.h"

namespace overt {
namespace {

using Kind = GazeEvent::Kind;

Table events_table() {
    return {
        "",
        "",
        {{"onset",
          "Begin of the event by the tracker's own clock, as the timestamps of the samples",
          "us",
          {}},
         {"duration", "From the begin of the first to the end of the last sample in it", "s", {}},
         {"trial_type",
          "What the tracker found the eye to do; n/a of messages",
          "",
          {{"fixation", "the eye rested"}, {"saccade", "the eye jumped"}, {"blink", "there was no pupil"}}},
         {"blink", "Whether a blink lies in a saccade", "", {{"0", "no"}, {"1", "yes: it may be none"}}},
         {"message", "Text sent to the tracker or by it; BUTTON and INPUT are its own ports", "", {}},
         {"x_px", "Mean place of a fixation, start of a saccade", "pixel", {}},
         {"y_px", "The same, downwards", "pixel", {}},
         {"end_x_px", "End of a saccade", "pixel", {}},
         {"end_y_px", "The same, downwards", "pixel", {}},
         {"pupil", "Mean pupil size of a fixation", "arbitrary", {}},
         {"amplitude_deg", "Size of a saccade", "deg", {}},
         {"peak_velocity_deg_s", "Peak velocity of a saccade", "deg/s", {}}}};
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

class EventRows {
  public:
    EventRows(const std::filesystem::path& file, Eye eye, const Table& table)
        : row_(file, table, TableFormat::tsv, Packing::gzip, TableWriter::Header::none), eye_(eye) {}

    /// In the order of their begins.
    void write(std::vector<GazeEvent> events) {
        std::stable_sort(events.begin(), events.end(),
                         [](const GazeEvent& a, const GazeEvent& b) { return a.start < b.start; });
        for (const GazeEvent& event : events)
            if (event.kind != Kind::note && (!is_eye_event(event.kind) || event.eye == eye_))
                write(event, events);
    }
    void close() { row_.close(); }

  private:
    void write(const GazeEvent& event, const std::vector<GazeEvent>& all);
    void number(const std::optional<double>& value, int decimals) {
        value ? row_.fixed(*value, decimals) : row_.missing();
    }
    void place(const std::optional<ScreenPoint>& place) {
        place ? row_.fixed(place->x_px, pixel_decimals).fixed(place->y_px, pixel_decimals) : row_.missing(2);
    }

    TableWriter row_;
    Eye eye_;
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

void EventRows::write(const GazeEvent& event, const std::vector<GazeEvent>& all) {
    row_.integer(event.start.time_since_epoch().count());
    if (!is_eye_event(event.kind)) {
        row_.integer(0).missing(2).text(message_of(event)).missing(7).end_row();
        return;
    }
    row_.fixed(1e-6 * static_cast<double>(event.duration.count()), 6).word(name_of(event.kind));
    if (event.kind == Kind::saccade)
        row_.integer(std::any_of(all.begin(), all.end(), [&](const GazeEvent& other) {
            return other.kind == Kind::blink && other.eye == event.eye && other.start >= event.start &&
                   other.end <= event.end;
        }));
    else
        row_.missing();
    row_.missing();
    place(event.place);
    place(event.arrival);
    number(event.pupil, pupil_decimals);
    number(event.amplitude_deg, pixel_decimals);
    number(event.peak_velocity_deg_s, pixel_decimals);
    row_.end_row();
}

} // namespace

void write_bids_gaze_events(const SessionRecord& record, int run, Eye eye,
                            const std::filesystem::path& stem) {
    const Table table = events_table();
    EventRows rows(stem.string() + ".tsv.gz", eye, table);
    const bool is_imported = record.gaze_source(run).has_value();
    const std::optional<ClockMap> clock_map = record.clock_map(run);
    std::vector<GazeEvent> outside;
    record.read_gaze_events_outside([&](const GazeEvent& event) { outside.push_back(event); });
    if (is_imported)
        rows.write(std::move(outside));
    for (const TrialRecord& trial : record.trials()) {
        if (trial.sitting != run)
            continue;
        std::vector<GazeEvent> events;
        record.read_gaze_events(trial, [&](const GazeEvent& event) { events.push_back(event); });
        if (!is_imported && clock_map)
            events = begins_of(trial, *clock_map);
        rows.write(std::move(events));
    }
    rows.close();

    nlohmann::ordered_json json;
    json["Description"] = is_imported
                              ? "Events and messages as the eye tracker recorded them."
                              : "When trials and their screens began, by the tracker's clock: computed from "
                                "readings of both clocks.";
    json["OnsetSource"] = "timestamp";
    nlohmann::ordered_json columns = nlohmann::ordered_json::array();
    for (const TableColumn& column : table.columns)
        columns.push_back(column.name);
    json["Columns"] = std::move(columns);
    json.update(describe_columns(table.columns, TableFormat::tsv));
    write_text_file(stem.string() + ".json", json_text(json));
}

} // namespace overt
