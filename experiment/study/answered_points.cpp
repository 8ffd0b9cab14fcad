#include "experiment/study/answered_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include "experiment/base/random.h"
#include "experiment/statistics/bootstrap.h"
#include "experiment/statistics/pairwise_mean.h"

namespace overt {

namespace {

using PointList = std::vector<const AnsweredPointRow*>;
using PointsByObserver = std::map<std::string, PointList>;

const StudyObject& shown_object(const StudyResults& results, int object) {
    return results.objects[static_cast<std::size_t>(object)];
}

/// Of places on one object, in mm; of an object whose scale is not known in its own unit.
double apart_mm(const StudyObject& object, const AnsweredPointRow& a, const AnsweredPointRow& b) {
    return glm::distance(*a.place, *b.place) * object.mm_per_unit.value_or(1.0);
}

PointsByObserver of_observers(const PointList& points) {
    PointsByObserver by_observer;
    for (const AnsweredPointRow* point : points)
        by_observer[point->of.observer].push_back(point);
    return by_observer;
}

/// Mean distance of two of them; nothing of fewer.
std::optional<double> within_mm(const StudyObject& object, const PointList& points) {
    double sum = 0.0;
    int pairs = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t j = i + 1; j < points.size(); ++j, ++pairs)
            sum += apart_mm(object, *points[i], *points[j]);
    return pairs > 0 ? std::optional(sum / pairs) : std::nullopt;
}

/// That of two places drawn from the exposure.
std::optional<double> chance_mm(const StudyObject& object, std::uint64_t seed) {
    if (!object.mesh || object.exposure_density.size() != object.mesh->positions.size())
        return std::nullopt;
    // A vertex stands for a third of each triangle about it.
    std::vector<double> weights(object.mesh->positions.size(), 0.0);
    for (const auto& triangle : object.mesh->triangles) {
        const glm::dvec3 a = object.mesh->positions[triangle[0]], b = object.mesh->positions[triangle[1]],
                         c = object.mesh->positions[triangle[2]];
        const double third = glm::length(glm::cross(b - a, c - a)) / 6.0;
        for (int corner = 0; corner < 3; ++corner)
            weights[triangle[corner]] += third * object.exposure_density[triangle[corner]];
    }
    std::partial_sum(weights.begin(), weights.end(), weights.begin());
    if (weights.empty() || !(weights.back() > 0.0))
        return std::nullopt;
    RandomStream random(seed, "places by chance");
    const auto drawn = [&] {
        const auto at = std::ranges::upper_bound(weights, random.uniform() * weights.back());
        const auto vertex = std::min<std::ptrdiff_t>(at - weights.begin(), std::ssize(weights) - 1);
        return glm::dvec3(object.mesh->positions[static_cast<std::size_t>(vertex)]);
    };
    // So many that the mean is exact to about half a per cent.
    constexpr int pairs = 20'000;
    double sum = 0.0;
    for (int i = 0; i < pairs; ++i) {
        const glm::dvec3 one = drawn();
        sum += glm::distance(one, drawn());
    }
    return sum / pairs * object.mm_per_unit.value_or(1.0);
}

/// The middle one, and how far they spread from it.
void add_middle(PointSpreadRow& row, const StudyObject& object, const PointList& points) {
    double least = std::numeric_limits<double>::infinity();
    for (const AnsweredPointRow* middle : points) {
        double sum = 0.0;
        for (const AnsweredPointRow* other : points)
            sum += std::pow(apart_mm(object, *middle, *other), 2.0);
        if (sum < least) {
            least = sum;
            row.middle = middle->place;
            row.middle_part = middle->part_name;
        }
    }
    if (row.middle)
        row.spread_mm = std::sqrt(least / static_cast<double>(points.size()));
}

Estimate between_mm(const StudyObject& object, const PointsByObserver& by_observer, double confidence) {
    PairwiseMean mean(by_observer.size());
    std::size_t a = 0;
    for (auto one = by_observer.begin(); one != by_observer.end(); ++one, ++a) {
        std::size_t b = a + 1;
        for (auto other = std::next(one); other != by_observer.end(); ++other, ++b)
            for (const AnsweredPointRow* here : one->second)
                for (const AnsweredPointRow* there : other->second)
                    mean.add(a, b, apart_mm(object, *here, *there));
    }
    return mean.estimate(confidence, "one observer only");
}

Estimate divided(const Estimate& by, std::optional<double> divisor) {
    if (!by.value)
        return by;
    if (!divisor || !(*divisor > 0.0))
        return Estimate::none("what is shown of the surface is not known");
    Estimate ratio = Estimate::of(*by.value / *divisor);
    if (by.interval)
        ratio.interval = Interval{by.interval->low / *divisor, by.interval->high / *divisor};
    return ratio;
}

class PointReckoning {
  public:
    PointReckoning(StudyResults& results, const StudyOptions& options)
        : results_(results), options_(options) {}

    void add(const PointsOf& of, const PointList& all) {
        PointList placed;
        for (const AnsweredPointRow* point : all)
            if (point->place)
                placed.push_back(point);
        const PointsByObserver by_observer = of_observers(placed);
        add_spread(of, all, placed, by_observer);
        add_areas(of, placed, by_observer);
        for (const auto& [observer, own] : of_observers(all)) {
            PointList own_placed;
            for (const AnsweredPointRow* point : own)
                if (point->place)
                    own_placed.push_back(point);
            const PointsOf single{observer, of.task, of.answer, of.object};
            add_spread(single, own, own_placed, {{observer, own_placed}});
            add_areas(single, own_placed, {{observer, own_placed}});
        }
    }

