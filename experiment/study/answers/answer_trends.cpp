#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <string_view>
#include <vector>

#include "experiment/base/text_number.h"
#include "experiment/statistics/bootstrap.h"
#include "experiment/study/answers/answer_differences.h"
#include "experiment/study/answers/answer_results.h"

namespace overt {

namespace {

/// What is a line over a factor: one number of an answer, nothing of answers that have none.
struct TrendMeasure {
    std::string_view name;
    bool (*is_of)(const StudyAnswer& one); ///< the answer counts
    double (*value)(const StudyAnswer& one);
};

constexpr std::string_view share_correct = "share correct";
constexpr TrendMeasure trend_measures[] = {
    {share_correct, [](const StudyAnswer& one) { return one.is_correct.has_value(); },
     [](const StudyAnswer& one) { return *one.is_correct ? 1.0 : 0.0; }},
    {"mean", [](const StudyAnswer& one) { return is_rating(one); },
     [](const StudyAnswer& one) { return *one.number; }},
    // A wrong answer says nothing of how long the right one takes.
    {"mean response time / s",
     [](const StudyAnswer& one) { return one.response_s && one.is_correct.value_or(true); },
     [](const StudyAnswer& one) { return *one.response_s; }},
};

/// A line by least squares over single answers, and the means at its levels.
struct TrendLine {
    double slope = 0.0, intercept = 0.0;
    int answers = 0;
    std::map<double, double> means; ///< by level
};

std::optional<TrendLine> line_of(const TrendMeasure& what, const AnswerList& answers,
                                 std::span<const double> weights, const std::string& along) {
    TrendLine line;
    std::map<double, std::pair<double, double>> levels; ///< sum and weight of the answers
    double weight = 0.0, x_sum = 0.0, y_sum = 0.0;
    for (std::size_t i = 0; i < answers.size(); ++i) {
        const auto x = number_in<double>(answers[i]->level(along));
        const double own = weights.empty() ? 1.0 : weights[i];
        if (!x || !what.is_of(*answers[i]) || own <= 0.0)
            continue;
        auto& [sum, count] = levels[*x];
        sum += own * what.value(*answers[i]);
        count += own;
        weight += own;
        x_sum += own * *x;
        y_sum += own * what.value(*answers[i]);
        ++line.answers;
    }
    if (levels.size() < 2)
        return std::nullopt;
    const double x_mean = x_sum / weight, y_mean = y_sum / weight;
    double xx = 0.0, xy = 0.0;
    for (const auto& [x, sums] : levels) {
        const auto& [sum, count] = sums;
        xx += count * (x - x_mean) * (x - x_mean);
        xy += (x - x_mean) * (sum - count * y_mean);
        line.means[x] = sum / count;
    }
    line.slope = xy / xx;
    // Equal means differ by no more than what doubles leave.
    const double across = levels.rbegin()->first - levels.begin()->first;
    if (std::abs(line.slope) * across <= 1e-12 * std::abs(y_mean))
        line.slope = 0.0;
    line.intercept = y_mean - line.slope * x_mean;
    return line;
}

/// Trials of which a line is made: all, or those of a level of another factor.
struct TrendGroup {
    std::string column, level;
};

std::vector<TrendGroup> groups_beside(const std::vector<ComparedColumn>& columns, const std::string& along) {
    std::vector<TrendGroup> groups{{}};
    for (const ComparedColumn& column : columns)
        if (column.name != along && column.name != "side")
            for (const std::string& level : column.levels)
                groups.push_back({column.name, level});
    return groups;
}

AnswerList of_group(const AnswerList& answers, const TrendGroup& group) {
    return group.column.empty() ? answers : answers_in(answers, group.column, group.level);
}

/// Of one observer.
AnswerTrendRow row_of_line(const AnswerOf& of, const TrendMeasure& what, const std::string& along,
                           const TrendGroup& group, const TrendLine& line) {
    AnswerTrendRow row;
    row.of = of;
    row.measure = what.name;
    row.along = along;
    row.column = group.column;
    row.level = group.level;
    row.answers = line.answers;
    row.slope = Estimate::of(line.slope);
    row.intercept = Estimate::of(line.intercept);
    for (const auto& [x, mean] : line.means)
        row.points.push_back({x, Estimate::of(mean)});
    return row;
}

/// Over the rows of the observers: means of theirs, each once however many answers it is of.
AnswerTrendRow row_of_all(const std::vector<const AnswerTrendRow*>& own, const StudyOptions& options) {
    AnswerTrendRow row = *own.front();
    row.of.observer.clear();
    row.answers = 0;
    row.observers = static_cast<int>(own.size());
    row.points.clear();
    std::vector<double> slopes, intercepts;
    std::map<double, std::vector<double>> at;
    for (const AnswerTrendRow* one : own) {
        row.answers += one->answers;
        slopes.push_back(*one->slope.value);
        intercepts.push_back(*one->intercept.value);
        for (const AnswerTrendPoint& point : one->points)
            at[point.x].push_back(*point.mean.value);
    }
    row.slope = estimated_mean(slopes, options.bootstrap(), "");
    row.intercept = estimated_mean(intercepts, options.bootstrap(), "");
    for (const auto& [x, means] : at) {
        const Interval range = row.measure == share_correct ? zero_to_one : any_number;
        row.points.push_back({x, estimated_mean(means, options.bootstrap(), "", range)});
    }
    return row;
}

} // namespace

std::optional<double> trend_slope(const AnswerList& answers, std::span<const double> weights,
                                  const std::string& measure, const std::string& along) {
    for (const TrendMeasure& what : trend_measures)
        if (what.name == measure)
            if (const auto line = line_of(what, answers, weights, along))
                return line->slope;
    return std::nullopt;
}

std::vector<AnswerTrendRow> answer_trends(const AnswersBy& answers, const StudyOptions& options) {
    std::vector<AnswerTrendRow> rows;
    for (const auto& [of, all] : answers) {
        if (!of.observer.empty())
            continue;
        const std::vector<ComparedColumn> columns = compared_columns(all);
        for (const TrendMeasure& what : trend_measures)
            for (const ComparedColumn& along : columns) {
                if (!std::ranges::all_of(along.levels, [](const std::string& level) {
                        return number_in<double>(level).has_value();
                    }))
                    continue;
                for (const TrendGroup& group : groups_beside(columns, along.name)) {
                    std::vector<AnswerTrendRow> observers;
                    for (const auto& [other, given] : answers) {
                        if (other.observer.empty() || other.task != of.task || other.answer != of.answer ||
                            other.item != of.item)
                            continue;
                        if (const auto line = line_of(what, of_group(given, group), {}, along.name))
                            observers.push_back(row_of_line(other, what, along.name, group, *line));
                    }
                    if (observers.empty())
                        continue;
                    std::vector<const AnswerTrendRow*> own;
                    for (const AnswerTrendRow& one : observers)
                        own.push_back(&one);
                    rows.push_back(row_of_all(own, options));
                    std::ranges::move(observers, std::back_inserter(rows));
                }
            }
    }
    return rows;
}

} // namespace overt
