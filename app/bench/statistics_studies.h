/// Simulated studies whose truth is known, with the statistics that the analysis gives of them.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/power/gaze_studies.h"
#include "experiment/statistics/estimate.h"

namespace overt {

/// What a study says: each p, and each number that has an interval, by its name in the tables.
struct StudyStatistics {
    std::map<std::string, double> p;
    std::map<std::string, Estimate> estimates;
    std::map<std::string, double>
        planted; ///< of estimates: what this study would give without the tracker's error
};

/// One kind of study: two sculptures in two materials, under two questions.
struct StatisticsSetting {
    int observers = 12;
    double accuracy_deg = 0.3; ///< standard deviation along each axis of a trial's constant error
    bool is_planted = false;   ///< in one material the odds of the head are 1.8 times as large
};

/// Studies of one setting, simulated at gaze level (GazeStudies): gaze errs by the same amount throughout a
/// trial, and observers differ in how much they look at the head.
class StatisticsStudies {
  public:
    explicit StatisticsStudies(const StatisticsSetting& setting);
    ~StatisticsStudies();
    StatisticsStudies(const StatisticsStudies&) = delete;
    StatisticsStudies& operator=(const StatisticsStudies&) = delete;

    /// A function of the seed. May be called from several threads.
    StudyStatistics study(std::uint64_t seed) const;

  private:
    StatisticsSetting setting_;
    Experiment experiment_;
    std::unique_ptr<GazeStudies> studies_;
    /// Of all fixations of a study, as read_study() adds it.
    void add_evidence(StudyResults& results) const;

    std::vector<ObjectSurface> surfaces_;
    std::unique_ptr<GazeStudies> without_error_; ///< the same observers
    std::unique_ptr<PursuedTurn> turn_;
    PoseTable poses_;
};

/// How often tests without an effect have p at most 0.05, and how often intervals of 95 % hold the truth.
struct StatisticsCount {
    std::string what; ///< the number's name, or that of the p
    bool is_p = false;
    int studies = 0;    ///< that gave it
    int hits = 0;       ///< p at most 0.05, or intervals that hold the truth
    double mean = 0.0;  ///< of an estimate over all studies
    double truth = 0.0; ///< what was planted, or, of numbers that are made of so many observers, the mean
    double share() const { return static_cast<double>(hits) / studies; }
};

/// Of studies of one setting, by name. Truths are the means over the studies, of the difference between
/// levels and of what is 0 where levels are alike 0 without an effect, and of shares without the tracker's
/// error those of the same observers without one. `done(i)` is told of each study that is done, one at a
/// time.
std::vector<StatisticsCount> count_statistics(const StatisticsSetting& setting, int studies,
                                              std::uint64_t seed, const std::function<void(int)>& done = {});

} // namespace overt
