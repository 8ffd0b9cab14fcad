#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "experiment/base/parallel.h"
#include "experiment/statistics/bootstrap.h"
#include "experiment/statistics/proportion.h"
#include "experiment/study/answers/answer_counts.h"
#include "experiment/study/answers/answer_differences.h"
#include "experiment/study/answers/answer_results.h"

namespace overt {

namespace {

/// A curve that is to be fitted.
struct CurveJob {
    AnswerOf of;
    std::string column, level;
    CurveCounts counts;
};

std::vector<AnswerCurvePoint> points_of(std::span<const LevelCount> levels, const PsychometricFit* fit,
                                        double confidence) {
    std::vector<AnswerCurvePoint> points;
    for (const LevelCount& one : levels) {
        AnswerCurvePoint& point = points.emplace_back();
        point.level = one.level;
        point.trials = one.trials;
        point.yes = one.yes;
        point.share = wilson_interval(one.yes, one.trials, confidence).value_or(Interval{0.0, 1.0});
        if (fit)
            point.fitted = fit->share_at(one.level);
    }
    return points;
}

AnswerCurveRow fitted(const CurveJob& job, const StudyOptions& options) {
    AnswerCurveRow row;
    row.of = job.of;
    row.factor = job.counts.factor;
    row.column = job.column;
    row.level = job.level;
    row.yes = job.counts.yes;
    row.trials = static_cast<int>(job.counts.trials.size());
    row.guess = job.counts.is_forced ? 0.5 : 0.0;
    const std::vector<LevelCount> levels = counts_by_level(job.counts.trials);
    row.levels = static_cast<int>(levels.size());
    const std::optional<PsychometricFit> fit = fit_curve(job.counts);
    row.points = points_of(levels, fit && fit->has_slope ? &*fit : nullptr, options.confidence);
    if (!fit || !fit->has_slope) {
        row.note = fit ? fit->note : "fewer than three levels";
        row.threshold = Estimate::none(row.note);
        return row;
    }
    row.note = fit->note;
    row.slope = fit->beta.value;
    row.slope_se = fit->beta.se_observed;
    row.threshold_se = fit->alpha.se_observed;
    if (job.counts.is_forced)
        row.lapse = fit->lapse.value;
    row.deviance = fit->deviance;
    row.pearson_x2 = fit->pearson_x2;
    row.degrees = fit->degrees;
    PsychometricBootstrap settings;
    // Answers that are all alike at each level are the same however often they are drawn.
    const bool all_alike = std::ranges::all_of(
        levels, [](const LevelCount& one) { return one.yes == 0.0 || one.yes == one.trials; });
    settings.is_parametric = all_alike;
    settings.confidence = options.confidence;
    settings.seed = options.seed;
    const PsychometricIntervals intervals = bootstrap_psychometric(levels, *fit, settings);
    row.failures = intervals.failures;
    row.deviance_limit = intervals.deviance_limit;
    row.threshold = Estimate::of(fit->alpha.value, intervals.alpha);
    const auto add_note = [&](const char* note) {
        row.note += (row.note.empty() ? "" : "; ") + std::string(note);
    };
    if (!sound_threshold(*fit, levels))
        add_note("the threshold lies far beyond the levels");
    if (all_alike)
        add_note(intervals.alpha ? "interval from the fitted function, since no level has different answers"
                                 : "no interval: most samples of the fitted function have no slope");
    return row;
}

void add_curve_jobs(std::vector<CurveJob>& jobs, const AnswerOf& of, const AnswerList& given) {
    for (const std::string& factor : curve_factors(given)) {
        for (CurveCounts& counts : curve_counts(given, factor))
            jobs.push_back({of, "", "", std::move(counts)});
        for (const ComparedColumn& column : compared_columns(given)) {
            // Which slot a rule put the stimulus into is what the levels' sign tells of pairs.
            if (column.name == "side")
                continue;
            // Levels of another factor with a function each.
            std::vector<CurveJob> of_column;
            std::set<std::string> with_curve;
            for (const std::string& level : column.levels) {
                const AnswerList own = answers_in(given, column.name, level);
                if (!curve_factors(own).contains(factor))
                    continue;
                for (CurveCounts& counts : curve_counts(own, factor)) {
                    of_column.push_back({of, column.name, level, std::move(counts)});
                    with_curve.insert(level);
                }
            }
            if (with_curve.size() > 1)
                std::ranges::move(of_column, std::back_inserter(jobs));
        }
    }
}

/// Over observers: means of thresholds, slopes and lapse rates; the counts of all.
AnswerCurveRow curve_of_all(const std::vector<const AnswerCurveRow*>& own, const StudyOptions& options) {
    AnswerCurveRow row;
    row.of = own.front()->of;
    row.of.observer.clear();
    row.factor = own.front()->factor;
    row.column = own.front()->column;
    row.level = own.front()->level;
    row.yes = own.front()->yes;
    row.guess = own.front()->guess;
    std::vector<double> thresholds;
    double slopes = 0.0, lapses = 0.0;
    std::vector<LevelCount> counts;
    for (const AnswerCurveRow* one : own) {
        row.trials += one->trials;
        for (const AnswerCurvePoint& point : one->points)
            counts.push_back({point.level, point.trials, point.yes});
        double reach = one->points.empty() ? 0.0 : one->points.back().level - one->points.front().level;
        if (!one->threshold.value || *one->threshold.value < one->points.front().level - reach ||
            *one->threshold.value > one->points.back().level + reach)
            continue;
        thresholds.push_back(*one->threshold.value);
        slopes += one->slope.value_or(0.0);
        lapses += one->lapse.value_or(0.0);
    }
    const std::vector<LevelCount> levels = counts_by_level(counts);
    row.levels = static_cast<int>(levels.size());
    row.points = points_of(levels, nullptr, options.confidence);
    row.threshold = estimated_mean(thresholds, options.bootstrap(), "no observer has a threshold");
    const auto observers = static_cast<double>(thresholds.size());
    if (!thresholds.empty()) {
        row.slope = slopes / observers;
        if (row.guess > 0.0)
            row.lapse = lapses / observers;
    }
    row.note = fmt::format("mean of {} of {} observers", thresholds.size(), own.size());
    return row;
}

} // namespace

std::vector<AnswerCurveRow> answer_curves(const AnswersBy& answers, const StudyOptions& options) {
    std::vector<CurveJob> jobs;
    for (const auto& [of, given] : answers)
        if (!of.observer.empty())
            add_curve_jobs(jobs, of, given);
    std::vector<AnswerCurveRow> rows(jobs.size());
    parallel_for(static_cast<int>(jobs.size()), [&](int i) {
        rows[static_cast<std::size_t>(i)] = fitted(jobs[static_cast<std::size_t>(i)], options);
    });
    std::map<std::tuple<AnswerOf, std::string, std::string, std::string, std::string>,
             std::vector<const AnswerCurveRow*>>
        same;
    for (const AnswerCurveRow& row : rows) {
        AnswerOf of = row.of;
        of.observer.clear();
        same[{of, row.factor, row.yes, row.column, row.level}].push_back(&row);
    }
    std::vector<AnswerCurveRow> all;
    for (const auto& [key, own] : same)
        all.push_back(curve_of_all(own, options));
    rows.insert(rows.begin(), all.begin(), all.end());
    return rows;
}

} // namespace overt
