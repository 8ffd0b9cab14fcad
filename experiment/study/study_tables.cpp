#include "experiment/study/study_tables.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "experiment/base/json_text.h"
#include "experiment/base/whole_file.h"
#include "experiment/record/tables/export_tables.h"
#include "experiment/study/mixed_models.h"
#include "experiment/study/study_layouts.h"

namespace overt {

namespace {

using Json = nlohmann::ordered_json;

class Tables {
  public:
    Tables(std::filesystem::path folder, TableFormat format) : folder_(std::move(folder)), format_(format) {}

    /// `each` calls what it is given with each row.
    template <class Row, class Each> void write(const RowLayout<Row>& layout, const Each& each) {
        TableWriter writer(folder_, layout.table(), format_);
        each([&](const Row& row) { layout.write(writer, row); });
        writer.close();
        dictionary_[layout.table().name + "." + std::string(ending_of(format_))] = {
            {"Description", layout.table().description},
            {"Columns", describe_columns(layout.table().columns, format_)}};
    }
    template <class Row> void write_all(const RowLayout<Row>& layout, const std::vector<Row>& rows) {
        write(layout, [&](const auto& take) {
            for (const Row& row : rows)
                take(row);
        });
    }

    const Json& dictionary() const { return dictionary_; }

  private:
    std::filesystem::path folder_;
    TableFormat format_;
    Json dictionary_ = Json::object();
};

Json keys_json(const std::vector<StudyKey>& keys) {
    Json json = Json::object();
    for (const StudyKey& key : keys)
        json[key.column] = key.value;
    return json;
}

} // namespace

std::string study_json(const StudyResults& results) {
    const StudyGlance& glance = results.glance;
    Json json{{"title", glance.title},
              {"observers", glance.observers},
              {"sessions", Json::array()},
              {"trials", glance.trials},
              {"excluded_trials", glance.excluded_trials},
              {"samples", glance.samples},
              {"fixations", glance.fixations},
              {"counted_fixations", glance.counted},
              {"only_by_reach", glance.only_by_reach},
              {"counted_s", glance.counted_s},
              {"not_counted", Json::object()},
              {"simulated", glance.any_simulated},
              {"by", results.by},
              {"parameters", Json::array()},
              {"remarks", results.remarks},
              {"sculptures", Json::array()},
              {"head_fractions", Json::array()}};
    for (const auto& [why, count] : glance.not_counted)
        json["not_counted"][std::string(name_of(why))] = count;
    for (const StudySession& session : results.sessions)
        json["sessions"].push_back({{"folder", session.folder},
                                    {"observer", session.observer},
                                    {"session", session.number},
                                    {"protocol", session.protocol},
                                    {"tracker", session.tracker},
                                    {"simulated", session.is_simulated},
                                    {"form", keys_json(session.form)},
                                    {"events", session.events},
                                    {"complete", session.is_complete},
                                    {"trials", session.trials}});
    for (const StudyParameter& parameter : results.parameters)
        json["parameters"].push_back({{"name", parameter.name},
                                      {"value", parameter.value},
                                      {"unit", parameter.unit},
                                      {"meaning", parameter.meaning}});
    for (const StudySculpture& sculpture : results.sculptures) {
        Json one{{"id", sculpture.id}, {"title", sculpture.title}};
        if (sculpture.mm_per_unit)
            one["mm_per_unit"] = *sculpture.mm_per_unit;
        if (sculpture.mm_per_deg)
            one["mm_per_deg"] = *sculpture.mm_per_deg;
        if (!sculpture.remark.empty())
            one["remark"] = sculpture.remark;
        json["sculptures"].push_back(std::move(one));
    }
    for (const HeadFractionRow& row : results.head_fractions) {
        Json one{{"keys", keys_json(row.keys)}, {"fixations", row.fixations}, {"observers", row.observers}};
        if (row.by_count.value)
            one["by_count"] = *row.by_count.value;
        if (row.by_count.interval)
            one["interval"] = {row.by_count.interval->low, row.by_count.interval->high};
        if (row.corrected.value)
            one["corrected"] = *row.corrected.value;
        if (row.corrected.interval)
            one["corrected_interval"] = {row.corrected.interval->low, row.corrected.interval->high};
        if (row.pooled)
            one["pooled"] = *row.pooled;
        json["head_fractions"].push_back(std::move(one));
    }
    return json_text(json);
}

void write_study_tables(const StudyResults& results, const std::filesystem::path& folder,
                        TableFormat format) {
    Tables tables(folder, format);
    const auto trial_of = [&](int index) -> const StudyTrial& {
        return results.trials[static_cast<std::size_t>(index)];
    };
    tables.write(study_fixations_layout(results), [&](const auto& take) {
        for (const StudyFixation& fixation : results.fixations)
            take(FixationRow{fixation, trial_of(fixation.trial)});
    });
    tables.write(study_trials_layout(results), [&](const auto& take) {
        for (const StudyTrial& trial : results.trials)
            take(trial_summary(results, trial));
    });
    tables.write_all(head_fractions_layout(results), results.head_fractions);
    tables.write_all(distributions_layout(results), results.distributions);
    tables.write_all(pairs_layout(results), results.pairs);
    tables.write_all(time_course_layout(results), results.time_course);
    tables.write_all(study_maps_layout(results), results.maps);
    // A table without a row would look like a result.
    if (!results.effects.empty())
        tables.write_all(factor_effects_layout(results), results.effects);
    if (!results.motions.empty())
        tables.write_all(gaze_motion_layout(results), results.motions);
    if (!results.lights.empty())
        tables.write_all(light_at_gaze_layout(results), results.lights);
    if (!results.exposures.empty())
        tables.write_all(exposure_layout(results), results.exposures);
    if (!results.predictions.empty())
        tables.write_all(map_predictions_layout(results), results.predictions);
    if (!results.reliabilities.empty())
        tables.write_all(map_reliability_layout(results), results.reliabilities);
    if (!results.differences.empty()) {
        tables.write(clusters_layout(results), [&](const auto& take) {
            for (const DifferenceMap& map : results.differences) {
                int number = 0;
                for (const DifferenceMap::Cluster& cluster : map.clusters)
                    take(ClusterRow{map, &cluster, ++number});
                if (number == 0)
                    take(ClusterRow{map, nullptr, 0});
            }
        });
    }
    tables.write(quality_layout(), [&](const auto& take) {
        for (std::size_t i = 0; i < results.sessions.size(); ++i) {
            for (const StudyTrial& trial : results.trials) {
                if (trial.session == static_cast<int>(i))
                    take(QualityRow{results.sessions[i], &trial, trial.quality});
            }
            take(QualityRow{results.sessions[i], nullptr, results.session_quality[i]});
        }
    });
    tables.write_all(reporting_layout(), results.reporting);
    write_mixed_models(results, folder, format);
    write_whole_file(folder / "dictionary.json", json_text(tables.dictionary()));
    write_whole_file(folder / "study.json", study_json(results));
}

bool is_study_table(const std::string& file) {
    static const std::vector<std::string> names{"fixations",
                                                "trials",
                                                "figure4_head_fraction",
                                                "figure5_distribution",
                                                "table1_pairs",
                                                "time_course",
                                                "maps",
                                                "map_predictions",
                                                "map_reliability",
                                                "factor_effects",
                                                "gaze_motion",
                                                "light_at_gaze",
                                                "exposure",
                                                "difference_clusters",
                                                "quality",
                                                "reporting"};
    if (file == "dictionary.json" || file == "study.json" || file == "mixed_models.R" ||
        file == "mixed_models_coefficients.csv" || file == "mixed_models_tests.csv")
        return true;
    const std::size_t dot = file.find('.');
    return dot != std::string::npos &&
           std::find(names.begin(), names.end(), file.substr(0, dot)) != names.end();
}

} // namespace overt
