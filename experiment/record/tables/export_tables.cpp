#include "experiment/record/tables/export_tables.h"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "experiment/record/tables/gaze_event_rows.h"
#include "experiment/timing/ledger_fit.h"

namespace overt {
namespace {

using Levels = std::vector<std::pair<std::string, std::string>>;

/// Columns that several tables share.
struct SharedColumns {
    explicit SharedColumns(const SessionHeader& header) {
        for (const RecordedTask& entry : header.tasks)
            task.levels.emplace_back(entry.id, entry.question);
        for (const RecordedSculpture& entry : header.sculptures)
            sculpture.levels.emplace_back(entry.id, entry.title);
        for (const RecordedMaterial& entry : header.materials)
            material.levels.emplace_back(entry.id, entry.title);
    }
    TableColumn trial{"trial", "Position of the trial in the observer's order, from 1", "", {}};
    TableColumn task{"task", "Which question was asked", "", {}};
    TableColumn sculpture{"sculpture", "Which sculpture was shown", "", {}};
    TableColumn material{"material", "In which material it was shown", "", {}};
    TableColumn angle{"angle_deg",
                      "Turn of the sculpture in the frame shown, counter-clockwise seen from above",
                      "deg",
                      {}};
};

TableColumn session_seconds(std::string name, std::string meaning) {
    return {
        std::move(name), std::move(meaning) + "; session clock, nine decimals keep each nanosecond", "s", {}};
}

Table trials_table(const SharedColumns& shared) {
    return {"trials",
            "One row for each attempt at a trial, in the order in which they were made.",
            {shared.trial,
             {"attempt", "Which attempt at this trial, from 1: a trial that was cut off is repeated", "", {}},
             {"sitting", "Counts how often the session was begun or resumed, from 1", "", {}},
             {"block", "The block that the trial is of, where the protocol has blocks", "", {}},
             shared.task,
             shared.sculpture,
             shared.material,
             {"status",
              "How the attempt ended",
              "",
              {{"completed", "all of it was done"},
               {"aborted",
                "broken off by the operator, or because a device went away; or failed, and to come again"},
               {"interrupted", "cut off when the program was killed, as was found when the session went on"},
               {"open", "running when the session was exported, or cut off when the program was killed"}}},
             {"counts",
              "Whether this is the attempt that counts; only such ones appear in the other tables",
              "",
              {{"yes", "completed"},
               {"no", "not completed, or its block was begun again later: the attempt there counts"}}},
             {"failure",
              "What spoke against the attempt: missed refreshes, gaze lost, rejected, repeated or skipped; "
              "n/a: nothing",
              "",
              {}},
             {"comes_again",
              "Whether the trial was to be attempted again because of that; n/a: the session ended in it",
              "",
              {{"never", "it was not"},
               {"now", "right afterwards"},
               {"end-of-block", "after the other trials of its block"}}},
             session_seconds("started_s", "Begin of the trial"),
             session_seconds("task_screen_onset_s", "Onset of the question"),
             session_seconds("presentation_onset_s", "Vertical blank of the presentation's first refresh"),
             session_seconds("presentation_end_s", "Vertical blank at which the presentation gave way"),
             session_seconds("response_screen_onset_s", "Onset of the response screen"),
             session_seconds("responded_s", "End of the answer"),
             {"shown_refreshes", "Refreshes in the flip ledger", "", {}},
             {"missed_refreshes", "Refreshes that went by with an old picture", "", {}},
             {"drift_deg", "Gaze error at the drift check", "deg", {}},
             {"lost_flips", "Flips that could not be recorded", "", {}},
             {"lost_samples", "Gaze samples that could not be recorded", "", {}},
             {"samples", "Gaze samples recorded", "", {}},
             {"samples_without_gaze", "Samples in which the tracker found no eye", "", {}},
             {"samples_on_object", "Samples that met the sculpture's surface", "", {}},
             {"samples_off_plan",
              "Samples that the planned frame times would have put on a frame that was not lit",
              "",
              {}}}};
}

Table flips_table(const SharedColumns& shared) {
    return {
        "flips",
        "The ledger of the completed trials: one row for each refresh of the display, from the "
        "presentation's onset to the plan's end, or longer where pictures came later.",
        {shared.trial,
         {"refresh", "Refresh of the display since the presentation's onset, from 0", "", {}},
         {"state",
          "Whether a picture was handed over for this refresh",
          "",
          {{"flipped", "shown_frame began, or went on, by a flip"},
           {"missed", "it went by with the frame before"}}},
         {"planned_frame",
          "Animation frame that the plan had for this refresh; n/a after the plan's end",
          "",
          {}},
         {"shown_frame", "Animation frame that was lit", "", {}},
         shared.angle,
         session_seconds("requested_s", "When the picture was asked for"),
         session_seconds("swapped_s", "When the buffer swap had been handed over"),
         session_seconds("vertical_blank_s", "When scan-out of this refresh began, by its own time stamp"),
         {"vertical_blank_uncertainty_s", "How far off the source may be", "s", {}},
         session_seconds("onset_s",
                         "The same by the line through all time stamps of the presentation; of a missed "
                         "refresh, too"),
         {"onset_uncertainty_s",
          "Two standard errors of the line; where time stamps scatter by less than 1 us they stand as they "
          "are, with their own uncertainty",
          "s",
          {}},
         {"source",
          "Where vertical_blank_s comes from",
          "",
          {{std::string(name_of(VblankSource::virtual_display)), "the program's own clock, exact"},
           {std::string(name_of(VblankSource::swap_return)), "when the buffer swap returned"},
           {std::string(name_of(VblankSource::glx_sync_control)),
            "GLX_OML_sync_control: the refresh at which the swap was lit"},
           {std::string(name_of(VblankSource::present_swap)),
            "X Present: the refresh at which the swap was lit"},
           {std::string(name_of(VblankSource::present_count)),
            "X Present, which only counts: the first refresh after the swap"},
           {std::string(name_of(VblankSource::egl_sync_control)),
            "EGL_CHROMIUM_sync_control: the refresh at which the swap was lit"},
           {std::string(name_of(VblankSource::drm_vblank)),
            "the kernel's count for the screen: the first refresh after the swap"}}},
         {"missed", "Refreshes that went by with the old picture before this one", "", {}},
         {"cause",
          "Why a refresh was missed",
          "",
          {{std::string(name_of(MissCause::asked_late)), "the flip was asked for when the refresh had begun"},
           {std::string(name_of(MissCause::drawn_late)), "it was asked for in time, but drawn too late"},
           {std::string(name_of(MissCause::shown_late)),
            "it was drawn in time, but the display took it later"}}}}};
}

std::vector<std::string> all_part_names(const SessionHeader& header) {
    std::vector<std::string> names;
    for (const RecordedSculpture& sculpture : header.sculptures)
        for (const std::string& name : sculpture.part_names)
            if (std::find(names.begin(), names.end(), name) == names.end())
                names.push_back(name);
    return names;
}

Table samples_table(const SharedColumns& shared, const SessionHeader& header) {
    Table samples{
        "samples",
        "One row for each gaze sample of the completed trials, joined with the frame that was lit on its row "
        "when it was taken. Pixels: origin at the top left corner, y down, pixel centres at 0.5.",
        {shared.trial, shared.task, shared.sculpture, shared.material}};
    const auto add = [&samples](std::vector<TableColumn> columns) {
        std::move(columns.begin(), columns.end(), std::back_inserter(samples.columns));
    };
    add(time_columns());
    add({{"tracker_time_us", "When the sample was taken, by the tracker's own clock", "us", {}},
         {"eye", "Which eye", "", {{"left", "left eye"}, {"right", "right eye"}}},
         {"x_px", "Gaze on the screen, to the right", "px", {}},
         {"y_px", "Gaze on the screen, downwards", "px", {}},
         {"pupil_area", "Pupil area", "the tracker's own unit", {}}});
    add(place_columns(header));
    return samples;
}

/// What stands after the columns of samples_table if there is a gaze cone.
void add_cone_columns(Table& samples, const std::vector<std::string>& parts, Degrees accuracy) {
    samples.columns.push_back(
        {"p_object",
         fmt::format(
             "Probability that the gaze was on the sculpture, taking the tracker to be {} degrees off "
             "on average, normally distributed to all sides; n/a as in silhouette_distance_deg",
             accuracy.value),
         "",
         {}});
    for (const std::string& part : parts)
        samples.columns.push_back(
            {"p_" + part,
             fmt::format("The same for the part «{}»; n/a, too, if the sculpture has no such part. All parts "
                         "together make p_object",
                         part),
             "",
             {}});
}

Table events_table() {
    return {"events",
            "What happened besides flips and samples, in all attempts and between trials.",
            {session_seconds("time_s", "When it happened"),
             {"trial", "Position of the trial in the observer's order, from 1", "", {}},
             {"kind", "What happened", "", {}},
             {"detail", "Particulars", "", {}}}};
}

Table responses_table(const SharedColumns& shared) {
    return {"responses",
            "One row for the answer in each completed trial.",
            {shared.trial,
             shared.task,
             shared.sculpture,
             shared.material,
             {"question", "The question as it was shown", "", {}},
             session_seconds("response_screen_onset_s", "Onset of the response screen"),
             session_seconds("responded_s", "End of the answer"),
             {"response_time_s", "From the onset of the response screen to the end of the answer", "s", {}},
             {"answer", "The answer, where the response panel took it down", "", {}}}};
}

Table stimuli_table(const SharedColumns& shared) {
    return {"stimuli",
            "What was shown: one row for each sculpture in each material.",
            {shared.sculpture,
             shared.material,
             {"source", "How the frames were made", "", {}},
             {"frames_sha256", "SHA-256 of the frames", "", {}},
             {"mesh_file", "The sculpture's mesh, relative to the session's directory", "", {}},
             {"mesh_sha256", "SHA-256 of the mesh", "", {}}}};
}

Table display_box_table() {
    return {
        "display_box",
        "What the video signal went through: one row for each sitting.",
        {{"sitting", "Counts how often the session was begun or resumed, from 1", "", {}},
         {"use",
          "Whether there was a display box",
          "",
          {{"box", "A Display++ or Bits# was switched to the mode"},
           {"declined", "The protocol says that there is none: its mode was nobody's business"},
           {"simulated", "Nothing was shown on a real screen in real time"},
           {"not needed", "The output goes through no box"}}},
         {"product", "Name of the box", "", {}},
         {"serial_number", "Its serial number", "", {}},
         {"firmware_date", "Date of its firmware", "", {}},
         {"port", "Serial port at which it was found", "", {}},
         {"mode", "To which it was switched", "", {}},
         {"gamma_table", "File on its disk that it was told to use", "", {}},
         {"settled_after_s", "From the command to two equal measurements of the video rate", "s", {}},
         {"video_rate_hz", "Rate of the video signal as the box measures it", "Hz", {}},
         {"clock_readings", "Readings of its clock and the session's", "", {}},
         session_seconds("clock_zero_s", "When its clock showed 0, by the line through the readings"),
         {"clock_uncertainty_s", "Bound on the error of times read off that line", "s", {}},
         {"clock_drift_ppm", "By how much a second of the session exceeds a second of the box", "ppm", {}},
         {"clock_drift_uncertainty_ppm", "Bound on the error of clock_drift_ppm", "ppm", {}}}};
}

std::string_view description_of(TableFormat format) {
    switch (format) {
    case TableFormat::tsv:
        return "Tab-separated tables in UTF-8. Missing values are n/a. In texts, tab, newline, "
               "carriage return and backslash are written as \\t, \\n, \\r and \\\\.";
    case TableFormat::csv:
        return "Comma-separated tables in UTF-8. Missing values are n/a. Texts with commas, quotes, line "
               "breaks or blanks at their ends stand in quotes, quotes in them doubled (RFC 4180).";
    case TableFormat::jsonl:
        break;
    }
    return "Tables in UTF-8, a JSON object in each line for each row. Missing values are null.";
}

} // namespace

std::vector<TableColumn> time_columns() {
    return {session_seconds("time_s", "When the sample was taken"),
            {"time_uncertainty_s", "Bound on the error of time_s", "s", {}}};
}

std::vector<TableColumn> place_columns(const SessionHeader& header) {
    TableColumn part{"part", "Part of the figure that is looked at", "", {}};
    for (const std::string& name : all_part_names(header))
        part.levels.emplace_back(name, fmt::format("the triangles labelled «{}»", name));
    const std::string mesh_unit = "unit of the mesh";
    return {{"frame", "Animation frame lit at the gaze's row", "", {}},
            SharedColumns(header).angle,
            {"image_x_px", "Gaze in the stimulus image, to the right", "px", {}},
            {"image_y_px", "Gaze in the stimulus image, downwards", "px", {}},
            {"surface_x", "Place on the unturned surface", mesh_unit, {}},
            {"surface_y", "Place on the unturned surface", mesh_unit, {}},
            {"surface_z", "Place on the unturned surface, upwards", mesh_unit, {}},
            {"triangle",
             "Index of the mesh's triangle, from 0; n/a where maps were given without a mesh",
             "",
             {}},
            part,
            {"depth", "Distance of the surface from the camera along the viewing direction", mesh_unit, {}},
            {"incidence_deg",
             "Angle between the line of sight and the surface's normal, 0 is head-on",
             "deg",
             {}},
            {"silhouette_distance_deg",
             "Visual angle from the gaze to the nearest place of the outline of the sculpture's picture: "
             "positive "
             "beside the sculpture, negative on it; n/a without gaze, when no frame was lit, or if the "
             "sculpture "
             "has no map. Right to within a pixel",
             "deg",
             {}}};
}

ExportTables::ExportTables(const SessionHeader& header, std::optional<Degrees> cone_accuracy) {
    const SharedColumns shared(header);
    trials = trials_table(shared);
    flips = flips_table(shared);
    samples = samples_table(shared, header);
    if (cone_accuracy) {
        cone_parts = all_part_names(header);
        add_cone_columns(samples, cone_parts, *cone_accuracy);
    }
    gaze_events = gaze_events_table();
    events = events_table();
    responses = responses_table(shared);
    stimuli = stimuli_table(shared);
    display_box = display_box_table();
}

std::vector<const Table*> ExportTables::all() const {
    return {&trials, &flips, &samples, &gaze_events, &events, &responses, &stimuli, &display_box};
}

nlohmann::ordered_json describe_columns(const std::vector<TableColumn>& columns, TableFormat format) {
    nlohmann::ordered_json description = nlohmann::ordered_json::object();
    for (const TableColumn& column : columns) {
        nlohmann::ordered_json& entry = description[column.name];
        entry["Description"] = column.meaning;
        if (!column.unit.empty())
            entry["Units"] = column.unit;
        // The quotes of a csv and of JSON are no part of the value.
        for (const auto& [value, meaning] : column.levels)
            entry["Levels"][format == TableFormat::tsv ? text_cell(value, format) : value] = meaning;
    }
    return description;
}

std::string table_dictionary(const ExportTables& tables, TableFormat format) {
    nlohmann::ordered_json dictionary;
    dictionary["Description"] = std::string(description_of(format));
    for (const Table* table : tables.all())
        dictionary["Files"][fmt::format("{}.{}", table->name, ending_of(format))] = {
            {"Description", table->description}, {"Columns", describe_columns(table->columns, format)}};
    return json_text(dictionary);
}

std::string json_text(const nlohmann::ordered_json& json) {
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
}

} // namespace overt
