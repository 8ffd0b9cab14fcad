/// A study with the paper's design, of fixations whose part and spread are given: what is reckoned from
/// trials.
#pragma once

#include <functional>
#include <string>

#include <fmt/format.h>

#include "experiment/base/random.h"
#include "experiment/study/results/study_groups.h"
#include "experiment/study/results/study_options.h"

namespace overt::test {

struct TrialOfDesign {
    int observer = 0, task = 0, object = 0, material = 0;
};

/// Where a trial's fixations go: each to the head with this probability, normally about the middle along each
/// axis.
struct LooksOfTrial {
    double head_share = 0.5, spread_mm = 20.0;
};

/// Three objects in three materials. Tasks 0 and 1 are asked of all nine, tasks 2 to 5 once of each
/// object, whose material goes round over the observers: 30 trials each.
class CountedTrials {
  public:
    using Looks = std::function<LooksOfTrial(const TrialOfDesign&, RandomStream&)>;

    CountedTrials(int observers, const Looks& looks, std::uint64_t seed = 1, int fixations = 20) {
        for (int i = 0; i < 3; ++i) {
            StudyObject& object = results.objects.emplace_back();
            object.id = fmt::format("object {}", i);
            object.part_names = {"body", "head"};
            object.areas = Areas(object.part_names);
            object.mm_per_unit = 1.0;
        }
        results.areas = results.compared_areas = {"body", "head"};
        results.area = "head";
        results.by = options.by = {"task", "object", "material"};
        for (int observer = 0; observer < observers; ++observer) {
            results.sessions.emplace_back().observer = fmt::format("{:02}", observer + 1);
            int number = 0;
            for (int task = 0; task < 6; ++task) {
                for (int object = 0; object < 3; ++object) {
                    for (int material = 0; material < 3; ++material) {
                        if (task >= 2 && material != (observer + task + object) % 3)
                            continue;
                        RandomStream random(seed, "counted trials",
                                            static_cast<std::uint64_t>(100 * observer + number));
                        const TrialOfDesign trial{observer, task, object, material};
                        add(trial, ++number, looks(trial, random), fixations, random);
                    }
                }
            }
        }
    }

    StudyResults results;
    StudyOptions options;

  private:
    void add(const TrialOfDesign& of, int number, const LooksOfTrial& looks, int fixations,
             RandomStream& random) {
        StudyTrial trial;
        trial.session = of.observer;
        trial.object = of.object;
        trial.number = number;
        trial.keys = {{"observer", results.sessions.back().observer},
                      {"task", fmt::format("task {}", of.task)},
                      {"object", results.objects[static_cast<std::size_t>(of.object)].id},
                      {"material", fmt::format("material {}", of.material)}};
        trial.presentation_s = 8.0;
        trial.first_fixation = results.fixations.size();
        trial.fixations = static_cast<std::size_t>(fixations);
        for (int i = 0; i < fixations; ++i) {
            StudyFixation& fixation = results.fixations.emplace_back();
            fixation.trial = static_cast<int>(results.trials.size());
            fixation.duration_s = 0.25;
            fixation.part = random.uniform() < looks.head_share ? PartIndex{1} : PartIndex{0};
            fixation.position =
                looks.spread_mm * glm::dvec3(random.normal(), random.normal(), random.normal());
        }
        results.trials.push_back(std::move(trial));
    }
};

} // namespace overt::test
