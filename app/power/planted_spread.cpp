#include "app/power/planted_spread.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include <fmt/format.h>

#include "app/power/power_tests.h"
#include "experiment/base/error.h"
#include "experiment/base/parallel.h"
#include "experiment/statistics/point_spread.h"

namespace overt {

namespace {

/// Pilot studies are of so many observers each, and of as many studies as have so many trials in the level:
/// their mean WSS has a relative standard error of about 1 %.
constexpr int pilot_observers = 3, pilot_trials = 1500, most_pilot_studies = 500;
/// Farther from none, hardly any place is taken at the first draw.
constexpr double least_spread = -4.0, most_spread = 1.2;
constexpr double tolerance = 2e-3; ///< of the ratio's logarithm

/// The mean WSS of an effect's level.
class Pilot {
  public:
    Pilot(const GazeStudies& studies, std::size_t effect, std::uint64_t seed, int jobs)
        : studies_(studies), effect_(effect), seed_(seed), jobs_(jobs) {
        // Only trials that are compared are tested, and therefore simulated.
        const StudyResults first = study(0, {});
        int compared = 0;
        for (const auto& cell : compared_cells(studies, first, studies.effects()[effect])) {
            for (const LevelComparison& one : cell) {
                tasks_.insert(first.trials[static_cast<std::size_t>(one.a.front()->trial)].key("task"));
                ++compared;
            }
        }
        if (compared > 0)
            studies_wanted_ = std::min((pilot_trials + compared - 1) / compared, most_pilot_studies);
    }

    int observers() const { return studies_wanted_ * pilot_observers; }

    /// In deg^2, over trials; 0 where none is compared.
    double mean_wss(std::span<const std::string> ids_of_tasks) const {
        std::vector<double> sums(static_cast<std::size_t>(studies_wanted_), 0.0);
        std::vector<int> counts(sums.size(), 0);
        const auto wanted = [&](const Trial& trial) {
            return studies_.holds_in(effect_, trial) &&
                   tasks_.contains(ids_of_tasks[static_cast<std::size_t>(trial.task)]);
        };
        parallel_for(
            studies_wanted_,
            [&](int number) {
                const auto at = static_cast<std::size_t>(number);
                const StudyResults results = study(at, wanted);
                for (int t = 0; t < static_cast<int>(results.trials.size()); ++t) {
                    const int object = results.trials[static_cast<std::size_t>(t)].object;
                    const auto& scale = studies_.surfaces()[static_cast<std::size_t>(object)].scale;
                    std::vector<glm::dvec3> points;
                    for_each_counted(results, t, [&](const StudyFixation& fixation) {
                        points.push_back(fixation.position);
                    });
                    if (const auto spread = point_spread(points); spread && scale) {
                        const double deg_per_unit = scale->mm_per_unit / scale->mm_per_deg;
                        sums[at] += spread->wss() * deg_per_unit * deg_per_unit;
                        ++counts[at];
                    }
                }
            },
            jobs_);
        const double sum = std::accumulate(sums.begin(), sums.end(), 0.0);
        const int count = std::accumulate(counts.begin(), counts.end(), 0);
        return count > 0 ? sum / count : 0.0;
    }

  private:
    StudyResults study(std::size_t number, const std::function<bool(const Trial&)>& wanted) const {
        RandomStream random(seed_, "pilot studies", number);
        return studies_.study(random.next_bits(), pilot_observers, wanted);
    }

    const GazeStudies& studies_;
    std::size_t effect_;
    std::uint64_t seed_;
    int jobs_;
    int studies_wanted_ = 0;
    std::set<std::string> tasks_; ///< in which the levels are compared
};

} // namespace

std::string plant_spread(GazeStudies& studies, std::size_t index, std::uint64_t seed, int jobs) {
    const PowerEffect effect = studies.effects()[index];
    // With no effect on average there can be one on each observer.
    const double wanted = effect.size == 1.0 ? std::log(1.1) : std::log(effect.size);
    if (effect.size == 1.0 && effect.sd == 0.0)
        return "No difference is planted, on average.";
    studies.plant_spread(index, 0.0, 0.0);
    const Pilot pilot(studies, index, seed, jobs);
    const std::vector<std::string>& tasks = studies.levels().at("task");
    const double without = pilot.mean_wss(tasks);
    if (!(without > 0.0))
        return "No observer sees an object in both levels, so that nothing is planted.";
    const auto log_ratio = [&](double spread) {
        studies.plant_spread(index, spread, 0.0);
        return std::log(pilot.mean_wss(tasks) / without);
    };
    // Between a spread that does too little and one that does too much.
    double near = 0.0, of_near = 0.0, far = wanted > 0.0 ? most_spread : least_spread,
           of_far = log_ratio(far);
    if (std::abs(of_far) < std::abs(wanted) || of_far * wanted <= 0.0)
        throw InputError(fmt::format("--effect {}: on these objects WSS can be made {:.2f} times as large "
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
    return fmt::format("Gaze in {} {} prefers places {} the middle of the object, such that the mean WSS of "
                       "{} observers is {:.3f} times that without the preference (spread = {:.3f} in a "
                       "[[simulated_effect]]).",
                       effect.column, effect.level, wanted > 0.0 ? "far from" : "near", pilot.observers(),
                       effect.size == 1.0 ? 1.0 : std::exp(of_spread), effect.size == 1.0 ? 0.0 : spread);
}

} // namespace overt
