/// A session with a tracker without errors, exported and held against what the simulated observer really saw.
#include <catch2/catch.hpp>

#include <algorithm>
#include <map>
#include <set>

#include "experiment/events/event_agreement.h"
#include "experiment/events/event_detector.h"
#include "experiment/record/read/observer_turns.h"
#include "tests/app/session/exact_sitting.h"
#include "tests/app/two_eyed_experiment.h"
#include "tests/experiment/events/detected_events.h"
#include "tests/support/tsv_file.h"

using namespace overt;
using namespace overt::test;

namespace {

/// With two lights, two motions that share a pose, and two views.
std::string protocol_of_lists() {
    std::string text = with(small_protocol, "[view]\nwidth_px = 128\nheight_px = 128\n",
                            R"([[view]]
id = "front"
width_px = 128
height_px = 128

[[view]]
id = "above"
width_px = 128
height_px = 128
camera_position = [300, -900, 700]

[[light]]
id = "cloudy"

[[light]]
id = "behind"
rotation_deg = 180
)");
    text =
        with(text, "[animation]\nframe_count = 31\nframe_rate_hz = 30\namplitude_deg = 25\nduration_s = 1\n",
             R"([[motion]]
id = "turn"
frame_count = 31
frame_rate_hz = 30
amplitude_deg = 25
duration_s = 1

[[motion]]
id = "lamp"
kind = "still"
angle_deg = 23.776412907378838
light_amplitude_deg = 40
frame_count = 5
frame_rate_hz = 10
duration_s = 0.5
)");
    return text;
}

void check_places(ExactSitting& sitting, int least_samples, int least_compared);

} // namespace

TEST_CASE("each exported gaze sample is where the observer's gaze met the surface", "[session]") {
    ExactSitting sitting;
    check_places(sitting, 10000, 6000);
}

TEST_CASE("gaze meets the surface of an object that turns about an axis of its own under a moving light",
          "[session]") {
    ExactSitting sitting(
        with(small_protocol, "amplitude_deg = 25\n",
             "amplitude_deg = 25\naxis = [1, 0.4, 0.3]\npivot = [10, 0, -60]\nlight_turns = 1\n"));
    check_places(sitting, 10000, 5000);
    const SessionRecord record(sitting.folder);
    const PoseTable& poses = record.header().poses;
    CHECK(poses.angles.size() == 15); // of 31 frames; at the middle it stands as ever
    CHECK(std::ranges::count_if(poses.angles, &ObjectPose::is_turn) == 1);
    const Animation& recorded = record.header().animations.front();
    const Animation& planned = sitting.protocol.motions.front();
    for (int frame = 0; frame < planned.frame_count; ++frame)
        CHECK(recorded.pose_of({frame}) == planned.pose_of({frame}));
}

TEST_CASE("gaze meets the surface in the pose that the observer had turned the object to", "[session]") {
    ExactSitting sitting(
        with(small_protocol, "frame_count = 31\nframe_rate_hz = 30\namplitude_deg = 25\nduration_s = 1\n",
             "kind = \"observer\"\nwith = \"keys\"\nstep_deg = 5\nfrom_deg = -60\nto_deg = 60\n"
             "speed_deg_s = 90\nsimulated_turn_deg = 60\nsimulated_pause_s = 0.1\n"
             "duration_s = 1\n"));
    check_places(sitting, 10000, 4000);
    const SessionRecord record(sitting.folder);
    // What was lit is where keys had turned it by the refresh before, to the nearest pose.
    int turned = 0;
    for (const TrialRecord& trial : record.trials()) {
        const TrialRecord seen = trial.seen_in(0);
        const std::vector<FlipRecord> flips = record.flips(seen);
        REQUIRE(record.steered_flips(seen).size() == flips.size());
        for (const ObserverTurns& turns : observer_turns(record, seen, record.ledger(seen))) {
            turned += turns.path.value > 20.0;
            CHECK(std::abs(turns.net.value) <= turns.path.value + 1e-9);
            if (turns.median_delay_s) {
                CHECK(*turns.median_delay_s > 0.0);
                CHECK(*turns.longest_delay_s <= 2.01 / 120.0);
            }
        }
        CHECK(trial.outcome.given.empty());
        for (const AnswerInput& input : trial.outcome.inputs)
            CHECK(input.id == sitting.protocol.motions.front().id);
    }
    CHECK(turned > static_cast<int>(record.trials().size()) / 2);
}

