#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "experiment/base/text_number.h"
#include "experiment/fits/difference_scaling.h"
#include "experiment/fits/pair_scaling.h"
#include "experiment/statistics/distributions.h"
#include "experiment/study/answers/answer_counts.h"
#include "experiment/study/answers/answer_results.h"

namespace overt {

namespace {

/// In logits or standard deviations.
constexpr double least_first_slot = 1e-9;

/// The only factor in which two stimuli differ; of a series, the numbers rather than the ids.
std::optional<std::string> only_difference(const AnsweredStimulus& one, const AnsweredStimulus& other) {
    std::optional<std::string> word, number;
    int words = 0, numbers = 0;
    for (std::size_t i = 0; i < one.levels.size() && i < other.levels.size(); ++i) {
        if (one.levels[i].second == other.levels[i].second)
            continue;
        const std::string& factor = one.levels[i].first;
        if (one.number(factor)) {
            ++numbers;
            number = factor;
        } else {
            ++words;
            word = factor;
        }
    }
    // Entries of a series have ids of their own beside their numbers.
    if (numbers == 1 && words <= 1)
        return number;
    return numbers == 0 && words == 1 ? word : std::nullopt;
}

std::string level_in(const AnsweredStimulus& of, const std::string& factor) {
    const auto found = std::ranges::find(of.levels, factor, &std::pair<std::string, std::string>::first);
    return found != of.levels.end() ? found->second : std::string();
}

Interval about(double value, double se, double confidence) {
    const double half = normal_quantile(0.5 + 0.5 * confidence) * se;
    return {value - half, value + half};
}

/// One judgement of which of two items has more of something.
struct JudgedPair {
    std::string first, second;
    double first_number = 0.0, second_number = 0.0; ///< by which items are ordered; words: 0
    bool is_first = false;                          ///< it was chosen
};

void add_scale_of_pairs(std::vector<AnswerScaleRow>& rows, const AnswerOf& of, const std::string& factor,
                        const std::vector<JudgedPair>& pairs, const StudyOptions& options) {
    // Numbers rise in the tables, words stand in the order of the alphabet.
    std::set<std::pair<double, std::string>> levels;
    for (const JudgedPair& pair : pairs) {
        levels.emplace(pair.first_number, pair.first);
        levels.emplace(pair.second_number, pair.second);
    }
    std::vector<std::string> items;
    for (const auto& [number, level] : levels)
        items.push_back(level);
    if (items.size() < 3)
        return;
    std::map<std::string, std::size_t> index;
    for (std::size_t i = 0; i < items.size(); ++i)
        index[items[i]] = i;
    std::map<std::pair<std::size_t, std::size_t>, PairCount> counts;
    for (const JudgedPair& pair : pairs) {
        const std::size_t first = index[pair.first], second = index[pair.second];
        PairCount& count = counts.try_emplace({first, second}, PairCount{first, second}).first->second;
        count.trials += 1.0;
        count.first += pair.is_first ? 1.0 : 0.0;
    }
    std::vector<PairCount> all;
    for (const auto& [key, count] : counts)
        all.push_back(count);
    for (const auto& [model, name] : {std::pair(PairModel::bradley_terry, "Bradley-Terry"),
                                      std::pair(PairModel::thurstone, "Thurstone Case V")}) {
        const std::optional<PairScale> scale = fit_pairs(all, items.size(), model, true);
        if (!scale)
            continue;
        for (std::size_t i = 0; i < items.size(); ++i) {
            AnswerScaleRow& row = rows.emplace_back();
            row.of = of;
            row.method = name;
            row.factor = factor;
            row.level = items[i];
            row.value = Estimate::of(scale->centred[i],
                                     about(scale->centred[i], scale->centred_se[i], options.confidence));
            row.se = scale->centred_se[i];
            // What the iteration leaves of an effect that is 0 by symmetry is none.
            row.first_slot = scale->side;
            if (row.first_slot && std::abs(*row.first_slot) < least_first_slot)
                row.first_slot = 0.0;
            row.trials = static_cast<int>(pairs.size());
            row.is_penalised = scale->is_penalised;
        }
    }
}

/// Of stimuli in two slots that differ in one factor.
void add_pair_scales(std::vector<AnswerScaleRow>& rows, const AnswerOf& of,
                     const std::vector<const StudyAnswer*>& given, const StudyOptions& options) {
    std::map<std::string, std::vector<JudgedPair>> by_factor;
    for (const StudyAnswer* one : given) {
        const AnsweredStimulus &first = one->shown[0], &second = one->shown[1];
        if (one->is_missed || (one->value != first.slot && one->value != second.slot))
            continue;
        if (const auto factor = only_difference(first, second))
            by_factor[*factor].push_back({level_in(first, *factor), level_in(second, *factor),
                                          first.number(*factor).value_or(0.0),
                                          second.number(*factor).value_or(0.0), one->value == first.slot});
    }
    for (const auto& [factor, pairs] : by_factor)
        add_scale_of_pairs(rows, of, factor, pairs, options);
}

/// The list that a place on a surface is of, "seen" of "seen.12"; empty: it is the name of no such place.
std::string list_of_place(const std::string& level) {
    const std::size_t dot = level.rfind('.');
    return dot == std::string::npos || !number_in<int>(std::string_view(level).substr(dot + 1))
               ? std::string()
               : level.substr(0, dot);
}

/// Of two marked places of one list, where the answer is the id of a mark.
void add_place_scales(std::vector<AnswerScaleRow>& rows, const AnswerOf& of,
                      const std::vector<const StudyAnswer*>& given, const StudyOptions& options) {
    std::map<std::string, std::vector<JudgedPair>> by_list;
    for (const StudyAnswer* one : given) {
        const std::string list = one->is_missed ? std::string() : list_of_place(one->level(one->value));
        if (list.empty())
            continue;
        std::vector<std::pair<std::string, std::string>> marks;
        std::ranges::copy_if(one->levels, std::back_inserter(marks),
                             [&](const auto& level) { return list_of_place(level.second) == list; });
        if (marks.size() == 2 && marks[0].second != marks[1].second)
            by_list[list].push_back({marks[0].second, marks[1].second,
                                     static_cast<double>(*number_in<int>(
                                         std::string_view(marks[0].second).substr(list.size() + 1))),
                                     static_cast<double>(*number_in<int>(
                                         std::string_view(marks[1].second).substr(list.size() + 1))),
                                     one->value == marks[0].first});
    }
    for (const auto& [list, pairs] : by_list)
        add_scale_of_pairs(rows, of, list, pairs, options);
}

/// Of pairs that can differ in several factors of numbers at once: what each level of each adds to the
/// judgement.
void add_conjoint_scales(std::vector<AnswerScaleRow>& rows, const AnswerOf& of,
                         const std::vector<const StudyAnswer*>& given, const StudyOptions& options) {
    std::map<std::string, std::set<double>> levels;
    for (const StudyAnswer* one : given)
        for (const AnsweredStimulus& shown : one->shown)
            for (const auto& [factor, number] : shown.numbers)
                levels[factor].insert(number);
    std::erase_if(levels, [](const auto& one) { return one.second.size() < 2; });
    std::vector<int> sizes;
    for (const auto& [factor, numbers] : levels)
        sizes.push_back(static_cast<int>(numbers.size()));
    if (sizes.size() < 2)
        return;
    const auto places_of = [&](const AnsweredStimulus& shown) {
        std::vector<int> places;
        for (const auto& [factor, numbers] : levels)
            if (const auto number = shown.number(factor))
                places.push_back(static_cast<int>(std::distance(numbers.begin(), numbers.find(*number))));
        return places;
    };
    std::map<std::pair<std::vector<int>, std::vector<int>>, ConjointCount> counts;
    int trials = 0;
    for (const StudyAnswer* one : given) {
        const std::vector<int> first = places_of(one->shown[0]), second = places_of(one->shown[1]);
        const bool is_slot = one->value == one->shown[0].slot || one->value == one->shown[1].slot;
        if (one->is_missed || !is_slot || first.size() != sizes.size() || second.size() != sizes.size())
            continue;
        ConjointCount& count =
            counts.try_emplace({first, second}, ConjointCount{first, second}).first->second;
        count.trials += 1.0;
        count.first += one->value == one->shown[0].slot ? 1.0 : 0.0;
        ++trials;
    }
    std::vector<ConjointCount> all;
    for (const auto& [key, count] : counts)
        all.push_back(count);
    const std::optional<ConjointScale> scale = fit_conjoint(all, sizes);
    if (!scale)
        return;
    std::size_t f = 0;
    for (const auto& [factor, numbers] : levels) {
        std::size_t level = 0;
        for (const double number : numbers) {
            AnswerScaleRow& row = rows.emplace_back();
            row.of = of;
            row.method = "MLCM";
            row.factor = factor;
            row.level = fmt::format("{}", number);
            row.value =
                Estimate::of(scale->parts[f][level],
                             about(scale->parts[f][level], scale->parts_se[f][level], options.confidence));
            row.se = scale->parts_se[f][level];
            row.trials = trials;
            row.is_penalised = scale->is_penalised;
            ++level;
        }
        ++f;
    }
}

/// The places of a trial's stimuli on the series, and whether the pair with the larger levels was chosen.
struct JudgedDifference {
    std::vector<double> levels; ///< rising
    bool is_upper = false;
};

std::optional<JudgedDifference> judged_difference(const StudyAnswer& answer, const std::string& factor) {
    JudgedDifference judged;
    for (const AnsweredStimulus& shown : answer.shown) {
        const auto number = shown.number(factor);
        if (!number)
            return std::nullopt;
        judged.levels.push_back(*number);
    }
    const auto chosen = std::ranges::find(answer.shown, answer.value, &AnsweredStimulus::slot);
    if (answer.is_missed || chosen == answer.shown.end())
        return std::nullopt;
    const auto place = static_cast<std::size_t>(chosen - answer.shown.begin());
    const std::size_t count = judged.levels.size();
    if (count == 3) {
        if (place == 1)
            return std::nullopt; // the middle one is of both pairs
        judged.is_upper = judged.levels[place] > judged.levels[1];
    } else {
        const double own = judged.levels[place], other = judged.levels[place < 2 ? 2 : 0];
        judged.is_upper = own > other;
    }
    std::ranges::sort(judged.levels);
    if (std::ranges::adjacent_find(judged.levels) != judged.levels.end())
        return std::nullopt;
    return judged;
}

} // namespace

DifferenceCounts difference_counts(const AnswerList& answers, const std::string& factor,
                                   std::span<const double> weights) {
    std::set<double> levels;
    std::vector<std::pair<JudgedDifference, double>> judged;
    for (std::size_t i = 0; i < answers.size(); ++i)
        if (auto difference = judged_difference(*answers[i], factor)) {
            levels.insert(difference->levels.begin(), difference->levels.end());
            judged.emplace_back(*std::move(difference), weights.empty() ? 1.0 : weights[i]);
        }
    DifferenceCounts found;
    found.series.assign(levels.begin(), levels.end());
    found.judged = static_cast<int>(judged.size());
    std::map<std::vector<int>, DifferenceCount> counts;
    for (const auto& [one, weight] : judged) {
        std::vector<int> places;
        for (const double level : one.levels)
            places.push_back(
                static_cast<int>(std::ranges::lower_bound(found.series, level) - found.series.begin()));
        DifferenceCount& count = counts.try_emplace(places, DifferenceCount{places}).first->second;
        count.trials += weight;
        count.upper += one.is_upper ? weight : 0.0;
    }
    for (const auto& [key, count] : counts)
        if (count.trials > 0.0)
            found.counts.push_back(count);
    return found;
}

namespace {

void add_difference_scales(std::vector<AnswerScaleRow>& rows, const AnswerOf& of,
                           const std::vector<const StudyAnswer*>& given, const StudyOptions& options) {
    for (const auto& [factor, any] : given.front()->shown.front().numbers) {
        const auto [series, all, judged] = difference_counts(given, factor, {});
        const auto scale =
            all.empty() ? std::nullopt : fit_difference_scale(all, static_cast<int>(series.size()));
        if (!scale)
            continue;
        ScaleBootstrap settings;
        settings.confidence = options.confidence;
        settings.seed = options.seed;
        const auto intervals = bootstrap_difference_scale(all, *scale, settings);
        for (std::size_t i = 0; i < series.size(); ++i) {
            AnswerScaleRow& row = rows.emplace_back();
            row.of = of;
            row.method = "MLDS";
            row.factor = factor;
            row.level = fmt::format("{}", series[i]);
            row.value =
                Estimate::of(scale->scale[i], intervals ? std::optional(intervals->scale[i]) : std::nullopt);
            row.se = intervals ? std::optional(intervals->scale_sd[i]) : scale->normalised_se(i);
            row.sigma = scale->sigma;
            row.trials = judged;
            row.is_penalised = scale->is_penalised;
        }
    }
}

} // namespace

std::vector<AnswerScaleRow> answer_scales(const AnswersBy& answers, const StudyOptions& options) {
    std::vector<AnswerScaleRow> rows;
    for (const auto& [of, given] : answers) {
        add_place_scales(rows, of, given, options);
        const std::size_t slots = given.front()->shown.size();
        if (!std::ranges::all_of(given, [&](const StudyAnswer* one) { return one->shown.size() == slots; }))
            continue;
        if (slots == 2) {
            add_pair_scales(rows, of, given, options);
            add_conjoint_scales(rows, of, given, options);
        } else if (slots == 3 || slots == 4)
            add_difference_scales(rows, of, given, options);
    }
    return rows;
}

} // namespace overt
