#include "experiment/study/head_fractions.h"

#include <algorithm>
#include <cmath>

#include "experiment/statistics/proportion.h"
#include "experiment/study/read/part_evidence.h"

namespace overt {

namespace {

/// On the head, and all.
struct HeadSum {
    double head = 0.0, all = 0.0;
    void add(bool is_head, double weight) {
        all += weight;
        head += is_head ? weight : 0.0;
    }
    std::optional<double> share() const { return all > 0.0 ? std::optional(head / all) : std::nullopt; }
};

/// Whether it is on the head; nothing if it has no part, or its object no head.
std::optional<bool> is_on_head(const StudyResults& results, const StudyFixation& fixation) {
    const StudyTrial& trial = results.trials[static_cast<std::size_t>(fixation.trial)];
    const StudyObject& object = results.objects[static_cast<std::size_t>(trial.object)];
    if (!fixation.part || !object.head)
        return std::nullopt;
    return object.head.has(fixation.part);
}

/// Intervals of means can reach beyond what a share can be.
Estimate estimated_share(const std::vector<double>& shares, const StudyOptions& options,
                         const std::string& reason) {
    Estimate estimate = estimated_mean(shares, options.bootstrap(), reason);
    if (estimate.interval)
        estimate.interval = {std::max(estimate.interval->low, 0.0), std::min(estimate.interval->high, 1.0)};
    return estimate;
}

const std::string no_error = "no validation tells the tracker's error, or there are too few fixations";
const std::string no_fixation = "no fixation was counted on an object with a head";

HeadFractionRow row_of(const StudyResults& results, std::vector<StudyKey> keys,
                       const std::vector<int>& trials, const StudyOptions& options) {
    HeadFractionRow row;
    row.keys = std::move(keys);
    row.trials = static_cast<int>(trials.size());
    std::vector<double> counts, durations, corrected;
    HeadSum pooled;
    for (const auto& [observer, own] : by_observer(results, trials)) {
        HeadSum count, duration;
        std::vector<PartEvidence> evidence;
        for (const int trial : own) {
            for_each_counted(results, trial, [&](const StudyFixation& fixation) {
                if (const std::optional<bool> head = is_on_head(results, fixation)) {
                    count.add(*head, 1.0);
                    duration.add(*head, fixation.duration_s);
                    pooled.add(*head, 1.0);
                }
            });
        }
        for (const int trial : own) {
            const StudyTrial& of = results.trials[static_cast<std::size_t>(trial)];
            for (std::size_t i = of.first_fixation; i < of.first_fixation + of.fixations; ++i) {
                if (results.fixations[i].evidence)
                    evidence.push_back(*results.fixations[i].evidence);
            }
        }
        if (const std::optional<double> share = most_probable_head_share(evidence))
            corrected.push_back(*share);
        if (count.share())
            counts.push_back(*count.share());
        if (duration.share())
            durations.push_back(*duration.share());
    }
    row.observers = static_cast<int>(counts.size());
    row.fixations = static_cast<int>(pooled.all);
    row.by_count = estimated_share(counts, options, no_fixation);
    row.of_observers = counts;
    row.by_duration = estimated_share(durations, options, no_fixation);
    row.corrected = estimated_share(corrected, options, no_error);
    row.pooled = pooled.share();
    row.pooled_interval = wilson_interval(pooled.head, pooled.all, options.confidence);
    return row;
}

} // namespace

std::vector<HeadFractionRow> head_fractions(const StudyResults& results, const LevelLists& order,
                                            const StudyOptions& options) {
    std::vector<HeadFractionRow> rows;
    for (const StudyGroup& group : results.groups)
        rows.push_back(row_of(results, group.keys, group.trials, options));
    if (results.by.size() > 1) {
        for (const std::string& column : results.by) {
            for (const StudyGroup& level : make_groups(results, {column}, order))
                rows.push_back(row_of(results, level.keys, level.trials, options));
        }
    }
    for (const StudyGroup& all : make_groups(results, {}, order)) {
        if (!results.by.empty())
            rows.push_back(row_of(results, {}, all.trials, options));
    }
    return rows;
}

std::vector<TimeCourseRow> head_time_course(const StudyResults& results, const LevelLists& order,
                                            const StudyOptions& options) {
    std::vector<TimeCourseRow> rows;
    double end_s = 0.0;
    for (const StudyTrial& trial : results.trials)
        end_s = std::max(end_s, trial.excluded ? 0.0 : trial.presentation_s);
    // Recordings without a presentation can last an hour: the course of so many stretches tells nothing.
    constexpr int most_stretches = 120;
    const int stretches =
        std::min(most_stretches, static_cast<int>(std::ceil(end_s / options.time_step_s - 1e-3)));
    std::vector<std::string> columns;
    if (!results.by.empty())
        columns.push_back(results.by.front());
    for (const StudyGroup& level : make_groups(results, columns, order)) {
        const auto observers = by_observer(results, level.trials);
        std::vector<std::vector<HeadSum>> sums(observers.size(),
                                               std::vector<HeadSum>(static_cast<std::size_t>(stretches)));
        for (std::size_t o = 0; o < observers.size(); ++o) {
            for (const int trial : observers[o].second) {
                for_each_counted(results, trial, [&](const StudyFixation& fixation) {
                    const std::optional<bool> head = is_on_head(results, fixation);
                    const double end = fixation.onset_s + fixation.duration_s;
                    const int first = std::max(0, static_cast<int>(fixation.onset_s / options.time_step_s));
                    for (int i = first; head && i < stretches && i * options.time_step_s < end; ++i) {
                        const double from = std::max(fixation.onset_s, i * options.time_step_s),
                                     to = std::min(end, (i + 1) * options.time_step_s);
                        sums[o][static_cast<std::size_t>(i)].add(*head, std::max(to - from, 0.0));
                    }
                });
            }
        }
        for (int i = 0; i < stretches; ++i) {
            std::vector<double> shares;
            for (const auto& of_observer : sums) {
                if (const auto share = of_observer[static_cast<std::size_t>(i)].share())
                    shares.push_back(*share);
            }
            TimeCourseRow row;
            if (!level.keys.empty())
                row.key = level.keys.front();
            row.from_s = i * options.time_step_s;
            row.to_s = std::min((i + 1) * options.time_step_s, end_s);
            row.observers = static_cast<int>(shares.size());
            row.head_fraction = estimated_share(shares, options, no_fixation);
            rows.push_back(std::move(row));
        }
    }
    return rows;
}

} // namespace overt
