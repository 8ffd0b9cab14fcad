#include "experiment/study/tables/study_tables.h"
#include "experiment/study/tables/exploration_layouts.h"
#include "experiment/study/tables/point_layouts.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "experiment/base/json_text.h"
#include "experiment/base/whole_file.h"
#include "experiment/record/tables/export_tables.h"
#include "experiment/study/area_shares.h"
#include "experiment/study/methods/study_facts.h"
#include "experiment/study/tables/answer_layouts.h"
#include "experiment/study/tables/answers_json.h"
#include "experiment/study/tables/area_layouts.h"
#include "experiment/study/tables/looking_layouts.h"
#include "experiment/study/tables/mixed_models.h"
#include "experiment/study/tables/relief_layouts.h"
#include "experiment/study/tables/screen_area_layouts.h"
#include "experiment/study/tables/study_layout.h"
#include "experiment/study/tables/study_layouts.h"
#include "experiment/study/tables/study_setup_json.h"

namespace overt {

namespace {

using Json = nlohmann::ordered_json;

/// Calls visit(layout, is_needed, rows) for each table, in which rows(take) gives take each row: one that is
/// not needed is left out without a row, for it would look like a result.
template <class Visit> void for_each_table(const StudyResults& results, const Visit& visit) {
    const auto all = [&](const auto& layout, const auto& rows, bool is_needed) {
        visit(layout, is_needed || !rows.empty(),
              [&](const auto& take) { std::ranges::for_each(rows, take); });
    };
    visit(study_fixations_layout(results), true, [&](const auto& take) {
        for (const StudyFixation& fixation : results.fixations)
            take(FixationRow{fixation, item(results.trials, fixation.trial)});
    });
    visit(study_trials_layout(results), true, [&](const auto& take) {
        for (const StudyTrial& trial : results.trials)
            take(trial_summary(results, trial));
    });
    // Recordings that know nothing of what was shown have no results on a surface, and no rows of n/a either.
    const bool on_surfaces = knows_stimuli(results);
    all(screen_areas_layout(results), results.screen_area_groups, false);
    all(screen_area_trials_layout(results), results.screen_area_trials, false);
    all(area_transitions_layout(results), results.area_transitions, !results.screen_area_trials.empty());
    all(figure4_layout(results), rows_of_figure_area(results), false);
    all(areas_layout(results), results.area_rows, false);
    all(surface_transitions_layout(results), results.surface_transitions, false);
    all(area_pairs_layout(results), results.area_pairs, false);
    all(measure_differences_layout(), results.measure_differences, false);
    all(distributions_layout(results), results.distributions, on_surfaces);
    all(pairs_layout(results), results.pairs, on_surfaces);
    all(time_course_layout(results), results.time_course, false);
    all(time_clusters_layout(), results.time_clusters, false);
    all(first_fixations_layout(results), results.first_fixations, false);
    all(scanpaths_layout(results), results.scanpaths, false);
    all(scanpath_likeness_layout(results), results.scanpath_likeness, false);
    all(study_maps_layout(results), results.maps, on_surfaces);
    all(factor_effects_layout(), results.effects, false);
    all(gaze_motion_layout(results), results.motions, false);
    all(light_at_gaze_layout(results), results.lights, false);
    all(exposure_layout(results), results.exposures, false);
    all(template_fit_layout(results), results.template_fits, false);
    all(map_predictions_layout(results), results.predictions, false);
    all(map_reliability_layout(results), results.reliabilities, false);
    const auto clusters = [&](const auto& layout, const std::vector<DifferenceMap>& maps) {
        visit(layout, !maps.empty(), [&](const auto& take) {
            for (const DifferenceMap& map : maps) {
                int number = 0;
                for (const DifferenceMap::Cluster& cluster : map.clusters)
                    take(ClusterRow{map, &cluster, ++number});
                if (number == 0)
                    take(ClusterRow{map, nullptr, 0});
            }
        });
    };
    clusters(clusters_layout(results), results.differences);
    clusters(answer_clusters_layout(results), results.answer_maps);
    visit(quality_layout(), true, [&](const auto& take) {
        for (std::size_t i = 0; i < results.sessions.size(); ++i) {
            for (const StudyTrial& trial : results.trials) {
                if (trial.session == static_cast<int>(i))
                    take(QualityRow{results.sessions[i], &trial, trial.quality});
            }
            take(QualityRow{results.sessions[i], nullptr, results.session_quality[i]});
        }
    });
    all(answer_trials_layout(results.answers.given), results.answers.given, false);
    all(answers_layout(), results.answers.summaries, false);
    all(answer_choices_layout(), results.answers.choices, false);
    all(psychometric_functions_layout(), results.answers.curves, false);
    visit(psychometric_points_layout(), !results.answers.curves.empty(), [&](const auto& take) {
        for (const AnswerCurveRow& curve : results.answers.curves)
            for (const AnswerCurvePoint& point : curve.points)
                take(AnswerPointRow{curve, point});
    });
    all(procedure_tracks_layout(), results.answers.tracks, false);
    all(response_times_layout(), results.answers.times, false);
    all(speed_and_accuracy_layout(), results.answers.speeds, false);
    all(answer_differences_layout(), results.answers.differences, false);
    all(answer_trends_layout(), results.answers.trends, false);
    visit(answer_trend_points_layout(), !results.answers.trends.empty(), [&](const auto& take) {
        for (const AnswerTrendRow& trend : results.answers.trends)
            for (const AnswerTrendPoint& point : trend.points)
                take(AnswerTrendPointRow{trend, point});
    });
    all(answer_likenesses_layout(), results.answers.likenesses, false);
    all(answer_gaze_layout(), results.answers.gaze, false);
    all(gaze_choices_layout(), results.answers.gaze_choices, false);
    all(answer_scales_layout(), results.answers.scales, false);
    all(ratings_layout(), results.answers.ratings, false);
    all(matches_layout(), results.answers.matches, false);
    all(match_lines_layout(), results.answers.match_lines, false);
    all(gauge_settings_layout(results), results.reliefs.settings, false);
    all(relief_points_layout(), results.reliefs.points, false);
    all(reliefs_layout(), results.reliefs.reliefs, false);
    all(exploration_shows_layout(results), results.explorations.shows, false);
    all(explorations_layout(), results.explorations.summaries, false);
    all(answered_points_layout(results), results.points.given, false);
    all(point_spreads_layout(results), results.points.spreads, false);
    all(point_areas_layout(results), results.points.areas, false);
    all(point_pairs_layout(results), results.points.pairs, false);
    all(reporting_layout(), results.reporting, true);
}

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
              {"observers_given", Json::array()},
              {"sessions", Json::array()},
              {"trials", trials_of_presentations(results)},
              {"presentations", glance.trials},
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
              {"objects", Json::array()},
              {"areas", results.areas},
              {"area", results.area},
              {"area_shares", Json::array()}};
    json.update(study_facts_json(results));
    json["headline"] = headline_json(results.headline);
    if (nlohmann::ordered_json answers = answers_json(results); !answers.is_null())
        json["answers"] = std::move(answers);
    json["methods"] = Json::array();
    for (const MethodsParagraph& paragraph : results.methods)
        json["methods"].push_back({{"topic", paragraph.topic}, {"text", paragraph.text}});
    for (const auto& [why, count] : glance.not_counted)
        json["not_counted"][std::string(name_of(why))] = count;
    for (const StudyObserver& one : results.observers) {
        Json given{{"observer", one.label}, {"counts", one.counts}};
        if (!one.counts)
            given["why"] = one.why;
        given.update({{"sessions", one.sessions}, {"trials", one.trials}, {"fixations", one.fixations}});
        json["observers_given"].push_back(std::move(given));
    }
    for (const StudySession& session : results.sessions) {
        json["sessions"].push_back({{"folder", session.folder},
                                    {"observer", session.observer},
                                    {"session", session.number},
                                    {"protocol", session.protocol},
                                    {"tracker", session.setup.gaze.tracker},
                                    {"simulated", session.is_simulated()},
                                    {"form", keys_json(session.form)},
                                    {"events", session.events},
                                    {"complete", session.is_complete},
                                    {"trials", session.trials}});
        if (!session.setup.imported_file.empty())
            json["sessions"].back()["imported_file"] = session.setup.imported_file;
        if (session.setup.presenter)
            json["sessions"].back()["presented_by"] = *session.setup.presenter;
    }
    for (const StudyParameter& parameter : results.parameters)
        json["parameters"].push_back({{"name", parameter.name},
                                      {"value", parameter.value},
                                      {"unit", parameter.unit},
                                      {"meaning", parameter.meaning}});
    for (const StudyObject& object : results.objects) {
        Json one{{"id", object.id}, {"title", object.title}};
        if (object.mm_per_unit)
            one["mm_per_unit"] = *object.mm_per_unit;
        if (object.mm_per_deg)
            one["mm_per_deg"] = *object.mm_per_deg;
        if (object.shown_size)
            one["shown_size"] = *object.shown_size;
        if (object.origin != glm::dvec3(0.0) && object.mm_per_unit) {
            const glm::dvec3 origin = *object.mm_per_unit * object.origin;
            one["origin_mm"] = {origin.x, origin.y, origin.z};
        }
        if (!object.remark.empty())
            one["remark"] = object.remark;
        json["objects"].push_back(std::move(one));
    }
    for (const ScreenAreaRow& row : results.screen_area_groups) {
        Json one{{"keys", keys_json(row.keys)},
                 {"area", row.area},
                 {"fixations", row.fixations},
                 {"trials", row.trials}};
        for (const auto& [name, estimate] :
             {std::pair{"dwell_share", &row.dwell_share}, std::pair{"visits", &row.visits},
              std::pair{"reached", &row.reached}, std::pair{"first_arrival_s", &row.first_arrival_s}})
            if (estimate->value)
                one[name] = *estimate->value;
        json["screen_areas"].push_back(std::move(one));
    }
    for (const AreaRow& row : results.area_rows) {
        Json one{{"area", row.area},
                 {"keys", keys_json(row.keys)},
                 {"fixations", row.fixations},
                 {"observers", row.observers}};
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
        json["area_shares"].push_back(std::move(one));
    }
    return json_text(json);
}

