#include "experiment/study/tables/study_setup_json.h"

#include "experiment/study/methods/study_facts.h"

namespace overt {

namespace {

using FactsJson = nlohmann::ordered_json;

void add_known(FactsJson& to, const char* name, double number) {
    if (number != 0.0)
        to[name] = number;
}
void add_known(FactsJson& to, const char* name, const std::string& text) {
    if (!text.empty())
        to[name] = text;
}

FactsJson gaze_json(const GazeSetup& gaze) {
    FactsJson json{{"origin", name_of(gaze.origin)}};
    add_known(json, "tracker", gaze.tracker);
    add_known(json, "model", gaze.model);
    add_known(json, "rate_hz", gaze.rate_hz);
    json["eye"] = gaze.eye == Eye::left ? "left" : "right";
    json["both_eyes"] = gaze.both_eyes;
    json["simulated"] = gaze.is_simulated();
    return json;
}

FactsJson display_json(const DisplaySetup& display) {
    FactsJson json{{"simulated", display.is_simulated}};
    if (display.screen_px.x > 0)
        json["screen_px"] = {display.screen_px.x, display.screen_px.y};
    if (display.screen_mm.x > 0.0)
        json["screen_mm"] = {display.screen_mm.x, display.screen_mm.y};
    add_known(json, "viewing_distance_mm", display.viewing_distance_mm);
    if (display.px_per_deg)
        json["px_per_deg"] = *display.px_per_deg;
    add_known(json, "refresh_hz", display.refresh_hz);
    add_known(json, "latency_ms", display.latency_ms);
    add_known(json, "timing", display.timing);
    if (display.light)
        json["light"] = {{"white_cd_m2", display.light->white_cd_m2},
                         {"instrument", display.light->instrument},
                         {"date", display.light->date}};
    return json;
}

FactsJson stimuli_json(const StimulusSetup& stimuli) {
    FactsJson json = FactsJson::object();
    if (stimuli.frame_count == 0)
        return json;
    json["image_px"] = {stimuli.image_px.x, stimuli.image_px.y};
    if (stimuli.image_deg)
        json["image_deg"] = {stimuli.image_deg->x, stimuli.image_deg->y};
    json["frames"] = stimuli.frame_count;
    json["frame_rate_hz"] = stimuli.frame_rate_hz;
    json["amplitude_deg"] = stimuli.amplitude_deg;
    json["playback"] = name_of(stimuli.playback);
    json["planned_duration_s"] = stimuli.duration_s;
    if (!stimuli.motions.empty())
        json["motions"] = stimuli.motions;
    return json;
}

FactsJson program_json(const std::string& version) {
    FactsJson json = FactsJson::object();
    add_known(json, "version", version);
    return json;
}

/// What sessions have in common, each once, with their number.
template <class Of, class Json>
FactsJson shared_json(const StudyResults& results, const Of& of, const Json& json_of) {
    FactsJson json = FactsJson::array();
    for (const auto& [value, sessions] : over_sessions(results, of)) {
        FactsJson one{{"sessions", sessions}};
        one.update(json_of(value));
        json.push_back(std::move(one));
    }
    return json;
}

FactsJson named_json(const std::vector<NamedThing>& things, const char* title) {
    FactsJson json = FactsJson::array();
    for (const NamedThing& thing : things)
        json.push_back({{"id", thing.id}, {title, thing.title}});
    return json;
}

FactsJson spread_json(const Spread& spread, const char* of) {
    return {{"median", spread.median}, {"least", spread.least}, {"most", spread.most}, {of, spread.trials}};
}

FactsJson setup_json(const StudyResults& results) {
    const auto of_setup = [](auto SessionSetup::*member) {
        return [member](const StudySession& session) { return session.setup.*member; };
    };
    const std::vector<NamedThing> objects = objects_shown(results), materials = materials_shown(results),
                                  tasks = tasks_asked(results);
    FactsJson calibrations = FactsJson::array();
    int times = 0;
    for (const SessionSetup::Calibrations& one : calibrations_of(results)) {
        calibrations.push_back({{"method", one.method},
                                {"times", one.times},
                                {"beyond_limits", one.beyond_limits},
                                {"simulated", one.is_simulated}});
        times += one.times;
    }
    return {{"gaze", shared_json(results, of_setup(&SessionSetup::gaze), gaze_json)},
            {"display", shared_json(results, of_setup(&SessionSetup::display), display_json)},
            {"stimuli", shared_json(results, of_setup(&SessionSetup::stimuli), stimuli_json)},
            {"program", shared_json(results, of_setup(&SessionSetup::program_version), program_json)},
            {"calibrated_times", times},
            {"calibrations", calibrations},
            {"objects_shown", objects.size()},
            {"objects", named_json(objects, "title")},
            {"materials_shown", materials.size()},
            {"materials", named_json(materials, "title")},
            {"tasks_asked", tasks.size()},
            {"tasks", named_json(tasks, "question")}};
}

std::string_view name_of_rule(ExclusionRule rule) {
    switch (rule) {
    case ExclusionRule::lost_share:
        return "most-lost";
    case ExclusionRule::accuracy:
        return "most-accuracy";
    case ExclusionRule::drift:
        return "most-drift";
    case ExclusionRule::missed_refreshes:
        return "most-missed";
    }
    return {};
}

} // namespace

FactsJson study_facts_json(const StudyResults& results) {
    FactsJson json{{"setup", setup_json(results)}, {"trial_measures", FactsJson::object()}};
    for (const TrialMeasure& of : trial_measures)
        if (const std::optional<Spread> spread = spread_over_trials(results, of))
            json["trial_measures"][std::string(of.name)] = spread_json(*spread, "trials");
    const RefreshCounts refreshes = refresh_counts(results);
    json["refreshes"] = refreshes.refreshes;
    if (refreshes.missed)
        json["missed_refreshes"] = *refreshes.missed;
    json["observers_who_took_part"] = observer_counts(results).all;
    json["trials_without_gaze"] = results.glance.without_gaze;
    json["simulated_observers"] = observer_counts(results).simulated;
    json["incomplete_sessions"] = incomplete_sessions(results);
    json["exclusions"] = FactsJson::object();
    for (const auto& [rule, trials] : results.glance.excluded_by)
        json["exclusions"][std::string(name_of_rule(rule))] = trials;
    json["observer_form"] = FactsJson::array();
    for (const FormField& field : form_fields(results)) {
        FactsJson one{{"field", field.field}, {"observers", field.observers}};
        if (field.numbers)
            one["numbers"] = spread_json(*field.numbers, "values");
        for (const auto& [value, observers] : field.values)
            one["values"].push_back({{"value", value}, {"observers", observers}});
        json["observer_form"].push_back(std::move(one));
    }
    if (const std::optional<MapCounts> maps = map_counts(results))
        json["maps"] = {{"of_each_weighting", maps->maps},
                        {"least_sigma_mm", maps->least_sigma_mm},
                        {"most_sigma_mm", maps->most_sigma_mm}};
    return json;
}

} // namespace overt
