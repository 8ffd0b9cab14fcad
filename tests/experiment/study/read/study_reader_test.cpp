/// Whole sessions of gaze that follows places of a turning ball, read into one study: what was planted comes
/// back.
#include "experiment/study/read/study_reader.h"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "tests/experiment/study/read/watched_ball.h"

using namespace overt;
using namespace overt::testing;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;

TEST_CASE("sessions are read with their trials, their quality and where on the object gaze was", "[unit]") {
    const TemporaryFolder root;
    const SessionHeader first = ball_header("P1"), second = ball_header("P2");
    const std::vector<fs::path> sessions{watched_session(root.path(), first),
                                         watched_session(root.path(), second)};
    const ReadStudy study = studied(sessions);
    const StudyResults& results = study.results;

    REQUIRE(results.sessions.size() == 2);
    CHECK(results.sessions[0].folder == sessions[0].filename());
    CHECK(results.sessions[1].observer == "P2");
    CHECK(results.sessions[0].number == 1);
    CHECK(results.sessions[0].protocol == "Balls");
    CHECK(results.sessions[0].form == std::vector<StudyKey>{{"age", "34"}});
    CHECK_FALSE(results.sessions[0].is_complete);
    CHECK(results.sessions[0].trials == 3);
    CHECK(study.levels.at("material") == std::vector<std::string>{"gold", "silver"});
    CHECK_FALSE(study.levels.contains("slot"));
    CHECK(study.levels.at("task") == std::vector<std::string>{"free", "age"});

    // One object, in both sessions, whose unit is as long as it is shown.
    REQUIRE(results.objects.size() == 1);
    const StudyObject& ball = results.objects[0];
    const double depth = glm::length(first.objects[0].camera(0).position);
    const double mm_per_unit =
        150.0 * 330.0 / 600.0 /
        (2.0 * std::tan(0.5 * first.objects[0].camera(0).vertical_fov.value * 3.14159265358979 / 180.0) *
         depth);
    CHECK(ball.id == "ball");
    CHECK(ball.title == "A ball");
    CHECK(*ball.mm_per_unit == Approx(mm_per_unit).epsilon(0.01));
    CHECK(*ball.shown_size == Approx(1.0));
    CHECK(*ball.mm_per_deg == Approx(571.0 * std::tan(3.14159265358979 / 180.0)));
    CHECK(ball.areas.has("head"));
    CHECK(ball.unit == "own");
    CHECK(ball.screen.image_px == glm::ivec2(160, 150));

    REQUIRE(results.trials.size() == 6);
    for (std::size_t t = 0; t < 6; ++t) {
        CAPTURE(t);
        const StudyTrial& trial = results.trials[t];
        const int index = static_cast<int>(t % 3);
        CHECK(trial.session == static_cast<int>(t / 3));
        CHECK(trial.object == 0);
        CHECK(trial.number == index + 1);
        CHECK(trial.label ==
              "observer P" + std::to_string(t / 3 + 1) + ", trial " + std::to_string(index + 1));
        CHECK(trial.key("material") == (index == 1 ? "gold" : "silver"));
        CHECK(trial.key("task") == (index == 0 ? "age" : "free"));
        CHECK(trial.key("observer") == (t < 3 ? "P1" : "P2"));
        CHECK(trial.key("age") == "34");
        CHECK(trial.key("session") == "1");
        CHECK(trial.presentation_s == Approx(1.2));
        CHECK(trial.has_gaze);
        CHECK_FALSE(trial.excluded);
        // That which was valid when the trial began.
        CHECK(*trial.quality.accuracy_deg == (index == 0 ? 0.3 : 0.5));
        CHECK(*trial.quality.worst_accuracy_deg == (index == 0 ? 0.6 : 0.9));
        CHECK(*trial.quality.drift_deg == 0.125 * (index + 1));
        CHECK(*trial.quality.missed_refreshes == index);
        CHECK(trial.quality.refreshes == 120 + index);
        CHECK(*trial.quality.rate_hz == Approx(500.0));
        CHECK(trial.quality.samples == 650);
        CHECK(trial.quality.blinks == 1);
        CHECK(trial.quality.lost_in_blinks == 35);
        CHECK(trial.quality.lost == 40);
        REQUIRE(trial.turns.size() == 30);
        CHECK(trial.turns[1].time_s == Approx(0.04));
        CHECK(trial.turns[1].angle_deg == Approx(0.0));
        CHECK(trial.turns[2].angle_deg == 15.0);
        CHECK(trial.turns[29].frame == 2);

        REQUIRE(trial.fixations == 3);
        const StudyFixation* const fixations = &results.fixations[trial.first_fixation];
        for (int i = 0; i < 2; ++i) {
            const StudyFixation& fixation = fixations[i];
            const glm::dvec3& place = i == 0 ? on_body : on_head;
            CAPTURE(i);
            CHECK(fixation.trial == static_cast<int>(t));
            CHECK(fixation.counted());
            CHECK(fixation.onset_s == Approx(i == 0 ? 0.05 : 0.45).margin(1e-4));
            CHECK(fixation.duration_s == Approx(i == 0 ? 0.4 : 0.5).margin(1e-4));
            CHECK(glm::distance(fixation.position, place) < 1.5); // a pixel is a unit
            CHECK(fixation.part == (i == 0 ? PartIndex{0} : PartIndex{1}));
            CHECK(fixation.samples == (i == 0 ? 200 : 250));
            CHECK(fixation.on_surface == 1.0);
            CHECK(fixation.within_reach == 0.0);
            CHECK(fixation.first_frame >= 0);
            CHECK(fixation.last_frame <= 2);
            CHECK(fixation.surface_way_deg2 > 0.0);
            CHECK(fixation.gaze_with_surface_deg2 == Approx(fixation.surface_way_deg2).epsilon(0.2));
            CHECK(fixation.sigma_mm == Approx(fixation.mm_per_deg));
            // The cone is of the tracker's error, and lies on the ball.
            CHECK(fixation.cone_at_edge.value() < 0.1);
            CHECK(fixation.cone_mm.value() > 0.9 * (index == 0 ? 0.3 : 0.5) * fixation.mm_per_deg);
            CHECK(fixation.cone_mm.value() < 3.0 * (index == 0 ? 0.3 : 0.5) * fixation.mm_per_deg);
            CHECK(fixation.displaced_motion.value().surface_way_deg2 ==
                  Approx(fixation.surface_way_deg2).epsilon(0.5));
            CHECK(fixation.lut_mm.value() < 0.01);
        }
        CHECK(fixations[2].why == NotCounted::not_on_surface);
        CHECK(fixations[2].on_surface == 0.0);
    }
    REQUIRE(results.traces.size() == 6);
    CHECK(results.traces[4].trial == 4);
    CHECK(results.traces[4].events.size() == 4); // of the one eye
    REQUIRE(results.traces[4].points.size() > 100);
    CHECK_FALSE(results.traces[4].points.front().gaze);
    CHECK(results.traces[4].points.front().time_s == Approx(0.0).margin(0.0021));
    CHECK(results.traces[4].points.back().pupil == 501.0f);
    CHECK(results.traces[4].points[100].time_s - results.traces[4].points[99].time_s == Approx(0.008));
    CHECK(results.glance.samples == 6 * 2 * 650); // of both eyes
    REQUIRE(results.session_quality.size() == 2);
    CHECK(results.session_quality[1].samples == 3 * 650);
    CHECK(*results.session_quality[1].missed_refreshes == 3);
    CHECK(*results.session_quality[1].accuracy_deg == Approx((0.3 + 0.5 + 0.5) / 3.0));
    // A ball: its area, and its upper part, is known; each pose is shown for a third of the time.
    REQUIRE(results.exposures.size() == 3);
    CHECK(results.exposures[0].area_mm2 ==
          Approx(4.0 * 3.14159265 * 2500.0 * mm_per_unit * mm_per_unit).epsilon(0.02));
    CHECK(results.exposures[2].area == "head");
    CHECK(results.exposures[2].share_of_area == Approx((50.0 - 20.0) / 100.0).margin(0.03));
    CHECK(*std::ranges::max_element(ball.seconds_visible) == Approx(1.2f));
    std::string remarks;
    for (const std::string& remark : results.remarks)
        remarks += remark + "\n";
    CHECK_THAT(remarks, Contains("Of binocular recordings the eye that the session names is taken."));
    CHECK(study.surfaces.at(0).scale->mm_per_unit == *ball.mm_per_unit);
}