    /// Answers of the same trial, by name in the order of the alphabet.
    void add_pairs() {
        std::map<std::pair<int, int>, PointList> by_trial;
        for (const AnsweredPointRow& point : results_.points.given)
            if (point.place)
                by_trial[{point.session, point.trial}].push_back(&point);
        std::map<std::tuple<std::string, std::string, std::string, int>,
                 std::map<std::string, std::vector<double>>>
            distances;
        for (const auto& [trial, points] : by_trial)
            for (const AnsweredPointRow* a : points)
                for (const AnsweredPointRow* b : points)
                    if (a->of.answer < b->of.answer && a->of.object == b->of.object)
                        distances[{a->of.task, a->of.answer, b->of.answer, a->of.object}][a->of.observer]
                            .push_back(apart_mm(shown_object(results_, a->of.object), *a, *b));
        for (const auto& [of, by_observer] : distances) {
            const auto& [task, first, second, object] = of;
            PointPairRow all{"", task, first, second, object, 0, static_cast<int>(by_observer.size()), {}};
            std::vector<double> means;
            std::vector<PointPairRow> single;
            for (const auto& [observer, own] : by_observer) {
                const double mean =
                    std::accumulate(own.begin(), own.end(), 0.0) / static_cast<double>(own.size());
                means.push_back(mean);
                all.trials += static_cast<int>(own.size());
                single.push_back({observer, task, first, second, object, static_cast<int>(own.size()), 1,
                                  Estimate::of(mean)});
            }
            all.distance_mm = estimated_mean(means, options_.bootstrap(), "no trial has both", from_zero_on);
            results_.points.pairs.push_back(std::move(all));
            std::ranges::move(single, std::back_inserter(results_.points.pairs));
        }
    }

  private:
    void add_spread(const PointsOf& of, const PointList& all, const PointList& placed,
                    const PointsByObserver& by_observer) {
        const StudyObject& object = shown_object(results_, of.object);
        PointSpreadRow& row = results_.points.spreads.emplace_back();
        row.of = of;
        row.answers = static_cast<int>(all.size());
        row.on_surface = static_cast<int>(placed.size());
        row.observers = static_cast<int>(by_observer.size());
        add_middle(row, object, placed);
        std::vector<double> within;
        for (const auto& [observer, own] : by_observer)
            if (const std::optional<double> mean = within_mm(object, own))
                within.push_back(*mean);
        const char* const pointed_once = "no observer answered twice";
        row.within_mm = of.observer.empty()
                            ? estimated_mean(within, options_.bootstrap(), pointed_once, from_zero_on)
                        : within.empty() ? Estimate::none("answered once")
                                         : Estimate::of(within.front());
        if (!of.observer.empty()) {
            row.between_mm = row.of_chance = Estimate::none("of one observer");
            return;
        }
        row.between_mm = between_mm(object, by_observer, options_.confidence).cut_to(from_zero_on);
        const auto [known, is_new] = chance_.try_emplace(of.object);
        if (is_new)
            known->second = chance_mm(object, options_.seed);
        row.chance_mm = known->second;
        row.of_chance = divided(row.between_mm, row.chance_mm);
    }

    void add_areas(const PointsOf& of, const PointList& placed, const PointsByObserver& by_observer) {
        const StudyObject& object = shown_object(results_, of.object);
        for (std::size_t area = 0; area < object.areas.size() && !placed.empty(); ++area) {
            PointAreaRow& row = results_.points.areas.emplace_back();
            row.of = of;
            row.area = object.areas.names()[area];
            row.answers = static_cast<int>(placed.size());
            row.observers = static_cast<int>(by_observer.size());
            std::vector<double> shares;
            for (const auto& [observer, own] : by_observer) {
                const auto on_area = std::ranges::count_if(own, [&](const AnsweredPointRow* point) {
                    return object.areas.holds(area, point->part);
                });
                row.on_area += static_cast<int>(on_area);
                shares.push_back(static_cast<double>(on_area) / static_cast<double>(own.size()));
            }
            row.share = of.observer.empty()
                            ? estimated_mean(shares, options_.bootstrap(), "no answer", zero_to_one)
                            : Estimate::of(shares.front());
            for (const ExposureRow& exposure : results_.exposures)
                if (exposure.object == of.object && exposure.area == row.area)
                    row.by_chance = exposure.share_of_exposure;
        }
    }

    StudyResults& results_;
    const StudyOptions& options_;
    std::map<int, std::optional<double>> chance_; ///< by object
};

} // namespace

void reckon_points(StudyResults& results, const StudyOptions& options) {
    results.points.spreads.clear();
    results.points.areas.clear();
    results.points.pairs.clear();
    std::map<PointsOf, PointList> by_answer;
    for (const AnsweredPointRow& point : results.points.given)
        by_answer[{"", point.of.task, point.of.answer, point.of.object}].push_back(&point);
    PointReckoning reckoning(results, options);
    for (const auto& [of, points] : by_answer)
        reckoning.add(of, points);
    reckoning.add_pairs();
}

} // namespace overt
