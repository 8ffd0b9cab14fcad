#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "experiment/base/text_number.h"
#include "experiment/fits/matching.h"
#include "experiment/statistics/bootstrap.h"
#include "experiment/study/answers/answer_differences.h"
#include "experiment/study/answers/answer_results.h"

namespace overt {

namespace {

/// A difference from a number; 0 where it is no more than what doubles leave of equal numbers.
double without_rounding(double difference, double from) {
    return std::abs(difference) <= 1e-12 * std::abs(from) ? 0.0 : difference;
}

/// A setting that was accepted, beside a reference.
struct SetMatch {
    const StudyAnswer* answer = nullptr;
    const MatchSetting* set = nullptr;
};

/// Of some answers, by the column that was set.
std::map<std::string, std::vector<SetMatch>> set_matches(const AnswerList& answers) {
    std::map<std::string, std::vector<SetMatch>> matches;
    for (const StudyAnswer* answer : answers)
        for (const MatchSetting& set : answer->settings)
            if (!answer->is_missed && set.reference)
                matches[set.along].push_back({answer, &set});
    return matches;
}

std::map<double, std::vector<SetMatch>> by_reference(const std::vector<SetMatch>& matches) {
    std::map<double, std::vector<SetMatch>> by;
    for (const SetMatch& match : matches)
        by[*match.set->reference].push_back(match);
    return by;
}

/// What a study's rows of matches are of: an observer's answers, or those of a level.
struct MatchGroup {
    AnswerOf of;
    std::string along, column, level;
    friend auto operator<=>(const MatchGroup&, const MatchGroup&) = default;
};

std::vector<MatchSettings> settings_of(const std::vector<SetMatch>& matches) {
    std::vector<MatchSettings> settings;
    for (const auto& [reference, of] : by_reference(matches)) {
        MatchSettings& one = settings.emplace_back();
        one.reference = reference;
        for (const SetMatch& match : of)
            one.settings.push_back(match.set->final);
    }
    return settings;
}

AnswerMatchRow match_row(const MatchGroup& group, double reference, const std::vector<SetMatch>& matches) {
    AnswerMatchRow row;
    row.of = group.of;
    row.along = group.along;
    row.column = group.column;
    row.level = group.level;
    row.reference = reference;
    row.settings = static_cast<int>(matches.size());
    const auto count = static_cast<double>(matches.size());
    for (const SetMatch& match : matches) {
        row.mean_start += match.set->start / count;
        row.mean_changes += match.set->changes / count;
        row.mean_reversals += match.set->reversals / count;
        row.at_end += match.set->stopped_low + match.set->stopped_high > 0 ? 1 : 0;
    }
    return row;
}

std::optional<double> slope_of(const std::vector<SetMatch>& matches) {
    const std::optional<MatchLine> line = least_squares_line(settings_of(matches));
    return line ? std::optional(line->slope) : std::nullopt;
}

std::optional<double> intercept_of(const std::vector<SetMatch>& matches) {
    const std::optional<MatchLine> line = least_squares_line(settings_of(matches));
    return line ? std::optional(line->intercept) : std::nullopt;
}

/// Over settings, drawn again with their references.
Estimate over_settings(const std::vector<SetMatch>& matches,
                       std::optional<double> (*statistic)(const std::vector<SetMatch>&),
                       const StudyOptions& options) {
    const std::optional<double> value = statistic(matches);
    if (!value)
        return Estimate::none("one reference only");
    const auto drawn = [&](std::span<const std::uint32_t> indices) {
        std::vector<SetMatch> again;
        for (const std::uint32_t index : indices)
            again.push_back(matches[index]);
        return statistic(again);
    };
    std::optional<Interval> interval =
        bootstrap_interval(static_cast<std::uint32_t>(matches.size()), drawn, options.bootstrap());
    // Settings that all lie on one line do not tell how others would scatter about it.
    if (interval && interval->low == interval->high)
        interval.reset();
    return Estimate::of(*value, interval);
}

/// What the light at the eye alone would have set: the number in the column `proximal` of the trial's own, or
/// of what it shows.
std::optional<double> proximal_of(const StudyAnswer& answer) {
    constexpr const char* column = "proximal";
    if (const auto own = number_in<double>(answer.level(column)))
        return own;
    for (const AnsweredStimulus& shown : answer.shown)
        if (const auto number = shown.number(column))
            return number;
    return std::nullopt;
}

/// Of an observer's settings whose proximal match is known and is not the reference itself.
Estimate constancy(const std::vector<SetMatch>& matches, double (*ratio)(double, double, double),
                   bool is_of_logarithms, const StudyOptions& options) {
    std::vector<double> ratios;
    for (const SetMatch& match : matches) {
        const std::optional<double> proximal = proximal_of(*match.answer);
        const double distal = *match.set->reference;
        if (!proximal || *proximal == distal ||
            (is_of_logarithms && !(match.set->final > 0.0 && *proximal > 0.0 && distal > 0.0)))
            continue;
        ratios.push_back(ratio(match.set->final, *proximal, distal));
    }
    return estimated_mean(ratios, options.bootstrap(), "no setting with another proximal match");
}

/// Of one observer.
void add_rows(std::vector<AnswerMatchRow>& rows, std::vector<AnswerMatchLineRow>& lines,
              const MatchGroup& group, const std::vector<SetMatch>& matches, const StudyOptions& options) {
    const std::vector<MatchSettings> settings = settings_of(matches);
    const std::vector<MatchEstimate> estimates = match_estimates(settings);
    std::size_t i = 0;
    for (const auto& [reference, of] : by_reference(matches)) {
        AnswerMatchRow row = match_row(group, reference, of);
        row.match = estimated_mean(settings[i].settings, options.bootstrap(), "");
        row.constant_error = without_rounding(estimates[i].constant_error, reference);
        row.sd = estimates[i].sd;
        row.just_noticeable = estimates[i].just_noticeable;
        rows.push_back(std::move(row));
        ++i;
    }
    AnswerMatchLineRow line;
    line.of = group.of;
    line.along = group.along;
    line.column = group.column;
    line.level = group.level;
    line.references = static_cast<int>(settings.size());
    line.settings = static_cast<int>(matches.size());
    line.slope = over_settings(matches, slope_of, options);
    line.intercept = over_settings(matches, intercept_of, options);
    line.brunswik = constancy(matches, brunswik_ratio, false, options);
    line.thouless = constancy(matches, thouless_ratio, true, options);
    if (const std::optional<MatchLine> deming = deming_line(settings)) {
        line.deming_slope = deming->slope;
        line.deming_intercept = deming->intercept;
    }
    lines.push_back(std::move(line));
}

MatchGroup group_of_all(const auto& row) {
    MatchGroup group{row.of, row.along, row.column, row.level};
    group.of.observer.clear();
    return group;
}

/// Of all observers: means of theirs, with the interval over observers.
void add_rows_of_all(std::vector<AnswerMatchRow>& rows, std::vector<AnswerMatchLineRow>& lines,
                     const StudyOptions& options) {
    std::map<std::pair<MatchGroup, double>, std::vector<const AnswerMatchRow*>> same;
    for (const AnswerMatchRow& row : rows)
        same[{group_of_all(row), row.reference}].push_back(&row);
    std::vector<AnswerMatchRow> all;
    for (const auto& [key, own] : same) {
        AnswerMatchRow& row = all.emplace_back();
        row = match_row(key.first, key.second, {});
        std::vector<double> means, sds;
        for (const AnswerMatchRow* one : own) {
            means.push_back(*one->match.value);
            if (one->sd)
                sds.push_back(*one->sd);
            const double share = 1.0 / static_cast<double>(own.size());
            row.settings += one->settings;
            row.mean_start += share * one->mean_start;
            row.mean_changes += share * one->mean_changes;
            row.mean_reversals += share * one->mean_reversals;
            row.at_end += one->at_end;
        }
        row.match = estimated_mean(means, options.bootstrap(), "");
        row.constant_error = without_rounding(*row.match.value - row.reference, row.reference);
        if (!sds.empty())
            row.sd = *estimated_mean(sds, options.bootstrap(), "").value;
    }
    std::map<MatchGroup, std::vector<const AnswerMatchLineRow*>> same_lines;
    for (const AnswerMatchLineRow& line : lines)
        same_lines[group_of_all(line)].push_back(&line);
    std::vector<AnswerMatchLineRow> all_lines;
    for (const auto& [group, own] : same_lines) {
        AnswerMatchLineRow& line = all_lines.emplace_back();
        line.of = group.of;
        line.along = group.along;
        line.column = group.column;
        line.level = group.level;
        std::vector<double> slopes, intercepts, deming_slopes, deming_intercepts, brunswik, thouless;
        for (const AnswerMatchLineRow* one : own) {
            line.references = std::max(line.references, one->references);
            line.settings += one->settings;
            if (one->slope.value)
                slopes.push_back(*one->slope.value);
            if (one->intercept.value)
                intercepts.push_back(*one->intercept.value);
            if (one->brunswik.value)
                brunswik.push_back(*one->brunswik.value);
            if (one->thouless.value)
                thouless.push_back(*one->thouless.value);
            if (one->deming_slope)
                deming_slopes.push_back(*one->deming_slope);
            if (one->deming_intercept)
                deming_intercepts.push_back(*one->deming_intercept);
        }
        line.slope = estimated_mean(slopes, options.bootstrap(), "no observer has two references");
        line.intercept = estimated_mean(intercepts, options.bootstrap(), "no observer has two references");
        line.brunswik =
            estimated_mean(brunswik, options.bootstrap(), "no setting with another proximal match");
        line.thouless =
            estimated_mean(thouless, options.bootstrap(), "no setting with another proximal match");
        line.deming_slope = estimated_mean(deming_slopes, options.bootstrap(), "").value;
        line.deming_intercept = estimated_mean(deming_intercepts, options.bootstrap(), "").value;
    }
    rows.insert(rows.begin(), all.begin(), all.end());
    lines.insert(lines.begin(), all_lines.begin(), all_lines.end());
}

} // namespace

void reckon_matches(StudyAnswers& answers, const AnswersBy& by, const StudyOptions& options) {
    for (const auto& [of, given] : by) {
        if (of.observer.empty())
            continue;
        for (const auto& [along, matches] : set_matches(given))
            add_rows(answers.matches, answers.match_lines, {of, along, "", ""}, matches, options);
        for (const ComparedColumn& column : compared_columns(given)) {
            for (const std::string& level : column.levels)
                for (const auto& [along, matches] : set_matches(answers_in(given, column.name, level)))
                    // What goes with the reference itself is no condition.
                    if (by_reference(matches).size() > 1)
                        add_rows(answers.matches, answers.match_lines, {of, along, column.name, level},
                                 matches, options);
        }
    }
    add_rows_of_all(answers.matches, answers.match_lines, options);
}

} // namespace overt
