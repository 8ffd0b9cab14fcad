#include "experiment/study/screen_area_looks.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

namespace overt {

namespace {

/// The shapes of each name of a trial, by the order in which the names come; those of no area last, without
/// shapes.
struct TrialAreas {
    std::vector<std::string> names;
    std::vector<std::vector<const ScreenArea*>> shapes;
};

TrialAreas areas_by_name(const std::vector<ScreenArea>& areas) {
    TrialAreas by_name;
    for (const ScreenArea& area : areas) {
        const auto found = std::ranges::find(by_name.names, area.name);
        const auto index = static_cast<std::size_t>(found - by_name.names.begin());
        if (found == by_name.names.end()) {
            by_name.names.push_back(area.name);
            by_name.shapes.emplace_back();
        }
        by_name.shapes[index].push_back(&area);
    }
    by_name.names.emplace_back(no_screen_area);
    by_name.shapes.emplace_back();
    return by_name;
}

bool is_looked_at(const StudyFixation& fixation) {
    return fixation.why != NotCounted::began_before_onset && fixation.why != NotCounted::too_short &&
           fixation.why != NotCounted::trial_excluded;
}

std::vector<AreaLook> looks_of(const StudyResults& results, const StudyTrial& trial,
                               const TrialAreas& areas) {
    std::vector<AreaLook> looks;
    for (std::size_t i = trial.first_fixation; i < trial.first_fixation + trial.fixations; ++i) {
        const StudyFixation& fixation = results.fixations[i];
        if (!is_looked_at(fixation))
            continue;
        AreaLook look{fixation.onset_s, fixation.duration_s, {}};
        const double middle_s = fixation.onset_s + 0.5 * fixation.duration_s;
        for (std::size_t area = 0; area < areas.shapes.size(); ++area) {
            if (std::ranges::any_of(areas.shapes[area], [&](const ScreenArea* shape) {
                    return shape->is_there_at(middle_s) && shape->contains(fixation.place);
                }))
                look.areas.push_back(area);
        }
        if (look.areas.empty())
            look.areas.push_back(areas.names.size() - 1);
        looks.push_back(std::move(look));
    }
    return looks;
}

/// How long the shapes are there, and how much of the screen they fill meanwhile.
class AreaPresence {
  public:
    explicit AreaPresence(glm::ivec2 screen_px) : screen_px_(screen_px) {}

    struct Sum {
        double there_s = 0.0, pixel_seconds = 0.0;
    };
    Sum sum(const std::vector<const ScreenArea*>& shapes, double presentation_s) {
        std::set<double> times{0.0, presentation_s};
        for (const ScreenArea* shape : shapes)
            for (const double time : {shape->from_s, shape->until_s})
                if (time > 0.0 && time < presentation_s)
                    times.insert(time);
        Sum all;
        for (auto from = times.begin(), until = std::next(from); until != times.end(); ++from, ++until) {
            std::vector<const ScreenArea*> there;
            for (const ScreenArea* shape : shapes)
                if (shape->is_there_at(*from))
                    there.push_back(shape);
            if (there.empty())
                continue;
            all.there_s += *until - *from;
            all.pixel_seconds += (*until - *from) * static_cast<double>(pixels(there));
        }
        return all;
    }

  private:
    /// Trials mostly have the same areas, and a screen has millions of pixels.
    std::int64_t pixels(const std::vector<const ScreenArea*>& shapes) {
        std::vector<std::pair<ScreenArea::Shape, std::vector<double>>> key;
        for (const ScreenArea* shape : shapes) {
            key.emplace_back(shape->shape, std::vector<double>());
            for (const ScreenPoint& point : shape->points)
                key.back().second.insert(key.back().second.end(), {point.x_px, point.y_px});
        }
        const auto [found, is_new] = known_.try_emplace(std::move(key), 0);
        if (is_new)
            found->second = pixels_in(shapes, screen_px_);
        return found->second;
    }

