/// The power of a planned study: simulated studies, each with the tests of the analysis.
#pragma once

#include <functional>
#include <optional>
#include <string_view>

#include "app/power/gaze_studies.h"
#include "experiment/power/power_results.h"

namespace overt {

struct PowerSettings {
    std::vector<int> observers; ///< numbers, rising
    int studies = 200;
    double alpha = 0.05, target = 0.8;
    std::uint64_t seed = 1;
    /// Studies are to show that an effect is smaller than this, in standard deviations of observers'
    /// differences (PairedEvidence::equivalence_p); nothing: that there is one.
    std::optional<double> equivalence{};
    std::optional<AlphaSpending> sequential{}; ///< see PowerResults
    int permutations = 5000;                   ///< where all swaps or flips are too many
    int jobs = 0;                              ///< threads; 0: one for each processor
    GazeStudySettings gaze;
};

/// Told what is being done and how much of it, from any thread, one at a time; ends the work by throwing.
using PowerProgress = std::function<void(std::string_view what, int done, int total)>;

/// Each study is simulated with the most observers; one with fewer has the first of them. The tests are those
/// of the table of pairs (study_pairs): between materials within each task, between tasks within each
/// object. Each effect is simulated alone, with the same seeds. A function of its arguments, whatever the
/// number of threads. Throws InputError for a spread of fixations that the objects do not allow, and as
/// GazeStudies does, for equivalence of maps (CC), which are no differences of observers, or
/// of factors, and for looks at it.
PowerResults simulate_power(const Experiment& experiment, const std::vector<PowerEffect>& effects,
                            const PowerSettings& settings, const PowerProgress& progress);

} // namespace overt
