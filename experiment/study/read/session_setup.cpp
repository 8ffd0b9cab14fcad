#include "experiment/study/read/session_setup.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <fmt/format.h>

#include "experiment/base/plain_text.h"
#include "experiment/motion_words.h"
#include "experiment/record/no_stimulus.h"
#include "experiment/record/read/import_source.h"
#include "experiment/record/read/rig_pages.h"

namespace overt {

namespace {

std::set<int> sittings_of(const SessionRecord& record) {
    std::set<int> sittings;
    for (const TrialRecord& trial : record.trials())
        sittings.insert(trial.sitting);
    return sittings;
}

/// The recording that the gaze was imported from; nothing if it came from the tracker itself.
std::optional<GazeSource> source_of(const SessionRecord& record) {
    for (const int sitting : sittings_of(record))
        if (std::optional<GazeSource> source = record.gaze_source(sitting))
            return source;
    return std::nullopt;
}

GazeOrigin origin_of(const SessionRecord& record, const std::optional<GazeSource>& source) {
    const std::string& name = record.header().tracker.name;
    if (source)
        return GazeOrigin::imported;
    if (name == "simulated")
        return GazeOrigin::simulated;
    if (name == "replay")
        return GazeOrigin::played_back;
    if (name == "mouse")
        return GazeOrigin::pointer;
    // The library of the EyeLink delivers nothing without a tracker.
    if (name == "none" || name == "eyelink without a tracker")
        return GazeOrigin::none;
    return GazeOrigin::measured;
}

/// The tracker that recorded what was imported: an export of overt's own names it in the file's header. Of a
/// session that took in a recording of its own tracker, that one.
std::string imported_tracker(const SessionHeader& header, const GazeSource& source) {
    constexpr std::string_view remark = "overt recorded this with the tracker: ";
    const std::size_t at = source.header.find(remark);
    if (at == std::string::npos)
        return header.tracker.name == "simulated" ? std::string() : header.tracker.name;
    const std::size_t begin = at + remark.size();
    return source.header.substr(begin, source.header.find_first_of("\r\n", begin) - begin);
}

GazeSetup gaze_of(const SessionRecord& record, const std::optional<GazeSource>& source) {
    const TrackerDescription& tracker = record.header().tracker;
    GazeSetup gaze{origin_of(record, source), tracker.name, tracker.model,
                   tracker.sample_rate_hz,    tracker.eye,  tracker.both_eyes};
    if (source) {
        gaze.tracker = imported_tracker(record.header(), *source);
        gaze.was_simulated = gaze.tracker == "simulated";
        if (source->rate_hz > 0.0)
            gaze.rate_hz = source->rate_hz;
    }
    // "gaze of sub-01_ses-01, by simulated"
    if (gaze.origin == GazeOrigin::played_back)
        gaze.was_simulated = tracker.model.ends_with(", by simulated");
    return gaze;
}

double angle_deg(double size_mm, double distance_mm) {
    return 2.0 * std::atan(0.5 * size_mm / distance_mm) * 180.0 / std::numbers::pi;
}

DisplaySetup display_of(const SessionHeader& header) {
    const RecordedDisplay& recorded = header.display;
    DisplaySetup display;
    display.is_simulated = header.clock == ClockKind::virtual_time;
    display.screen_px = recorded.screen.screen_px;
    display.screen_mm = recorded.screen.screen_mm;
    display.viewing_distance_mm = recorded.screen.viewing_distance_mm;
    if (display.viewing_distance_mm > 0.0 && display.screen_mm.x > 0.0)
        display.px_per_deg = recorded.screen.px_per_deg_at_centre();
    display.refresh_hz = recorded.refresh_hz;
    display.latency_ms = 1e3 * to_seconds(recorded.latency);
    display.timing = recorded.timing;
    display.stereo = recorded.stereo;
    display.interocular_mm = recorded.interocular_mm;
    if (header.characterisation)
        display.light = {header.characterisation->white_cd_m2(), header.characterisation->instrument,
                         header.characterisation->date};
    return display;
}

/// Such as "the object stood turned by 25 deg and the light turned to and fro …, for 2 s".
std::string motion_in_words(const Animation& motion) {
    if (motion.kind == MotionKind::observer) {
        const ObserverTurn& by = motion.by_observer;
        return fmt::format(
            "the observer turned the object about the vertical, {}, from pose to pose {} deg apart{}",
            by.is_whole() ? std::string("all round")
                          : fmt::format("from {} to {} deg", by.from.value, by.to.value),
            by.step.value,
            by.has_elevations()
                ? fmt::format(", and tilted it from {} to {} deg, {} deg apart", by.elevation_from.value,
                              by.elevation_to.value, by.elevation_step.value)
                : std::string());
    }
    if (motion.kind == MotionKind::recorded)
        return "the object turned as observers of earlier sessions had turned it, refresh by refresh";
    const bool turns = motion.kind == MotionKind::turn && motion.amplitude.value != 0.0;
    const bool is_of_old = motion.kind == MotionKind::turn || motion.kind == MotionKind::still;
    if (!is_of_old || motion.light_turns != 0) {
        const std::string light = way_of_light(motion);
        return fmt::format("the object moved: {}{}, in {} frames at {} Hz, for {} s", way_of(motion),
                           light.empty() ? std::string() : ", and the light " + light, motion.frame_count,
                           motion.frame_rate_hz, motion.duration_s);
    }
    const bool light_turns = motion.light_amplitude.value != 0.0;
    std::string words = turns
                            ? fmt::format("the object turned by {} deg to each side", motion.amplitude.value)
                            : std::string("the object stood");
    if (motion.angle.value != 0.0)
        words += fmt::format("{} {} deg from its front", turns ? " of" : " at", motion.angle.value);
    if (light_turns)
        words += fmt::format(" and the light turned by {} deg to each side", motion.light_amplitude.value);
    if (!turns && !light_turns)
        return words; // for how long is a matter of the trial's steps
    words += fmt::format(", to and fro about {} as a sine of time, in {} frames of {} at {} Hz",
                         motion.only_turns() ? "the vertical" : "an axis of its own", motion.frame_count,
                         motion.playback == Playback::ping_pong ? "one sweep" : "one period",
                         motion.frame_rate_hz);
    return words + fmt::format(", for {} s", motion.duration_s);
}

StimulusSetup stimuli_of(const SessionHeader& header) {
    const ScreenGeometry& screen = header.display.screen;
    StimulusSetup stimuli;
    stimuli.image_px = screen.image_px;
    if (screen.viewing_distance_mm > 0.0 && screen.screen_mm.x > 0.0 && screen.screen_mm.y > 0.0) {
        const glm::dvec2 image_mm =
            glm::dvec2(screen.image_px) * screen.screen_mm / glm::dvec2(screen.screen_px);
        stimuli.image_deg = {angle_deg(image_mm.x, screen.viewing_distance_mm),
                             angle_deg(image_mm.y, screen.viewing_distance_mm)};
    }
    stimuli.frame_count = header.animations.front().frame_count;
    stimuli.frame_rate_hz = header.animations.front().frame_rate_hz;
    stimuli.amplitude_deg = header.animations.front().amplitude.value;
    stimuli.playback = header.animations.front().playback;
    stimuli.duration_s = header.animations.front().duration_s;
    const Animation& first = header.animations.front();
    if (header.animations.size() > 1 || first.kind != MotionKind::turn || first.angle.value != 0.0 ||
        first.turns_light() || !first.only_turns()) {
        for (const Animation& motion : header.animations)
            stimuli.motions.push_back(motion_in_words(motion));
    }
    return stimuli;
}

std::vector<SessionSetup::Calibrations> calibrations_of(const SessionRecord& record) {
    std::vector<SessionSetup::Calibrations> all;
    for (const int sitting : sittings_of(record)) {
        for (const RecordedCalibration& one : record.calibrations(sitting)) {
            auto found = std::ranges::find(all, one.method, &SessionSetup::Calibrations::method);
            if (found == all.end())
                found = all.insert(all.end(), {one.method, 0, 0, false});
            ++found->times;
            found->beyond_limits += !one.is_within_limits;
        }
    }
    return all;
}

/// Of several sittings that name different pages, each once.
std::string rig_of(const SessionRecord& record) {
    std::set<std::string> told;
    std::string all;
    for (const NamedRigPage& named : rig_pages_of(record))
        if (told.insert(named.page).second)
            all += (all.empty() ? "" : " / ") + named.page;
    return all;
}

} // namespace

SessionSetup setup_of(const SessionRecord& record) {
    const SessionHeader& header = record.header();
    const std::optional<GazeSource> source = source_of(record);
    SessionSetup setup;
    setup.gaze = gaze_of(record, source);
    if (source)
        setup.imported_file = source->file;
    if (const std::optional<ImportSource> foreign = import_source(record)) {
        setup.presenter = foreign->presenter;
        setup.gaze.origin = GazeOrigin::imported;
    }
    setup.display = display_of(header);
    if (!knows_no_stimulus(header)) {
        setup.stimuli = stimuli_of(header);
        for (const ListEntry& material : header.materials)
            setup.materials.push_back({material.id, plain_line_of(material.title)});
        for (const RecordedTask& task : header.tasks)
            setup.tasks.push_back({task.id, plain_line_of(task.question)});
    }
    setup.calibrations = calibrations_of(record);
    for (SessionSetup::Calibrations& one : setup.calibrations)
        one.is_simulated = setup.gaze.is_simulated();
    setup.rig = rig_of(record);
    setup.program_version = header.program.version;
    return setup;
}

} // namespace overt
