/// What simulated studies tell about the chance of finding an effect. Plain data.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiment/power/power_effect.h"
#include "experiment/power/sequential_design.h"
#include "experiment/statistics/estimate.h"
#include "experiment/statistics/permutation.h"
#include "experiment/study/results/study_results.h"

namespace overt {

/// The test of one effect in one simulated study with so many observers.
struct StudyOutcome {
    std::optional<double> p; ///< nothing: there was nothing to test
    /// Mean over observers of the difference of shares; the same of WSS in deg^2; CC of the maps.
    std::optional<double> estimate;
    /// Of answers: observers who do not have the measure in both levels, such as a threshold that could not
    /// be fitted. The test is without them.
    int without_measure = 0;
};

/// Of observers' differences: p of flips of their signs, or, with an effect size that is still of interest,
/// that they are shown to be smaller (PairedEvidence::equivalence_p).
StudyOutcome outcome_of(std::span<const double> differences, const PermutationSettings& settings,
                        const std::optional<double>& equivalence);

/// All studies with one number of observers.
struct PowerPoint {
    int observers = 0;
    std::vector<StudyOutcome> studies;
    int found = 0;                ///< p at most alpha
    int without_test = 0;         ///< count as not found
    int without_measure = 0;      ///< StudyOutcome::without_measure, summed over the studies
    Interval interval;            ///< Wilson's, 95 %, of the share found
    double median_estimate = 0.0; ///< over the studies with a test; 0 without any
    double share() const { return static_cast<double>(found) / static_cast<double>(studies.size()); }
};

struct PowerCurve {
    PowerEffect effect;
    std::string analysis;                          ///< the command whose row has this test
    std::string planted;                           ///< a sentence on how the effect was planted
    std::vector<PowerPoint> points;                ///< by number of observers, rising
    std::optional<SequentialOutcome> sequential{}; ///< with a look at each of these
};

struct PowerResults {
    std::string protocol; ///< title
    int trials = 0;       ///< of the first observer
    int planned = 0;      ///< observers that the protocol plans
    int studies = 0;
    double alpha = 0.05, target = 0.8;
    std::optional<double> equivalence{}; ///< studies are to show that effects are smaller; see outcome_of
    std::optional<AlphaSpending> sequential{}; ///< studies are looked at with each number of observers
    std::vector<StudyParameter> parameters;
    std::vector<std::string> remarks; ///< whole sentences
    std::vector<PowerCurve> curves;
};

/// Counts, intervals and medians of a curve from its studies.
void summarise(PowerCurve& curve, double alpha);

/// What studies of the curve come to that are looked at with each of its numbers of observers, and end where
/// p is at most that look's level.
SequentialOutcome with_looks(const PowerCurve& curve, double alpha, AlphaSpending spending);

/// The fewest observers of those simulated with whom, and with all more of those simulated, the share found
/// is at least the target. Nothing if there are none.
std::optional<int> observers_needed(const PowerCurve& curve, double target);

/// The answer in a sentence or two.
std::string answer_of(const PowerCurve& curve, const PowerResults& results);

/// With fewer observers no outcome has a p of alpha or less: 2 / 2^n is the least.
int fewest_testable_observers(double alpha);

} // namespace overt
