/// What is said of a session's tracker, display and stimuli, from records whose values are all different.
#include "experiment/study/read/session_setup.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "experiment/record/gaze_rows.h"
#include "experiment/record/read/session_record.h"
#include "experiment/record/session_schema.h"
#include "tests/experiment/record/session_fixture.h"

using namespace overt;
using namespace overt::testing;

namespace {

template <class Change> SessionSetup setup_with(Change change, const std::string& sql = "") {
    const TemporaryFolder root;
    SessionHeader header = example_header();
    change(header);
    const std::filesystem::path session = make_session(root.path(), header);
    {
        SessionStore store(session / session_file_name, patient());
        const Trial& trial = header.schedule.trials.front();
        store.trial_started(trial, at_ms(1000));
        store.trial_finished(trial, outcome_at(1000));
        store.close();
    }
    if (!sql.empty())
        SQLite::Database((session / session_file_name).string(), SQLite::OPEN_READWRITE).exec(sql);
    return setup_of(SessionRecord(session));
}

const auto as_it_is = [](SessionHeader&) {};

std::vector<std::string> motions_with(const std::function<void(Animation&)>& change) {
    return setup_with([&](SessionHeader& header) {
               Animation& motion = header.animations.front();
               change(motion);
           })
        .stimuli.motions;
}

} // namespace

TEST_CASE("a session's display and stimuli have their sizes in pixels, millimetres and degrees", "[unit]") {
    const SessionSetup setup = setup_with([](SessionHeader& header) {
        RecordedCharacterisation light;
        light.instrument = "A meter";
        light.date = "2024-02-28";
        light.black_xyz = {0.0, 0.5, 0.0};
        light.primaries_xyz = {glm::dvec3{0.0, 20.0, 0.0}, glm::dvec3{0.0, 70.0, 0.0},
                               glm::dvec3{0.0, 9.0, 0.0}};
        header.characterisation = light;
        header.display.timing = "proven";
        header.materials[1].title = "<b>Silver</b>";
    });
    CHECK(setup.display.is_simulated);
    CHECK(setup.display.screen_px == glm::ivec2(800, 600));
    CHECK(setup.display.screen_mm == glm::dvec2(400.5, 300.25));
    CHECK(setup.display.viewing_distance_mm == 571.0);
    const double mm_per_deg = 571.0 * std::tan(3.14159265358979 / 180.0);
    CHECK(*setup.display.px_per_deg == Approx(mm_per_deg * 800.0 / 400.5).epsilon(1e-3));
    CHECK(setup.display.refresh_hz == 100.0);
    CHECK(setup.display.latency_ms == Approx(1.5));
    CHECK(setup.display.timing == "proven");
    REQUIRE(setup.display.light);
    CHECK(setup.display.light->white_cd_m2 == 99.5);
    CHECK(setup.display.light->instrument == "A meter");
    CHECK(setup.display.light->date == "2024-02-28");
    CHECK(setup.stimuli.image_px == glm::ivec2(512, 511));
    REQUIRE(setup.stimuli.image_deg);
    const auto degrees = [](double mm) {
        return 2.0 * std::atan(mm / 2.0 / 571.0) * 180.0 / 3.14159265358979;
    };
    CHECK(setup.stimuli.image_deg->x == Approx(degrees(512.0 * 400.5 / 800.0)));
    CHECK(setup.stimuli.image_deg->y == Approx(degrees(511.0 * 300.25 / 600.0)));
    CHECK(setup.stimuli.frame_count == 3);
    CHECK(setup.stimuli.frame_rate_hz == 25.0);
    CHECK(setup.stimuli.amplitude_deg == 12.5);
    CHECK(setup.stimuli.playback == Playback::ping_pong);
    CHECK(setup.stimuli.duration_s == 2.52);
    CHECK(setup.stimuli.motions.empty()); // one turn about the front under a light that stands
    CHECK(setup.materials == std::vector<NamedThing>{{"gold", "Gold"}, {"silver", "Silver"}});
    CHECK(setup.tasks.at(0) == NamedThing{"free", "Look around"});
    CHECK(setup.program_version == "0.1.0");
    CHECK(setup.imported_file.empty());
    CHECK_FALSE(setup.presenter);

    const SessionSetup unknown = setup_with([](SessionHeader& header) {
        header.display.screen.viewing_distance_mm = 0.0;
        header.clock = ClockKind::steady;
    });
    CHECK_FALSE(unknown.display.px_per_deg);
    CHECK_FALSE(unknown.stimuli.image_deg);
    CHECK_FALSE(unknown.display.light);
    CHECK_FALSE(unknown.display.is_simulated);
}