TEST_CASE("sessions read one by one and joined are those read at once, and not when they have gone on",
          "[unit]") {
    const TemporaryFolder root;
    const std::vector<fs::path> sessions{
        watched_session(root.path(), ball_header("P1")), watched_session(root.path(), ball_header("P2")),
        watched_session(root.path(), ball_header("P3")), watched_session(root.path(), ball_header("P4"))};
    const SurfaceFor surface = [](const SessionRecord&, std::size_t, const ViewedObject&) {
        return &maps_of_ball();
    };
    const StudyProgress progress = [](std::string_view, int, int) {};
    std::vector<ReadSession> read;
    for (const fs::path& session : sessions)
        read.push_back(read_sessions(std::array{session}, surface, {}, progress).at(0));
    const StudyResults joined = join_sessions(read, surface, {}, progress).results,
                       whole = studied(sessions).results;
    REQUIRE(joined.fixations.size() == whole.fixations.size());
    for (std::size_t i = 0; i < whole.fixations.size(); ++i) {
        CHECK(joined.fixations[i].position == whole.fixations[i].position);
        CHECK(joined.fixations[i].trial == whole.fixations[i].trial);
        CHECK(joined.fixations[i].evidence.size() == whole.fixations[i].evidence.size());
    }
    // Of so many fixations each is told for one part or the other.
    for (std::size_t i = 0; i < whole.fixations.size(); ++i) {
        const std::vector<AreaEvidence>& evidence = whole.fixations[i].evidence;
        if (i % 3 == 2) // beside the ball
            continue;
        CAPTURE(i);
        REQUIRE(evidence.size() == 2);
        const std::size_t own = i % 3, other = 1 - own; // body, head
        CHECK(evidence[own].inside > 10.0 * evidence[own].elsewhere);
        CHECK(evidence[other].elsewhere > 10.0 * evidence[other].inside);
        CHECK(joined.fixations[i].evidence.at(0).inside == evidence[0].inside);
    }
    CHECK(joined.sessions[1].events == whole.sessions[1].events);
    CHECK(joined.exposures.size() == whole.exposures.size());
    read[1].state = "another";
    CHECK_THROWS_WITH(join_sessions(read, surface, {}, progress), Contains("has changed since it was read"));
}

