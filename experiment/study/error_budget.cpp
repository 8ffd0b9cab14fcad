#include "experiment/study/error_budget.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "experiment/base/parallel.h"
#include "experiment/study/study_maps.h"
#include "experiment/surface/euclidean_kernel.h"
#include "experiment/units.h"

namespace overt {

namespace {

/// Root of a weighted mean of squares; nothing unless every fixation has a number.
class MeanSquare {
  public:
    void add(std::optional<double> value, double weight) {
        is_whole_ &= value.has_value();
        sum_ += value ? weight * *value * *value : 0.0;
        weights_ += weight;
    }
    std::optional<double> root() const {
        return is_whole_ && weights_ > 0.0 ? std::optional(std::sqrt(sum_ / weights_)) : std::nullopt;
    }

  private:
    double sum_ = 0.0, weights_ = 0.0;
    bool is_whole_ = true;
};

/// The mean of what has a number.
class WeightedMean {
  public:
    void add(std::optional<double> value, double weight) {
        if (value) {
            sum_ += weight * *value;
            weights_ += weight;
        }
    }
    std::optional<double> mean() const {
        return weights_ > 0.0 ? std::optional(sum_ / weights_) : std::nullopt;
    }

  private:
    double sum_ = 0.0, weights_ = 0.0;
};

using LeakOfFixation = std::map<const StudyFixation*, double>;

/// A place of the coarse surface with all fixations that have a part of their weight there: ways along the
/// surface are the same for all of them.
struct SharedPlace {
    SurfacePlace place;
    std::vector<std::size_t> fixations;
    std::vector<double> weights, sigmas_mm;
};

LeakOfFixation leaks_on(const StudyResults& results, int object, const ObjectSurface& surface) {
    LeakOfFixation leaks;
    if (!surface.coarse)
        return leaks;
    std::vector<const StudyFixation*> fixations;
    std::map<std::tuple<std::uint32_t, double, double>, SharedPlace> places;
    for_each_counted_on(results, object, [&](const StudyFixation& fixation) {
        if (!fixation.triangle || !(fixation.sigma_mm > 0.0))
            return;
        for (const SurfaceWeight& weight : surface.coarse->moved(weight_of(fixation, 1.0))) {
            const SurfacePlace& at = weight.place;
            SharedPlace& shared = places[{at.triangle, at.barycentric.x, at.barycentric.y}];
            shared.place = at;
            shared.fixations.push_back(fixations.size());
            shared.weights.push_back(weight.weight);
            shared.sigmas_mm.push_back(weight.sigma_mm);
        }
        fixations.push_back(&fixation);
    });
    std::vector<const SharedPlace*> shared;
    for (const auto& [key, place] : places)
        shared.push_back(&place);
    const EuclideanKernel kernel(*surface.coarse_geometry);
    std::vector<std::vector<double>> shares(shared.size());
    parallel_for(static_cast<int>(shared.size()), [&](int i) {
        const auto at = static_cast<std::size_t>(i);
        shares[at] = kernel.leaked_shares(shared[at]->place, shared[at]->sigmas_mm);
    });
    std::vector<double> leaked(fixations.size()), whole(fixations.size());
    for (std::size_t place = 0; place < shared.size(); ++place) {
        for (std::size_t i = 0; i < shares[place].size(); ++i) {
            const std::size_t fixation = shared[place]->fixations[i];
            leaked[fixation] += shared[place]->weights[i] * shares[place][i];
            whole[fixation] += shared[place]->weights[i];
        }
    }
    for (std::size_t i = 0; i < fixations.size(); ++i)
        leaks[fixations[i]] = whole[i] > 0.0 ? leaked[i] / whole[i] : 0.0;
    return leaks;
}

ErrorBudget budget_of(const StudyResults& results, const StudyObject& object,
                      std::span<const StudyFixation* const> fixations, MapWeighting weighting) {
    MeanSquare accuracy, precision, lut, timing;
    WeightedMean at_edge, near_edge;
    // One of the cone's directions is enough; shares are sums of equal weights.
    constexpr double least_share = 1e-6;
    for (const StudyFixation* fixation : fixations) {
        const StudyTrial& trial = results.trials[static_cast<std::size_t>(fixation->trial)];
        const double weight = weighting == MapWeighting::duration ? fixation->duration_s : 1.0;
        accuracy.add(trial.quality.accuracy_deg ? fixation->cone_mm : std::nullopt, weight);
        const std::optional<double>& rms = trial.quality.rms_s2s_deg;
        precision.add(rms && fixation->mm_per_deg > 0.0
                          ? std::optional(*rms / std::numbers::sqrt2 * fixation->mm_per_deg)
                          : std::nullopt,
                      weight);
        // Samples that only lie within reach were moved by more than any look-up errs.
        if (fixation->lut_mm)
            lut.add(fixation->lut_mm, weight);
        const std::optional<double> speed = surface_speed_mm_s(*fixation, trial, object);
        timing.add(speed ? std::optional(*speed * trial.clock_uncertainty_s * std::numbers::inv_sqrt3)
                         : std::nullopt,
                   weight);
        at_edge.add(fixation->cone_at_edge, weight);
        if (fixation->cone_at_edge)
            near_edge.add(*fixation->cone_at_edge > least_share ? 1.0 : 0.0, fixation->samples);
    }
    ErrorBudget budget{accuracy.root(), precision.root(), lut.root(),      timing.root(),
                       std::nullopt,    at_edge.mean(),   near_edge.mean()};
    if (budget.accuracy_mm) {
        double squares = 0.0;
        for (const std::optional<double>& part :
             {budget.accuracy_mm, budget.precision_mm, budget.lut_mm, budget.timing_mm})
            squares += part.value_or(0.0) * part.value_or(0.0);
        budget.together_mm = std::sqrt(squares);
    }
    return budget;
}

} // namespace

std::optional<double> surface_speed_mm_s(const StudyFixation& fixation, const StudyTrial& trial,
                                         const StudyObject& object) {
    if (!object.mm_per_unit || trial.turns.empty())
        return std::nullopt;
    // The frames shown during it, one before and one after, as far as there are any.
    const auto after = [](double time, const StudyTurn& turn) { return time < turn.time_s; };
    auto begin = std::upper_bound(trial.turns.begin(), trial.turns.end(), fixation.onset_s, after);
    auto end = std::upper_bound(begin, trial.turns.end(), fixation.onset_s + fixation.duration_s, after);
    for (int back = 0; back < 2 && begin != trial.turns.begin(); ++back)
        --begin;
    if (end != trial.turns.end())
        ++end;
    if (end - begin < 2)
        return 0.0;
    double angle_deg = 0.0;
    for (auto turn = begin + 1; turn != end; ++turn)
        angle_deg += std::abs(turn->angle_deg - (turn - 1)->angle_deg);
    const double seconds = (end - 1)->time_s - begin->time_s;
    const double from_axis =
        std::hypot(fixation.position.x - object.axis_point.x, fixation.position.y - object.axis_point.y);
    return seconds > 0.0 ? to_radians(Degrees{angle_deg}).value / seconds * from_axis * *object.mm_per_unit
                         : 0.0;
}

void add_error_budget(StudyResults& results, int object, const ObjectSurface& surface) {
    const StudyObject& shown = results.objects[static_cast<std::size_t>(object)];
    const LeakOfFixation leaks = leaks_on(results, object, surface);
    for (StudyMap& map : results.maps) {
        if (map.object != object)
            continue;
        const std::vector<const StudyFixation*> fixations =
            fixations_on(results, results.groups[static_cast<std::size_t>(map.group)].trials, object);
        map.error = budget_of(results, shown, fixations, map.weighting);
        WeightedMean leak;
        for (const StudyFixation* fixation : fixations) {
            const auto found = leaks.find(fixation);
            if (found != leaks.end())
                leak.add(found->second, map.weighting == MapWeighting::duration ? fixation->duration_s : 1.0);
        }
        map.euclidean_leak = leak.mean();
    }
}

} // namespace overt
