#include "experiment/record/foreign/gaze_columns.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "experiment/base/error.h"
#include "experiment/base/whole_file.h"

namespace fs = std::filesystem;

namespace overt {
namespace {

/// A name as the table has it: newer exports of Tobii have the same quantity in several spaces, and say
/// behind the name which: "[DACS px]" is pixels of the display, "[MCS norm]" shares of the picture.
std::string in_display_px(const ForeignTable& table, const std::string& name) {
    for (const char* space : {" [DACS px]", " [ADCS px]", " (ADCSpx)"})
        if (table.find(name + space))
            return name + space;
    return name;
}

std::string if_there(const ForeignTable& table, const std::string& name) {
    return table.has(name) ? name : std::string();
}

/// The columns of an eye in pixels of the display, as far as they are there; none without a place. `place`:
/// its name without "X" and "Y", which stand behind `before_axis`.
GazeColumns::OfEye eye_in_px(const ForeignTable& table, const std::string& place, const std::string& pupil,
                             const std::string& validity, const std::string& before_axis) {
    const std::string x = in_display_px(table, place + before_axis + "X");
    if (!table.has(x))
        return {};
    return {x, in_display_px(table, place + before_axis + "Y"), if_there(table, pupil),
            if_there(table, validity)};
}

GazeColumns tobii_columns(const ForeignTable& table) {
    GazeColumns columns;
    columns.program = "Tobii Pro Lab";
    columns.time = "Recording timestamp";
    if (const auto at = table.find(columns.time)) // newer versions say it: "Recording timestamp [ms]"
        columns.time_unit = table.columns()[*at].find("[ms]") != std::string::npos ? "ms"
                            : table.columns()[*at].find("s]") != std::string::npos ? "us"
                                                                                   : "";
    // Recordings are in whole ms, unless asked otherwise; the tracker's own clock is in us.
    if (columns.time_unit == "ms")
        columns.fine_time = if_there(table, "Eyetracker timestamp");
    const auto eye = [&](const std::string& which) {
        return eye_in_px(table, "Gaze point " + which, "Pupil diameter " + which, "Validity " + which, " ");
    };
    columns.left = eye("left");
    columns.right = eye("right");
    if (!columns.left.is_there() && !columns.right.is_there())
        columns.single = eye_in_px(table, "Gaze point", "", "", " ");
    if (table.has("Sensor")) {
        columns.kind = "Sensor";
        columns.samples_word = "Eye Tracker";
    }
    columns.mark = if_there(table, "Event");
    columns.mark_value = if_there(table, "Event value");
    columns.trial = if_there(table, "Presented Stimulus name");
    return columns;
}

/// Tobii Studio, which Pro Lab replaced. Its codes of validity go from 0, certainly this eye, to 4, not
/// found; its makers advise to use 0 and 1 alone.
GazeColumns tobii_studio_columns(const ForeignTable& table) {
    GazeColumns columns;
    columns.program = "Tobii Studio";
    columns.time = "RecordingTimestamp";
    columns.time_unit = "ms";
    columns.fine_time = if_there(table, "EyeTrackerTimestamp");
    columns.greatest_validity = 1.0;
    const auto eye = [&](const std::string& which) {
        return eye_in_px(table, "GazePoint" + which, "Pupil" + which, "Validity" + which, "");
    };
    columns.left = eye("Left");
    columns.right = eye("Right");
    if (!columns.left.is_there() && !columns.right.is_there())
        columns.single = eye_in_px(table, "GazePoint", "", "", "");
    columns.mark = if_there(table, "StudioEvent");
    columns.mark_value = if_there(table, "StudioEventData");
    columns.trial = if_there(table, "MediaName");
    return columns;
}

GazeColumns gazepoint_columns(const ForeignTable& table) {
    GazeColumns columns;
    columns.program = "Gazepoint";
    columns.time = "TIME";
    columns.time_unit = "s";
    columns.unit = "normalised";
    // In mm; LPD and RPD are pixels of the camera.
    const auto pupil = [&](const std::string& eye) {
        return table.has(eye + "PMM") ? eye + "PMM" : std::string();
    };
    if (table.has("LPOGX") && table.has("RPOGX")) {
        columns.left = {"LPOGX", "LPOGY", pupil("L"), "LPOGV"};
        columns.right = {"RPOGX", "RPOGY", pupil("R"), "RPOGV"};
    } else {
        columns.single = {"BPOGX", "BPOGY", pupil("R"), "BPOGV"};
        columns.remarks.emplace_back(
            "The table has the best point of gaze of both eyes alone (BPOGX): it is taken "
            "for the right eye's.");
    }
    if (table.has("USER"))
        columns.mark = "USER";
    if (table.has("MEDIA_NAME"))
        columns.trial = "MEDIA_NAME";
    return columns;
}

GazeColumns pupil_surface_columns() {
    GazeColumns columns;
    columns.program = "Pupil Core";
    columns.time = "gaze_timestamp";
    columns.time_unit = "s";
    columns.unit = "normalised";
    columns.y_goes_up = true; // surfaces have their origin at the bottom left
    columns.single = {"x_norm", "y_norm", "", "confidence"};
    columns.least_validity = 0.6; // below, Pupil's own makers advise against use
    columns.remarks.emplace_back("Gaze is on the surface of this file, which is taken for the whole screen.");
    return columns;
}

constexpr const char* neon_x = "gaze position on surface x";

/// Of Neon's and Invisible's Marker Mapper, whose surfaces begin at the top left.
GazeColumns neon_surface_columns() {
    GazeColumns columns;
    columns.program = "Pupil Labs Neon";
    columns.time = "timestamp";
    columns.time_unit = "ns";
    columns.unit = "normalised";
    columns.single = {neon_x, "gaze position on surface y", "", ""};
    columns.remarks.emplace_back("Gaze is on the surface of this file, which is taken for the whole screen.");
    return columns;
}

GazeColumns pupil_world_columns(const ForeignTable& table, bool takes_any_gaze) {
    if (!takes_any_gaze)
        throw InputError(
            fmt::format("{}: places are in the picture of the world camera, and not on the "
                        "screen: define the screen as a "
                        "surface, in Pupil Player or of Neon in the Marker Mapper, export, and give "
                        "surfaces/gaze_positions_on_surface_NAME.csv or the Marker Mapper's gaze.csv; "
                        "--as-gaze takes "
                        "these for places on the screen all the same",
                        table.file().string()));
    if (table.has("gaze x")) { // Neon's, in pixels of the scene camera
        GazeColumns columns = neon_surface_columns();
        columns.unit = "px";
        columns.single = {"gaze x", "gaze y", "", ""};
        columns.remarks = {"Places in the picture of the scene camera are taken for places on the screen."};
        return columns;
    }
    GazeColumns columns = pupil_surface_columns();
    columns.time = table.has("gaze_timestamp") ? "gaze_timestamp" : "timestamp";
    columns.single = {"norm_pos_x", "norm_pos_y", "", "confidence"};
    columns.remarks = {"Places in the picture of the world camera are taken for places on the screen."};
    return columns;
}

GazeColumns mark_columns(std::string program, std::string time, std::string mark) {
    GazeColumns columns;
    columns.program = std::move(program);
    columns.time = std::move(time);
    columns.time_unit = "s";
    columns.mark = std::move(mark);
    return columns;
}

GazeColumns smi_columns(const ForeignTable& table) {
    GazeColumns columns;
    columns.program = "SMI";
    columns.time = "Time";
    columns.time_unit = "us";
    columns.kind = "Type";
    columns.samples_word = "SMP";
    columns.messages_word = "MSG";
    columns.zero_is_lost = true;
    const auto eye = [&](const std::string& which) -> GazeColumns::OfEye {
        if (!table.has(which + " POR X"))
            return {};
        return {which + " POR X", which + " POR Y",
                table.has(which + " Mapped Diameter")  ? which + " Mapped Diameter"
                : table.has(which + " Pupil Diameter") ? which + " Pupil Diameter"
                                                       : "",
                ""};
    };
    columns.left = eye("L");
    columns.right = eye("R");
    columns.trial = if_there(table, "Stimulus"); // of BeGaze
    return columns;
}

std::string text_at(const nlohmann::json& json, const char* key) {
    const auto found = json.find(key);
    return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// "…_physio.tsv.gz" with another ending.
fs::path beside(const fs::path& file, std::string_view ending, std::string_view other) {
    const std::string name = file.filename().string();
    return file.parent_path() / (name.substr(0, name.size() - ending.size()) + std::string(other));
}

constexpr std::string_view physio_ending = "_physio.tsv.gz", events_ending = "_physioevents.tsv.gz";

GazeColumns bids_columns(const fs::path& file, bool is_of_events) {
    const fs::path side_car = beside(file, ".tsv.gz", ".json");
    nlohmann::json json;
    try {
        json = nlohmann::json::parse(read_whole_file(side_car));
        if (!json.is_object())
            throw InputError("");
    } catch (const std::exception&) {
        throw InputError(fmt::format("{}: cannot be read as JSON: BIDS names the columns of {} there",
                                     side_car.string(), file.filename().string()));
    }
    GazeColumns columns;
    columns.program = text_at(json, "Manufacturer") + (json.contains("Manufacturer") ? " " : "") +
                      text_at(json, "ManufacturersModelName");
    for (const auto& name : json.value("Columns", nlohmann::json::array()))
        columns.names.push_back(name.is_string() ? name.get<std::string>() : std::string());
    if (columns.names.size() < 2)
        throw InputError(fmt::format("{}: \"Columns\" is missing", side_car.string()));
    if (const auto start = json.find("StartTime"); start != json.end() && start->is_number())
        columns.start_s = start->get<double>();
    columns.time = is_of_events ? "onset" : "timestamp";
    const std::string unit =
        json.contains(columns.time) ? text_at(json[columns.time], "Units") : std::string();
    columns.time_unit = unit == "us" || unit == "ms" || unit == "s" || unit == "ns" ? unit : "";
    if (is_of_events) {
        columns.mark = "message";
        return columns;
    }
    const std::string of_place =
        json.contains("x_coordinate") ? text_at(json["x_coordinate"], "Units") : "pixel";
    if (!of_place.starts_with("pix") && of_place != "px" && !of_place.starts_with("deg") &&
        of_place != "normalized")
        throw InputError(
            fmt::format("{}: x_coordinate is in \"{}\": pixel, degree and normalized are understood",
                        side_car.string(), of_place));
    columns.unit = of_place.starts_with("deg") ? "degrees" : of_place == "normalized" ? "normalised" : "px";
    columns.single = {"x_coordinate", "y_coordinate", "", ""};
    if (std::ranges::find(columns.names, "pupil_size") != columns.names.end())
        columns.single.pupil = "pupil_size";
    const std::string eye = text_at(json, "RecordedEye");
    columns.single_eye = eye == "left" ? Eye::left : Eye::right;
    if (eye == "cyclopean")
        columns.remarks.emplace_back(
            "Gaze is that of both eyes as one (cyclopean): it is taken for the right eye's.");
    if (const fs::path events = beside(file, physio_ending, events_ending); fs::exists(events))
        columns.marks.push_back(events);
    const std::string name = file.filename().string();
    const std::size_t before_ending = std::min(name.find("_recording-"), name.size() - physio_ending.size());
    if (const fs::path log = file.parent_path() / (name.substr(0, before_ending) + "_events.tsv");
        fs::exists(log))
        columns.trials = log;
    if (const std::size_t at = name.find("_recording-eye1_"); at != std::string::npos) {
        std::string other = name;
        other.replace(at, 16, "_recording-eye2_");
        if (fs::exists(file.parent_path() / other))
            columns.other_eye = file.parent_path() / other;
    }
    return columns;
}

} // namespace

GazeColumns known_gaze_columns(const fs::path& file, bool takes_any_gaze) {
    const std::string name = file.filename().string();
    if (name.ends_with(physio_ending) || name.ends_with(events_ending))
        return bids_columns(file, name.ends_with(events_ending));
    const ForeignTable table(file);
    const auto has_any_in_px = [&](std::initializer_list<const char*> names) {
        return std::ranges::any_of(names,
                                   [&](const char* of) { return table.has(in_display_px(table, of)); });
    };
    if (table.has("Recording timestamp") &&
        has_any_in_px({"Gaze point left X", "Gaze point right X", "Gaze point X"}))
        return tobii_columns(table);
    if (table.has("RecordingTimestamp") && has_any_in_px({"GazePointLeftX", "GazePointRightX", "GazePointX"}))
        return tobii_studio_columns(table);
    if (table.has("TIME") && (table.has("BPOGX") || table.has("LPOGX")))
        return gazepoint_columns(table);
    if (table.has("gaze_timestamp") && table.has("x_norm"))
        return pupil_surface_columns();
    if (table.has(neon_x) && table.has("timestamp"))
        return neon_surface_columns();
    if ((table.has("norm_pos_x") && table.has("confidence")) ||
        (table.has("gaze x") && table.has("gaze y") && table.has("timestamp")))
        return pupil_world_columns(table, takes_any_gaze);
    if (table.has("label") && table.has("timestamp"))
        return mark_columns("Pupil Core", "timestamp", "label");
    if (table.has("name") && table.has("timestamp") && table.has("recording id")) {
        GazeColumns columns = mark_columns("Pupil Labs Neon", "timestamp", "name");
        columns.time_unit = "ns";
        return columns;
    }
    if (table.has("Type") && table.has("Time") && (table.has("L POR X") || table.has("R POR X")))
        return smi_columns(table);
    throw InputError(fmt::format("{}: is a table of no program that is known by its columns (Tobii Pro Lab, "
                                 "Tobii Studio, Gazepoint, Pupil, Neon, SMI, BIDS): say "
                                 "which columns are which, --columns time=NAME,x=NAME,y=NAME; it has {}",
                                 file.string(), table.columns_in_words()));
}

GazeColumns gaze_columns_of(const std::vector<std::string>& words) {
    GazeColumns columns;
    columns.program = "another program";
    const auto true_word = [](const std::string& word) {
        return word == "yes" || word == "true" || word == "1";
    };
    for (const auto& [key, value] : column_words(words,
                                                 {"time",
                                                  "x",
                                                  "y",
                                                  "pupil",
                                                  "validity",
                                                  "left_x",
                                                  "left_y",
                                                  "left_pupil",
                                                  "left_validity",
                                                  "right_x",
                                                  "right_y",
                                                  "right_pupil",
                                                  "right_validity",
                                                  "eye",
                                                  "mark",
                                                  "trial",
                                                  "time_unit",
                                                  "unit",
                                                  "valid",
                                                  "least_validity",
                                                  "y_up",
                                                  "zero_is_lost",
                                                  "program"},
                                                 "--columns")) {
        GazeColumns::OfEye& of = key.starts_with("left_")    ? columns.left
                                 : key.starts_with("right_") ? columns.right
                                                             : columns.single;
        const std::string of_eye = key.starts_with("left_")    ? key.substr(5)
                                   : key.starts_with("right_") ? key.substr(6)
                                                               : key;
        if (of_eye == "x")
            of.x = value;
        else if (of_eye == "y")
            of.y = value;
        else if (of_eye == "pupil")
            of.pupil = value;
        else if (of_eye == "validity")
            of.validity = value;
        else if (key == "time")
            columns.time = value;
        else if (key == "eye")
            columns.eye = value;
        else if (key == "mark")
            columns.mark = value;
        else if (key == "trial")
            columns.trial = value;
        else if (key == "time_unit")
            columns.time_unit = value;
        else if (key == "unit")
            columns.unit = value;
        else if (key == "valid")
            columns.valid = value;
        else if (key == "y_up")
            columns.y_goes_up = true_word(value);
        else if (key == "zero_is_lost")
            columns.zero_is_lost = true_word(value);
        else if (key == "program")
            columns.program = value;
        else if (const auto least = number_in_cell(value))
            columns.least_validity = *least;
        else
            throw InputError(fmt::format("--columns least_validity={}: is no number", value));
    }
    if (columns.time.empty() || columns.is_of_marks_alone())
        throw InputError("--columns: time and x, y (or left_x, left_y, right_x, right_y) have to be named");
    for (const GazeColumns::OfEye* eye : {&columns.left, &columns.right, &columns.single})
        if (eye->x.empty() != eye->y.empty())
            throw InputError("--columns: x and y go together");
    if (columns.unit != "px" && columns.unit != "normalised" && columns.unit != "degrees")
        throw InputError(
            fmt::format("--columns unit={}: places are in px, normalised (0 to 1 of the screen) or "
                        "degrees (from the middle of the screen)",
                        columns.unit));
    return columns;
}

} // namespace overt