TEST_CASE("sessions that would count twice, and observers that are not there, are refused", "[unit]") {
    const TemporaryFolder root, copies;
    const fs::path session = watched_session(root.path(), ball_header("P1"));
    CHECK_THROWS_WITH(studied({session, session}), Contains("named twice"));
    fs::copy(session, copies.path() / "copy", fs::copy_options::recursive);
    CHECK_THROWS_WITH(studied({session, copies.path() / "copy"}),
                      Contains("is the same session as") &&
                          Contains("(observer P1, session 1, begun 2024-03-01"));
    StudyOptions options;
    options.same_observer = {{"P2", "P1"}};
    CHECK_THROWS_WITH(studied({session}, options), Contains("no session is of observer P2"));
    StudyOptions another;
    another.same_observer = {{"P1", "P1"}, {"P9", "P1"}};
    CHECK_THROWS_WITH(studied({session}, another), Contains("no session is of observer P9"));
    const fs::path other = watched_session(root.path(), ball_header("P2"));
    const StudyResults results = studied({session, other}, options).results;
    CHECK(results.sessions[1].observer == "P1");
    CHECK(results.trials[4].key("observer") == "P1");
}

TEST_CASE("trials beyond a limit are excluded with the reason, and their fixations with them", "[unit]") {
    const TemporaryFolder root;
    const fs::path session = watched_session(root.path(), ball_header("P1"));
    const auto excluded = [&](const auto& limit) {
        StudyOptions options;
        limit(options.exclude);
        std::string all;
        const StudyResults results = studied({session}, options).results;
        for (const StudyTrial& trial : results.trials) {
            all += std::to_string(trial.number) + (trial.excluded ? ": " + trial.why_excluded : "") + " ";
            CHECK((results.fixations[trial.first_fixation].why == NotCounted::trial_excluded) ==
                  trial.excluded);
        }
        return all;
    };
    CHECK(excluded([](ExclusionRules&) {}) == "1 2 3 ");
    CHECK(excluded([](ExclusionRules& rules) { rules.most_accuracy_deg = 0.4; }) ==
          "1 2: The validation before it had a mean error of 0.50 deg. 3: The "
          "validation before it had a mean error of 0.50 deg. ");
    CHECK(excluded([](ExclusionRules& rules) { rules.most_drift_deg = 0.25; }) ==
          "1 2 3: The drift check found an error of 0.38 deg. ");
    CHECK(excluded([](ExclusionRules& rules) { rules.most_missed_refreshes = 1; }) ==
          "1 2 3: 2 refreshes were missed. ");
    const std::string lost = excluded([](ExclusionRules& rules) { rules.most_lost_share = 0.05; });
    CHECK_THAT(lost, Contains("1: 6.2 % of the samples were lost outside of blinks."));
}

