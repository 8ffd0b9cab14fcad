#include "experiment/power/power_tables.h"

#include <nlohmann/json.hpp>

#include "experiment/base/json_text.h"
#include "experiment/base/whole_file.h"
#include "experiment/record/tables/export_tables.h"
#include "experiment/study/tables/study_layout.h"

namespace overt {

namespace {

using Json = nlohmann::ordered_json;

constexpr int share_digits = 4;

struct CurveRow {
    const PowerCurve& curve;
    const PowerPoint& point;
    std::size_t look() const { return static_cast<std::size_t>(&point - curve.points.data()); }
};

struct OutcomeRow {
    const PowerCurve& curve;
    const PowerPoint& point;
    int study; ///< from 1
    const StudyOutcome& outcome;
};

template <class Row> void add_effect(StudyLayout<Row>& to) {
    to.text("effect", "What was planted and is tested, as --effect takes it",
            [](const Row& row) { return row.curve.effect.text(); });
    to.count("observers", "Observers of a study", [](const Row& row) { return row.point.observers; });
}

RowLayout<CurveRow> curve_layout() {
    const auto of_point = [](auto what) {
        return [what](const CurveRow& row) { return std::invoke(what, row.point); };
    };
    StudyLayout<CurveRow> to("power_curve",
                             "How many of the simulated studies found the effect, by number of observers.");
    add_effect(to);
    to.count("studies", "Simulated studies", of_point([](auto& point) { return point.studies.size(); }));
    to.count("found", "Of these, with p at most alpha", of_point(&PowerPoint::found));
    to.count("without_test", "Of these, with nothing to test; they count as not found",
             of_point(&PowerPoint::without_test));
    to.count("observers_without_measure",
             "Simulated observers of all the studies who do not have the measure in both levels, such as a "
             "threshold or a slope that could not be fitted; the tests are without them. Of gaze always 0",
             of_point(&PowerPoint::without_measure));
    to.number("power", "Share that found the effect", "", of_point(&PowerPoint::share), share_digits);
    to.number("power_low", "Lower end of its interval of 95 % (Wilson)", "",
              of_point([](auto& point) { return point.interval.low; }), share_digits);
    to.number("power_high", "Upper end of its interval of 95 % (Wilson)", "",
              of_point([](auto& point) { return point.interval.high; }), share_digits);
    to.number("median_estimate",
              "Median over studies of the estimated difference of shares of fixations, difference of WSS in "
              "deg^2, or CC; of tests of factors their statistic, of clusters their number",
              "", of_point(&PowerPoint::median_estimate));
    to.number("look_level", "With --sequential: a study ends with so many observers if p is at most this", "",
              [](const CurveRow& row) {
                  return row.curve.sequential ? std::optional(row.curve.sequential->levels[row.look()])
                                              : std::nullopt;
              });
    to.number(
        "found_up_to_look",
        "With --sequential: share of the studies that found the effect at this look or an "
        "earlier one",
        "",
        [](const CurveRow& row) {
            return row.curve.sequential ? std::optional(row.curve.sequential->found[row.look()] /
                                                        static_cast<double>(row.point.studies.size()))
                                        : std::nullopt;
        },
        share_digits);
    return to;
}

RowLayout<OutcomeRow> outcome_layout() {
    StudyLayout<OutcomeRow> to("power_studies", "The test of each effect in each simulated study.");
    add_effect(to);
    to.count("study", "Number of the study; one with fewer observers has the first of those of one with more",
             &OutcomeRow::study);
    to.number("p", "Of the test", "", [](const OutcomeRow& row) { return row.outcome.p; });
    to.count("observers_without_measure", "Observers of the study without the measure in both levels",
             [](const OutcomeRow& row) { return row.outcome.without_measure; });
    to.number("estimate", "Difference of shares of fixations, difference of WSS in deg^2, or CC", "",
              [](const OutcomeRow& row) { return row.outcome.estimate; });
    return to;
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
        if (curve.sequential)
            one["sequential"] = {
                {"spending", name_of(*results.sequential)},
                {"levels", curve.sequential->levels},
                {"found", curve.sequential->found},
                {"interval", {curve.sequential->interval.low, curve.sequential->interval.high}},
                {"mean_observers", curve.sequential->mean_observers}};
        for (const PowerPoint& point : curve.points)
            one["curve"].push_back({{"observers", point.observers},
                                    {"found", point.found},
                                    {"without_test", point.without_test},
                                    {"observers_without_measure", point.without_measure},
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
    describe_table(dictionary, curves.table(), format);
    describe_table(dictionary, outcomes.table(), format);
    write_whole_file(folder / "dictionary.json", json_text(dictionary));
    write_whole_file(folder / "power.json", power_json(results));
}

bool is_power_table(const std::string& file) {
    const std::string name = file.substr(0, file.find('.'));
    return name == "power_curve" || name == "power_studies" || file == "dictionary.json" ||
           file == "power.json";
}

} // namespace overt
