#include "experiment/study/read/reporting.h"

#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/counted.h"

namespace overt {

namespace {

constexpr const char* tracker_item = "manufacturer, model";
constexpr const char* eye_item = "eyes measured";
constexpr const char* nominal_item = "nominal rate";
constexpr const char* screen_item = "screen and distance";
constexpr const char* latency_item = "from vertical blank to light";
constexpr const char* timing_item = "timing of the display";
constexpr const char* light_item = "light of the display";
constexpr const char* instruction_item = "questions asked";
constexpr const char* calibration_item = "calibration";
constexpr const char* program_item = "program";

std::string eyes_of(const TrackerDescription& tracker) {
    const std::string one = tracker.eye == Eye::left ? "left" : "right";
    return tracker.both_eyes ? fmt::format("both, of which the {} is analysed", one) : one;
}

std::string screen_of(const RecordedDisplay& display) {
    const ScreenGeometry& screen = display.screen;
    return fmt::format(
        "{} x {} pixels, {:.5g} x {:.5g} mm, {:.5g} Hz, seen from {:.5g} mm: {:.4g} pixels per degree",
        screen.screen_px.x, screen.screen_px.y, screen.screen_mm.x, screen.screen_mm.y, display.refresh_hz,
        screen.viewing_distance_mm, screen.px_per_deg_at_centre());
}

/// Over all sessions, each value once, with how many have it if not all do.
std::string values_of(const StudyResults& results, const std::string& item) {
    std::vector<std::pair<std::string, int>> values;
    for (const StudySession& session : results.sessions) {
        for (const StudyKey& key : session.setup) {
            if (key.column != item)
                continue;
            const auto found = std::ranges::find(values, key.value, &std::pair<std::string, int>::first);
            if (found == values.end())
                values.emplace_back(key.value, 1);
            else
                ++found->second;
        }
    }
    std::string text;
    for (const auto& [value, sessions] : values) {
        text += text.empty() ? value : fmt::format("; {}", value);
        if (sessions < static_cast<int>(results.sessions.size()))
            text += fmt::format(" ({})", counted(sessions, "session"));
    }
    return text;
}

/// Median over the trials that are not excluded, with the smallest and the largest.
std::string spread_over_trials(const StudyResults& results, const char* unit, double scale,
                               const std::function<std::optional<double>(const StudyQuality&)>& value) {
    std::vector<double> values;
    for (const StudyTrial& trial : results.trials) {
        if (const auto number = value(trial.quality); number && !trial.excluded)
            values.push_back(scale * *number);
    }
    if (values.empty())
        return {};
    std::ranges::sort(values);
    return fmt::format("{:.4g}{} (median over {}; {:.4g} to {:.4g}{})", quantile_of_sorted(values, 0.5), unit,
                       counted(static_cast<int>(values.size()), "trial"), values.front(), values.back(),
                       unit);
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
                       counted(results.glance.trials, "trial"), limits.empty() ? "none" : limits);
}

std::string participants_of(const StudyResults& results) {
    std::set<std::string> fields;
    for (const StudySession& session : results.sessions) {
        for (const StudyKey& key : session.form)
            fields.insert(key.column);
    }
    return fmt::format("{} in {}{}", counted(results.glance.observers, "observer"),
                       counted(results.glance.sessions, "session"),
                       fields.empty() ? ""
                                      : fmt::format("; of each are recorded: {}", fmt::join(fields, ", ")));
}

} // namespace

std::vector<StudyKey> setup_of(const SessionRecord& record) {
    const SessionHeader& header = record.header();
    std::vector<StudyKey> setup;
    const auto add = [&](const char* item, const std::string& value) {
        if (!value.empty())
            setup.push_back({item, value});
    };
    add(tracker_item, header.tracker.model.empty()
                          ? header.tracker.name
                          : fmt::format("{}, {}", header.tracker.name, header.tracker.model));
    add(eye_item, eyes_of(header.tracker));
    if (header.tracker.sample_rate_hz > 0.0)
        add(nominal_item, fmt::format("{:g} Hz", header.tracker.sample_rate_hz));
    if (header.display.screen.viewing_distance_mm > 0.0 && header.display.screen.screen_mm.x > 0.0)
        add(screen_item, screen_of(header.display));
    // Nobody measures exactly 0.
    if (const double ms = 1e3 * to_seconds(header.display.latency);
        ms != 0.0 || header.clock == ClockKind::virtual_time)
        add(latency_item,
            fmt::format("{:g} ms{}", ms, header.clock == ClockKind::virtual_time ? ", simulated" : ""));
    if (header.display.timing == "proven")
        add(timing_item, "proven by the display's vertical blanks");
    else if (header.display.is_timing_unproven())
        add(timing_item, "unproven: when pictures were lit, and which refreshes were missed, is not known");
    if (header.characterisation)
        add(light_item, fmt::format("white of {:.4g} cd/m2, measured with {} on {}",
                                    header.characterisation->white_cd_m2(),
                                    header.characterisation->instrument, header.characterisation->date));
    std::vector<std::string> questions;
    for (const RecordedTask& task : header.tasks)
        questions.push_back(fmt::format("\"{}\"", task.question));
    add(instruction_item, fmt::format("{}", fmt::join(questions, ", ")));
    std::set<int> sittings;
    for (const TrialRecord& trial : record.trials())
        sittings.insert(trial.sitting);
    std::map<std::string, int> methods;
    for (const int sitting : sittings) {
        for (const RecordedCalibration& calibration : record.calibrations(sitting))
            ++methods[calibration.method];
    }
    for (const auto& [method, count] : methods)
        add(calibration_item, fmt::format("{}, {}", method, counted(count, "time")));
    if (!header.program.version.empty())
        add(program_item, fmt::format("overt {}", header.program.version));
    return setup;
}

