#include "experiment/record/bids/bids_tracker.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "experiment/record/asc/asc_words.h"
#include "experiment/record/bids/bids_names.h"
#include "experiment/record/read/recorded_validation.h"
#include "experiment/record/read/tracker_facts.h"

namespace overt {
namespace {

/// Of one eye, in one run.
struct Calibrations {
    int count = 0;
    std::optional<ValidationResult> validation; ///< the last
    std::string type;                           ///< of the last calibration, such as HV9; empty: not known
    std::string method;                 ///< of tracking, as an imported recording has it; empty: not known
    std::vector<ScreenPoint> validated; ///< targets of the last validation, which may be others
};

/// The number before a word: 0.31 of "ERROR 0.31 avg.".
std::optional<double> number_before(std::string_view text, std::string_view word) {
    const std::size_t end = text.find(word);
    if (end == std::string_view::npos || end < 2)
        return std::nullopt;
    const std::size_t last = text.find_last_not_of(' ', end - 1);
    const std::size_t blank = text.find_last_of(' ', last);
    return blank == std::string_view::npos ? std::nullopt : number_of(text.substr(blank + 1, last - blank));
}

/// Of "(HV9,P-CR)" in ">>>>>>> CALIBRATION (HV9,P-CR) FOR LEFT: <<<<<<<<<".
void take_calibration(Calibrations& calibrations, std::string_view text) {
    const std::size_t begin = text.find('(') + 1, end = text.find(')', begin);
    const std::string_view inside = text.substr(begin, std::min(end, text.size()) - begin);
    const std::string_view type = inside.substr(0, inside.find(','));
    // HV0: a program before this one wrote it of a calibration whose targets it did not know.
    calibrations.type = type == "HV0" ? "" : type;
}

/// The word by which the tracker says whether it takes the reflection on the cornea into account.
std::string_view method_called(std::string_view word) {
    return word == "CR" || word == "P-CR" ? "P-CR" : word == "P" ? "pupil alone" : "";
}

/// ">>>>>>> CALIBRATION (HV9,P-CR) FOR LEFT: <<<<<<<<<", "RECCFG CR 1000 2 1 L" and
/// "!CAL VALIDATION HV9 L LEFT  GOOD ERROR 0.31 avg. 0.75 max ..."
void take_line(Calibrations& calibrations, const GazeEvent& event, std::string_view eye) {
    const std::string_view text = event.text;
    if (event.kind == GazeEvent::Kind::note && text.starts_with(">>>") &&
        text.find(" CALIBRATION (") != std::string_view::npos &&
        (text.find(eye) != std::string_view::npos || text.find("BINOCULAR") != std::string_view::npos)) {
        ++calibrations.count;
        take_calibration(calibrations, text);
    }
    Words words(text);
    if (event.kind != GazeEvent::Kind::message)
        return;
    const std::string_view first = words.next();
    if (first == "RECCFG")
        calibrations.method = method_called(words.next());
    if (first != "!CAL" || words.next() != "VALIDATION")
        return;
    words.next();
    words.next();
    const auto mean_deg = number_before(text, "avg."), max_deg = number_before(text, "max");
    if (words.next() == eye && mean_deg && max_deg)
        calibrations.validation = {Degrees{*mean_deg}, Degrees{*max_deg}};
}

Calibrations calibrations_of(const SessionRecord& record, int run, Eye eye, bool is_imported) {
    Calibrations calibrations;
    if (const std::vector<RecordedCalibration> all = record.calibrations(run); !all.empty()) {
        calibrations.count = static_cast<int>(all.size());
        const ValidationOfEye last = validation_of_eye(all.back().validation, eye);
        calibrations.validation = {last.mean_error, last.max_error};
        for (const ValidatedTarget& target : last.targets)
            calibrations.validated.push_back(target.target);
        if (const std::optional<int> points = calibration_points(all.back().method))
            calibrations.type = fmt::format("HV{}", *points);
        return calibrations;
    }
    if (!is_imported) {
        record.read_events([&](const RecordedEvent& event) {
            if (const auto validation = event.sitting == run ? validation_of(event) : std::nullopt) {
                ++calibrations.count; // each ends with a validation
                calibrations.validation = validation;
            }
        });
        return calibrations;
    }
    const auto take = [&](const GazeEvent& event) {
        take_line(calibrations, event, eye == Eye::left ? "LEFT" : "RIGHT");
    };
    record.read_gaze_events_before(take);
    for (const TrialRecord& trial : record.trials())
        if (trial.sitting == run) {
            record.read_gaze_events(trial, take);
            record.read_gaze_events_after(trial, take);
        }
    return calibrations;
}

} // namespace

nlohmann::ordered_json bids_tracker(const SessionRecord& record, int run, Eye eye) {
    const SessionHeader& header = record.header();
    const std::optional<GazeSource> source = record.gaze_source(run);
    nlohmann::ordered_json json;
    json["SamplingFrequency"] =
        source && source->rate_hz > 0.0 ? source->rate_hz : header.tracker.sample_rate_hz;
    json["ManufacturersModelName"] = header.tracker.name;
    const TrackerFacts facts = tracker_facts(record, run);
    if (!facts.manufacturer.empty())
        json["Manufacturer"] = facts.manufacturer;
    const Calibrations calibrations = calibrations_of(record, run, eye, source.has_value());
    if (const std::string method = facts.method.empty() ? calibrations.method : std::string(facts.method);
        !method.empty())
        json["EyeTrackingMethod"] = method;
    if (calibrations.count > 0)
        json["CalibrationCount"] = calibrations.count;
    if (calibrations.validation) {
        json["AverageCalibrationError"] = calibrations.validation->mean_error.value;
        json["MaximalCalibrationError"] = calibrations.validation->max_error.value;
    }
    if (!calibrations.type.empty())
        json["CalibrationType"] = calibrations.type;
    // BIDS has no words for them: where the calibration's own targets were is not on record.
    if (!calibrations.validated.empty()) {
        json["ValidationUnit"] = "pixel";
        json["ValidationPosition"] = nlohmann::ordered_json::array();
        for (const ScreenPoint target : calibrations.validated)
            json["ValidationPosition"].push_back({target.x_px, target.y_px});
    }
    json["TaskName"] = bids_task_name(header);
    return json;
}

} // namespace overt
