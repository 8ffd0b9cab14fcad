#include "experiment/report/report_answers.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "experiment/study/gauge_reliefs.h"

namespace overt {

namespace {

/// Beyond so many response times of an answer the page has every n-th: a histogram looks the same.
constexpr std::size_t most_times = 20'000;

Json answer_key(const AnswerOf& of) { return {of.observer, of.task, of.answer, of.item}; }

Json json_of_curves(const StudyAnswers& answers) {
    Json curves = Json::array();
    for (const AnswerCurveRow& row : answers.curves) {
        Json points = Json::array();
        for (const AnswerCurvePoint& point : row.points)
            points.push_back({number(point.level), number(point.trials), number(point.yes),
                              number(point.share.low, 4), number(point.share.high, 4)});
        curves.push_back({{"of", answer_key(row.of)},
                          {"factor", row.factor},
                          {"column", row.column},
                          {"level", row.level},
                          {"yes", row.yes},
                          {"guess", number(row.guess)},
                          {"trials", row.trials},
                          {"threshold", json_of(row.threshold)},
                          {"slope", number(row.slope)},
                          {"slope_se", number(row.slope_se)},
                          {"lapse", number(row.lapse)},
                          {"deviance", number(row.deviance)},
                          {"degrees", row.deviance ? Json(row.degrees) : Json(nullptr)},
                          {"limit", number(row.deviance_limit)},
                          {"note", row.note},
                          {"planted", number(row.planted_threshold)},
                          {"planted_slope", number(row.planted_slope)},
                          {"points", std::move(points)}});
    }
    return curves;
}

Json json_of_scales(const StudyAnswers& answers) {
    Json scales = Json::array();
    for (const AnswerScaleRow& row : answers.scales)
        scales.push_back({{"of", answer_key(row.of)},
                          {"method", row.method},
                          {"factor", row.factor},
                          {"level", row.level},
                          {"value", json_of(row.value)},
                          {"first", number(row.first_slot)},
                          {"sigma", number(row.sigma)},
                          {"trials", row.trials},
                          {"penalised", row.is_penalised},
                          {"planted", number(row.planted)}});
    return scales;
}

Json json_of_ratings(const StudyAnswers& answers) {
    Json ratings = Json::array();
    for (const AnswerRatingRow& row : answers.ratings)
        ratings.push_back({{"of", answer_key(row.of)},
                           {"factor", row.factor},
                           {"level", row.level},
                           {"ratings", row.ratings},
                           {"mean", json_of(row.mean)},
                           {"sd", number(row.sd)},
                           {"place", number(row.place)},
                           {"planted", number(row.planted)}});
    return ratings;
}

/// Median times, distributions, and correctness by speed.
void add_times(Json& to, const StudyAnswers& answers) {
    Json times = Json::array(), speeds = Json::array();
    for (const AnswerTimeRow& row : answers.times)
        times.push_back({{"of", answer_key(row.of)},
                         {"which", row.which},
                         {"times", row.times},
                         {"median", json_of(row.median_s)},
                         {"mean", number(row.mean_s)},
                         {"sd", number(row.sd_s)},
                         {"ex", {number(row.ex_mu_s), number(row.ex_sigma_s), number(row.ex_tau_s)}},
                         {"ex_likelihood", number(row.ex_log_likelihood)},
                         {"shifted", {number(row.shift_s), number(row.log_mean), number(row.log_sd)}},
                         {"shifted_likelihood", number(row.log_normal_log_likelihood)}});
    for (const AnswerSpeedRow& row : answers.speeds)
        speeds.push_back({{"of", answer_key(row.of)},
                          {"part", row.part},
                          {"parts", row.parts},
                          {"trials", row.trials},
                          {"time", number(row.mean_response_s)},
                          {"correct", json_of(row.correct)}});
    // Single times in ms, of all observers together.
    std::map<std::tuple<std::string, std::string, std::string, std::string>, std::vector<int>> single;
    for (const StudyAnswer& one : answers.given) {
        if (!one.response_s)
            continue;
        const std::string which = one.is_correct ? (*one.is_correct ? "correct" : "wrong") : "all";
        single[{one.task, one.answer, one.item, which}].push_back(
            static_cast<int>(std::lround(1000.0 * *one.response_s)));
    }
    Json samples = Json::array();
    for (const auto& [key, all] : single) {
        const auto& [task, answer, item, which] = key;
        const std::size_t every = 1 + all.size() / most_times;
        Json ms = Json::array();
        for (std::size_t i = 0; i < all.size(); i += every)
            ms.push_back(all[i]);
        samples.push_back({{"of", answer_key({"", task, answer, item})}, {"which", which}, {"ms", ms}});
    }
    to["times"] = std::move(times);
    to["speeds"] = std::move(speeds);
    to["samples"] = std::move(samples);
}

Json json_of_tracks(const StudyAnswers& answers) {
    Json tracks = Json::array();
    const AnswerTrackRow* before = nullptr;
    for (const AnswerTrackRow& row : answers.tracks) {
        if (!before || before->of != row.of || before->procedure != row.procedure ||
            before->track != row.track)
            tracks.push_back({{"of", answer_key(row.of)},
                              {"procedure", row.procedure},
                              {"factor", row.factor},
                              {"track", row.track},
                              {"steps", Json::array()}});
        tracks.back()["steps"].push_back(
            {row.trial, number(row.level), row.value.empty() ? Json(nullptr) : Json(row.value),
             row.is_correct ? Json(*row.is_correct ? 1 : 0) : Json(nullptr), row.is_reversal ? 1 : 0});
        before = &row;
    }
    return tracks;
}

Json each_of(const std::vector<double>& values) {
    Json each = Json::array();
    for (const double value : values)
        each.push_back(number(value, 4));
    return each;
}

/// Of an observer, or of all: an answer's key and what was shown.
Json relief_key(const ReliefOf& of, const std::vector<ReliefRow>& all) {
    return {of.observer, of.task, of.answer, picture_in_words(of, all)};
}

Json json_of_reliefs(const StudyReliefs& study) {
    Json reliefs = Json::array();
    for (const ReliefRow& row : study.reliefs) {
        Json places = Json::array();
        for (const ReliefPointRow& point : study.points)
            if (point.of == row.of && point.z)
                places.push_back({number(point.true_z), number(*point.z)});
        reliefs.push_back({{"of", relief_key(row.of, study.reliefs)},
                           {"settings", row.settings},
                           {"points", row.points},
                           {"deviation", number(row.deviation_deg)},
                           {"repeat", number(row.repeat_sd_deg)},
                           {"gain", number(row.gain)},
                           {"r", number(row.r)},
                           {"affine_gain", number(row.affine_gain)},
                           {"x_shear", number(row.x_shear)},
                           {"y_shear", number(row.y_shear)},
                           {"affine_r", number(row.affine_r)},
                           {"attitude_gain", json_of(row.attitude_gain)},
                           {"attitude_r", number(row.attitude_r)},
                           {"planted", number(row.planted)},
                           {"note", row.note},
                           {"places", std::move(places)}});
    }
    return reliefs;
}

Json json_of_trends(const StudyAnswers& answers) {
    Json trends = Json::array();
    for (const AnswerTrendRow& row : answers.trends) {
        Json points = Json::array();
        for (const AnswerTrendPoint& point : row.points)
            points.push_back({number(point.x), json_of(point.mean)});
        trends.push_back({{"of", answer_key(row.of)},
                          {"measure", row.measure},
                          {"along", row.along},
                          {"column", row.column},
                          {"level", row.level},
                          {"slope", json_of(row.slope)},
                          {"intercept", json_of(row.intercept)},
                          {"answers", row.answers},
                          {"observers", row.observers},
                          {"points", std::move(points)},
                          {"planted", number(row.planted)}});
    }
    return trends;
}

Json json_of_likenesses(const StudyAnswers& answers) {
    Json likenesses = Json::array();
    for (const AnswerLikenessRow& row : answers.likenesses)
        likenesses.push_back({{"of", answer_key(row.of)},
                              {"factor", row.factor},
                              {"a", row.a},
                              {"b", row.b},
                              {"trials", row.trials},
                              {"together", row.together},
                              {"share", json_of(row.share)},
                              {"chance", number(row.chance)},
                              {"planted", number(row.planted)}});
    return likenesses;
}

} // namespace

Json report_answers(const StudyResults& results) {
    const StudyAnswers& answers = results.answers;
    if (answers.given.empty())
        return nullptr;
    Json json = Json::object(), summaries = Json::array(), choices = Json::array(),
         differences = Json::array(), gaze = Json::array();
    for (const AnswerSummaryRow& row : answers.summaries)
        summaries.push_back({{"of", answer_key(row.of)},
                             {"trials", row.trials},
                             {"missed", row.missed},
                             {"correct", json_of(row.correct)},
                             {"planted", number(row.planted_correct)},
                             {"d_prime", number(row.d_prime)},
                             {"d_prime_se", number(row.d_prime_se)},
                             {"criterion", number(row.criterion)},
                             {"design", row.design},
                             {"design_d_prime", number(row.design_d_prime)},
                             {"median", number(row.median_response_s)}});
    for (const AnswerChoiceRow& row : answers.choices)
        choices.push_back({{"of", answer_key(row.of)},
                           {"choice", row.choice},
                           {"chosen", row.chosen},
                           {"answered", row.answered},
                           {"share", json_of(row.share)}});
    for (const AnswerDifferenceRow& row : answers.differences)
        differences.push_back({{"of", answer_key(row.of)},
                               {"measure", row.measure},
                               {"column", row.column},
                               {"a", row.a},
                               {"b", row.b},
                               {"difference", json_of(row.difference)},
                               {"p", number(row.p)},
                               {"holm", number(row.p_holm)},
                               {"evidence", json_of(row.evidence)},
                               {"observers", row.observers},
                               {"planted", number(row.planted)}});
    for (const GazeChoiceRow& row : answers.gaze_choices)
        gaze.push_back({{"of", answer_key(row.of)},
                        {"measure", row.measure},
                        {"area", row.area},
                        {"a", row.a},
                        {"b", row.b},
                        {"value", json_of(row.value)},
                        {"chance", number(row.chance)},
                        {"p", number(row.p)},
                        {"holm", number(row.p_holm)},
                        {"evidence", json_of(row.evidence)},
                        {"observers", row.observers},
                        {"trials", row.trials},
                        {"planted", number(row.planted)},
                        {"each", each_of(row.of_observers)}});
    json["summaries"] = std::move(summaries);
    json["choices"] = std::move(choices);
    json["curves"] = json_of_curves(answers);
    json["scales"] = json_of_scales(answers);
    json["ratings"] = json_of_ratings(answers);
    add_times(json, answers);
    json["tracks"] = json_of_tracks(answers);
    json["differences"] = std::move(differences);
    json["gaze"] = std::move(gaze);
    Json matches = Json::array(), lines = Json::array();
    for (const AnswerMatchRow& row : answers.matches)
        matches.push_back({{"of", answer_key(row.of)},
                           {"column", row.column},
                           {"level", row.level},
                           {"along", row.along},
                           {"reference", number(row.reference)},
                           {"settings", row.settings},
                           {"match", json_of(row.match)},
                           {"error", number(row.constant_error)},
                           {"sd", number(row.sd)},
                           {"at_end", row.at_end}});
    for (const AnswerMatchLineRow& row : answers.match_lines)
        lines.push_back({{"of", answer_key(row.of)},
                         {"column", row.column},
                         {"level", row.level},
                         {"along", row.along},
                         {"settings", row.settings},
                         {"slope", json_of(row.slope)},
                         {"intercept", json_of(row.intercept)},
                         {"deming", number(row.deming_slope)},
                         {"brunswik", json_of(row.brunswik)},
                         {"thouless", json_of(row.thouless)},
                         {"planted", number(row.planted)}});
    json["matches"] = std::move(matches);
    json["match_lines"] = std::move(lines);
    json["trends"] = json_of_trends(answers);
    json["likenesses"] = json_of_likenesses(answers);
    json["reliefs"] = json_of_reliefs(results.reliefs);
    return json;
}

} // namespace overt
