#include <algorithm>
#include <cmath>
#include <set>
#include <span>

#include "experiment/fits/rating_scale_fit.h"
#include "experiment/statistics/bootstrap.h"
#include "experiment/statistics/proportion.h"
#include "experiment/study/answers/answer_designs.h"
#include "experiment/study/answers/answer_differences.h"
#include "experiment/study/answers/answer_results.h"

namespace overt {

namespace {

/// Places of the levels of each factor on a continuous quality, where the ratings are steps of a scale.
void add_rating_places(std::span<AnswerRatingRow> rows,
                       const std::map<std::pair<std::string, std::string>, std::vector<double>>& ratings) {
    std::map<std::string, std::vector<std::pair<AnswerRatingRow*, RatingCounts>>> by_factor;
    double low = 0.0, high = 0.0;
    bool is_first = true;
    for (const auto& [level, numbers] : ratings)
        for (const double number : numbers) {
            if (number != std::floor(number))
                return; // a line has no steps
            low = is_first ? number : std::min(low, number);
            high = is_first ? number : std::max(high, number);
            is_first = false;
        }
    if (high - low < 1.0 || high - low > 20.0)
        return;
    for (AnswerRatingRow& row : rows) {
        if (row.factor.empty())
            continue;
        RatingCounts counts{std::vector<double>(static_cast<std::size_t>(high - low) + 1, 0.0)};
        for (const double number : ratings.at({row.factor, row.level}))
            counts.by_category[static_cast<std::size_t>(number - low)] += 1.0;
        by_factor[row.factor].emplace_back(&row, std::move(counts));
    }
    for (auto& [factor, levels] : by_factor) {
        std::vector<RatingCounts> counts;
        for (const auto& [row, own] : levels)
            counts.push_back(own);
        const std::optional<RatingScale> scale = levels.size() > 1 ? fit_rating_scale(counts) : std::nullopt;
        for (std::size_t i = 0; scale && i < levels.size(); ++i) {
            levels[i].first->place = scale->stimuli[i];
            levels[i].first->place_se = scale->stimuli_se[i];
        }
    }
}

} // namespace

AnswersBy answers_by(std::span<const StudyAnswer> answers) {
    AnswersBy by;
    for (const StudyAnswer& one : answers)
        for (const std::string& observer : {one.observer, std::string()})
            by[{observer, one.task, one.answer, one.item}].push_back(&one);
    return by;
}

std::vector<AnswerSummaryRow> answer_summaries(const AnswersBy& answers, const StudyOptions& options) {
    std::vector<AnswerSummaryRow> rows;
    for (const auto& [of, given] : answers) {
        AnswerSummaryRow& row = rows.emplace_back();
        row.of = of;
        std::vector<double> times;
        double right = 0.0, judged = 0.0;
        for (const StudyAnswer* one : given) {
            ++row.trials;
            row.missed += one->is_missed ? 1 : 0;
            if (one->is_correct) {
                judged += 1.0;
                right += *one->is_correct ? 1.0 : 0.0;
            }
            if (one->response_s)
                times.push_back(*one->response_s);
        }
        row.correct = judged > 0.0
                          ? Estimate::of(right / judged, wilson_interval(right, judged, options.confidence))
                          : Estimate::none("nothing is correct or wrong");
        if (const auto found = d_prime_of(given)) {
            row.d_prime = found->d_prime;
            row.d_prime_se = found->se;
            row.criterion = found->criterion;
        }
        if (const auto design = answer_design(given)) {
            row.design = design->name();
            if (const auto found = d_prime_by(*design, given)) {
                row.design_d_prime = found->d_prime;
                row.design_d_prime_se = found->se;
            }
        }
        if (times.empty())
            continue;
        std::ranges::sort(times);
        row.median_response_s = quantile_of_sorted(times, 0.5);
        row.mean_response_s = 0.0;
        for (const double time : times)
            *row.mean_response_s += time / static_cast<double>(times.size());
    }
    return rows;
}

std::vector<AnswerChoiceRow> answer_choices(const AnswersBy& answers, const StudyOptions& options) {
    std::vector<AnswerChoiceRow> rows;
    for (const auto& [of, given] : answers) {
        std::map<std::string, int> counts;
        int answered = 0;
        for (const StudyAnswer* one : given) {
            if (!is_choice(*one))
                continue;
            ++counts[one->value];
            ++answered;
        }
        for (const auto& [choice, count] : counts)
            rows.push_back({of, choice, count, answered,
                            Estimate::of(static_cast<double>(count) / answered,
                                         wilson_interval(count, answered, options.confidence))});
    }
    return rows;
}

std::vector<AnswerRatingRow> answer_ratings(const AnswersBy& answers, const StudyOptions& options) {
    std::vector<AnswerRatingRow> rows;
    for (const auto& [of, given] : answers) {
        // By factor and level, and within by observer: an interval over observers is of their means.
        std::map<std::pair<std::string, std::string>, std::map<std::string, std::vector<double>>> ratings;
        for (const StudyAnswer* one : given) {
            if (!is_rating(*one))
                continue;
            ratings[{}][one->observer].push_back(*one->number);
            if (one->shown.size() == 1)
                for (const auto& level : one->shown.front().levels)
                    if (level.second != "n/a") // what has no such property is of no level of it
                        ratings[level][one->observer].push_back(*one->number);
        }
        const std::size_t before = rows.size();
        std::map<std::pair<std::string, std::string>, std::vector<double>> together;
        for (const auto& [level, by_observer] : ratings) {
            std::vector<double>& all = together[level];
            std::vector<double> means;
            for (const auto& [observer, own] : by_observer) {
                double sum = 0.0;
                for (const double one : own)
                    sum += one;
                means.push_back(sum / static_cast<double>(own.size()));
                all.insert(all.end(), own.begin(), own.end());
            }
            AnswerRatingRow& row = rows.emplace_back();
            row.of = of;
            row.factor = level.first;
            row.level = level.second;
            row.ratings = static_cast<int>(all.size());
            row.mean = estimated_mean(of.observer.empty() ? means : all, options.bootstrap(), "no ratings");
            double mean = 0.0, squares = 0.0;
            for (const double one : all)
                mean += one / static_cast<double>(all.size());
            for (const double one : all)
                squares += (one - mean) * (one - mean);
            if (all.size() > 1)
                row.sd = std::sqrt(squares / static_cast<double>(all.size() - 1));
        }
        add_rating_places(std::span(rows).subspan(before), together);
    }
    return rows;
}

void reckon_answers(StudyAnswers& answers, const StudyOptions& options) {
    const AnswersBy by = answers_by(answers.given);
    answers.summaries = answer_summaries(by, options);
    answers.choices = answer_choices(by, options);
    answers.curves = answer_curves(by, options);
    answers.scales = answer_scales(by, options);
    answers.ratings = answer_ratings(by, options);
    answers.tracks = answer_tracks(answers.given);
    answers.times = answer_times(by, options);
    answers.speeds = answer_speeds(by, options);
    answers.differences = answer_differences(by, options);
    answers.trends = answer_trends(by, options);
    answers.likenesses = answer_likenesses(by, options);
    reckon_matches(answers, by, options);
}

} // namespace overt