void write_study_tables(const StudyResults& results, const std::filesystem::path& folder,
                        TableFormat format) {
    Json dictionary = Json::object();
    for_each_table(results, [&](const auto& layout, bool is_needed, const auto& rows) {
        if (!is_needed)
            return;
        TableWriter writer(folder, layout.table(), format);
        rows([&](const auto& row) { layout.write(writer, row); });
        writer.close();
        describe_table(dictionary, layout.table(), format);
    });
    if (knows_stimuli(results))
        write_mixed_models(results, folder, format);
    if (!results.answers.given.empty())
        write_answer_models(folder, format);
    write_whole_file(folder / "dictionary.json", json_text(dictionary));
    write_whole_file(folder / "study.json", study_json(results));
}

bool is_study_table(const std::string& file) {
    if (file == "dictionary.json" || file == "study.json" || file == "mixed_models.R" ||
        file == "mixed_models_coefficients.csv" || file == "mixed_models_tests.csv" ||
        file == "answer_models.R" || file == "answer_models.csv")
        return true;
    const std::size_t dot = file.find('.');
    bool is_table = false;
    for_each_table(StudyResults(), [&](const auto& layout, bool, const auto&) {
        is_table |= dot != std::string::npos && layout.table().name == file.substr(0, dot);
    });
    return is_table;
}

} // namespace overt
