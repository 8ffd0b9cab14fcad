#include "experiment/study/first_fixations.h"

#include <algorithm>
#include <array>
#include <string>

#include "experiment/statistics/bootstrap.h"

namespace overt {

namespace {

/// Of one observer, by number of the fixation.
struct FirstSums {
    struct OfNumber {
        double at = 0.0, up_to = 0.0;
        int trials = 0;
    };
    std::array<OfNumber, most_first_fixations> numbers;

    void add(const StudyResults& results, int trial, const Areas& areas, std::size_t area) {
        int number = 0, inside = 0;
        for_each_counted(results, trial, [&](const StudyFixation& fixation) {
            if (number == most_first_fixations)
                return;
            const bool is_on_it = fixation.part && areas.holds(area, fixation.part);
            OfNumber& of = numbers[static_cast<std::size_t>(number++)];
            inside += is_on_it;
            of.at += is_on_it;
            of.up_to += static_cast<double>(inside) / number;
            ++of.trials;
        });
    }
};

Estimate first_share(const std::vector<double>& shares, const StudyOptions& options) {
    return estimated_mean(shares, options.bootstrap(), "no trial on an object with this area has so many",
                          zero_to_one);
}

} // namespace

std::vector<FirstFixationsRow> first_fixations(const StudyResults& results, const LevelLists& levels,
                                               const StudyOptions& options) {
    std::vector<FirstFixationsRow> rows;
    for (const std::string& area : results.areas) {
        for (const StudyGroup& group : all_and_levels(results, results.by, levels)) {
            std::vector<FirstSums> observers;
            for (const auto& [observer, own] : by_observer(results, group.trials)) {
                FirstSums& sums = observers.emplace_back();
                for (const int trial : own) {
                    const StudyTrial& of = results.trials[static_cast<std::size_t>(trial)];
                    const Areas& areas = results.objects[static_cast<std::size_t>(of.object)].areas;
                    if (const std::optional<std::size_t> index = areas.find(area))
                        sums.add(results, trial, areas, *index);
                }
            }
            for (int number = 1; number <= most_first_fixations; ++number) {
                FirstFixationsRow row;
                row.area = area;
                row.keys = group.keys;
                row.number = number;
                std::vector<double> at, up_to;
                for (const FirstSums& sums : observers) {
                    const FirstSums::OfNumber& of = sums.numbers[static_cast<std::size_t>(number - 1)];
                    row.trials += of.trials;
                    if (of.trials == 0)
                        continue;
                    at.push_back(of.at / of.trials);
                    up_to.push_back(of.up_to / of.trials);
                }
                if (row.trials == 0)
                    break;
                row.observers = static_cast<int>(at.size());
                row.at = first_share(at, options);
                row.up_to = first_share(up_to, options);
                rows.push_back(std::move(row));
            }
        }
    }
    return rows;
}

} // namespace overt