TEST_CASE("objects of sessions are one only where picture and mesh are the same", "[unit]") {
    const TemporaryFolder root;
    const fs::path first = make_session(root.path(), ball_header("P1")); // nobody has seen it yet
    int number = 2;
    const auto objects = [&](const auto& change) {
        SessionHeader header = ball_header("Q" + std::to_string(number++));
        change(header);
        return studied({first, make_session(root.path(), header)}).results.objects.size();
    };
    CHECK(objects([](SessionHeader&) {}) == 1);
    CHECK(objects([](SessionHeader& h) { h.objects[0].mesh_sha256 = std::string(64, 'b'); }) == 2);
    CHECK(objects([](SessionHeader& h) { h.objects[0].cameras[0].position.x += 1.0; }) == 2);
    CHECK(objects([](SessionHeader& h) { h.display.screen.viewing_distance_mm += 1.0; }) == 2);
    CHECK(objects([](SessionHeader& h) { h.objects[0].title = "Another title"; }) == 1);
}

TEST_CASE("what cannot be looked up is said, and its gaze is not counted", "[unit]") {
    const TemporaryFolder root;
    const std::vector<fs::path> sessions{watched_session(root.path(), ball_header("P1"))};
    const StudyProgress progress = [](std::string_view, int, int) {};
    const auto remarks = [&](const SurfaceFor& surface) {
        const StudyResults results = read_study(sessions, surface, {}, progress).results;
        for (const StudyFixation& fixation : results.fixations)
            CHECK(fixation.why == NotCounted::no_surface);
        std::string all;
        for (const std::string& remark : results.remarks)
            all += remark + "\n";
        return all;
    };
    CHECK_THAT(remarks([](const SessionRecord&, std::size_t, const ViewedObject&) -> const SurfaceLookup* {
                   return nullptr;
               }),
               Contains("The sessions have no maps of ball"));
    SessionHeader unknown = ball_header("P2");
    unknown.display.screen.viewing_distance_mm = 0.0;
    CHECK(studied({make_session(root.path(), unknown)}).results.objects.at(0).remark ==
          "The camera or the screen of ball is not known: there are no millimetres, and no maps.");
    CHECK(studied({sessions[0]}).results.objects.at(0).remark.empty());
    CHECK_THAT(remarks([](const SessionRecord&, std::size_t, const ViewedObject&) -> const SurfaceLookup* {
                   throw InputError("a map is damaged");
               }),
               Contains("The maps of ball cannot be used, so its gaze is not counted: a map is damaged"));
}
