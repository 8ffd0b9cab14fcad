#include "experiment/study/factor_effects.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "experiment/statistics/factor_tests.h"
#include "experiment/study/trial_summary.h"

namespace overt {

namespace {

/// A trial that has a number.
struct TrialValue {
    const StudyTrial* trial;
    std::string observer;
    double value;
};

using Values = std::vector<TrialValue>;
using Cell = std::vector<std::string>;

Cell cell_of(const TrialValue& one, const std::vector<std::string>& columns) {
    Cell cell;
    for (const std::string& column : columns)
        cell.push_back(one.trial->key(column));
    return cell;
}

/// Trials of whom there are others that are alike in these columns and have another level of `column`.
Values with_other_levels(const Values& values, const std::vector<std::string>& columns,
                         const std::string& column) {
    std::map<Cell, std::set<std::string>> levels;
    for (const TrialValue& one : values)
        levels[cell_of(one, columns)].insert(one.trial->key(column));
    Values found;
    std::ranges::copy_if(values, std::back_inserter(found),
                         [&](const TrialValue& one) { return levels.at(cell_of(one, columns)).size() > 1; });
    return found;
}

/// By trial the number of the group of all that are alike in these columns.
std::vector<std::size_t> groups_of(const Values& values, const std::vector<std::string>& columns) {
    std::map<Cell, std::size_t> numbers;
    std::vector<std::size_t> groups;
    for (const TrialValue& one : values)
        groups.push_back(numbers.try_emplace(cell_of(one, columns), numbers.size()).first->second);
    return groups;
}

/// Values and observers; cells and what is beside are left to the test.
FactorTrials trials_of(const Values& values) {
    FactorTrials trials;
    std::map<std::string, std::size_t> observers;
    for (const TrialValue& one : values) {
        trials.values.push_back(one.value);
        trials.observers.push_back(observers.try_emplace(one.observer, observers.size()).first->second);
    }
    return trials;
}

std::size_t place_in(const std::vector<std::string>& levels, const std::string& level) {
    return static_cast<std::size_t>(std::ranges::find(levels, level) - levels.begin());
}

std::vector<std::string> without(std::vector<std::string> columns, const std::string& one) {
    std::erase(columns, one);
    return columns;
}

std::vector<std::string> with(std::vector<std::string> columns, const std::string& one) {
    columns.push_back(one);
    return columns;
}

class EffectTests {
  public:
    EffectTests(const StudyResults& results, const LevelLists& lists, const StudyOptions& options)
        : results_(results), lists_(lists), options_(options), columns_(tested_columns(options.by)) {}

    std::vector<FactorEffectRow> rows_of(const std::string& measure, const Values& values) const {
        std::vector<FactorEffectRow> rows;
        for (const std::string& column : columns_)
            rows.push_back(main_effect(column, values));
        for (std::size_t a = 0; a < columns_.size(); ++a) {
            for (std::size_t b = a + 1; b < columns_.size(); ++b)
                rows.push_back(interaction(columns_[a], columns_[b], values));
        }
        std::vector<double> p;
        for (FactorEffectRow& row : rows) {
            row.measure = measure;
            if (row.p)
                p.push_back(*row.p);
        }
        const std::vector<double> corrected = holm(p);
        std::size_t next = 0;
        for (FactorEffectRow& row : rows) {
            if (row.p)
                row.p_holm = corrected[next++];
        }
        return rows;
    }

  private:
    /// All that is held alike when a column is tested.
    std::vector<std::string> beside(const std::string& column) const {
        return with(without(columns_, column), "object");
    }
    std::vector<std::string> levels(const std::string& column) const {
        return levels_of(results_, column, lists_);
    }

    static FactorEffectRow row_of(std::string effect, const std::optional<FactorTest>& test,
                                  const char* absent) {
        FactorEffectRow row;
        row.effect = std::move(effect);
        if (!test) {
            row.absent = absent;
            return row;
        }
        row.statistic = test->statistic;
        row.p = test->test.p;
        row.least_p = test->least_p;
        row.observers = test->observers;
        return row;
    }

    FactorEffectRow main_effect(const std::string& column, const Values& values) const {
        const std::vector<std::string> own = levels(column);
        if (own.size() < 2)
            return row_of(column, std::nullopt, "there is one level alone");
        Values compared = with_other_levels(values, beside(column), column);
        if (compared.empty())
            return row_of(column, std::nullopt, "no two levels were measured with all else alike");
        FactorTrials trials = trials_of(compared);
        for (const TrialValue& one : compared)
            trials.cells.push_back(place_in(own, one.trial->key(column)));
        trials.beside = {groups_of(compared, beside(column))};
        return row_of(column, main_effect_test(std::move(trials), own.size(), options_.permutation()),
                      "fewer than two observers have numbers in two levels");
    }

    FactorEffectRow interaction(const std::string& a, const std::string& b, const Values& values) const {
        const std::string effect = fmt::format("{}:{}", a, b);
        const std::vector<std::string> in_a = levels(a), in_b = levels(b);
        if (in_a.size() < 2 || in_b.size() < 2)
            return row_of(effect, std::nullopt, "one of both has one level alone");
        const std::vector<std::string> others = without(beside(a), b);
        FactorTrials trials = trials_of(values);
        for (const TrialValue& one : values)
            trials.cells.push_back(place_in(in_a, one.trial->key(a)) * in_b.size() +
                                   place_in(in_b, one.trial->key(b)));
        trials.beside = {groups_of(values, with(others, a)), groups_of(values, with(others, b))};
        return row_of(effect, interaction_test(trials, in_a.size(), in_b.size(), options_.permutation()),
                      "fewer than two observers have numbers that tell it from both by themselves");
    }

    const StudyResults& results_;
    const LevelLists& lists_;
    const StudyOptions& options_;
    std::vector<std::string> columns_;
};

} // namespace

std::vector<std::string> tested_columns(const std::vector<std::string>& by) {
    return without(without(by, "object"), "observer");
}

std::vector<FactorEffectRow> factor_effects(const StudyResults& results, const LevelLists& levels,
                                            const StudyOptions& options) {
    Values spreads;
    std::vector<Values> shares(results.areas.size());
    for (std::size_t i = 0; i < results.trials.size(); ++i) {
        const StudyTrial& trial = results.trials[i];
        if (trial.excluded)
            continue;
        const TrialSummaryRow summary = trial_summary(results, trial);
        const std::string& observer = observer_of(results, static_cast<int>(i));
        for (std::size_t area = 0; area < shares.size(); ++area) {
            if (summary.areas[area] && summary.counted > 0)
                shares[area].push_back(
                    {&trial, observer,
                     static_cast<double>(summary.areas[area]->fixations) / summary.counted});
        }
        if (summary.wss_mm2.value_or(0.0) > 0.0)
            spreads.push_back({&trial, observer, std::log(*summary.wss_mm2)});
    }
    const EffectTests tests(results, levels, options);
    std::vector<FactorEffectRow> rows;
    for (const std::string& area : results.compared_areas) {
        const auto index =
            static_cast<std::size_t>(std::ranges::find(results.areas, area) - results.areas.begin());
        std::ranges::copy(tests.rows_of(fmt::format("share on {}", area), shares[index]),
                          std::back_inserter(rows));
    }
    std::ranges::copy(tests.rows_of("log WSS", spreads), std::back_inserter(rows));
    return rows;
}

} // namespace overt