TEST_CASE("gaze meets the surface that its own eye's picture shows", "[session]") {
    for (const char* const eye : {"left", "right"}) {
        CAPTURE(eye);
        ExactSitting sitting(two_eyed(eye));
        check_places(sitting, 10000, 5000);
        const SessionHeader& header = SessionRecord(sitting.folder).header();
        CHECK(header.display.screen.screen_px == glm::ivec2(272, 192));
        CHECK(header.display.screen.screen_mm.x == Approx(136.0));
        CHECK(header.display.stereo == "mirrors");
        CHECK(header.display.interocular_mm == 70.0);
        CHECK(header.maps.size() == 2 * 2 * header.poses.angles.size());
        for (const RecordedObject& object : header.objects) {
            REQUIRE(object.cameras.size() == 2);
            CHECK(object.cameras[0].aside < -1.0);
            CHECK(object.cameras[1].aside == -object.cameras[0].aside);
        }
    }
}

TEST_CASE("gaze meets the surface in the pose and the view of its trial", "[session]") {
    ExactSitting sitting(protocol_of_lists());
    check_places(sitting, 10000, 5000);
    const SessionRecord record(sitting.folder);
    const SessionHeader& header = record.header();
    // The lamp's pose is one that the turn has, and no light has maps of its own.
    CHECK(header.poses.of_motion.size() == 2);
    CHECK(std::ranges::count(header.poses.of_motion[0], header.poses.of_motion[1].front()) > 0);
    CHECK(header.maps.size() == 2 * 2 * header.poses.angles.size());
    CHECK(header.stimuli.size() == 2u * 2u * 2u * 2u * 2u);
    std::set<int> lights, motions, views;
    for (const TrialRecord& trial : record.trials()) {
        const Stimulus& stimulus = trial.trial.stimulus;
        lights.insert(stimulus.light);
        motions.insert(stimulus.motion);
        views.insert(stimulus.view);
        const PageCycle cycle = header.page_cycle_of(stimulus);
        CHECK(trial.outcome.shown_refreshes == cycle.total_refreshes);
        CHECK(cycle.total_refreshes == (stimulus.motion == 0 ? 120 : 60));
        CHECK(trial.trial == header.schedule.trials[static_cast<std::size_t>(trial.trial.index)]);
    }
    for (const auto& levels : {lights, motions, views})
        CHECK(levels.size() == 2);
}

namespace {

void check_places(ExactSitting& sitting, int least_samples, int least_compared) {
    const TsvFile samples(sitting.run() / "samples.tsv");
    REQUIRE(static_cast<int>(samples.size()) > least_samples);

    int compared = 0, on_another_frame = 0, elsewhere = 0, missing = 0, invented = 0;
    double farthest_px = 0.0, latest_s = 0.0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const TrackerTime sampled_at{TrackerClock::duration(samples.integer(i, "tracker_time_us"))};
        const SessionTime at = sitting.tracker.session_time_at(sampled_at);
        const GazeTruth truth = sitting.observer.truth_at(at);
        latest_s = std::max(latest_s, std::abs(samples.number(i, "time_s") - to_seconds(at)));
        if (!samples.has(i, "x_px")) {
            CHECK(truth.gaze.state == EyeState::blink);
            continue;
        }
        farthest_px = std::max({farthest_px, std::abs(samples.number(i, "x_px") - truth.gaze.place.x_px),
                                std::abs(samples.number(i, "y_px") - truth.gaze.place.y_px)});
        // Frames are compared where both know one: at a change of frames the reading of clocks decides.
        const bool has_frame = samples.has(i, "frame");
        if (has_frame != truth.frame.has_value() ||
            (has_frame && samples.integer(i, "frame") != truth.frame->value)) {
            ++on_another_frame;
            continue;
        }
        const bool has_surface = samples.has(i, "surface_x");
        missing += truth.surface && !has_surface;
        invented += !truth.surface && has_surface;
        if (!truth.surface || !has_surface)
            continue;
        ++compared;
        const glm::dvec3 exported(samples.number(i, "surface_x"), samples.number(i, "surface_y"),
                                  samples.number(i, "surface_z"));
        // Six decimals are exported of each coordinate.
        elsewhere += glm::distance(exported, truth.surface->position) > 1e-6;
    }
    CHECK(compared > least_compared);
    CHECK(elsewhere == 0);
    // Right on an outline the last digit may decide.
    CHECK(missing == 0);
    CHECK(invented == 0);
    CHECK(on_another_frame <= static_cast<int>(samples.size()) / 1000);
    CHECK(farthest_px < 0.0006); // of a pixel, three
    CHECK(latest_s < 2e-5);      // as well as both clocks were read together
}

} // namespace

