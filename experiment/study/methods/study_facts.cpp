#include "experiment/study/methods/study_facts.h"

#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "experiment/statistics/bootstrap.h"

namespace overt {

std::int64_t trials_of_presentations(const StudyResults& results) {
    std::set<std::pair<int, int>> trials;
    for (const StudyTrial& trial : results.trials)
        trials.emplace(trial.session, trial.number);
    return static_cast<std::int64_t>(trials.size());
}

std::string_view unit_of_gaze(const StudyResults& results) {
    const auto presentations = static_cast<std::int64_t>(results.trials.size());
    return trials_of_presentations(results) == presentations ? "trial" : "presentation";
}

namespace {

template <std::optional<double> StudyQuality::*number>
std::optional<double> quality_of(const StudyTrial& trial) {
    return trial.quality.*number;
}

template <double StudyQuality::*samples> std::optional<double> percent_of(const StudyTrial& trial) {
    const StudyQuality& quality = trial.quality;
    if (!(quality.samples > 0.0))
        return std::nullopt;
    return 100.0 * quality.*samples / quality.samples;
}

std::optional<double> presentation_of(const StudyTrial& trial) {
    if (!(trial.presentation_s > 0.0))
        return std::nullopt;
    return trial.presentation_s;
}

std::optional<Spread> spread_of(std::vector<double> values) {
    if (values.empty())
        return std::nullopt;
    std::ranges::sort(values);
    return Spread{quantile_of_sorted(values, 0.5), values.front(), values.back(),
                  static_cast<int>(values.size())};
}

std::optional<double> whole_number_of(const std::string& text) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
        return std::nullopt;
    return value;
}

void add_once(std::vector<NamedThing>& to, NamedThing thing) {
    if (std::ranges::find(to, thing) == to.end())
        to.push_back(std::move(thing));
}

/// What the trials' column names, with the title and in the order of their session's list.
std::vector<NamedThing> named_in_trials(const StudyResults& results, const char* column,
                                        std::vector<NamedThing> SessionSetup::*list) {
    std::set<std::pair<int, std::string>> named; ///< by session
    for (const StudyTrial& trial : results.trials)
        named.emplace(trial.session, trial.key(column));
    std::vector<NamedThing> things;
    for (std::size_t session = 0; session < results.sessions.size(); ++session)
        for (const NamedThing& known : results.sessions[session].setup.*list)
            if (named.contains({static_cast<int>(session), known.id}))
                add_once(things, known);
    return things;
}

} // namespace

const std::array<TrialMeasure, 8> trial_measures{{
    {"accuracy_deg", "accuracy (mean error of the validation)", "deg", 3,
     quality_of<&StudyQuality::accuracy_deg>, "there was no validation"},
    {"drift_deg", "error at the drift check", "deg", 3, quality_of<&StudyQuality::drift_deg>,
     "there was no drift check"},
    {"rms_s2s_deg", "precision (RMS-S2S)", "deg", 4, quality_of<&StudyQuality::rms_s2s_deg>,
     "there are no fixations, or degrees are not known"},
    {"sd_deg", "precision (SD around the motion of the eye, a line through each 0.2 s)", "deg", 4,
     quality_of<&StudyQuality::sd_deg>, "there are no fixations, or degrees are not known"},
    {"lost_percent", "data loss, blinks apart", "%", 2, percent_of<&StudyQuality::lost>,
     "there are no samples"},
    {"lost_in_blinks_percent", "data loss in blinks", "%", 2, percent_of<&StudyQuality::lost_in_blinks>,
     "there are no samples"},
    {"rate_hz", "measured from time stamps", "Hz", 1, quality_of<&StudyQuality::rate_hz>,
     "there are no samples"},
    {"presentation_s", "duration of a presentation", "s", 3, presentation_of, "there are no presentations"},
}};

const TrialMeasure& trial_measure(TrialMeasureOf which) {
    return trial_measures[static_cast<std::size_t>(which)];
}

std::optional<Spread> spread_over_trials(const StudyResults& results, const TrialMeasure& of) {
    std::vector<double> values;
    for (const StudyTrial& trial : results.trials) {
        if (const std::optional<double> value = of.of(trial); value && !trial.excluded)
            values.push_back(*value);
    }
    std::optional<Spread> spread = spread_of(std::move(values));
    if (spread)
        spread->thing = unit_of_gaze(results);
    return spread;
}