TEST_CASE("where gaze comes from follows from the tracker's name, or from the recording it was in",
          "[unit]") {
    const auto named = [](const char* name, const char* model = "") {
        return setup_with([&](SessionHeader& header) {
                   header.tracker = {name, 2000.0, Eye::left};
                   header.tracker.model = model;
                   header.tracker.both_eyes = true;
               })
            .gaze;
    };
    const GazeSetup simulated = named("simulated", "a model");
    CHECK(simulated.origin == GazeOrigin::simulated);
    CHECK(simulated.tracker == "simulated");
    CHECK(simulated.model == "a model");
    CHECK(simulated.rate_hz == 2000.0);
    CHECK(simulated.eye == Eye::left);
    CHECK(simulated.both_eyes);
    CHECK_FALSE(simulated.was_simulated);
    CHECK(named("mouse").origin == GazeOrigin::pointer);
    CHECK(named("none").origin == GazeOrigin::none);
    CHECK(named("eyelink without a tracker").origin == GazeOrigin::none);
    CHECK(named("eyelink").origin == GazeOrigin::measured);
    const GazeSetup played = named("replay", "gaze of sub-01_ses-01, by simulated");
    CHECK(played.origin == GazeOrigin::played_back);
    CHECK(played.was_simulated);
    CHECK_FALSE(named("replay", "gaze of sub-01_ses-01, by eyelink").was_simulated);

    const auto imported = [](const char* tracker, const char* head, double rate_hz) {
        return setup_with(
            [&](SessionHeader& header) {
                header.tracker = {tracker, 2000.0, Eye::left};
            },
            std::string(gaze_tables_sql) + "INSERT INTO gaze_source VALUES (1, 'a.asc', '', '" + head +
                "', 'area', " + std::to_string(rate_hz) + ", 'both', 1, 1, 0)");
    };
    const SessionSetup own =
        imported("eyelink", "** one\n** overt recorded this with the tracker: simulated\r\n** two", 500.0);
    CHECK(own.imported_file == "a.asc");
    CHECK(own.gaze.tracker == "simulated");
    CHECK(own.gaze.was_simulated);
    CHECK(own.gaze.origin == GazeOrigin::imported);
    CHECK(own.gaze.rate_hz == 500.0);
    CHECK(imported("eyelink", "** one", 0.0).gaze.tracker == "eyelink");
    CHECK(imported("eyelink", "** one", 0.0).gaze.rate_hz == 2000.0);
    CHECK(imported("simulated", "** one", 500.0).gaze.tracker.empty());
}

TEST_CASE("calibrations are counted by method, with those beyond the limits", "[unit]") {
    const SessionSetup setup = setup_with(
        as_it_is,
        std::string(gaze_tables_sql) +
            "INSERT INTO calibration (sitting, at_ns, method, mean_deg, max_deg, within_limits) VALUES "
            "(1, 1, 'tracker', 0.3, 0.5, 1), (1, 2, 'own', 0.3, 0.5, 0), (1, 3, 'tracker', 0.3, 0.5, 0), "
            "(1, 4, 'tracker', 0.3, 0.5, 1)");
    CHECK(setup.calibrations ==
          std::vector<SessionSetup::Calibrations>{{"tracker", 3, 1, true}, {"own", 1, 1, true}});
}

TEST_CASE("motions that are no turn about the front are said in words", "[unit]") {
    const auto words = [](const std::function<void(Animation&)>& change) {
        const std::vector<std::string> all = motions_with(change);
        REQUIRE(all.size() == 1);
        return all.front();
    };
    CHECK(words([](Animation& motion) { motion.angle = Degrees{30.0}; }) ==
          "the object turned by 12.5 deg to each side of 30 deg from its front, to and fro about the "
          "vertical as a "
          "sine of time, in 3 frames of one sweep at 25 Hz, for 2.52 s");
    CHECK_THAT(words([](Animation& motion) {
                   motion.angle = Degrees{30.0};
                   motion.playback = Playback::cycle;
               }),
               Catch::Contains("in 3 frames of one period at 25 Hz"));
    CHECK(words([](Animation& motion) {
              motion.amplitude = {};
              motion.angle = Degrees{30.0};
          }) == "the object stood at 30 deg from its front");
    CHECK(words([](Animation& motion) { motion.light_amplitude = Degrees{4.0}; }) ==
          "the object turned by 12.5 deg to each side and the light turned by 4 deg to each side, to "
          "and fro about "
          "the vertical as a sine of time, in 3 frames of one sweep at 25 Hz, for 2.52 s");
    const auto turntable = [&](double light_deg) {
        return words([=](Animation& motion) {
            motion.kind = MotionKind::turntable;
            motion.turns = 2;
            motion.light_amplitude = Degrees{light_deg};
        });
    };
    CHECK_THAT(turntable(4.0),
               Catch::StartsWith("the object moved: ") &&
                   Catch::EndsWith(", and the light 4 deg to each side, in 3 frames at 25 Hz, for 2.52 s"));
    CHECK_THAT(turntable(0.0),
               !Catch::Contains("light") && Catch::EndsWith(", in 3 frames at 25 Hz, for 2.52 s"));
    CHECK(words([](Animation& motion) { motion.kind = MotionKind::recorded; }) ==
          "the object turned as observers of earlier sessions had turned it, refresh by refresh");
    const std::string turned = words([](Animation& motion) {
        motion.kind = MotionKind::observer;
        motion.by_observer.step = Degrees{3.0};
        motion.by_observer.from = Degrees{-20.0};
        motion.by_observer.to = Degrees{40.0};
        motion.by_observer.elevation_step = Degrees{5.0};
        motion.by_observer.elevation_from = Degrees{-10.0};
        motion.by_observer.elevation_to = Degrees{15.0};
    });
    CHECK(turned ==
          "the observer turned the object about the vertical, from -20 to 40 deg, from pose to pose 3 deg "
          "apart, and tilted it from -10 to 15 deg, 5 deg apart");
}

