#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "experiment/fits/psychometric_fit.h"
#include "experiment/statistics/bootstrap.h"
#include "experiment/study/answer_results.h"

namespace overt {

namespace {

/// The counts that a curve is fitted to.
struct CurveCounts {
    std::string factor, yes;
    bool is_forced = false; ///< at its worst the answer is a guess between two slots
    std::vector<LevelCount> trials;
};

/// All levels of a factor in a slot.
std::set<double> numbers_in(const std::vector<const StudyAnswer*>& answers, const std::string& factor) {
    std::set<double> numbers;
    for (const StudyAnswer* one : answers)
        for (const AnsweredStimulus& shown : one->shown)
            if (const auto number = shown.number(factor))
                numbers.insert(*number);
    return numbers;
}

/// A level that each pair has in one of its slots or in both: a standard.
std::optional<double> standard_of(const std::vector<const StudyAnswer*>& answers, const std::string& factor) {
    std::set<double> common = numbers_in(answers, factor);
    for (const StudyAnswer* one : answers)
        std::erase_if(common, [&](double level) {
            return std::ranges::none_of(
                one->shown, [&](const AnsweredStimulus& shown) { return shown.number(factor) == level; });
        });
    return common.size() == 1 ? std::optional(*common.begin()) : std::nullopt;
}

CurveCounts counts_of_pairs(const std::vector<const StudyAnswer*>& answers, const std::string& factor) {
    CurveCounts counts;
    counts.factor = factor;
    const std::optional<double> standard = standard_of(answers, factor);
    counts.yes = standard ? fmt::format("the slot without the standard {:.6g}, over its level", *standard)
                          : "the first slot, over its level less the other's";
    bool is_above = false, is_below = false;
    for (const StudyAnswer* one : answers) {
        const auto first = one->shown[0].number(factor), second = one->shown[1].number(factor);
        const bool is_slot = one->value == one->shown[0].slot || one->value == one->shown[1].slot;
        if (one->is_missed || !first || !second || !is_slot)
            continue;
        // Where both show the standard, either is as good: half a trial each.
        if (standard && *first == *second) {
            counts.trials.push_back({*first, 1.0, 0.5});
            continue;
        }
        const std::size_t test = standard && *first == *standard ? 1 : 0;
        const double level = standard ? one->shown[test].number(factor).value() : *first - *second;
        is_above |= standard && level > *standard;
        is_below |= standard && level < *standard;
        counts.trials.push_back({level, 1.0, one->value == one->shown[test].slot ? 1.0 : 0.0});
    }
    counts.is_forced = is_above != is_below;
    return counts;
}

std::vector<CurveCounts> counts_of_one(const std::vector<const StudyAnswer*>& answers,
                                       const std::string& factor) {
    std::set<std::string> choices;
    for (const StudyAnswer* one : answers)
        if (!one->is_missed && !one->number && one->kind != "text" && one->kind != "spoken")
            choices.insert(one->value);
    std::vector<CurveCounts> all;
    for (const std::string& choice : choices) {
        CurveCounts& counts =
            all.emplace_back(CurveCounts{factor, fmt::format("\"{}\", over the level", choice), false, {}});
        for (const StudyAnswer* one : answers)
            if (const auto level = one->shown[0].number(factor); level && !one->is_missed)
                counts.trials.push_back({*level, 1.0, one->value == choice ? 1.0 : 0.0});
    }
    if (choices.size() < 2)
        all.clear();
    if (choices.size() == 2)
        all.pop_back(); // the other one's is its mirror image
    return all;
}

AnswerCurveRow fitted(const AnswerOf& of, const CurveCounts& counts, const StudyOptions& options) {
    AnswerCurveRow row;
    row.of = of;
    row.factor = counts.factor;
    row.yes = counts.yes;
    row.trials = static_cast<int>(counts.trials.size());
    PsychometricModel model;
    if (counts.is_forced) {
        model.guess.value = row.guess = 0.5;
        model.lapse = {0.02, true};
    }
    const std::vector<LevelCount> levels = counts_by_level(counts.trials);
    row.levels = static_cast<int>(levels.size());
    const std::optional<PsychometricFit> fit =
        row.levels < 3 ? std::nullopt : fit_psychometric(levels, model);
    if (!fit || !fit->has_slope) {
        row.note = fit ? fit->note : "fewer than three levels";
        row.threshold = Estimate::none(row.note);
        return row;
    }
    row.note = fit->note;
    row.slope = fit->beta.value;
    row.slope_se = fit->beta.se_observed;
    row.threshold_se = fit->alpha.se_observed;
    if (counts.is_forced)
        row.lapse = fit->lapse.value;
    row.deviance = fit->deviance;
    row.pearson_x2 = fit->pearson_x2;
    row.degrees = fit->degrees;
    PsychometricBootstrap settings;
    settings.is_parametric = false;
    settings.confidence = options.confidence;
    settings.seed = options.seed;
    const PsychometricIntervals intervals = bootstrap_psychometric(levels, *fit, settings);
    row.failures = intervals.failures;
    row.deviance_limit = intervals.deviance_limit;
    row.threshold = Estimate::of(fit->alpha.value, intervals.alpha);
    return row;
}

} // namespace

std::vector<AnswerCurveRow> answer_curves(const AnswersBy& answers, const StudyOptions& options) {
    std::vector<AnswerCurveRow> rows;
    for (const auto& [of, given] : answers) {
        if (of.observer.empty())
            continue;
        std::set<std::string> factors;
        const std::size_t slots = given.front()->shown.size();
        const bool is_alike =
            std::ranges::all_of(given, [&](const StudyAnswer* one) { return one->shown.size() == slots; });
        if (!is_alike || slots > 2)
            continue;
        for (const auto& [factor, number] : given.front()->shown.front().numbers)
            if (numbers_in(given, factor).size() >= 3)
                factors.insert(factor);
        for (const std::string& factor : factors) {
            if (slots == 1) {
                for (const CurveCounts& counts : counts_of_one(given, factor))
                    rows.push_back(fitted(of, counts, options));
            } else if (const CurveCounts counts = counts_of_pairs(given, factor); !counts.trials.empty()) {
                rows.push_back(fitted(of, counts, options));
            }
        }
    }
    // Over observers: the mean of their thresholds.
    std::map<std::tuple<AnswerOf, std::string, std::string>, std::vector<const AnswerCurveRow*>> same;
    for (const AnswerCurveRow& row : rows) {
        AnswerOf of = row.of;
        of.observer.clear();
        same[{of, row.factor, row.yes}].push_back(&row);
    }
    std::vector<AnswerCurveRow> all;
    for (const auto& [key, own] : same) {
        AnswerCurveRow& row = all.emplace_back();
        row.of = std::get<0>(key);
        row.factor = own.front()->factor;
        row.yes = own.front()->yes;
        row.guess = own.front()->guess;
        std::vector<double> thresholds;
        for (const AnswerCurveRow* one : own) {
            row.trials += one->trials;
            row.levels = std::max(row.levels, one->levels);
            if (one->threshold.value)
                thresholds.push_back(*one->threshold.value);
        }
        row.threshold = estimated_mean(thresholds, options.bootstrap(), "no observer has a threshold");
        row.note = fmt::format("mean of {} of {} observers", thresholds.size(), own.size());
    }
    rows.insert(rows.begin(), all.begin(), all.end());
    return rows;
}

} // namespace overt
