#include "app/power/planted_spread.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "app/power/power_tests.h"
#include "experiment/base/error.h"
#include "experiment/base/parallel.h"
#include "experiment/statistics/point_spread.h"
#include "experiment/study/study_maps.h"

namespace overt {

namespace {

/// Studies of a few observers each, whose mean WSS is taken.
constexpr int pilot_studies = 16, pilot_observers = 3;
/// Farther from none, hardly any place is taken at the first draw.
constexpr double least_spread = -4.0, most_spread = 1.2;
constexpr double tolerance = 2e-3; ///< of the ratio's logarithm

/// Mean WSS of the effect's level in mm^2, over trials.
double mean_wss(const GazeStudies& studies, const PowerEffect& effect, std::uint64_t seed, int jobs) {
    std::vector<double> sums(pilot_studies, 0.0);
    std::vector<int> counts(pilot_studies, 0);
    parallel_for(
        pilot_studies,
        [&](int pilot) {
            const auto at = static_cast<std::size_t>(pilot);
            RandomStream random(seed, "pilot studies", at);
            const StudyResults results = studies.study(random.next_bits(), pilot_observers);
            for (const std::vector<LevelComparison>& cell : compared_cells(studies, results, effect)) {
                for (const LevelComparison& one : cell) {
                    const auto& scale = studies.surfaces()[static_cast<std::size_t>(one.sculpture)].scale;
                    std::vector<glm::dvec3> points;
                    for (const StudyFixation* fixation : one.a)
                        points.push_back(fixation->position);
                    sums[at] += point_spread(points)->wss() * scale->mm_per_unit * scale->mm_per_unit;
                    ++counts[at];
                }
            }
        },
        jobs);
    double sum = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        sum += sums[i];
        count += counts[i];
    }
    return count > 0 ? sum / count : 0.0;
}

} // namespace

std::string plant_spread(GazeStudies& studies, std::size_t index, std::uint64_t seed, int jobs) {
    const PowerEffect effect = studies.effects()[index];
    // With no effect on average there can be one on each observer.
    const double wanted = effect.size == 1.0 ? std::log(1.1) : std::log(effect.size);
    if (effect.size == 1.0 && effect.sd == 0.0)
        return "No difference of WSS is planted.";
    studies.plant_spread(index, 0.0, 0.0);
    const double without = mean_wss(studies, effect, seed, jobs);
    if (!(without > 0.0))
        return "No observer sees a sculpture in both levels, so that nothing is planted.";
    const auto log_ratio = [&](double spread) {
        studies.plant_spread(index, spread, 0.0);
        return std::log(mean_wss(studies, effect, seed, jobs) / without);
    };
    // Between a spread that does too little and one that does too much.
    double near = 0.0, of_near = 0.0, far = wanted > 0.0 ? most_spread : least_spread,
           of_far = log_ratio(far);
    if (std::abs(of_far) < std::abs(wanted) || of_far * wanted <= 0.0)
        throw InputError(fmt::format("--effect {}: on these sculptures WSS can be made {:.2f} times as large "
                                     "at {}, by looking at what lies {}.",
                                     effect.text(), std::exp(of_far), wanted > 0.0 ? "most" : "least",
                                     wanted > 0.0 ? "far from the middle" : "about the middle"));
    double spread = far, of_spread = of_far;
    for (int step = 0; step < 12 && std::abs(of_spread - wanted) > tolerance; ++step) {
        // Alternately the chord and the middle: the ratio is smooth, but not straight.
        spread = step % 2 == 0 ? near + (far - near) * (wanted - of_near) / (of_far - of_near)
                               : 0.5 * (near + far);
        of_spread = log_ratio(spread);
        const bool is_beyond = std::abs(of_spread) > std::abs(wanted) && of_spread * wanted > 0.0;
        (is_beyond ? far : near) = spread;
        (is_beyond ? of_far : of_near) = of_spread;
    }
    studies.plant_spread(index, effect.size == 1.0 ? 0.0 : spread, spread / of_spread);
    return fmt::format(
        "Gaze in {} {} prefers places {} the middle of the sculpture, such that the mean WSS of "
        "{} observers is {:.3f} times that without the preference.",
        effect.column, effect.level, wanted > 0.0 ? "far from" : "near", pilot_studies * pilot_observers,
        effect.size == 1.0 ? 1.0 : std::exp(of_spread));
}

} // namespace overt