TEST_CASE("the fixations of a simulated observer come back from its session", "[session]") {
    ExactSitting sitting;
    const TsvFile events(sitting.run() / "gaze_events.tsv");
    const SessionRecord record(sitting.folder);
    EventAgreement fixations(GazeEvent::Kind::fixation), saccades(GazeEvent::Kind::saccade);
    std::size_t row = 0;
    for (const TrialRecord& trial : record.trials()) {
        const std::vector<GazeSample> samples = record.samples(trial);
        std::vector<GazeEvent> recorded;
        record.read_gaze_events(trial, [&](const GazeEvent& event) { recorded.push_back(event); });
        // What was found while the session ran is what its samples give.
        testing::EventList again;
        EventDetector detector(sitting.protocol.events, GazeAngles(sitting.geometry), again);
        for (const GazeSample& sample : samples)
            detector.push(sample);
        detector.finish();
        CHECK(recorded.size() == again.events.size());
        for (std::size_t i = 0; i < std::min(recorded.size(), again.events.size()); ++i) {
            CHECK(recorded[i].kind == again.events[i].kind);
            CHECK(recorded[i].start == again.events[i].start);
            CHECK(recorded[i].end == again.events[i].end);
            REQUIRE(row < events.size());
            CHECK(events.text(row, "kind") == name_of(recorded[i].kind));
            CHECK(events.text(row, "detector") == "overt");
            CHECK(events.integer(row, "tracker_start_us") == recorded[i].start.time_since_epoch().count());
            ++row;
        }
        std::stable_sort(recorded.begin(), recorded.end(),
                         [](const GazeEvent& a, const GazeEvent& b) { return a.start < b.start; });
        // What the observer did, by the samples that fell into it.
        std::vector<GazeEvent> done;
        for (const GazeSample& sample : samples) {
            const EyeState state =
                sitting.observer.truth_at(sitting.tracker.session_time_at(sample.sampled_at)).gaze.state;
            const GazeEvent::Kind kind = state == EyeState::fixation  ? GazeEvent::Kind::fixation
                                         : state == EyeState::saccade ? GazeEvent::Kind::saccade
                                                                      : GazeEvent::Kind::blink;
            if (done.empty() || done.back().kind != kind) {
                done.emplace_back();
                done.back().kind = kind;
                done.back().start = sample.sampled_at;
            }
            done.back().end = sample.sampled_at;
            done.back().duration = done.back().end - done.back().start + TrackerClock::duration(500);
        }
        // A blink lies in a saccade.
        for (std::size_t i = done.size(); i-- > 0;)
            if (done[i].kind == GazeEvent::Kind::blink) {
                GazeEvent lid = done[i];
                lid.kind = GazeEvent::Kind::saccade;
                done.insert(done.begin() + static_cast<std::ptrdiff_t>(i), lid);
            }
        fixations.add(done, recorded);
        saccades.add(done, recorded);
    }
    CHECK(row == events.size());
    REQUIRE(fixations.in_reference() > 30);
    CHECK(fixations.f1() > 0.95);
    // Of a saccade of less than a degree hardly half is faster than 30 deg/s.
    CHECK(saccades.f1() > 0.7);
    CHECK(fixations.median_onset_error_ms().value() <= 4.0);
    CHECK(fixations.median_offset_error_ms().value() <= 4.0);
}

TEST_CASE("the share of gaze on the head comes back as the tasks had it", "[session]") {
    ExactSitting sitting;
    const TsvFile samples(sitting.run() / "samples.tsv");
    struct Count {
        int head = 0, all = 0;
    };
    std::map<std::string, Count> exported, meant;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const TrackerTime sampled_at{TrackerClock::duration(samples.integer(i, "tracker_time_us"))};
        const GazeTruth truth = sitting.observer.truth_at(sitting.tracker.session_time_at(sampled_at));
        if (!truth.target || !truth.frame || truth.gaze.state != EyeState::fixation)
            continue;
        const std::string& task = samples.text(i, "task");
        const auto trial = static_cast<std::size_t>(samples.integer(i, "trial") - 1);
        const int object = sitting.schedule.trials.at(trial).stimulus.object;
        const Mesh& mesh = sitting.experiment.objects[static_cast<std::size_t>(object)].mesh;
        ++exported[task].all;
        exported[task].head += samples.text(i, "part") == "head";
        ++meant[task].all;
        meant[task].head += mesh.part_names[truth.target->part] == "head";
    }
    REQUIRE(exported.size() == 3);
    for (const auto& [task, count] : exported) {
        CAPTURE(task);
        CHECK(count.all > 400);
        const double share = static_cast<double>(count.head) / count.all;
        CHECK(share == Approx(static_cast<double>(meant[task].head) / meant[task].all).margin(0.02));
        if (task == "face")
            CHECK(share > 0.97);
        if (task == "clothes")
            CHECK(share < 0.03);
    }
}
