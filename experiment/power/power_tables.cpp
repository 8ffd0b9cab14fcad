#include "experiment/power/power_tables.h"

#include <nlohmann/json.hpp>

#include "experiment/base/json_text.h"
#include "experiment/base/whole_file.h"
#include "experiment/record/tables/export_tables.h"
#include "experiment/study/study_columns.h"

namespace overt {

namespace {

using Json = nlohmann::ordered_json;

constexpr int share_digits = 4, estimate_digits = 6;

struct CurveRow {
    const PowerCurve& curve;
    const PowerPoint& point;
};

struct OutcomeRow {
    const PowerCurve& curve;
    const PowerPoint& point;
    int study; ///< from 1
    const StudyOutcome& outcome;
};

template <class Row> StudyColumns<Row> effect_columns() {
    return joined_columns<Row>(text_column<Row>("effect",
                                                "What was planted and is tested, as --effect takes it",
                                                [](const Row& row) { return row.curve.effect.text(); }),
                               count_column<Row>("observers", "Observers of a study",
                                                 [](const Row& row) { return row.point.observers; }));
}

RowLayout<CurveRow> curve_layout() {
    using Row = CurveRow;
    const auto number = [](const char* name, const char* meaning, auto value) {
        return number_column<Row>(name, meaning, "", share_digits, [value](const Row& row) {
            return std::optional<double>(value(row.point));
        });
    };
    return {"power_curve", "How many of the simulated studies found the effect, by number of observers.",
            joined_columns<Row>(
                effect_columns<Row>(),
                count_column<Row>("studies", "Simulated studies",
                                  [](const Row& row) { return static_cast<int>(row.point.studies.size()); }),
                count_column<Row>("found", "Of these, with p at most alpha",
                                  [](const Row& row) { return row.point.found; }),
                count_column<Row>("without_test", "Of these, with nothing to test; they count as not found",
                                  [](const Row& row) { return row.point.without_test; }),
                number("power", "Share that found the effect", [](const PowerPoint& p) { return p.share(); }),
                number("power_low", "Lower end of its interval of 95 % (Wilson)",
                       [](const PowerPoint& p) { return p.interval.low; }),
                number("power_high", "Upper end of its interval of 95 % (Wilson)",
                       [](const PowerPoint& p) { return p.interval.high; }),
                number_column<Row>(
                    "median_estimate",
                    "Median over studies of the estimated difference of head fractions, difference of WSS in "
                    "mm^2, or CC",
                    "", estimate_digits,
                    [](const Row& row) { return std::optional<double>(row.point.median_estimate); }))};
}

RowLayout<OutcomeRow> outcome_layout() {
    using Row = OutcomeRow;
    return {"power_studies", "The test of each effect in each simulated study.",
            joined_columns<Row>(effect_columns<Row>(),
                                count_column<Row>("study",
                                                  "Number of the study; one with fewer observers has the "
                                                  "first of those of one with more",
                                                  [](const Row& row) { return row.study; }),
                                number_column<Row>("p", "Of the test", "", estimate_digits,
                                                   [](const Row& row) { return row.outcome.p; }),
                                number_column<Row>("estimate",
                                                   "Difference of head fractions, difference of WSS in mm^2, "
                                                   "or CC",
                                                   "", estimate_digits,
                                                   [](const Row& row) { return row.outcome.estimate; }))};
}

template <class Row> void describe(Json& dictionary, const RowLayout<Row>& layout, TableFormat format) {
    dictionary[layout.table().name + "." + std::string(ending_of(format))] = {
        {"Description", layout.table().description},
        {"Columns", describe_columns(layout.table().columns, format)}};
}

} // namespace

std::string power_json(const PowerResults& results) {
    Json json{{"protocol", results.protocol}, {"trials_per_observer", results.trials},
              {"studies", results.studies},   {"alpha", results.alpha},
              {"target", results.target},     {"parameters", Json::array()},
              {"remarks", results.remarks},   {"effects", Json::array()}};
    for (const StudyParameter& parameter : results.parameters)
        json["parameters"].push_back({{"name", parameter.name},
                                      {"value", parameter.value},
                                      {"unit", parameter.unit},
                                      {"meaning", parameter.meaning}});
    for (const PowerCurve& curve : results.curves) {
        Json one{{"effect", curve.effect.text()}, {"answer", answer_of(curve, results)},
                 {"planted", curve.planted},      {"analysis", curve.analysis},
                 {"observers_needed", nullptr},   {"curve", Json::array()}};
        if (const std::optional<int> needed = observers_needed(curve, results.target))
            one["observers_needed"] = *needed;
        for (const PowerPoint& point : curve.points)
            one["curve"].push_back({{"observers", point.observers},
                                    {"found", point.found},
                                    {"without_test", point.without_test},
                                    {"power", point.share()},
                                    {"interval", {point.interval.low, point.interval.high}},
                                    {"median_estimate", point.median_estimate}});
        json["effects"].push_back(std::move(one));
    }
    return json_text(json);
}

void write_power_tables(const PowerResults& results, const std::filesystem::path& folder,
                        TableFormat format) {
    const RowLayout<CurveRow> curves = curve_layout();
    const RowLayout<OutcomeRow> outcomes = outcome_layout();
    TableWriter curve_file(folder, curves.table(), format), outcome_file(folder, outcomes.table(), format);
    for (const PowerCurve& curve : results.curves) {
        for (const PowerPoint& point : curve.points) {
            curves.write(curve_file, CurveRow{curve, point});
            for (std::size_t study = 0; study < point.studies.size(); ++study)
                outcomes.write(outcome_file,
                               OutcomeRow{curve, point, static_cast<int>(study) + 1, point.studies[study]});
        }
    }
    curve_file.close();
    outcome_file.close();
    Json dictionary = Json::object();
    describe(dictionary, curves, format);
    describe(dictionary, outcomes, format);
    write_whole_file(folder / "dictionary.json", json_text(dictionary));
    write_whole_file(folder / "power.json", power_json(results));
}

bool is_power_table(const std::string& file) {
    const std::string name = file.substr(0, file.find('.'));
    return name == "power_curve" || name == "power_studies" || file == "dictionary.json" ||
           file == "power.json";
}

} // namespace overt
