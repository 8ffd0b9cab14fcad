#include "experiment/study/answers/answer_counts.h"

#include <algorithm>

#include <fmt/format.h>

namespace overt {

namespace {

/// All levels of a factor in a slot.
std::set<double> curve_numbers(const AnswerList& answers, const std::string& factor) {
    std::set<double> numbers;
    for (const StudyAnswer* one : answers)
        for (const AnsweredStimulus& shown : one->shown)
            if (const auto number = shown.number(factor))
                numbers.insert(*number);
    return numbers;
}

/// A level that each pair has in one of its slots or in both: a standard.
std::optional<double> standard_of(const AnswerList& answers, const std::string& factor) {
    std::set<double> common = curve_numbers(answers, factor);
    for (const StudyAnswer* one : answers)
        std::erase_if(common, [&](double level) {
            return std::ranges::none_of(
                one->shown, [&](const AnsweredStimulus& shown) { return shown.number(factor) == level; });
        });
    return common.size() == 1 ? std::optional(*common.begin()) : std::nullopt;
}

CurveCounts counts_of_pairs(const AnswerList& answers, const std::string& factor) {
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

std::vector<CurveCounts> counts_of_one(const AnswerList& answers, const std::string& factor) {
    std::set<std::string> choices;
    for (const StudyAnswer* one : answers)
        if (is_choice(*one))
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

} // namespace

std::set<std::string> curve_factors(const AnswerList& answers) {
    std::set<std::string> factors;
    if (answers.empty())
        return factors;
    const std::size_t slots = answers.front()->shown.size();
    const bool is_alike =
        std::ranges::all_of(answers, [&](const StudyAnswer* one) { return one->shown.size() == slots; });
    if (!is_alike || slots < 1 || slots > 2)
        return factors;
    for (const auto& [factor, number] : answers.front()->shown.front().numbers)
        if (curve_numbers(answers, factor).size() >= 3)
            factors.insert(factor);
    return factors;
}

std::vector<CurveCounts> curve_counts(const AnswerList& answers, const std::string& factor) {
    if (answers.empty())
        return {};
    if (answers.front()->shown.size() == 1)
        return counts_of_one(answers, factor);
    CurveCounts counts = counts_of_pairs(answers, factor);
    return counts.trials.empty() ? std::vector<CurveCounts>() : std::vector{std::move(counts)};
}

std::optional<PsychometricFit> fit_curve(const CurveCounts& counts) {
    PsychometricModel model;
    if (counts.is_forced) {
        model.guess.value = 0.5;
        model.lapse = {0.02, true};
    }
    const std::vector<LevelCount> levels = counts_by_level(counts.trials);
    return levels.size() < 3 ? std::nullopt : fit_psychometric(levels, model);
}

std::optional<double> sound_threshold(const PsychometricFit& fit, std::span<const LevelCount> levels) {
    if (!fit.has_slope || levels.empty())
        return std::nullopt;
    const auto [low, high] = std::ranges::minmax(levels, {}, &LevelCount::level);
    const double range = high.level - low.level, alpha = fit.alpha.value;
    return alpha >= low.level - range && alpha <= high.level + range ? std::optional(alpha) : std::nullopt;
}

} // namespace overt
