#include "experiment/study/methods/reporting.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/counted.h"
#include "experiment/study/methods/sentences.h"
#include "experiment/study/methods/study_facts.h"
#include "experiment/study/methods/tracker_words.h"

namespace overt {

namespace {

// Of a session, in a few words; empty: not recorded.

std::string eye_of_session(const StudySession& session) {
    const bool has_eye =
        session.setup.gaze.origin != GazeOrigin::pointer && session.setup.gaze.origin != GazeOrigin::none;
    return has_eye ? eyes_words(session.setup.gaze) : std::string();
}

std::string nominal_rate_of(const StudySession& session) {
    const double rate_hz = session.setup.gaze.rate_hz;
    return rate_hz > 0.0 ? fmt::format("{} Hz", as_set(rate_hz)) : std::string();
}

std::string screen_of(const StudySession& session) {
    const DisplaySetup& display = session.setup.display;
    if (!display.px_per_deg)
        return {};
    return fmt::format("{} x {} pixels, {} x {} mm, {} Hz, seen from {} mm: {} pixels per degree",
                       display.screen_px.x, display.screen_px.y, as_set(display.screen_mm.x),
                       as_set(display.screen_mm.y), as_set(display.refresh_hz),
                       as_set(display.viewing_distance_mm), as_measured(*display.px_per_deg, 1));
}

std::string latency_of(const StudySession& session) {
    const DisplaySetup& display = session.setup.display;
    // Nobody measures exactly 0.
    if (display.latency_ms == 0.0 && !display.is_simulated)
        return {};
    return fmt::format("{} ms{}", as_set(display.latency_ms), display.is_simulated ? ", simulated" : "");
}

std::string timing_of(const StudySession& session) {
    const std::string& timing = session.setup.display.timing;
    if (timing == "proven")
        return "proven by the display's vertical blanks";
    if (timing == "unproven")
        return "unproven: when pictures were lit, and which refreshes were missed, is not known";
    return {};
}

const std::string& rig_of(const StudySession& session) { return session.setup.rig; }

std::string light_of(const StudySession& session) {
    const std::optional<DisplaySetup::Light>& light = session.setup.display.light;
    return light ? fmt::format("white of {} cd/m2, measured with {} on {}",
                               as_measured(light->white_cd_m2, 2), light->instrument, light->date)
                 : std::string();
}

std::string calibrations_in_words(const StudyResults& results) {
    std::vector<std::string> methods;
    for (const SessionSetup::Calibrations& one : calibrations_of(results))
        methods.push_back(
            fmt::format("{}{}{}{}", one.method, one.method.empty() ? "" : ", ", counted(one.times, "time"),
                        one.beyond_limits > 0
                            ? fmt::format(", {} of them beyond the protocol's limits", one.beyond_limits)
                            : ""));
    return fmt::format("{}", fmt::join(methods, "; "));
}

std::string questions_of(const StudyResults& results) {
    std::vector<std::string> questions;
    for (const NamedThing& task : tasks_asked(results))
        if (!task.title.empty())
            questions.push_back(fmt::format("\"{}\"", task.title));
    return fmt::format("{}", fmt::join(questions, ", "));
}

std::string program_of(const StudySession& session) {
    const std::string& version = session.setup.program_version;
    if (const std::optional<std::string>& presenter = session.setup.presenter)
        return fmt::format("presented by {}, imported into overt {}",
                           presenter->empty() ? "a program that is not on record" : *presenter,
                           version.empty() ? "(version not on record)" : version);
    return version.empty() ? std::string() : fmt::format("overt {}", version);
}

/// Over all sessions, each value once, with how many have it if not all do.
template <class Of> std::string values_of_sessions(const StudyResults& results, const Of& of) {
    std::string text;
    for (const auto& [value, sessions] : over_sessions(results, of)) {
        if (value.empty())
            continue;
        text += fmt::format("{}{}", text.empty() ? "" : "; ", value);
        if (sessions < static_cast<int>(results.sessions.size()))
            text += fmt::format(" ({})", counted(sessions, "session"));
    }
    return text;
}

std::string exclusions_of(const StudyResults& results, const ExclusionRules& rules) {
    std::string limits;
    const auto add = [&](const std::string& limit) { limits += limits.empty() ? limit : ", " + limit; };
    if (rules.most_lost_share)
        add(fmt::format("more than {:g} % of the samples lost, blinks apart",
                        100.0 * *rules.most_lost_share));
    if (rules.most_accuracy_deg)
        add(fmt::format("a validation with a mean error above {:g} deg", *rules.most_accuracy_deg));
    if (rules.most_drift_deg)
        add(fmt::format("a drift check above {:g} deg", *rules.most_drift_deg));
    if (rules.most_missed_refreshes)
        add(fmt::format("more than {} missed refreshes", *rules.most_missed_refreshes));
    return fmt::format("{} of {} excluded; rules: {}", results.glance.excluded_trials,
                       counted(results.glance.trials, unit_of_gaze(results)),
                       limits.empty() ? "none" : limits);
}

std::string participants_of(const StudyResults& results) {
    std::vector<std::string> fields;
    for (const FormField& field : form_fields(results))
        fields.push_back(field.field);
    return fmt::format("{} in {}{}", counted(results.glance.observers, "observer"),
                       counted(results.glance.sessions, "session"),
                       fields.empty() ? ""
                                      : fmt::format("; of each are recorded: {}", fmt::join(fields, ", ")));
}

} // namespace

std::vector<ReportingItem> reporting_items(const StudyResults& results, const StudyOptions& options) {
    std::vector<ReportingItem> items;
    const auto add = [&](const char* topic, std::string item, std::string value,
                         std::string_view if_missing) {
        const bool is_recorded = !value.empty();
        items.push_back({topic, std::move(item),
                         is_recorded ? std::move(value) : fmt::format("not recorded: {}", if_missing),
                         is_recorded});
    };
    const auto of_sessions = [&](const char* topic, const char* item, const auto& of,
                                 const char* if_missing) {
        add(topic, item, values_of_sessions(results, of), if_missing);
    };
    const auto over_trials = [&](const char* topic, TrialMeasureOf which) {
        const TrialMeasure& of = trial_measure(which);
        const std::optional<Spread> spread = spread_over_trials(results, of);
        add(topic, std::string(of.item), spread ? as_spread(*spread, of.unit, of.decimals) : std::string(),
            of.if_missing);
    };
    of_sessions(
        "1 eye tracker", "manufacturer, model",
        [](const StudySession& session) { return tracker_words(session.setup.gaze); },
        "name maker and model");
    of_sessions("1 eye tracker", "eyes measured", eye_of_session, "say which eye");
    add("1 eye tracker", "technique", {}, "say how it works, such as by pupil and corneal reflection");
    of_sessions("2 sampling frequency", "nominal rate", nominal_rate_of, "give the tracker's rate");
    over_trials("2 sampling frequency", TrialMeasureOf::rate);
    of_sessions("3 setup and geometry", "screen and distance", screen_of,
                "give size and distance of the screen");
    of_sessions(
        "3 setup and geometry", "from vertical blank to light", latency_of,
        "taken as 0 ms; measure it with a light sensor (overt doctor --photodiode) and set latency_ms");
    add("3 setup and geometry", "head stabilisation", {},
        "say whether there was a chin rest, a bite bar or none");
    of_sessions("3 setup and geometry", "timing of the display", timing_of,
                "time was virtual, or the sessions do not say what proves their times");
    of_sessions("3 setup and geometry", "light of the display", light_of,
                "the display was not characterised: give its luminance");
    of_sessions("3 setup and geometry", "what was proved on the rig", rig_of,
                "no session names a page of its rig: overt doctor --first-day keeps one");
    add("4 recording environment", "room and its light", {}, "describe both");
    add("5 instructions", "questions asked", questions_of(results), "say what observers were asked");
    add("6 data quality", "calibration", calibrations_in_words(results),
        "say how, with how many targets and limits");
    for (const TrialMeasureOf which : {TrialMeasureOf::accuracy, TrialMeasureOf::rms_s2s, TrialMeasureOf::sd,
                                       TrialMeasureOf::lost, TrialMeasureOf::in_blinks})
        over_trials("6 data quality", which);
    std::set<std::string> events;
    for (const StudySession& session : results.sessions) {
        if (!session.events.empty())
            events.insert(session.events);
    }
    add("7 processing", "fixations, saccades, blinks", fmt::format("{}", fmt::join(events, " ")),
        "there are none");
    add("7 processing", "filters of the tracker", {}, "say what its software smooths");
    add("7 processing", "analysis", "see Methods and their parameters", "");
    of_sessions("8 software", "program", program_of, "name the program that recorded");
    add("8 software", "firmware of the tracker", {}, "give its version");
    add("9 exclusions", "trials", exclusions_of(results, options.exclude), "");
    add("9 exclusions", "participants", participants_of(results), "");
    return items;
}

} // namespace overt
