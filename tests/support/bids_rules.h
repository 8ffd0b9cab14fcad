/// The rules of BIDS 1.11 for behavioural data with eye tracking, checked on a dataset's files without the
/// program's own code. Each finding names the rule, so that a test can ask for one.
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/support/gzip_file.h"

namespace overt::testing {

struct BidsFinding {
    std::string rule, place;
};

class BidsRules {
  public:
    explicit BidsRules(const std::filesystem::path& dataset) : root_(dataset) {
        check_dataset(dataset, "raw");
        check_participants();
        check_tree(dataset);
        if (const auto derivative = dataset / "derivatives" / "overt"; std::filesystem::exists(derivative)) {
            check_dataset(derivative, "derivative");
            check_tree(derivative);
        }
    }

    const std::vector<BidsFinding>& findings() const { return findings_; }
    bool breaks(const std::string& rule) const {
        return std::any_of(findings_.begin(), findings_.end(),
                           [&](const auto& one) { return one.rule == rule; });
    }
    std::string text() const {
        std::string text;
        for (const BidsFinding& finding : findings_)
            text += finding.rule + ": " + finding.place + "\n";
        return text;
    }
    int recordings() const { return recordings_; }

  private:
    using Json = nlohmann::json;
    using Rows = std::vector<std::vector<std::string>>;

    void found(const std::string& rule, const std::filesystem::path& place) {
        findings_.push_back({rule, std::filesystem::relative(place, root_).string()});
    }
    static Rows rows_of(const std::string& text) {
        Rows rows;
        std::istringstream stream(text);
        for (std::string line; std::getline(stream, line);) {
            rows.emplace_back();
            std::istringstream cells(line + '\t');
            for (std::string cell; std::getline(cells, cell, '\t');)
                rows.back().push_back(cell);
        }
        return rows;
    }
    static std::optional<double> number(const std::string& cell) {
        static const std::regex decimal(R"(-?\d+(\.\d+)?([eE][-+]?\d+)?)");
        return std::regex_match(cell, decimal) ? std::optional(std::stod(cell)) : std::nullopt;
    }
    Json json_of(const std::filesystem::path& file) {
        if (!std::filesystem::exists(file)) {
            found("SIDECAR_MISSING", file);
            return Json::object();
        }
        const Json json = Json::parse(bytes_of(file), nullptr, false);
        if (!json.is_object())
            found("JSON_INVALID", file);
        return json.is_object() ? json : Json::object();
    }
    void require(const Json& json, const char* key, const char* rule, const std::filesystem::path& place) {
        if (!json.contains(key))
            found(rule, place);
    }

    void check_dataset(const std::filesystem::path& dataset, const std::string& type) {
        const std::filesystem::path file = dataset / "dataset_description.json";
        const Json json = json_of(file);
        require(json, "Name", "DATASET_NAME", file);
        require(json, "BIDSVersion", "DATASET_VERSION", file);
        if (json.value("DatasetType", "") != type)
            found("DATASET_TYPE", file);
        if (!json.contains("GeneratedBy") || !json["GeneratedBy"].is_array() || json["GeneratedBy"].empty() ||
            !json["GeneratedBy"][0].contains("Name"))
            found("GENERATED_BY", file);
        if (!std::filesystem::exists(dataset / "README.md") || bytes_of(dataset / "README.md").size() < 150)
            found("README", dataset);
    }

    void check_participants() {
        const Rows rows = rows_of(bytes_of(root_ / "participants.tsv"));
        if (rows.empty() || rows[0].empty() || rows[0][0] != "participant_id") {
            found("PARTICIPANT_ID_FIRST", root_ / "participants.tsv");
            return;
        }
        const Json json = json_of(root_ / "participants.json");
        for (const std::string& name : rows[0])
            require(json, name.c_str(), "COLUMN_UNDESCRIBED", root_ / "participants.tsv");
        for (std::size_t i = 1; i < rows.size(); ++i) {
            if (rows[i].size() != rows[0].size())
                found("ROW_LENGTH", root_ / "participants.tsv");
            if (!participants_.insert(rows[i][0]).second)
                found("PARTICIPANT_TWICE", root_ / "participants.tsv");
            check_levels(rows, i, json, root_ / "participants.tsv");
        }
        for (const auto& entry : std::filesystem::directory_iterator(root_))
            if (const std::string name = entry.path().filename().string();
                name.starts_with("sub-") && !participants_.contains(name))
                found("PARTICIPANT_MISSING", entry.path());
    }

    void check_levels(const Rows& rows, std::size_t i, const Json& json, const std::filesystem::path& file) {
        for (std::size_t column = 0; column < std::min(rows[0].size(), rows[i].size()); ++column) {
            const std::string &name = rows[0][column], &cell = rows[i][column];
            if (cell.empty())
                found("EMPTY_CELL", file);
            if (cell != "n/a" && json.contains(name) && json[name].contains("Levels") &&
                !json[name]["Levels"].contains(cell))
                found("VALUE_NOT_IN_LEVELS", file);
        }
    }

