#include "experiment/record/bids/bids_tracker.h"

#include <optional>

#include <nlohmann/json.hpp>

#include "experiment/ports/event_kinds.h"
#include "experiment/record/asc/asc_words.h"

namespace overt {
namespace {

struct Validations {
    int count = 0;
    double mean_deg = 0.0, max_deg = 0.0; ///< of the last
    std::string type;                     ///< such as HV9
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

void take(Validations& validations, std::string_view text, std::string_view mean, std::string_view max) {
    const auto mean_deg = number_before(text, mean), max_deg = number_before(text, max);
    if (!mean_deg || !max_deg)
        return;
    ++validations.count;
    validations.mean_deg = *mean_deg;
    validations.max_deg = *max_deg;
}

Validations validations_of(const SessionRecord& record, int run, bool is_imported) {
    Validations validations;
    if (!is_imported) {
        record.read_events([&](const RecordedEvent& event) {
            // "mean error 0.312 deg, largest 0.754 deg"
            if (event.sitting == run && event.kind == validation_event)
                take(validations, event.detail, "deg,", "deg");
        });
        return validations;
    }
    const auto take_message = [&](const GazeEvent& event) {
        constexpr std::string_view beginning = "!CAL VALIDATION ";
        if (event.kind != GazeEvent::Kind::message || !event.text.starts_with(beginning))
            return;
        take(validations, event.text, "avg.", "max");
        validations.type = Words(std::string_view(event.text).substr(beginning.size())).next();
    };
    record.read_gaze_events_outside(take_message);
    for (const TrialRecord& trial : record.trials())
        if (trial.sitting == run)
            record.read_gaze_events(trial, take_message);
    return validations;
}

} // namespace

nlohmann::ordered_json bids_tracker(const SessionRecord& record, int run) {
    const SessionHeader& header = record.header();
    const std::optional<GazeSource> source = record.gaze_source(run);
    nlohmann::ordered_json json;
    json["SamplingFrequency"] =
        source && source->rate_hz > 0.0 ? source->rate_hz : header.tracker.sample_rate_hz;
    json["ManufacturersModelName"] = header.tracker.name;
    if (header.tracker.name.starts_with("EyeLink") || source) {
        json["Manufacturer"] = "SR Research";
        json["EyeTrackingMethod"] = "P-CR";
    }
    const Validations validations = validations_of(record, run, source.has_value());
    if (validations.count > 0) {
        json["CalibrationCount"] = validations.count;
        json["AverageCalibrationError"] = validations.mean_deg;
        json["MaximalCalibrationError"] = validations.max_deg;
    }
    if (!validations.type.empty())
        json["CalibrationType"] = validations.type;
    json["TaskName"] = header.protocol.title.empty() ? header.protocol.name : header.protocol.title;
    return json;
}

} // namespace overt
