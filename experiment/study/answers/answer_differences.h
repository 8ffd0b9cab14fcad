/// Two levels of a factor compared within observers by what they answered.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiment/base/enum_names.h"
#include "experiment/statistics/permutation.h"
#include "experiment/study/answers/answer_counts.h"
#include "experiment/study/answers/answer_results.h"

namespace overt {

/// A factor of the answers' trials (StudyAnswer::levels), and its levels: numbers rising, else by the
/// alphabet.
struct ComparedColumn {
    std::string name;
    std::vector<std::string> levels;
};

/// More levels than so many are not compared in pairs.
inline constexpr std::size_t most_compared_levels = 6;

/// Those with two to `most_compared_levels` levels, numbers first. Of several that part the answers alike,
/// such as the ids and the numbers of a series, the first.
std::vector<ComparedColumn> compared_columns(const AnswerList& answers);

/// Those whose trial has the level.
AnswerList answers_in(const AnswerList& answers, const std::string& column, const std::string& level);

/// What is compared.
enum class AnswerMeasure : std::uint8_t {
    threshold, ///< of a psychometric function over a factor
    log_slope, ///< natural logarithm of its slope
    correct,   ///< share of correct answers
    d_prime,   ///< as answers_layout has it
    choice,    ///< share of one choice
    mean,      ///< of numbers
    time       ///< median response time, s
};
template <>
inline constexpr auto names_of<AnswerMeasure> = enum_names<AnswerMeasure>("threshold", "log slope",
                                                                          "share correct", "d'", "share",
                                                                          "mean", "median response time / s");

struct MeasuredAnswer {
    AnswerMeasure measure = AnswerMeasure::mean;
    std::string of; ///< the factor of a threshold and a slope, the choice of a share; else empty
    /// As tables have it: "threshold of roughness", "share of left".
    std::string name() const;
};

/// Of one observer's answers; nothing where there is none.
std::optional<double> measured(const MeasuredAnswer& what, const AnswerList& answers);

/// An observer's value in level a less that in b; nothing where one of both has none.
std::optional<double> difference_of(const MeasuredAnswer& what, const AnswerList& of_observer,
                                    const std::string& column, const std::string& a, const std::string& b);

/// Lines of shares of correct answers, of ratings and of response times over each compared column of numbers
/// (compared_columns): of all trials, and of those of each level of each other such column but the side. Of
/// each observer who answered at two levels at least, and of all.
std::vector<AnswerTrendRow> answer_trends(const AnswersBy& answers, const StudyOptions& options);

/// Of one observer's answers, each counting by its weight (empty: one each), the slope of a measure as
/// AnswerTrendRow names it; nothing with fewer than two levels.
std::optional<double> trend_slope(const AnswerList& answers, std::span<const double> weights,
                                  const std::string& measure, const std::string& along);

/// Each measure that the answers have, for each pair of levels of each column, of observers who have both:
/// mean of their differences, interval and p over them (flips of signs), corrected after Holm over the rows
/// of an answer's measure. Of thresholds and slopes, where a choice has a function over a factor of numbers.
std::vector<AnswerDifferenceRow> answer_differences(const AnswersBy& answers, const StudyOptions& options);

} // namespace overt