    void check_tree(const std::filesystem::path& dataset) {
        static const std::regex name(
            R"(sub-([A-Za-z0-9]+)_ses-([A-Za-z0-9]+)_task-[A-Za-z0-9]+(_acq-[A-Za-z0-9]+)?_run-\d+)"
            R"((_recording-eye[123])?_(physio|physioevents|events)\.(tsv|tsv\.gz|json))");
        for (const auto& entry : std::filesystem::recursive_directory_iterator(dataset)) {
            const std::filesystem::path& file = entry.path();
            const std::string relative = std::filesystem::relative(file, dataset).string();
            if (!entry.is_regular_file() || !relative.starts_with("sub-"))
                continue;
            std::smatch match;
            const std::string file_name = file.filename().string();
            if (!std::regex_match(file_name, match, name)) {
                found("FILE_NAME", file);
                continue;
            }
            if (relative != fmt_path(match[1], match[2]) + file_name)
                found("FILE_PLACE", file);
            const std::string suffix = match[5], ending = match[6];
            const bool is_packed = ending == "tsv.gz";
            if (suffix == "events" ? is_packed : ending == "tsv")
                found("FILE_NAME", file);
            if (suffix != "events" && !match[4].matched)
                found("RECORDING_MISSING", file);
            if (is_packed && !is_anonymous_gzip(file))
                found("GZIP_HEADER", file);
            if (suffix == "physio" && is_packed)
                check_physio(file, file_name, dataset == root_);
            if (suffix == "physioevents" && is_packed)
                check_physioevents(file);
            if (suffix == "events" && ending == "tsv")
                check_events(file);
        }
    }
    static std::string fmt_path(const std::string& subject, const std::string& session) {
        return "sub-" + subject + "/ses-" + session + "/beh/";
    }
    static std::filesystem::path side_car(const std::filesystem::path& file) {
        std::string path = file.string();
        return path.substr(0, path.find(".tsv")) + ".json";
    }

    /// Columns of a file without a header line: as the side car has them.
    std::vector<std::string> columns_of(const Json& json, const std::filesystem::path& file) {
        if (!json.contains("Columns") || !json["Columns"].is_array()) {
            found("COLUMNS", file);
            return {};
        }
        auto columns = json["Columns"].get<std::vector<std::string>>();
        if (std::set<std::string>(columns.begin(), columns.end()).size() != columns.size())
            found("COLUMNS", file);
        for (const std::string& column : columns)
            if (!json.contains(column) || !json[column].contains("Description"))
                found("COLUMN_UNDESCRIBED", file);
        return columns;
    }

    void check_physio(const std::filesystem::path& file, const std::string& name, bool is_raw) {
        ++recordings_;
        const std::filesystem::path json_file = side_car(file);
        const Json json = json_of(json_file);
        require(json, "SamplingFrequency", "SAMPLING_FREQUENCY", json_file);
        require(json, "StartTime", "START_TIME", json_file);
        if (json.contains("StartTime") && !json["StartTime"].is_number())
            found("START_TIME", json_file);
        if (json.value("PhysioType", "") != "eyetrack")
            found("PHYSIO_TYPE", json_file);
        if (const std::string eye = json.value("RecordedEye", "");
            eye != "left" && eye != "right" && eye != "cyclopean")
            found("RECORDED_EYE", json_file);
        if (json.value("SampleCoordinateSystem", "") != "gaze-on-screen")
            found("COORDINATE_SYSTEM", json_file);
        const std::vector<std::string> columns = columns_of(json, json_file);
        if (columns.size() < 3 || columns[0] != "timestamp" || columns[1] != "x_coordinate" ||
            columns[2] != "y_coordinate")
            found("COLUMN_ORDER", json_file);
        for (const char* column : {"x_coordinate", "y_coordinate"})
            if (!json.contains(column) || !json[column].contains("Units"))
                found("COORDINATE_UNITS", json_file);
        if (json.contains("pupil_size")) {
            const std::string description = json["pupil_size"].value("Description", "");
            if (description.find("area") == std::string::npos &&
                description.find("diameter") == std::string::npos)
                found("PUPIL_DESCRIPTION", json_file);
        }
        const Rows rows = rows_of(unpacked(file));
        double last = -1e300;
        for (const auto& row : rows) {
            if (row.size() != columns.size())
                found("ROW_LENGTH", file);
            const std::optional<double> time = number(row[0]);
            if (!time)
                found("HEADER_LINE_OR_BAD_TIME", file);
            else if (*time <= last)
                found("TIMESTAMPS_UNSORTED", file);
            last = time.value_or(last);
            for (std::size_t i = 0; i < std::min<std::size_t>(row.size(), is_raw ? 4 : 3); ++i)
                if (row[i] != "n/a" && !number(row[i]))
                    found("NOT_A_NUMBER", file);
        }
        check_stimulus_presentation(file.parent_path() /
                                    (name.substr(0, name.find("_recording")) + "_events.json"));
    }