std::vector<ReportingItem> reporting_items(const StudyResults& results, const StudyOptions& options) {
    std::vector<ReportingItem> items;
    const auto add = [&](const char* topic, const char* item, std::string value, const char* if_missing) {
        const bool is_recorded = !value.empty();
        items.push_back({topic, item,
                         is_recorded ? std::move(value) : fmt::format("not recorded: {}", if_missing),
                         is_recorded});
    };
    const auto of_setup = [&](const char* topic, const char* item, const char* if_missing) {
        add(topic, item, values_of(results, item), if_missing);
    };
    const auto over_trials = [&](const char* item, const char* unit, double scale, const auto& value,
                                 const char* if_missing) {
        add("6 data quality", item, spread_over_trials(results, unit, scale, value), if_missing);
    };
    of_setup("1 eye tracker", tracker_item, "name maker and model");
    of_setup("1 eye tracker", eye_item, "say which eye");
    add("1 eye tracker", "technique", {}, "say how it works, such as by pupil and corneal reflection");
    of_setup("2 sampling frequency", nominal_item, "give the tracker's rate");
    add("2 sampling frequency", "measured from time stamps",
        spread_over_trials(results, " Hz", 1.0, [](const StudyQuality& q) { return q.rate_hz; }),
        "there are no samples");
    of_setup("3 setup and geometry", screen_item, "give size and distance of the screen");
    of_setup("3 setup and geometry", latency_item,
             "taken as 0 ms; measure it with a light sensor (overt doctor --photodiode) and set latency_ms");
    add("3 setup and geometry", "head stabilisation", {},
        "say whether there was a chin rest, a bite bar or none");
    of_setup("3 setup and geometry", timing_item,
             "time was virtual, or the sessions do not say what proves their times");
    of_setup("3 setup and geometry", light_item, "the display was not characterised: give its luminance");
    add("4 recording environment", "room and its light", {}, "describe both");
    of_setup("5 instructions", instruction_item, "say what observers were asked");
    of_setup("6 data quality", calibration_item, "say how, with how many targets and limits");
    over_trials(
        "accuracy (mean error of the validation)", " deg", 1.0,
        [](const StudyQuality& q) { return q.accuracy_deg; }, "there was no validation");
    over_trials(
        "precision (RMS-S2S)", " deg", 1.0, [](const StudyQuality& q) { return q.rms_s2s_deg; },
        "there are no fixations");
    std::string scatter =
        spread_over_trials(results, " deg", 1.0, [](const StudyQuality& q) { return q.sd_deg; });
    if (!scatter.empty())
        scatter += "; around the motion of the eye, a line through each 0.2 s of a fixation";
    add("6 data quality", "precision (SD)", std::move(scatter), "there are no fixations");
    const auto share = [](double StudyQuality::*number) {
        return [number](const StudyQuality& q) {
            return q.samples > 0.0 ? std::optional(q.*number / q.samples) : std::nullopt;
        };
    };
    over_trials("data loss, blinks apart", " %", 100.0, share(&StudyQuality::lost), "there are no samples");
    over_trials("data loss in blinks", " %", 100.0, share(&StudyQuality::lost_in_blinks),
                "there are no samples");
    std::set<std::string> events;
    for (const StudySession& session : results.sessions) {
        if (!session.events.empty())
            events.insert(session.events);
    }
    add("7 processing", "fixations, saccades, blinks", fmt::format("{}", fmt::join(events, " ")),
        "there are none");
    add("7 processing", "filters of the tracker", {}, "say what its software smooths");
    add("7 processing", "analysis", "see Methods and their parameters", "");
    of_setup("8 software", program_item, "name the program that recorded");
    add("8 software", "firmware of the tracker", {}, "give its version");
    add("9 exclusions", "trials", exclusions_of(results, options.exclude), "");
    add("9 exclusions", "participants", participants_of(results), "");
    return items;
}

} // namespace overt
