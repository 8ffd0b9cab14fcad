/// Sessions of gaze that follows places of a turning ball.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

#include "experiment/record/session_schema.h"
#include "experiment/study/read/study_reader.h"
#include "tests/experiment/record/session_fixture.h"
#include "tests/experiment/surface/flat_and_round.h"
#include "tests/support/cast_maps.h"

namespace overt::testing {

/// A ball of 50 units whose upper part is its head, in three poses.
inline const test::CastScene& turning_ball() {
    static const test::CastScene scene = [] {
        Mesh mesh = test::icosphere(50.0, 4);
        mesh.part_names = {"body", "head"};
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
            mesh.triangle_parts[t] = mesh.positions[mesh.triangles[t].x].z > 20.0f ? 1 : 0;
        return test::CastScene(std::move(mesh), {{{-15.0}}, {{0.0}}, {{15.0}}}, {160, 150}, 0.2);
    }();
    return scene;
}

inline const CoordinateMaps& maps_of_ball() {
    static const CoordinateMaps maps = turning_ball().maps();
    return maps;
}

/// Four trials in two tasks and two materials; a frame takes four refreshes of 10 ms.
inline SessionHeader ball_header(const std::string& observer) {
    SessionHeader header = example_header();
    header.schedule.observer = {observer, 1};
    header.session_number = 1;
    header.started_utc = "2024-03-01T00:00:0" + std::to_string(observer.back() % 10) + "Z";
    header.protocol.title = "Balls";
    const SceneView view = turning_ball().scene;
    RecordedObject ball{"ball",           "A ball",           std::string(64, 'a'), "meshes/ball.ply",
                        {"body", "head"}, {view.view.camera}, {0.0, 0.0, 0.0},      view.bounds};
    ball.unit = "own";
    header.objects = {ball};
    header.stimuli = {};
    header.maps = {};
    header.schedule.trials = {{0, 1, {0, 1}}, {1, 0, {0, 0}}, {2, 0, {0, 1}}, {3, 1, {0, 0}}};
    header.poses = {turning_ball().angles, {{PoseIndex{0}, PoseIndex{1}, PoseIndex{2}}}};
    header.display.screen.image_px = {160, 150};
    header.display.screen.screen_px = {800, 600};
    header.display.screen.screen_mm = {400.0, 330.0};
    header.display.latency = {};
    header.animations.front().amplitude = Degrees{15.0};
    header.animations.front().duration_s = 1.2;
    header.tracker = {"a tracker", 500.0, Eye::right};
    header.tracker.both_eyes = true;
    return header;
}

/// Where a place of the ball stands on the screen in a pose.
inline ScreenPoint seen_at(const SessionHeader& header, const glm::dvec3& place, int pose) {
    const glm::dvec3 px = maps_of_ball().sight_lines(PoseIndex{pose}).project(place);
    return {px.x + header.display.screen.image_origin_px.x, px.y + header.display.screen.image_origin_px.y};
}

inline const glm::dvec3 on_body = 50.0 * glm::normalize(glm::dvec3{0.3, -1.0, -0.2}),
                        on_head = 50.0 * glm::normalize(glm::dvec3{-0.3, -1.0, 0.6}),
                        beside_ball{120.0, -50.0, 0.0};

/// In each trial gaze follows a place of the body for 0.4 s, one of the head for 0.5 s, and is beside the
/// ball for 0.2 s, after 0.05 s in which the eye is lost. `change`: of how the trial went.
using ChangedOutcome = std::function<void(const Trial&, TrialOutcome&)>;
inline void watch_ball(SessionStore& store, const SessionHeader& header, const Trial& trial,
                       const ChangedOutcome& change = {}) {
    const std::int64_t start_ms = 10'000 * (trial.index + 1), onset_ms = start_ms + 1000;
    store.trial_started(trial, at_ms(start_ms));
    for (int refresh = 0; refresh < 120; ++refresh) {
        const int frame = refresh / 4 % 3;
        FlipRecord flip{trial.index, refresh, {frame}, {frame}, {frame}, {}};
        flip.report.refresh = {refresh};
        flip.report.vertical_blank = at_ms(onset_ms + 10 * refresh);
        store.flip(flip);
    }
    const auto tracker_at = [&](std::int64_t ms) { return tracker_time(5'000'000 + 1000 * (onset_ms + ms)); };
    for (int ms = -100; ms < 1200; ms += 2) {
        // The middle of the screen is lit half a refresh after its top.
        const int pose = std::clamp(static_cast<int>(std::floor((ms - 3.0) / 40.0)), 0, 29) % 3;
        const glm::dvec3& place = ms < 450 ? on_body : ms < 950 ? on_head : beside_ball;
        for (const Eye eye : {Eye::left, Eye::right}) {
            GazeSample sample{tracker_at(ms), eye, std::nullopt, 500.0f + static_cast<float>(trial.index)};
            if (ms >= 50)
                sample.gaze = seen_at(header, place, pose);
            if (eye == Eye::left && sample.gaze)
                sample.gaze->x_px += 60.0;
            store.sample(trial.index, sample);
        }
    }
    const auto event = [&](GazeEvent::Kind kind, Eye eye, int from_ms, int until_ms) {
        TrackerEvent found;
        found.kind = kind;
        found.eye = eye;
        found.start = tracker_at(from_ms);
        found.end = tracker_at(until_ms - 2);
        found.duration = std::chrono::milliseconds(until_ms - from_ms);
        store.tracker_item(trial.index, found);
    };
    event(GazeEvent::Kind::blink, Eye::right, -20, 50);
    event(GazeEvent::Kind::fixation, Eye::left, 50, 430);
    event(GazeEvent::Kind::fixation, Eye::right, 50, 450);
    event(GazeEvent::Kind::fixation, Eye::right, 450, 950);
    event(GazeEvent::Kind::fixation, Eye::right, 950, 1150);
    TrialOutcome outcome;
    outcome.task_screen_onset = at_ms(start_ms + 10);
    outcome.presentation_onset = at_ms(onset_ms);
    outcome.presentation_end = at_ms(onset_ms + 1200);
    outcome.response_screen_onset = at_ms(onset_ms + 1210);
    outcome.responded_at = at_ms(onset_ms + 2000);
    outcome.shown_refreshes = 120;
    outcome.missed_refreshes = trial.index;
    outcome.drift = Degrees{0.125 * (trial.index + 1)};
    outcome.answer = "yes";
    if (trial.index == 3)
        outcome.status = TrialOutcome::Status::aborted;
    if (change)
        change(trial, outcome);
    store.trial_finished(trial, outcome);
}

/// The tracker is validated before the first trial and again before the second. The last trial does not
/// count.
inline std::filesystem::path watched_session(const std::filesystem::path& root, const SessionHeader& header,
                                             const ChangedOutcome& change = {}) {
    const std::filesystem::path session = make_session(root, header);
    SessionStore store(session / session_file_name, patient());
    for (const std::int64_t second : {0, 100})
        store.clock_pair(
            {at_ms(1000 * second), tracker_time(5'000'000 + 1'000'000 * second), at_ms(1000 * second)});
    store.observer_fields({{"age", "Age", "34"}});
    store.event({at_ms(5'000), -1, "validation", "mean error 0.300 deg, largest 0.600 deg"});
    for (const Trial& trial : header.schedule.trials) {
        if (trial.index == 1)
            store.event({at_ms(15'000), -1, "validation", "mean error 0.500 deg, largest 0.900 deg"});
        watch_ball(store, header, trial, change);
    }
    store.close();
    return session;
}

inline ReadStudy studied(const std::vector<std::filesystem::path>& sessions,
                         const StudyOptions& options = {}) {
    return read_study(
        sessions, [](const SessionRecord&, std::size_t, const ViewedObject&) { return &maps_of_ball(); },
        options, [](std::string_view, int, int) {});
}

} // namespace overt::testing