    void check_stimulus_presentation(const std::filesystem::path& file) {
        const Json json = json_of(file);
        const Json screen = json.value("StimulusPresentation", Json());
        const auto is_pair = [](const Json& value, bool whole) {
            return value.is_array() && value.size() == 2 && value[0].is_number() && value[1].is_number() &&
                   value[0] > 0 && value[1] > 0 && (!whole || value[0].is_number_integer());
        };
        if (!screen.is_object() || !screen.contains("ScreenDistance") ||
            !screen["ScreenDistance"].is_number() || screen["ScreenDistance"] <= 0.0 ||
            screen["ScreenDistance"] > 20.0)
            found("SCREEN_DISTANCE", file);
        if (!screen.is_object() || screen.value("ScreenOrigin", Json()) != Json({"top", "left"}))
            found("SCREEN_ORIGIN", file);
        if (!screen.is_object() || !is_pair(screen.value("ScreenResolution", Json()), true))
            found("SCREEN_RESOLUTION", file);
        if (!screen.is_object() || !is_pair(screen.value("ScreenSize", Json()), false) ||
            screen["ScreenSize"][0] > 20)
            found("SCREEN_SIZE", file);
    }

    void check_physioevents(const std::filesystem::path& file) {
        const std::filesystem::path json_file = side_car(file);
        const Json json = json_of(json_file);
        const std::vector<std::string> columns = columns_of(json, json_file);
        if (columns.empty() || columns[0] != "onset")
            found("ONSET_FIRST", json_file);
        const std::string physio = file.string().substr(0, file.string().find("events.tsv"));
        const Json samples = json_of(physio + ".json");
        const auto names = samples.value("Columns", std::vector<std::string>());
        if (std::find(names.begin(), names.end(), json.value("OnsetSource", "")) == names.end())
            found("ONSET_SOURCE", json_file);
        require(json, "Description", "EVENTS_DESCRIPTION", json_file);
        require(json, "TaskName", "TASK_DESCRIBED", json_file);
        if (json.contains("duration") && json["duration"].value("Units", "s") != "s")
            found("DURATION_UNITS", json_file);
        Rows rows = rows_of(unpacked(file));
        check_table(rows, columns, json, file, false);
    }

    void check_events(const std::filesystem::path& file) {
        const Json json = json_of(side_car(file));
        Rows rows = rows_of(bytes_of(file));
        if (rows.empty() || rows[0].size() < 2 || rows[0][0] != "onset" || rows[0][1] != "duration") {
            found("ONSET_DURATION_FIRST", file);
            return;
        }
        const std::vector<std::string> columns = rows[0];
        for (const std::string& column : columns)
            if (!json.contains(column))
                found("COLUMN_UNDESCRIBED", file);
        for (const char* key : {"TaskName", "Instructions", "TaskDescription"})
            require(json, key, "TASK_DESCRIBED", file);
        const auto stimulus = std::find(columns.begin(), columns.end(), "stim_file") - columns.begin();
        for (std::size_t i = 1; i < rows.size(); ++i)
            if (stimulus < static_cast<std::ptrdiff_t>(rows[i].size()))
                if (const std::string name = rows[i][static_cast<std::size_t>(stimulus)];
                    name != "n/a" && !std::filesystem::is_regular_file(root_ / "stimuli" / name))
                    found("STIMULUS_MISSING", file);
        rows.erase(rows.begin());
        check_table(rows, columns, json, file, true);
    }

    /// Rows without the names of their columns.
    void check_table(Rows rows, const std::vector<std::string>& columns, const Json& json,
                     const std::filesystem::path& file, bool may_be_negative) {
        double last = -1e300;
        rows.insert(rows.begin(), columns);
        for (std::size_t i = 1; i < rows.size(); ++i) {
            const auto& row = rows[i];
            if (row.size() != columns.size()) {
                found("ROW_LENGTH", file);
                continue;
            }
            const std::optional<double> onset = number(row[0]);
            if (!onset || (!may_be_negative && *onset < 0.0))
                found("ONSET_NUMBER", file);
            else if (*onset < last)
                found("EVENTS_UNSORTED", file);
            last = onset.value_or(last);
            const std::optional<double> duration = number(row[1]);
            if (row[1] != "n/a" && (!duration || *duration < 0.0))
                found("DURATION", file);
            check_levels(rows, i, json, file);
        }
    }

    std::filesystem::path root_;
    std::vector<BidsFinding> findings_;
    std::set<std::string> participants_;
    int recordings_ = 0;
};

} // namespace overt::testing