    glm::ivec2 screen_px_;
    std::map<std::vector<std::pair<ScreenArea::Shape, std::vector<double>>>, std::int64_t> known_;
};

void add_trial_rows(StudyResults& results, int index, std::map<int, AreaPresence>& presences) {
    const StudyTrial& trial = results.trials[static_cast<std::size_t>(index)];
    const TrialAreas areas = areas_by_name(results.screen_areas[static_cast<std::size_t>(index)]);
    const std::size_t count = areas.names.size();
    const std::vector<AreaLook> looks = looks_of(results, trial, areas);
    const std::vector<AreaVisits> visits = area_visits(looks, count);
    double fixated_s = 0.0;
    for (const AreaLook& look : looks)
        fixated_s += look.duration_s;
    const glm::ivec2 screen_px = results.objects[static_cast<std::size_t>(trial.object)].screen.screen_px;
    AreaPresence& presence = presences.try_emplace(trial.object, screen_px).first->second;
    const double screen_seconds = trial.presentation_s * screen_px.x * screen_px.y;
    for (std::size_t area = 0; area < count; ++area) {
        ScreenAreaTrialRow row{index, areas.names[area], {}, {}, {}, visits[area]};
        std::vector<const ScreenArea*> shapes = areas.shapes[area];
        const bool is_rest = area + 1 == count;
        if (is_rest)
            for (const auto& others : areas.shapes)
                shapes.insert(shapes.end(), others.begin(), others.end());
        if (screen_seconds > 0.0) {
            const AreaPresence::Sum there = presence.sum(shapes, trial.presentation_s);
            row.there_s = is_rest ? trial.presentation_s : there.there_s;
            const double share = there.pixel_seconds / screen_seconds;
            row.share_by_chance = is_rest ? 1.0 - share : share;
        }
        if (fixated_s > 0.0)
            row.dwell_share = row.visits.dwell_s / fixated_s;
        results.screen_area_trials.push_back(std::move(row));
    }
    const std::vector<int> transitions = area_transitions(looks, count);
    for (std::size_t from = 0; from < count; ++from)
        for (std::size_t to = 0; to < count; ++to)
            if (const int times = transitions[from * count + to]; times > 0)
                results.area_transitions.push_back({index, areas.names[from], areas.names[to], times});
}

double mean_of(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values)
        sum += value;
    return sum / static_cast<double>(values.size());
}

Estimate estimated_part(const std::vector<double>& shares, const StudyOptions& options) {
    return estimated_mean(shares, options.bootstrap(), "no trial with this area has a fixation", zero_to_one);
}

using RowsByTrial = std::map<std::tuple<int, std::string>, const ScreenAreaTrialRow*>;

std::optional<ScreenAreaRow> area_row(const StudyResults& results, const RowsByTrial& by_trial,
                                      const StudyGroup& group, const std::string& area,
                                      const StudyOptions& options) {
    ScreenAreaRow row;
    row.keys = group.keys;
    row.area = area;
    std::vector<double> chances, shares, visits, reached, arrivals;
    for (const auto& [observer, trials] : by_observer(results, group.trials)) {
        double dwell_s = 0.0, fixated_s = 0.0;
        std::vector<double> own_visits, own_reached, own_arrivals;
        for (const int trial : trials) {
            const auto found = by_trial.find({trial, area});
            if (found == by_trial.end())
                continue;
            const ScreenAreaTrialRow& of = *found->second;
            ++row.trials;
            row.fixations += of.visits.fixations;
            if (of.share_by_chance)
                chances.push_back(*of.share_by_chance);
            if (!of.dwell_share)
                continue;
            dwell_s += of.visits.dwell_s;
            own_visits.push_back(of.visits.visits);
            own_reached.push_back(of.visits.fixations > 0 ? 1.0 : 0.0);
            if (of.visits.first_arrival_s)
                own_arrivals.push_back(*of.visits.first_arrival_s);
            const StudyTrial& at = results.trials[static_cast<std::size_t>(trial)];
            for (std::size_t i = at.first_fixation; i < at.first_fixation + at.fixations; ++i)
                if (is_looked_at(results.fixations[i]))
                    fixated_s += results.fixations[i].duration_s;
        }
        if (own_visits.empty())
            continue;
        shares.push_back(dwell_s / fixated_s);
        visits.push_back(mean_of(own_visits));
        reached.push_back(mean_of(own_reached));
        if (!own_arrivals.empty())
            arrivals.push_back(mean_of(own_arrivals));
    }
    if (row.trials == 0)
        return std::nullopt;
    row.observers = static_cast<int>(shares.size());
    if (!chances.empty())
        row.share_by_chance = mean_of(chances);
    row.dwell_share = estimated_part(shares, options);
    row.reached = estimated_part(reached, options);
    row.visits =
        estimated_mean(visits, options.bootstrap(), "no trial with this area has a fixation", from_zero_on);
    row.first_arrival_s =
        estimated_mean(arrivals, options.bootstrap(), "no fixation is in this area", from_zero_on);
    return row;
}

/// In the order in which trials name them, those of no area last.
std::vector<std::string> area_names(const StudyResults& results) {
    std::vector<std::string> names;
    for (const ScreenAreaTrialRow& row : results.screen_area_trials)
        if (row.area != no_screen_area && std::ranges::find(names, row.area) == names.end())
            names.push_back(row.area);
    names.emplace_back(no_screen_area);
    return names;
}

} // namespace

void add_screen_area_looks(StudyResults& results, const LevelLists& order, const StudyOptions& options) {
    if (results.screen_areas.empty())
        return;
    std::map<int, AreaPresence> presences;
    for (int trial = 0; trial < static_cast<int>(results.trials.size()); ++trial)
        if (!results.trials[static_cast<std::size_t>(trial)].excluded &&
            !results.screen_areas[static_cast<std::size_t>(trial)].empty())
            add_trial_rows(results, trial, presences);
    RowsByTrial by_trial;
    for (const ScreenAreaTrialRow& row : results.screen_area_trials)
        by_trial[{row.trial, row.area}] = &row;
    std::vector<StudyGroup> groups = results.groups;
    for (StudyGroup& group : all_and_levels(results, results.by, order))
        if (std::ranges::find(groups, group.keys, &StudyGroup::keys) == groups.end())
            groups.push_back(std::move(group));
    const std::vector<std::string> names = area_names(results);
    for (const StudyGroup& group : groups)
        for (const std::string& area : names)
            if (std::optional<ScreenAreaRow> row = area_row(results, by_trial, group, area, options))
                results.screen_area_groups.push_back(*std::move(row));
}

} // namespace overt