ObserverCounts observer_counts(const StudyResults& results) {
    std::map<std::string, bool> is_simulated; ///< by observer
    for (const StudySession& session : results.sessions) {
        const bool simulated = session.is_simulated();
        const auto [known, is_new] = is_simulated.emplace(session.observer, simulated);
        known->second = known->second && simulated;
    }
    const auto simulated = std::ranges::count_if(is_simulated, [](const auto& one) { return one.second; });
    return {static_cast<int>(is_simulated.size()), static_cast<int>(simulated)};
}

RefreshCounts refresh_counts(const StudyResults& results) {
    RefreshCounts counts;
    for (const StudyTrial& trial : results.trials) {
        if (trial.excluded)
            continue;
        counts.refreshes += trial.quality.refreshes;
        if (counts.missed && trial.quality.missed_refreshes)
            *counts.missed += *trial.quality.missed_refreshes;
        else
            counts.missed.reset();
    }
    return counts;
}

int incomplete_sessions(const StudyResults& results) {
    return static_cast<int>(
        std::ranges::count_if(results.sessions, [](const StudySession& one) { return !one.is_complete; }));
}

std::optional<MapCounts> map_counts(const StudyResults& results) {
    std::optional<MapCounts> counts;
    for (const StudyMap& map : results.maps) {
        if (map.density.empty() || map.weighting != MapWeighting::duration)
            continue;
        if (!counts)
            counts = {0, map.least_sigma_mm, map.most_sigma_mm};
        ++counts->maps;
        counts->least_sigma_mm = std::min(counts->least_sigma_mm, map.least_sigma_mm);
        counts->most_sigma_mm = std::max(counts->most_sigma_mm, map.most_sigma_mm);
    }
    return counts;
}

std::vector<SessionSetup::Calibrations> calibrations_of(const StudyResults& results) {
    std::vector<SessionSetup::Calibrations> all;
    for (const StudySession& session : results.sessions) {
        for (const SessionSetup::Calibrations& one : session.setup.calibrations) {
            auto found = std::ranges::find_if(all, [&](const SessionSetup::Calibrations& known) {
                return known.method == one.method && known.is_simulated == one.is_simulated;
            });
            if (found == all.end())
                found = all.insert(all.end(), {one.method, 0, 0, one.is_simulated});
            found->times += one.times;
            found->beyond_limits += one.beyond_limits;
        }
    }
    return all;
}

std::vector<FormField> form_fields(const StudyResults& results) {
    std::vector<FormField> fields;
    std::vector<std::vector<std::pair<std::string, std::string>>> said; ///< by field: observer and value
    for (const StudySession& session : results.sessions) {
        for (const StudyKey& key : session.form) {
            const auto found = std::ranges::find(fields, key.column, &FormField::field);
            const auto index = static_cast<std::size_t>(found - fields.begin());
            if (found == fields.end()) {
                fields.push_back({key.column, 0, {}, {}});
                said.emplace_back();
            }
            const std::pair<std::string, std::string> one{session.observer, key.value};
            if (std::ranges::find(said[index], one) == said[index].end())
                said[index].push_back(one);
        }
    }
    for (std::size_t i = 0; i < fields.size(); ++i) {
        FormField& field = fields[i];
        std::vector<double> numbers;
        std::map<std::string, int> observers;
        for (const auto& [observer, value] : said[i]) {
            ++observers[observer];
            if (const std::optional<double> number = whole_number_of(value))
                numbers.push_back(*number);
            const auto known = std::ranges::find(field.values, value, &std::pair<std::string, int>::first);
            if (known == field.values.end())
                field.values.emplace_back(value, 1);
            else
                ++known->second;
        }
        field.observers = static_cast<int>(observers.size());
        if (numbers.size() == said[i].size()) {
            field.numbers = spread_of(std::move(numbers));
            field.values.clear();
        }
    }
    return fields;
}

std::vector<NamedThing> objects_shown(const StudyResults& results) {
    std::set<int> in_trials;
    for (const StudyTrial& trial : results.trials)
        // Imported recordings have one that stands for nothing.
        if (results.sessions[static_cast<std::size_t>(trial.session)].setup.stimuli.frame_count > 0)
            in_trials.insert(trial.object);
    std::vector<NamedThing> shown;
    for (const int index : in_trials) {
        const StudyObject& object = results.objects[static_cast<std::size_t>(index)];
        add_once(shown, {object.id, object.title});
    }
    return shown;
}

std::vector<NamedThing> materials_shown(const StudyResults& results) {
    return named_in_trials(results, "material", &SessionSetup::materials);
}

std::vector<NamedThing> tasks_asked(const StudyResults& results) {
    return named_in_trials(results, "task", &SessionSetup::tasks);
}

} // namespace overt
