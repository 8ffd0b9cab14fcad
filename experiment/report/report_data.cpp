#include <algorithm>
#include <cmath>

#include "experiment/report/packed_array.h"
#include "experiment/report/report_answers.h"
#include "experiment/report/report_areas.h"
#include "experiment/report/report_explorations.h"
#include "experiment/report/report_points.h"
#include "experiment/report/report_json.h"
#include "experiment/report/report_maps.h"
#include "experiment/report/report_page.h"
#include "experiment/report/report_tables.h"
#include "experiment/study/methods/study_facts.h"
#include "experiment/surface/colour_scale.h"

namespace overt {
namespace {

/// Samples of all traces that a page holds, some 30 MB of it: a larger study's traces are thinned further.
constexpr std::size_t most_trace_samples = 3'000'000;

Json json_of_quality(const StudyQuality& q) {
    return {{"accuracy", number(q.accuracy_deg)},
            {"worst", number(q.worst_accuracy_deg)},
            {"drift", number(q.drift_deg)},
            {"rms", number(q.rms_s2s_deg)},
            {"sd", number(q.sd_deg)},
            {"rate", number(q.rate_hz, 7)},
            {"samples", q.samples},
            {"lost", number(q.lost_share())},
            {"blinked", number(q.blink_share())},
            {"blinks", q.blinks},
            {"refreshes", q.refreshes},
            {"missed", q.missed_refreshes ? Json(*q.missed_refreshes) : Json("unproven")},
            {"off_plan", number(q.off_plan)}};
}

Json json_of_trials(const StudyResults& results) {
    Json trials = Json::array();
    for (const StudyTrial& trial : results.trials) {
        std::vector<float> times, angles;
        for (const StudyTurn& turn : trial.turns) {
            times.push_back(static_cast<float>(turn.time_s));
            angles.push_back(static_cast<float>(turn.angle_deg));
        }
        Json fixations = Json::array();
        for (std::size_t i = trial.first_fixation; i < trial.first_fixation + trial.fixations; ++i) {
            const StudyFixation& f = results.fixations[i];
            Json position = nullptr;
            if (f.triangle)
                position = {number(f.position.x, 5), number(f.position.y, 5), number(f.position.z, 5)};
            fixations.push_back({number(f.onset_s, 5), number(f.duration_s, 4), number(f.place.x_px, 5),
                                 number(f.place.y_px, 5), position, f.counted() ? 1 : 0,
                                 std::string(name_of(f.why)),
                                 f.part ? Json(static_cast<int>(*f.part)) : Json(nullptr)});
        }
        trials.push_back({{"label", trial.label},
                          {"session", trial.session},
                          {"object", trial.object},
                          {"number", trial.number},
                          {"keys", json_of(trial.keys)},
                          {"seconds", number(trial.presentation_s)},
                          {"excluded", trial.excluded ? trial.why_excluded : std::string()},
                          {"times", packed(times)},
                          {"angles", packed(angles)},
                          {"fixations", std::move(fixations)},
                          {"quality", json_of_quality(trial.quality)}});
    }
    return trials;
}

// Places in tenths of pixels; -32768 where the eye was lost. Times as the steps from sample to sample in
// ten-thousandths of a second, the first one from the onset; a step that is longer than the number can hold
// is several without gaze. Pupil in the tracker's unit over 255 of its largest.
Json json_of_trace(const StudyTrace& trace, std::size_t every) {
    constexpr std::int16_t lost = -32768;
    constexpr std::int64_t longest_step = 65535;
    std::vector<std::uint16_t> steps;
    std::vector<std::int16_t> places;
    std::vector<std::uint8_t> pupils;
    float widest = 0.0f;
    for (const StudyTracePoint& point : trace.points)
        widest = std::max(widest, point.pupil);
    const auto tenths = [](double px) {
        return static_cast<std::int16_t>(std::lround(std::clamp(10.0 * px, -32767.0, 32767.0)));
    };
    const auto add = [&](std::int64_t step, std::int16_t x, std::int16_t y, float pupil) {
        steps.push_back(static_cast<std::uint16_t>(step));
        places.insert(places.end(), {x, y});
        pupils.push_back(static_cast<std::uint8_t>(
            std::lround(widest > 0.0f ? 255.0f * std::max(0.0f, pupil) / widest : 0.0f)));
    };
    std::int64_t before = 0;
    for (std::size_t i = 0; i < trace.points.size(); i += every) {
        const StudyTracePoint& point = trace.points[i];
        const std::int64_t time = std::max<std::int64_t>(std::llround(1e4 * point.time_s), before);
        for (; time - before > longest_step; before += longest_step)
            add(longest_step, lost, lost, 0.0f);
        add(time - before, point.gaze ? tenths(point.gaze->x_px) : lost,
            point.gaze ? tenths(point.gaze->y_px) : lost, point.pupil);
        before = time;
    }
    Json events = Json::array();
    for (const StudyTraceEvent& event : trace.events) {
        const char* kind = event.kind == GazeEvent::Kind::fixation  ? "f"
                           : event.kind == GazeEvent::Kind::saccade ? "s"
                                                                    : "b";
        Json json{kind, number(event.onset_s, 5), number(event.duration_s, 4)};
        if (event.kind == GazeEvent::Kind::saccade) {
            json.push_back(number(event.amplitude_deg, 4));
            json.push_back(number(event.peak_velocity_deg_s, 4));
        }
        events.push_back(std::move(json));
    }
    return {{"trial", trace.trial},
            {"steps", packed(steps)},
            {"places", packed(places)},
            {"pupils", packed(pupils)},
            {"events", events}};
}

/// Every how many samples the page has of each trace.
std::size_t thinning_of(const std::vector<StudyTrace>& traces) {
    std::size_t samples = 0;
    for (const StudyTrace& trace : traces)
        samples += trace.points.size();
    return 1 + samples / most_trace_samples;
}

Json json_of_traces(const StudyResults& results) {
    const std::size_t every = thinning_of(results.traces);
    Json traces = Json::array();
    for (const StudyTrace& trace : results.traces)
        traces.push_back(json_of_trace(trace, every));
    return traces;
}

} // namespace

nlohmann::ordered_json report_data(const StudyResults& results) {
    ReportMaps maps = report_maps(results);
    Json sessions = Json::array(), parameters = Json::array(), groups = Json::array(),
         not_counted = Json::array();
    for (const StudySession& s : results.sessions)
        sessions.push_back({{"folder", s.folder},
                            {"observer", s.observer},
                            {"number", s.number},
                            {"protocol", s.protocol},
                            {"tracker", s.setup.gaze.tracker},
                            {"simulated", s.is_simulated()},
                            {"form", json_of(s.form)},
                            {"events", s.events},
                            {"complete", s.is_complete},
                            {"trials", s.trials}});
    for (const StudyParameter& p : results.parameters)
        parameters.push_back({p.name, p.value, p.unit, p.meaning});
    for (const StudyGroup& g : results.groups)
        groups.push_back({{"keys", json_of(g.keys)},
                          {"observers", g.observers},
                          {"trials", g.trials.size()},
                          {"fixations", g.fixations}});
    for (const auto& [why, count] : results.glance.not_counted)
        not_counted.push_back({std::string(name_of(why)), count});
    Json quality = Json::array();
    for (const StudyQuality& q : results.session_quality)
        quality.push_back(json_of_quality(q));
    Json reporting = Json::array();
    for (const ReportingItem& item : results.reporting)
        reporting.push_back({item.topic, item.item, item.value, item.is_recorded});
    Json methods = Json::array();
    for (const MethodsParagraph& paragraph : results.methods)
        methods.push_back({paragraph.topic, paragraph.text});
    Json colours = Json::object();
    for (const ColourMap map : {ColourMap::viridis, ColourMap::cividis, ColourMap::coolwarm}) {
        std::vector<std::uint8_t> bytes;
        for (const auto& colour : colour_table(map))
            bytes.insert(bytes.end(), colour.begin(), colour.end());
        colours[std::string(name_of(map))] = packed(bytes);
    }
    const StudyGlance& glance = results.glance;
    Json trials = json_of_trials(results);
    Json area_sets = report_area_sets(results, trials);
    return {{"glance",
             {{"title", glance.title},
              {"observers", glance.observers},
              {"sessions", glance.sessions},
              {"trials", trials_of_presentations(results)},
              {"presentations", glance.trials},
              {"excluded", glance.excluded_trials},
              {"samples", glance.samples},
              {"fixations", glance.fixations},
              {"counted", glance.counted},
              {"not_counted", not_counted},
              {"seconds", number(glance.counted_s)},
              {"simulated", glance.any_simulated}}},
            {"headline",
             {{"question", results.headline.question},
              {"design", results.headline.design},
              {"sample", results.headline.sample},
              {"result", results.headline.result},
              {"measure", results.headline.measure}}},
            {"answers", report_answers(results)},
            {"explorations", report_explorations(results.explorations)},
            {"points", report_points(results)},
            {"answer_maps", std::move(maps.answer_maps)},
            {"knows_stimuli", knows_stimuli(results)},
            {"parameters", parameters},
            {"remarks", results.remarks},
            {"by", results.by},
            {"areas", results.areas},
            {"area", results.area},
            {"confidence", results.confidence},
            {"colours", colours},
            {"sessions", sessions},
            {"session_quality", quality},
            {"reporting", reporting},
            {"methods", methods},
            {"objects", std::move(maps.objects)},
            {"groups", groups},
            {"maps", std::move(maps.maps)},
            {"differences", std::move(maps.differences)},
            {"tables", report_tables(results)},
            {"trials", std::move(trials)},
            {"area_sets", std::move(area_sets)},
            {"traces", json_of_traces(results)},
            {"trace_hz", number(most_trace_hz / static_cast<double>(thinning_of(results.traces)))}};
}

} // namespace overt
