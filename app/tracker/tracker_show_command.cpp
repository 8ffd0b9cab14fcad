#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/inputs/session_folders.h"
#include "app/tracker/calibration_text.h"
#include "app/tracker/tracker_commands.h"
#include "experiment/base/error.h"
#include "experiment/record/read/session_record.h"

namespace overt {

namespace {

const char* word_of(Eye eye) { return eye == Eye::left ? "left" : "right"; }

nlohmann::ordered_json degrees(const std::optional<Degrees>& angle) {
    return angle ? nlohmann::ordered_json(angle->value) : nlohmann::ordered_json();
}

nlohmann::ordered_json json_of(int sitting, const RecordedCalibration& calibration) {
    auto targets = nlohmann::ordered_json::array();
    for (const ValidatedTarget& target : calibration.validation.targets) {
        nlohmann::ordered_json item{
            {"eye", word_of(target.eye)}, {"x_px", target.target.x_px}, {"y_px", target.target.y_px}};
        item["gaze_x_px"] =
            target.gaze ? nlohmann::ordered_json(target.gaze->x_px) : nlohmann::ordered_json();
        item["gaze_y_px"] =
            target.gaze ? nlohmann::ordered_json(target.gaze->y_px) : nlohmann::ordered_json();
        item["error_deg"] = target.gaze ? degrees(target.error) : nlohmann::ordered_json();
        item["rms_s2s_deg"] = degrees(target.rms_s2s);
        item["sd_deg"] = degrees(target.sd);
        targets.push_back(std::move(item));
    }
    return {{"sitting", sitting},
            {"at_s", to_seconds(calibration.at - SessionTime())},
            {"method", calibration.method},
            {"mean_error_deg", calibration.validation.mean_error.value},
            {"max_error_deg", calibration.validation.max_error.value},
            {"within_limits", calibration.is_within_limits},
            {"targets", std::move(targets)}};
}

} // namespace

int run_tracker_show(const TrackerShowOptions& options) {
    const SessionRecord record(session_in(options.session));
    auto json = nlohmann::ordered_json::array();
    std::optional<RecordedCalibration> last;
    for (int sitting = 1; !record.started_utc(sitting).empty(); ++sitting) {
        for (RecordedCalibration& calibration : record.calibrations(sitting)) {
            if (options.json) {
                json.push_back(json_of(sitting, calibration));
            } else {
                fmt::print("sitting {}, {:.1f} s: ", sitting, to_seconds(calibration.at - SessionTime()));
                print_calibration(calibration);
            }
            last = std::move(calibration);
        }
    }
    if (options.json)
        fmt::print("{}\n", json.dump(2));
    if (!last)
        throw InputError(
            fmt::format("{}: has no calibration: it was recorded without an eye tracker, or by a "
                        "program that did not keep them",
                        options.session.string()));
    if (!options.picture.empty()) {
        draw_validation(*last, record.header().display.screen, options.picture);
        fmt::print(options.json ? stderr : stdout, "picture: {}\n", options.picture.string());
    }
    return 0;
}

} // namespace overt
