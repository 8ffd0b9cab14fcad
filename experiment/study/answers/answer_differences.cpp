#include "experiment/study/answers/answer_differences.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "experiment/base/text_number.h"
#include "experiment/statistics/bootstrap.h"
#include "experiment/study/answers/answer_designs.h"

namespace overt {

namespace {

/// In rising order of their numbers, if they all are, else of the alphabet.
std::vector<std::string> in_order(const std::set<std::string>& names) {
    std::vector<std::string> levels(names.begin(), names.end());
    const auto number = [](const std::string& text) { return number_in<double>(text); };
    if (std::ranges::all_of(levels, [&](const std::string& text) { return number(text).has_value(); }))
        std::ranges::stable_sort(levels, {}, [&](const std::string& text) { return *number(text); });
    return levels;
}

/// Which answers have the same level as which: the number of the first answer of each one's level.
std::vector<std::size_t> partition_by(const AnswerList& answers, const std::string& column) {
    std::map<std::string, std::size_t> first;
    std::vector<std::size_t> parts;
    for (std::size_t i = 0; i < answers.size(); ++i)
        parts.push_back(first.try_emplace(answers[i]->level(column), i).first->second);
    return parts;
}

std::optional<double> curve_value(const MeasuredAnswer& what, const AnswerList& answers) {
    if (!curve_factors(answers).contains(what.of))
        return std::nullopt;
    const std::vector<CurveCounts> counts = curve_counts(answers, what.of);
    if (counts.size() != 1)
        return std::nullopt; // of several choices none is the function
    const std::optional<PsychometricFit> fit = fit_curve(counts.front());
    if (!fit)
        return std::nullopt;
    const std::optional<double> threshold = sound_threshold(*fit, counts_by_level(counts.front().trials));
    if (!threshold || what.measure == AnswerMeasure::threshold)
        return threshold;
    return fit->beta.value > 0.0 ? std::optional(std::log(fit->beta.value)) : std::nullopt;
}

/// What there is to compare of an answer.
std::vector<MeasuredAnswer> measures_of(const AnswerList& given) {
    std::vector<MeasuredAnswer> measures;
    for (const std::string& factor : curve_factors(given))
        if (curve_counts(given, factor).size() == 1) {
            measures.push_back({AnswerMeasure::threshold, factor});
            measures.push_back({AnswerMeasure::log_slope, factor});
        }
    const auto any = [&](const auto& is_so) { return std::ranges::any_of(given, is_so); };
    const bool is_judged = any([](const StudyAnswer* one) { return one->is_correct.has_value(); });
    if (is_judged) {
        measures.push_back({AnswerMeasure::correct, ""});
        if (d_prime_of(given))
            measures.push_back({AnswerMeasure::d_prime, ""});
    }
    if (any([](const StudyAnswer* one) { return one->number.has_value(); })) {
        measures.push_back({AnswerMeasure::mean, ""});
    } else {
        std::set<std::string> choices;
        for (const StudyAnswer* one : given)
            if (!one->is_missed && asks_for_choice(*one))
                choices.insert(one->value);
        if (choices.size() == 2)
            choices.erase(std::prev(choices.end())); // the other's is its mirror image
        for (const std::string& choice : choices)
            if (!is_judged)
                measures.push_back({AnswerMeasure::choice, choice});
    }
    if (any([](const StudyAnswer* one) { return one->response_s.has_value(); }))
        measures.push_back({AnswerMeasure::time, ""});
    return measures;
}

void correct_differences(std::vector<AnswerDifferenceRow>& rows, std::size_t from) {
    std::map<std::string, std::vector<AnswerDifferenceRow*>> same;
    for (std::size_t i = from; i < rows.size(); ++i)
        if (rows[i].p)
            same[rows[i].measure].push_back(&rows[i]);
    for (const auto& [measure, own] : same) {
        std::vector<double> tested;
        for (const AnswerDifferenceRow* row : own)
            tested.push_back(*row->p);
        const std::vector<double> after = holm(tested);
        for (std::size_t i = 0; i < own.size(); ++i)
            own[i]->p_holm = after[i];
    }
}

/// Choices of a slot, and functions of them, say by themselves on which side something was.
bool goes_by_slots(const MeasuredAnswer& what, const AnswerList& answers) {
    if (what.measure != AnswerMeasure::threshold && what.measure != AnswerMeasure::log_slope &&
        what.measure != AnswerMeasure::choice)
        return false;
    return std::ranges::any_of(answers, [](const StudyAnswer* one) {
        return std::ranges::find(one->shown, one->value, &AnsweredStimulus::slot) != one->shown.end();
    });
}

} // namespace

std::vector<ComparedColumn> compared_columns(const AnswerList& answers) {
    std::vector<ComparedColumn> words, numbers;
    if (answers.empty())
        return words;
    std::vector<std::string> names;
    std::map<std::string, std::set<std::string>> levels_of_name;
    for (const StudyAnswer* one : answers)
        for (const auto& [name, level] : one->levels) {
            std::set<std::string>& known = levels_of_name[name];
            if (known.empty())
                names.push_back(name);
            known.insert(level);
        }
    for (const std::string& name : names) {
        const std::set<std::string>& levels = levels_of_name[name];
        if (levels.size() < 2 || levels.size() > most_compared_levels)
            continue;
        const bool are_numbers = std::ranges::all_of(
            levels, [](const std::string& level) { return number_in<double>(level).has_value(); });
        (are_numbers ? numbers : words).push_back({name, in_order(levels)});
    }
    std::ranges::move(words, std::back_inserter(numbers));
    std::vector<ComparedColumn> columns;
    std::set<std::vector<std::size_t>> known;
    for (ComparedColumn& column : numbers)
        if (known.insert(partition_by(answers, column.name)).second)
            columns.push_back(std::move(column));
    return columns;
}

AnswerList answers_in(const AnswerList& answers, const std::string& column, const std::string& level) {
    AnswerList own;
    for (const StudyAnswer* one : answers)
        if (one->level(column) == level)
            own.push_back(one);
    return own;
}

std::string MeasuredAnswer::name() const {
    return of.empty() ? std::string(name_of(measure)) : fmt::format("{} of {}", name_of(measure), of);
}

std::optional<double> measured(const MeasuredAnswer& what, const AnswerList& answers) {
    double sum = 0.0, count = 0.0;
    std::vector<double> times;
    switch (what.measure) {
    case AnswerMeasure::threshold:
    case AnswerMeasure::log_slope:
        return curve_value(what, answers);
    case AnswerMeasure::d_prime: {
        const std::optional<SensitivityEstimate> found = d_prime_of(answers);
        return found ? std::optional(found->d_prime) : std::nullopt;
    }
    case AnswerMeasure::correct:
        for (const StudyAnswer* one : answers)
            if (one->is_correct) {
                sum += *one->is_correct ? 1.0 : 0.0;
                count += 1.0;
            }
        break;
    case AnswerMeasure::choice:
        for (const StudyAnswer* one : answers)
            if (!one->is_missed) {
                sum += one->value == what.of ? 1.0 : 0.0;
                count += 1.0;
            }
        break;
    case AnswerMeasure::mean:
        for (const StudyAnswer* one : answers)
            if (one->number) {
                sum += *one->number;
                count += 1.0;
            }
        break;
    case AnswerMeasure::time:
        for (const StudyAnswer* one : answers)
            if (one->response_s)
                times.push_back(*one->response_s);
        if (times.empty())
            return std::nullopt;
        std::ranges::sort(times);
        return quantile_of_sorted(times, 0.5);
    }
    return count > 0.0 ? std::optional(sum / count) : std::nullopt;
}

std::optional<double> difference_of(const MeasuredAnswer& what, const AnswerList& of_observer,
                                    const std::string& column, const std::string& a, const std::string& b) {
    const std::optional<double> in_a = measured(what, answers_in(of_observer, column, a)),
                                in_b = measured(what, answers_in(of_observer, column, b));
    return in_a && in_b ? std::optional(*in_a - *in_b) : std::nullopt;
}

std::vector<AnswerDifferenceRow> answer_differences(const AnswersBy& answers, const StudyOptions& options) {
    std::vector<AnswerDifferenceRow> rows;
    for (const auto& [of, all] : answers) {
        if (!of.observer.empty())
            continue;
        std::vector<const AnswerList*> observers;
        for (const auto& [other, given] : answers)
            if (!other.observer.empty() && other.task == of.task && other.answer == of.answer &&
                other.item == of.item)
                observers.push_back(&given);
        const std::size_t before = rows.size();
        const std::vector<ComparedColumn> columns = compared_columns(all);
        for (const MeasuredAnswer& what : measures_of(all)) {
            for (const ComparedColumn& column : columns) {
                // A function over a factor is not of its own levels.
                if (column.name == what.of || (column.name == "side" && goes_by_slots(what, all)))
                    continue;
                // Each observer's value in a level is reckoned once.
                std::vector<std::vector<std::optional<double>>> values;
                for (const AnswerList* own : observers) {
                    values.emplace_back();
                    for (const std::string& level : column.levels)
                        values.back().push_back(measured(what, answers_in(*own, column.name, level)));
                }
                for (std::size_t a = 0; a < column.levels.size(); ++a)
                    for (std::size_t b = a + 1; b < column.levels.size(); ++b) {
                        AnswerDifferenceRow row;
                        row.of = of;
                        row.measure = what.name();
                        row.column = column.name;
                        row.a = column.levels[a];
                        row.b = column.levels[b];
                        for (const auto& own : values)
                            if (own[a] && own[b])
                                row.of_observers.push_back(*own[a] - *own[b]);
                        if (row.of_observers.empty())
                            continue;
                        row.observers = static_cast<int>(row.of_observers.size());
                        row.difference = estimated_mean(row.of_observers, options.bootstrap(), "");
                        if (const auto test = sign_flip_test(row.of_observers, options.permutation()))
                            row.p = test->p;
                        row.evidence = options.evidence(row.of_observers);
                        rows.push_back(std::move(row));
                    }
            }
        }
        correct_differences(rows, before);
    }
    return rows;
}

} // namespace overt
