#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "experiment/ports/given_answer.h"
#include "experiment/statistics/bootstrap.h"
#include "experiment/statistics/proportion.h"
#include "experiment/study/answers/answer_results.h"

namespace overt {

namespace {

/// How often a pair was shown, and how often none of the two was the odd one out; weights of answers.
struct StayedPair {
    double shown = 0.0, together = 0.0;
    double by_chance = 0.0; ///< of which `together`, were every one the odd one as often
};

/// Two levels in the order of the alphabet.
using LevelPair = std::pair<std::string, std::string>;

/// By factor, of the factors in which what is shown differs.
std::map<std::string, std::map<LevelPair, StayedPair>>
stayed_pairs(std::span<const StudyAnswer* const> answers, std::span<const double> weights) {
    std::map<std::string, std::map<LevelPair, StayedPair>> factors;
    for (std::size_t n = 0; n < answers.size(); ++n) {
        const StudyAnswer& one = *answers[n];
        const std::size_t count = one.shown.size();
        if (one.kind != odd_one_out_kind || one.is_missed || count < 3)
            continue;
        const double weight = weights.empty() ? 1.0 : weights[n];
        for (std::size_t factor = 0; factor < one.shown.front().levels.size(); ++factor) {
            const std::string& name = one.shown.front().levels[factor].first;
            const auto level = [&](std::size_t i) { return one.shown[i].levels[factor].second; };
            const bool differ = std::ranges::any_of(one.shown, [&](const AnsweredStimulus& shown) {
                return shown.levels[factor].second != one.shown.front().levels[factor].second;
            });
            if (!differ)
                continue;
            for (std::size_t i = 0; i < count; ++i)
                for (std::size_t k = i + 1; k < count; ++k) {
                    StayedPair& pair = factors[name][std::minmax(level(i), level(k))];
                    pair.shown += weight;
                    pair.by_chance += weight * static_cast<double>(count - 2) / static_cast<double>(count);
                    if (one.value != one.shown[i].slot && one.value != one.shown[k].slot)
                        pair.together += weight;
                }
        }
    }
    return factors;
}

} // namespace

std::map<LevelPairOfFactor, double> likeness_shares(std::span<const StudyAnswer* const> answers,
                                                    std::span<const double> weights) {
    std::map<LevelPairOfFactor, double> shares;
    for (const auto& [factor, pairs] : stayed_pairs(answers, weights))
        for (const auto& [levels, count] : pairs)
            if (count.shown > 0.0)
                shares[{factor, levels}] = count.together / count.shown;
    return shares;
}

std::vector<AnswerLikenessRow> answer_likenesses(const AnswersBy& answers, const StudyOptions& options) {
    std::vector<AnswerLikenessRow> rows;
    std::map<std::tuple<std::string, std::string, std::string, std::string, LevelPair>, std::vector<double>>
        of_observers;
    // The label of all is empty, and comes first: its shares are filled in when those of observers are known.
    for (const auto& [of, given] : answers)
        for (const auto& [factor, pairs] : stayed_pairs(given, {}))
            for (const auto& [levels, count] : pairs) {
                AnswerLikenessRow& row = rows.emplace_back();
                row.of = of;
                row.factor = factor;
                row.a = levels.first;
                row.b = levels.second;
                row.trials = static_cast<int>(count.shown);
                row.together = static_cast<int>(count.together);
                row.chance = count.by_chance / count.shown;
                if (of.observer.empty())
                    continue;
                row.share = Estimate::of(count.together / count.shown,
                                         wilson_interval(count.together, count.shown, options.confidence));
                of_observers[{of.task, of.answer, of.item, factor, levels}].push_back(count.together /
                                                                                      count.shown);
            }
    for (AnswerLikenessRow& row : rows) {
        if (!row.of.observer.empty())
            continue;
        row.share = estimated_mean(
            of_observers[{row.of.task, row.of.answer, row.of.item, row.factor, {row.a, row.b}}],
            options.bootstrap(), "", zero_to_one);
        // Observers see a pair a few times: where they agree by chance, their shares do not tell how many
        // more answers would scatter.
        const std::optional<Interval> of_answers =
            wilson_interval(row.together, row.trials, options.confidence);
        if (row.share.interval && of_answers)
            row.share.interval = Interval{std::min(row.share.interval->low, of_answers->low),
                                          std::max(row.share.interval->high, of_answers->high)};
    }
    return rows;
}

} // namespace overt
