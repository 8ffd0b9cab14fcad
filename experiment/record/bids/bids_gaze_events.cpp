#include "experiment/record/bids/bids_gaze_events.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "experiment/base/json_text.h"
#include "experiment/record/asc/asc_trial.h"
#include "experiment/record/tables/export_tables.h"
#include "experiment/record/tables/joined_cells.h"
#include "experiment/record/tables/table_writer.h"

namespace overt {
namespace {

using Kind = GazeEvent::Kind;

struct PhysioEvent {
    const GazeEvent& event;
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

RowLayout<PhysioEvent> physio_events_layout() {
    return {
        "",
        "",
        {
            {{"onset",
              "Begin of the event by the tracker's own clock, as the timestamps of the samples",
              "us",
              {}},
             [](auto& to, auto& row) { to.integer(row.event.start.time_since_epoch().count()); }},
            {{"duration", "From the begin of the first to the end of the last sample in it", "s", {}},
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
             [](auto& to, auto& row) { row.is_of_eye ? to.word(name_of(row.event.kind)) : to.missing(); }},
            {{"blink", "Whether a blink lies in a saccade", "", {{"0", "no"}, {"1", "yes: it may be none"}}},
             [](auto& to, auto& row) { row.has_blink ? to.integer(*row.has_blink) : to.missing(); }},
            {{"message", "Text sent to the tracker or by it; BUTTON and INPUT are its own ports", "", {}},
             [](auto& to, auto& row) { row.is_of_eye ? to.missing() : to.text(message_of(row.event)); }},
            {{"x_px", "Mean place of a fixation, start of a saccade", "pixel", {}},
             [](auto& to, auto& row) {
                 row.event.place ? to.fixed(row.event.place->x_px, pixel_decimals) : to.missing();
             }},
            {{"y_px", "The same, downwards", "pixel", {}},
             [](auto& to, auto& row) {
                 row.event.place ? to.fixed(row.event.place->y_px, pixel_decimals) : to.missing();
             }},
            {{"end_x_px", "End of a saccade", "pixel", {}},
             [](auto& to, auto& row) {
                 row.event.arrival ? to.fixed(row.event.arrival->x_px, pixel_decimals) : to.missing();
             }},
            {{"end_y_px", "The same, downwards", "pixel", {}},
             [](auto& to, auto& row) {
                 row.event.arrival ? to.fixed(row.event.arrival->y_px, pixel_decimals) : to.missing();
             }},
            {{"pupil", "Mean pupil size of a fixation", "arbitrary", {}},
             [](auto& to, auto& row) {
                 row.event.pupil ? to.fixed(*row.event.pupil, pupil_decimals) : to.missing();
             }},
            {{"amplitude_deg", "Size of a saccade", "deg", {}},
             [](auto& to, auto& row) {
                 row.event.amplitude_deg ? to.fixed(*row.event.amplitude_deg, pixel_decimals) : to.missing();
             }},
            {{"peak_velocity_deg_s", "Peak velocity of a saccade", "deg/s", {}},
             [](auto& to, auto& row) {
                 row.event.peak_velocity_deg_s ? to.fixed(*row.event.peak_velocity_deg_s, pixel_decimals)
                                               : to.missing();
             }},
        }};
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
    std::stable_sort(events.begin(), events.end(),
                     [](const GazeEvent& a, const GazeEvent& b) { return a.start < b.start; });
    const auto has_blink = [&](const GazeEvent& saccade) {
        return std::any_of(events.begin(), events.end(), [&](const GazeEvent& other) {
            return other.kind == Kind::blink && other.eye == saccade.eye && other.start >= saccade.start &&
                   other.end <= saccade.end;
        });
    };
    for (const GazeEvent& event : events) {
        const bool is_of_eye = is_eye_event(event.kind);
        if (event.kind == Kind::note || (is_of_eye && event.eye != eye))
            continue;
        layout.write(to, {event, is_of_eye,
                          event.kind == Kind::saccade ? std::optional(has_blink(event)) : std::nullopt});
    }
}

} // namespace

void write_bids_gaze_events(const SessionRecord& record, int run, Eye eye,
                            const std::filesystem::path& stem) {
    const RowLayout<PhysioEvent> layout = physio_events_layout();
    TableWriter writer(stem.string() + ".tsv.gz", layout.table(), TableFormat::tsv, Packing::gzip,
                       TableWriter::Header::none);
    const bool is_imported = record.gaze_source(run).has_value();
    const std::optional<ClockMap> clock_map = record.clock_map(run);
    std::vector<GazeEvent> outside;
    record.read_gaze_events_outside([&](const GazeEvent& event) { outside.push_back(event); });
    if (is_imported)
        write_events(writer, layout, std::move(outside), eye);
    for (const TrialRecord& trial : record.trials()) {
        if (trial.sitting != run)
            continue;
        std::vector<GazeEvent> events;
        record.read_gaze_events(trial, [&](const GazeEvent& event) { events.push_back(event); });
        if (!is_imported && clock_map)
            for (GazeEvent& begin : begins_of(trial, *clock_map))
                events.push_back(std::move(begin));
        write_events(writer, layout, std::move(events), eye);
    }
    writer.close();

    nlohmann::ordered_json json;
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
