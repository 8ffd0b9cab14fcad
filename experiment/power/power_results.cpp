#include "experiment/power/power_results.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "experiment/base/counted.h"
#include "experiment/statistics/bootstrap.h"
#include "experiment/statistics/paired_evidence.h"
#include "experiment/statistics/proportion.h"

namespace overt {

namespace {

std::string percent(double share) { return fmt::format("{:.0f} %", 100.0 * share); }

std::string of_studies(const PowerPoint& point) {
    return fmt::format(
        "with {}, {} of {} (95 % interval {:.0f} to {:.0f} %)", counted(point.observers, "observer"),
        percent(point.share()),
        counted(static_cast<int>(point.studies.size()), "simulated study", "simulated studies"),
        100.0 * point.interval.low, 100.0 * point.interval.high);
}

/// With how many observers the share asked for is reached.
std::string words_of_needed(const std::optional<int>& needed, const PowerCurve& curve,
                            const PowerResults& results) {
    if (needed && *needed == curve.points.front().observers)
        return fmt::format(" {} is reached with the fewest observers that were simulated, {}.",
                           percent(results.target), *needed);
    if (needed)
        return fmt::format(" {} needs {}.", percent(results.target), counted(*needed, "observer"));
    return fmt::format(" {} was not reached with up to {}.", percent(results.target),
                       counted(curve.points.back().observers, "observer"));
}

} // namespace

void summarise(PowerCurve& curve, double alpha) {
    for (PowerPoint& point : curve.points) {
        point.found = point.without_test = point.without_measure = 0;
        std::vector<double> estimates;
        for (const StudyOutcome& study : point.studies) {
            point.found += study.p && *study.p <= alpha;
            point.without_test += !study.p;
            point.without_measure += study.without_measure;
            if (study.estimate)
                estimates.push_back(*study.estimate);
        }
        std::sort(estimates.begin(), estimates.end());
        point.median_estimate = estimates.empty() ? 0.0 : quantile_of_sorted(estimates, 0.5);
        if (const auto interval = wilson_interval(point.found, static_cast<double>(point.studies.size())))
            point.interval = *interval;
    }
}

SequentialOutcome with_looks(const PowerCurve& curve, double alpha, AlphaSpending spending) {
    std::vector<int> observers;
    for (const PowerPoint& point : curve.points)
        observers.push_back(point.observers);
    SequentialOutcome outcome;
    outcome.levels = sequential_levels(observers, alpha, spending);
    outcome.found.assign(observers.size(), 0);
    const std::size_t studies = curve.points.front().studies.size();
    for (std::size_t study = 0; study < studies; ++study) {
        int ended_with = observers.back();
        for (std::size_t look = 0; look < observers.size(); ++look) {
            const std::optional<double>& p = curve.points[look].studies[study].p;
            if (!p || *p > outcome.levels[look])
                continue;
            ended_with = observers[look];
            for (std::size_t later = look; later < observers.size(); ++later)
                ++outcome.found[later];
            break;
        }
        outcome.mean_observers += ended_with / static_cast<double>(studies);
    }
    if (const auto interval = wilson_interval(outcome.found.back(), static_cast<double>(studies)))
        outcome.interval = *interval;
    return outcome;
}

std::optional<int> observers_needed(const PowerCurve& curve, double target) {
    std::optional<int> needed;
    for (const PowerPoint& point : curve.points) {
        if (point.share() < target)
            needed.reset();
        else if (!needed)
            needed = point.observers;
    }
    return needed;
}

namespace {

std::string words_of_looks(const PowerCurve& curve) {
    if (!curve.sequential)
        return {};
    const double all = static_cast<double>(curve.points.front().studies.size());
    return fmt::format(
        " Looked at with each of these numbers of observers, {} (95 % interval {:.0f} to {:.0f} %) find "
        "something at some look, and end with {:.1f} observers on average.",
        percent(curve.sequential->found.back() / all), 100.0 * curve.sequential->interval.low,
        100.0 * curve.sequential->interval.high, curve.sequential->mean_observers);
}

} // namespace

std::string answer_of(const PowerCurve& curve, const PowerResults& results) {
    // What is said is of the number that the protocol plans, or of the number that is needed, or of the most.
    const std::optional<int> needed = observers_needed(curve, results.target);
    const PowerPoint* shown = &curve.points.back();
    for (const std::optional<int> wanted : {needed, std::optional(results.planned)}) {
        for (const PowerPoint& point : curve.points) {
            if (point.observers == wanted)
                shown = &point;
        }
    }
    std::string begin = of_studies(*shown);
    begin[0] = 'W';
    if (results.equivalence)
        return fmt::format(
            "{} showed that the effect on the {} is smaller than {} standard deviations of observers' "
            "differences.{}",
            begin, curve.effect.words(), *results.equivalence, words_of_needed(needed, curve, results));
    if (curve.effect.is_none())
        return fmt::format("{} found a difference that was not planted ({}); {} is the level of the test.{}",
                           begin, curve.effect.words(), percent(results.alpha), words_of_looks(curve));
    return fmt::format("{} found the effect on the {}.{}{}", begin, curve.effect.words(),
                       words_of_needed(needed, curve, results), words_of_looks(curve));
}

StudyOutcome outcome_of(std::span<const double> differences, const PermutationSettings& settings,
                        const std::optional<double>& equivalence) {
    StudyOutcome outcome;
    if (equivalence)
        outcome.p = paired_evidence(differences, *equivalence).equivalence_p;
    else if (const auto test = sign_flip_test(differences, settings))
        outcome.p = test->p;
    if (outcome.p)
        outcome.estimate = std::accumulate(differences.begin(), differences.end(), 0.0) /
                           static_cast<double>(differences.size());
    return outcome;
}

int fewest_testable_observers(double alpha) {
    int observers = 1;
    double least = 1.0;
    while (least > alpha) {
        least *= 0.5;
        ++observers;
    }
    return observers;
}

} // namespace overt