TEST_CASE("sizes in degrees are told only where every size of the screen is known", "[unit]") {
    struct Unknown {
        std::function<void(ScreenGeometry&)> change;
        bool has_px_per_deg;
    };
    const std::vector<Unknown> unknowns{
        {[](ScreenGeometry&) {}, true},
        {[](ScreenGeometry& screen) { screen.viewing_distance_mm = 0.0; }, false},
        {[](ScreenGeometry& screen) { screen.screen_mm.x = 0.0; }, false},
        {[](ScreenGeometry& screen) { screen.screen_mm.y = 0.0; }, true}};
    for (std::size_t i = 0; i < unknowns.size(); ++i) {
        CAPTURE(i);
        const SessionSetup setup =
            setup_with([&](SessionHeader& header) { unknowns[i].change(header.display.screen); });
        CHECK(setup.display.px_per_deg.has_value() == unknowns[i].has_px_per_deg);
        CHECK(setup.stimuli.image_deg.has_value() == (i == 0));
    }
}

TEST_CASE("pages of rigs are told once each, in the order of sittings", "[unit]") {
    const auto rigs = [](const std::string& pages) {
        return setup_with(as_it_is, pages.empty()
                                        ? ""
                                        : "INSERT INTO event (sitting, at_ns, kind, detail) VALUES " + pages)
            .rig;
    };
    CHECK(rigs("").empty());
    CHECK(rigs("(1, 5, 'rig page', 'begun: one')") == "begun: one");
    CHECK(rigs("(1, 5, 'rig page', 'begun: two'), (1, 6, 'rig page', 'none: off'), (1, 7, 'rig page', "
               "'begun: two'), "
               "(1, 8, 'another', 'begun: three')") == "begun: two / none: off");
}

TEST_CASE("motions are told from the plainest turn on", "[unit]") {
    // A turn about the front under a light that stands is in the columns, and needs no words.
    const auto has_words = [](const std::function<void(Animation&)>& change) {
        return !motions_with(change).empty();
    };
    CHECK_FALSE(has_words([](Animation&) {}));
    CHECK(has_words([](Animation& motion) { motion.angle = Degrees{1.0}; }));
    CHECK(has_words([](Animation& motion) { motion.light_turns = 1; }));
    CHECK(has_words([](Animation& motion) { motion.kind = MotionKind::still; }));
    const auto words = [](const std::function<void(Animation&)>& change) {
        return motions_with(change).at(0);
    };
    CHECK(words([](Animation& motion) { motion.kind = MotionKind::still; }) == "the object stood");
    CHECK(words([](Animation& motion) {
              motion.kind = MotionKind::still;
              motion.light_amplitude = Degrees{7.0};
          }) == "the object stood and the light turned by 7 deg to each side, to and fro about the vertical "
                "as a sine of "
                "time, in 3 frames of one sweep at 25 Hz, for 2.52 s");
    CHECK(words([](Animation& motion) { motion.light_turns = 1; }) ==
          "the object moved: 12.5 deg to each side, and the light once all the way round, counter-clockwise, "
          "in 3 "
          "frames at 25 Hz, for 2.52 s");
    CHECK(words([](Animation& motion) { motion.kind = MotionKind::observer; }) ==
          "the observer turned the object about the vertical, all round, from pose to pose 2 deg apart");
    const SessionSetup two = setup_with([](SessionHeader& header) {
        header.animations.push_back(header.animations.front());
        header.animations.back().kind = MotionKind::still;
        header.motions = {{.id = "one"}, {.id = "two"}};
        header.poses.of_motion.push_back(header.poses.of_motion.front());
    });
    CHECK(two.stimuli.motions.size() == 2);
}

TEST_CASE("a session that knows of no stimulus says nothing of them, and names who presented", "[unit]") {
    const SessionSetup setup = setup_with(
        [](SessionHeader& header) {
            header.stimuli.clear();
            header.maps.clear();
            for (RecordedObject& object : header.objects)
                object.mesh_file.clear();
        },
        "INSERT INTO event (sitting, at_ns, kind, detail) VALUES (1, 5, 'gaze imported', 'gaze of A; trials "
        "of B; more')");
    CHECK(setup.presenter == "B");
    CHECK(setup.gaze.origin == GazeOrigin::imported);
    CHECK(setup.materials.empty());
    CHECK(setup.tasks.empty());
    CHECK(setup.stimuli.frame_count == StimulusSetup{}.frame_count);
    CHECK(setup.stimuli.motions.empty());
}
