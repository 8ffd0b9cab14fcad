#include "experiment/study/read/gauge_reader.h"

#include <algorithm>

#include "experiment/record/read/session_record.h"

namespace overt {

namespace {

/// The presentation on which a probe stood; nothing: the trial showed none.
std::optional<PlacedStimulus> shown_under(const TrialRecord& trial, const std::string& probe) {
    const auto& probes = trial.outcome.probes;
    const auto found = std::ranges::find(probes, probe, &ShownProbe::id);
    const auto place =
        found == probes.end() ? trial.trial.shown_count() : static_cast<std::size_t>(found->place);
    return place < trial.trial.shown_count() ? std::optional(trial.trial.shown(place)) : std::nullopt;
}

/// A place of the surface in the camera's coordinates.
glm::dvec3 seen_position(const SessionHeader& header, const Stimulus& stimulus, AnimationFrameIndex frame,
                         const glm::dvec3& position) {
    const RecordedObject& object = header.objects[static_cast<std::size_t>(stimulus.object)];
    const ObjectPose& pose = header.poses.object_of(header.poses.pose_of(stimulus.motion, frame));
    const glm::dmat4 world_from_object = TurntablePose{object.axis_point, pose}.world_from_object();
    const View view{object.camera(stimulus.view), glm::ivec2(1)};
    return view.view_from_world() * world_from_object * glm::dvec4(position, 1.0);
}

std::string id_of_entry(const SessionHeader& header, std::size_t list, int index) {
    const std::vector<ListEntry> entries = entries_of(header, list);
    return entries[static_cast<std::size_t>(index)].id;
}

void add_settings(const SessionRecord& record, int session, const std::string& observer,
                  std::vector<GaugeSettingRow>& settings) {
    const SessionHeader& header = record.header();
    for (const TrialRecord& trial : record.trials()) {
        if (!trial.gives_results())
            continue;
        for (const GivenAnswer& given : trial.outcome.given) {
            if (!given.gauge || given.is_missed || !given.gauge->frame ||
                !given.gauge->is_visible.value_or(false))
                continue;
            const GaugeAnswer& gauge = *given.gauge;
            const std::optional<PlacedStimulus> shown = shown_under(trial, gauge.probe);
            const auto point = std::ranges::find_if(header.points, [&](const RecordedPoint& one) {
                return shown && one.object == shown->stimulus.object && one.name == gauge.point;
            });
            if (point == header.points.end())
                continue;
            const Stimulus& stimulus = shown->stimulus;
            const glm::dvec3 seen =
                seen_position(header, stimulus, AnimationFrameIndex{*gauge.frame}, point->position);
            GaugeSettingRow& row = settings.emplace_back();
            row.of = {observer,
                      header.tasks[static_cast<std::size_t>(trial.trial.task)].id,
                      given.id,
                      id_of_entry(header, 0, stimulus.object),
                      id_of_entry(header, 1, stimulus.material),
                      id_of_entry(header, 2, stimulus.light),
                      id_of_entry(header, 3, stimulus.motion),
                      id_of_entry(header, 4, stimulus.view),
                      *gauge.frame};
            row.session = session;
            row.trial = trial.trial.index + 1;
            row.point = gauge.point;
            row.x = seen.x;
            row.y = seen.y;
            row.z = seen.z;
            row.set = gauge.set;
            row.truth = gauge.truth;
            row.is_at_limit = gauge.is_at_limit;
            if (const auto time = given.response_time())
                row.response_s = to_seconds(*time);
        }
    }
}

} // namespace

std::vector<GaugeSettingRow>
read_gauge_settings(std::span<const std::filesystem::path> sessions,
                    std::span<const std::pair<std::string, std::string>> same_observer) {
    std::vector<GaugeSettingRow> settings;
    for (std::size_t session = 0; session < sessions.size(); ++session) {
        const SessionRecord record(sessions[session]);
        if (record.header().points.empty())
            continue;
        std::string observer = record.header().schedule.observer.label;
        const auto same =
            std::ranges::find(same_observer, observer, &std::pair<std::string, std::string>::first);
        if (same != same_observer.end())
            observer = same->second;
        add_settings(record, static_cast<int>(session), observer, settings);
    }
    return settings;
}

} // namespace overt
